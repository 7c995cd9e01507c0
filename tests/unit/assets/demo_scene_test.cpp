// SPDX-License-Identifier: MIT
// The situation of [SKF07] figure 1: what hits what in the demo clip, and that the right arm alone
// could do better.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "assets/demo.h"
#include "assets/generator/posing.h"
#include "tests/unit/assets/demo_world.h"

namespace elbowroom::test {
namespace {

constexpr double kDegrees = kPi / 180.0;

struct Shape {
  std::vector<Vec3> positions;
  std::vector<glm::uvec3> triangles;
};

bool segment_crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 d = q - p, e1 = b - a, e2 = c - a, h = glm::cross(d, e2);
  const double det = glm::dot(e1, h);
  if (std::abs(det) < 1e-18) return false;
  const Vec3 s = p - a;
  const double u = glm::dot(s, h) / det;
  if (u < 0 || u > 1) return false;
  const Vec3 k = glm::cross(s, e1);
  const double v = glm::dot(d, k) / det;
  if (v < 0 || u + v > 1) return false;
  const double t = glm::dot(e2, k) / det;
  return t >= 0 && t <= 1;
}

// Two closed surfaces cross (neither inside the other in these scenes).
bool cross(const Shape& x, const Shape& y) {
  struct Box {
    Vec3 low{1e9}, high{-1e9};
    void add(const Vec3& p) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    bool meets(const Box& o) const {
      return glm::all(glm::lessThanEqual(low, o.high)) && glm::all(glm::lessThanEqual(o.low, high));
    }
  };
  const auto box_of = [](const Shape& s, const glm::uvec3& t) {
    Box box;
    for (int k = 0; k < 3; ++k) box.add(s.positions[t[k]]);
    return box;
  };
  Box all_x, all_y;
  for (const Vec3& p : x.positions) all_x.add(p);
  for (const Vec3& p : y.positions) all_y.add(p);
  if (!all_x.meets(all_y)) return false;
  std::vector<std::pair<Box, glm::uvec3>> near_y;
  for (const glm::uvec3& t : y.triangles)
    if (const Box box = box_of(y, t); box.meets(all_x)) near_y.push_back({box, t});
  // Sorted upwards, so that only triangles of like height are looked at.
  std::stable_sort(near_y.begin(), near_y.end(),
                   [](const auto& a, const auto& b) { return a.first.low.y < b.first.low.y; });
  double tallest = 0;
  for (const auto& n : near_y) tallest = std::max(tallest, n.first.high.y - n.first.low.y);
  for (const glm::uvec3& t : x.triangles) {
    const Box box = box_of(x, t);
    if (!box.meets(all_y)) continue;
    auto at = std::lower_bound(near_y.begin(), near_y.end(), box.low.y - tallest,
                               [](const auto& n, double height) { return n.first.low.y < height; });
    for (; at != near_y.end() && at->first.low.y <= box.high.y; ++at) {
      const auto& [other_box, o] = *at;
      if (!box.meets(other_box)) continue;
      for (int k = 0; k < 3; ++k) {
        const int n = (k + 1) % 3;
        if (segment_crosses(x.positions[t[k]], x.positions[t[n]], y.positions[o.x],
                            y.positions[o.y], y.positions[o.z]) ||
            segment_crosses(y.positions[o[k]], y.positions[o[n]], x.positions[t.x],
                            x.positions[t.y], x.positions[t.z]))
          return true;
      }
    }
  }
  return false;
}

Shape umbrella_in_hand(const std::vector<Mat4>& globals) {
  static const Body body = welded(umbrella());
  const int hand = mannequin().skeleton.find(demo::kAttachJoint);
  const Mat4& world_from_hand = globals[static_cast<std::size_t>(hand)];
  Shape shape{{}, body.triangles};
  for (const Vec3& p : body.positions)
    shape.positions.push_back(Vec3(
        world_from_hand * glm::dvec4(p + Vec3(demo::kGripX, demo::kGripY, demo::kGripZ), 1.0)));
  return shape;
}

Shape body_in(const std::vector<Mat4>& globals, bool without_right_arm) {
  const Model& model = mannequin();
  static const Body body = welded(model);
  Shape shape{deformed(model, body, globals), {}};
  const int arm = model.skeleton.find("RightLowerArm");
  for (const glm::uvec3& t : body.triangles) {
    bool keep = true;
    for (int k = 0; k < 3 && without_right_arm; ++k)
      for (const Influence& f : body.influences[t[k]])
        keep = keep && !model.skeleton.is_within(f.joint, arm);
    if (keep) shape.triangles.push_back(t);
  }
  return shape;
}

const Shape& the_posts() {
  static const Shape shape = [] {
    const Body body = welded(posts());
    return Shape{body.positions, body.triangles};
  }();
  return shape;
}

TEST(DemoScene, UmbrellaHitsAPostOnTheWay) {
  const Model& model = mannequin();
  double first = -1, last = -1;
  const auto times = key_times(model, demo::kDemoClip);
  for (const double t : times)
    if (cross(umbrella_in_hand(globals_at(model, demo::kDemoClip, t)), the_posts())) {
      if (first < 0) first = t;
      last = t;
    }
  RecordProperty("hit_begin_seconds", std::to_string(first));
  RecordProperty("hit_end_seconds", std::to_string(last));
  // Well inside the clip, so that there is time to give way before and after.
  ASSERT_GE(first, 0.8);
  EXPECT_LE(last, times.back() - 0.8);
  EXPECT_GT(last - first, 0.2);
}

TEST(DemoScene, BodyPassesBetweenThePosts) {
  const Model& model = mannequin();
  for (const double t : key_times(model, demo::kDemoClip)) {
    const Shape body = body_in(globals_at(model, demo::kDemoClip, t), false);
    EXPECT_FALSE(cross(body, the_posts())) << t;
    // And by a hand's breadth: the posts stand 0.57 m from the middle.
    for (const Vec3& p : body.positions)
      if (std::abs(p.z) < 0.1) {
        EXPECT_LT(std::abs(p.x), 0.49) << t;
      }
  }
}

TEST(DemoScene, UmbrellaIsClearOfHeadAndBodyInTheClip) {
  const Model& model = mannequin();
  for (const double t : key_times(model, demo::kDemoClip)) {
    const auto g = globals_at(model, demo::kDemoClip, t);
    EXPECT_FALSE(cross(umbrella_in_hand(g), body_in(g, true))) << t;
  }
}

TEST(DemoScene, HandIsClosedAboutTheHandle) {
  const Model& model = mannequin();
  const auto g = globals_at(model, demo::kDemoClip, 1.0);
  const int hand = model.skeleton.find(demo::kAttachJoint);
  const Mat4 hand_from_world = glm::inverse(g[static_cast<std::size_t>(hand)]);
  // The finger bones go round the handle's axis: over the last joints the angle about it, seen from
  // the knuckle, is more than a third of a turn.
  for (const std::string finger : {"Index", "Middle", "Ring", "Little"}) {
    double turned = 0;
    Vec3 before(0.0);
    for (int i = 1; i <= 3; ++i) {
      const Vec3 world = joint_position(model, g, "Right" + finger + std::to_string(i));
      Vec3 p = Vec3(hand_from_world * glm::dvec4(world, 1.0)) -
               Vec3(demo::kGripX, demo::kGripY, demo::kGripZ);
      p.y = 0;
      if (i > 1) {
        const double cosine = glm::dot(p, before) / (glm::length(p) * glm::length(before));
        turned += std::acos(std::clamp(cosine, -1.0, 1.0));
        // Near enough to hold it, too far to be inside it.
        EXPECT_GT(glm::length(p), 0.0115) << finger << i;
        EXPECT_LT(glm::length(p), 0.045) << finger << i;
      }
      before = p;
    }
    EXPECT_GT(turned, 100.0 * kDegrees) << finger;
  }
}

// The way out that a planner should find one like: the arm brings the umbrella in front of the body
// and back. Only the right arm's three joints differ from the clip.
TEST(DemoScene, TheRightArmAloneCanBringItThrough) {
  const Model& model = mannequin();
  const Clip& clip = model.clips[static_cast<std::size_t>(model.find_clip(demo::kDemoClip))];
  const int shoulder = model.skeleton.find("RightShoulder");
  const int joints[3] = {model.skeleton.find("RightUpperArm"), model.skeleton.find("RightLowerArm"),
                         model.skeleton.find("RightHand")};
  for (double t = clip.begin; t <= clip.end; t += 1.0 / 40.0) {
    Pose pose = rest_pose(model.skeleton);
    sample_clip(clip, t, pose);
    std::vector<Mat4> g;
    compute_globals(model.skeleton, pose, Mat4(1.0), g);
    const double z = joint_position(model, g, "Hips").z;
    // In front of the body from 1.4 m before the posts' line to 0.9 m behind it.
    const double in = std::clamp((z + 2.0) / 0.7, 0.0, 1.0);
    const double out = std::clamp((1.5 - z) / 0.7, 0.0, 1.0);
    const double u = std::min(in, out);
    const double blend = u * u * (3 - 2 * u);

    const Quat trunk = rotation_of(g[static_cast<std::size_t>(shoulder)]);
    using demo::turn_x, demo::turn_y, demo::turn_z;
    const Quat upper = trunk * turn_z(-4.0 * kDegrees) * turn_x(-24.0 * kDegrees) *
                       turn_x(0.5 * kPi) * turn_z(-40.0 * kDegrees);
    const Quat lower = upper * turn_x(-72.0 * kDegrees);
    const Quat hand = turn_y(25.0 * kDegrees);  // upright
    const Quat wanted[3] = {glm::conjugate(trunk) * upper, glm::conjugate(upper) * lower,
                            glm::conjugate(lower) * hand};
    for (int i = 0; i < 3; ++i) {
      Quat& local = pose.local[static_cast<std::size_t>(joints[i])].rotation;
      local = slerp_shortest(local, wanted[i], blend);
    }
    compute_globals(model.skeleton, pose, Mat4(1.0), g);
    const Shape carried = umbrella_in_hand(g);
    EXPECT_FALSE(cross(carried, the_posts())) << t;
    const Shape body = body_in(g, false);
    EXPECT_FALSE(cross(body, the_posts())) << t;
    EXPECT_FALSE(cross(carried, body_in(g, true))) << t;
  }
}

TEST(DemoScene, AttachArgumentSaysTheSameAsItsConstants) {
  char expected[128];
  std::snprintf(expected, sizeof expected, "%s@%s,%g,%g,%g", demo::kUmbrellaFile,
                demo::kAttachJoint, demo::kGripX, demo::kGripY, demo::kGripZ);
  EXPECT_STREQ(demo::kAttachArgument, expected);
}

}  // namespace
}  // namespace elbowroom::test
