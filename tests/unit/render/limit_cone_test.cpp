// SPDX-License-Identifier: MIT
// The rim is where the bone's end is when the joint's numbers are at their limits.
#include "render/limit_cone.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/random.h"

namespace elbowroom::test {
namespace {

// A ball joint with an ellipse, in axes of its own.
LimbModel limb_of(Random& random, double side) {
  const auto rotation = [&] {
    return quat_from_rotation_vector(
        2.0 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
  };
  LimbModel limb;
  limb.joints[0].kind = JointModelKind::ball;
  limb.joints[0].joint = 1;
  limb.joints[0].side = side;
  limb.joints[0].parent_from_zero = rotation();
  limb.joints[0].joint_from_anatomy = rotation();
  limb.joints[1].kind = JointModelKind::hinge;
  limb.joints[2].kind = JointModelKind::fixed;
  limb.space.dofs = {{"a", DofRole::swing, -1.2, 1.2, -0.5, 0.7, 1},
                     {"b", DofRole::secondary_swing, -0.8, 0.6, -0.2, 0.3, 1},
                     {"c", DofRole::twist, -1, 1, -1, 1, 1}};
  limb.space.ellipses = {{0, 1, 1.2, 0.8}};
  return limb;
}

TEST(LimitCone, RimIsTheBoneAtItsLimitUnderAnyParent) {
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    const LimbModel limb = limb_of(random, i % 2 == 0 ? 1 : -1);
    Skeleton skeleton;
    skeleton.joints.resize(3);
    skeleton.joints[1].parent = 0;
    skeleton.joints[2].parent = 1;
    skeleton.joints[0].rest.translation = Vec3(3, -2, 1e3);
    skeleton.joints[0].rest.scale = i % 4 < 2 ? Vec3(2) : Vec3(-0.5, 0.5, 0.5);
    skeleton.joints[0].rest.rotation = quat_from_rotation_vector(
        Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)));
    skeleton.joints[1].rest.translation = Vec3(0.2, 0.3, 0.4);
    skeleton.joints[2].rest.translation =
        0.35 * (limb.joints[0].joint_from_anatomy * Vec3(1, 0, 0));
    ASSERT_TRUE(link_skeleton(skeleton));
    std::vector<Mat4> globals;
    Pose pose = rest_pose(skeleton);
    const auto end_at = [&](double a, double b) {
      const double q[3] = {a, b, 0.3};  // a twist does not move the bone
      pose.local[1].rotation = local_rotation(limb.joints[0], q, Quat(1, 0, 0, 0));
      compute_globals(skeleton, pose, Mat4(1.0), globals);
      return Vec3(globals[2][3]);
    };
    (void)end_at(0, 0);
    const Vec3 apex(globals[1][3]);
    const double length = glm::length(Vec3(globals[2][3]) - apex);
    const LimitCone cone = limit_cone(limb, 0, globals[0], apex, length, 64);
    EXPECT_LT(glm::length(cone.zero - end_at(0, 0)), 1e-9);
    ASSERT_EQ(cone.rim.size(), 64u);
    EXPECT_LT(glm::length(cone.rim[0] - end_at(1.2, 0)), 1e-9);
    EXPECT_LT(glm::length(cone.rim[32] - end_at(-1.2, 0)), 1e-9);
    EXPECT_LT(glm::length(cone.rim[16] - end_at(0, 0.6)), 1e-9);   // the range is narrower
    EXPECT_LT(glm::length(cone.rim[48] - end_at(0, -0.8)), 1e-9);  // the ellipse
    for (int k = 0; k < 64; ++k) {
      // Every rim point is at a pose within the limits of which a longer step is out of them.
      const double angle = 2 * kPi * k / 64, a = std::cos(angle), b = std::sin(angle);
      double inside = 0, outside = kPi;
      for (int n = 0; n < 60; ++n) {
        const double step = 0.5 * (inside + outside);
        Dofs q;
        q.count = 3;
        q[0] = step * a, q[1] = step * b;
        (limb.space.within_limits(q, 0) ? inside : outside) = step;
      }
      EXPECT_LT(glm::length(cone.rim[static_cast<std::size_t>(k)] - end_at(inside * a, inside * b)),
                1e-6);
    }
    ASSERT_EQ(cone.sampling.size(), 64u);
    EXPECT_LT(glm::length(cone.sampling[0] - end_at(-0.5, -0.2)), 1e-9);
    EXPECT_LT(glm::length(cone.sampling[32] - end_at(0.7, 0.3)), 1e-9);
    EXPECT_GT(cone_trails(cone, 0xffffff).size(), 10u);
  }
}

TEST(LimitCone, JointsWithoutSwingAndHostileValuesGiveNothing) {
  Random random(2);
  const LimbModel limb = limb_of(random, 1);
  for (const int which : {-1, 1, 2, 3}) {
    EXPECT_TRUE(limit_cone(limb, which, Mat4(1.0), Vec3(0.0), 1).rim.empty());
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(limit_cone(limb, 0, Mat4(0.0), Vec3(0.0), 1).rim.empty());
  EXPECT_TRUE(limit_cone(limb, 0, Mat4(nan), Vec3(0.0), 1).rim.empty());
  EXPECT_TRUE(limit_cone(limb, 0, Mat4(1.0), Vec3(nan), 1).rim.empty());
  EXPECT_TRUE(limit_cone(limb, 0, Mat4(1.0), Vec3(0.0), nan).rim.empty());
  EXPECT_FALSE(limit_cone(limb, 0, Mat4(1.0), Vec3(0.0), 1, -5).rim.empty());
  EXPECT_TRUE(cone_trails({}, 0).empty());
}

}  // namespace
}  // namespace elbowroom::test
