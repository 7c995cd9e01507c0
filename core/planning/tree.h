// SPDX-License-Identifier: MIT
// One search tree of the planner [SKF07 4.1]: nodes with their metric points kept apart, coordinate
// by coordinate, so that the linear search for the nearest node runs over plain arrays.
#pragma once

#include <cstddef>
#include <vector>

#include "core/planning/state_space.h"

namespace elbowroom {

// dist(a, b) = time_weight |a.t - b.t| + posture_weight max |p_a - p_b|.
struct MetricWeights {
  double time = 1;     // scene units a second
  double posture = 1;  // 1
};

double metric_distance(const MetricWeights& weights, double t_a, const std::vector<Vec3>& points_a,
                       double t_b, const std::vector<Vec3>& points_b);

class Tree {
 public:
  // Grows forward in time (T_init) or backward (T_goal).
  enum class Direction { forward, backward };
  Tree(Direction direction, const MetricWeights& weights);

  // Returns the new node's index; parent -1 for the root.
  int add(const Configuration& c, const std::vector<Vec3>& points, int parent);

  // The node nearest to (t, points) among those at least `time_step` before it (after it, for a
  // tree that grows backward); the oldest of equals; -1 if there is none.
  int nearest(double t, const std::vector<Vec3>& points, double time_step);

  // Takes node i, which is not the root, and all that grew from it out of later searches. Indices
  // stay as they are.
  void cut(int i);
  bool is_cut(int i) const;

  Direction direction() const { return direction_; }
  int size() const { return static_cast<int>(nodes_.size()); }
  const Configuration& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  int parent(int i) const { return parents_[static_cast<std::size_t>(i)]; }

 private:
  Direction direction_;
  MetricWeights weights_;
  std::vector<Configuration> nodes_;
  std::vector<int> parents_;
  std::vector<double> times_;                     // NaN for nodes cut off
  std::vector<std::vector<double>> coordinates_;  // 3 a point: x, y, z; each one a node
  std::vector<double> squares_;                   // scratch of nearest()
};

}  // namespace elbowroom
