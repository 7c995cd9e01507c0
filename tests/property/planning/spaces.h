// SPDX-License-Identifier: MIT
// Worlds whose collisions are formulas: a point, a planar linkage and an arm of seven DOFs among
// moving discs, spheres and capsules, for tests of search, smoothing and curve.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/planning/state_space.h"

namespace elbowroom::test {

// A ball (or disc) that moves on a straight line, and from `appears` on only.
struct Ball {
  Vec3 place{0.0};     // at t = 0
  Vec3 velocity{0.0};  // units a second
  double radius = 0.1;
  double appears = -1e30;
  double vanishes = 1e30;
};

// A capsule that stands still: a post.
struct Post {
  Vec3 from{0.0}, to{0.0};
  double radius = 0.02;
};

// Distance of two segments; of a point, when both ends of one are the same.
double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// A world of segments with thickness, told by a function of (q, t), among balls and posts.
class SegmentSpace : public StateSpace {
 public:
  struct Segment {
    Vec3 from, to;
    double radius;
  };
  using Place = std::function<void(const Configuration&, std::vector<Segment>&)>;

  std::string name;
  DofSpace space;
  Place place;
  std::vector<Ball> balls;
  std::vector<Post> posts;
  std::vector<double> steps;
  double length_unit = 1;
  std::int64_t calls = 0;
  std::function<void()> on_call;  // for tests that interfere

  bool valid(const Configuration& c) override;
  void metric_points(const Configuration& c, std::vector<Vec3>& points) override;
  const std::vector<double>& step_times() const override { return steps; }

 private:
  std::vector<Segment> segments_;
};

// A point in the square [-1, 1]², thin as a pencil; 2 DOFs.
SegmentSpace point_space();
// A planar linkage of n links, each of length 1/n, on a base at the origin; n flexion-like DOFs.
SegmentSpace linkage_space(int links);
// Shoulder (swing in an ellipse, twist), elbow (flexion, twist), wrist (swing): 7 DOFs, 0.6 long;
// its base walks along +z at `pace` units a second. `umbrella`: length of one held across the hand,
// its canopy two crossed bars; 0 for none.
SegmentSpace arm_space(double pace, double umbrella);

// Problems with an answer, each with start and goal: what all property tests run over.
struct Problem {
  SegmentSpace world;
  Configuration init, goal;
  Dofs velocity_init, velocity_goal;
  std::function<Dofs(double)> clip;  // collides on the way
};
std::vector<Problem> problems();

Dofs dofs(std::initializer_list<double> values);

}  // namespace elbowroom::test
