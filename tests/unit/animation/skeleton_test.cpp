// SPDX-License-Identifier: MIT
#include "core/animation/skeleton.h"

#include <gtest/gtest.h>

#include "core/animation/affine.h"
#include "core/base/random.h"

namespace elbowroom {
namespace {

Quat random_rotation(Random& random) {
  Quat q(0, 0, 0, 0);
  while (glm::length(q) < 0.1) {
    q = Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
             random.uniform(-1, 1));
  }
  return glm::normalize(q);
}

double difference(const Mat4& a, const Mat4& b) {
  double most = 0;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
  }
  return most;
}

TEST(LinkSkeleton, OrdersParentsFirstWhateverTheNumbers) {
  Skeleton s;
  s.joints.resize(5);
  s.joints[0].parent = 3;
  s.joints[3].parent = 4;
  s.joints[1].parent = 0;
  s.joints[2].parent = -1;
  ASSERT_TRUE(link_skeleton(s));
  ASSERT_EQ(s.order.size(), 5u);
  std::vector<int> position(5);
  for (int i = 0; i < 5; ++i)
    position[static_cast<std::size_t>(s.order[static_cast<std::size_t>(i)])] = i;
  for (std::size_t i = 0; i < 5; ++i) {
    if (s.joints[i].parent >= 0) {
      EXPECT_LT(position[static_cast<std::size_t>(s.joints[i].parent)], position[i]);
    }
  }
  EXPECT_EQ(s.children[0], std::vector<int>{1});
  EXPECT_TRUE(s.is_within(1, 4));
  EXPECT_TRUE(s.is_within(1, 1));
  EXPECT_FALSE(s.is_within(4, 1));
  EXPECT_FALSE(s.is_within(1, -1));
}

TEST(LinkSkeleton, RefusesLoopsAndForeignParents) {
  Skeleton loop;
  loop.joints.resize(3);
  loop.joints[0].parent = 1;
  loop.joints[1].parent = 0;
  EXPECT_FALSE(link_skeleton(loop));
  Skeleton self;
  self.joints.resize(1);
  self.joints[0].parent = 0;
  EXPECT_FALSE(link_skeleton(self));
  Skeleton far;
  far.joints.resize(1);
  far.joints[0].parent = 7;
  EXPECT_FALSE(link_skeleton(far));
  Skeleton none;
  EXPECT_TRUE(link_skeleton(none));
}

TEST(ComputeGlobals, MultipliesDownTheChain) {
  Skeleton s;
  s.joints.resize(3);
  s.joints[1].parent = 0;
  s.joints[2].parent = 1;
  s.joints[0].rest.translation = {1, 0, 0};
  s.joints[0].rest.rotation = glm::angleAxis(kPi / 2, Vec3(0, 0, 1));
  s.joints[1].rest.translation = {2, 0, 0};
  s.joints[1].rest.scale = {1, 3, 1};
  s.joints[2].rest_matrix = glm::translate(Mat4(1.0), Vec3(0, 1, 0));
  ASSERT_TRUE(link_skeleton(s));
  EXPECT_EQ(s.find("none"), -1);
  std::vector<Mat4> world;
  compute_globals(s, rest_pose(s), glm::translate(Mat4(1.0), Vec3(0, 0, 10)), world);
  // Joint 1 lies 2 along the turned x, which is y; joint 2 lies 3 (scaled) along the turned y, -x.
  EXPECT_LT(glm::distance(Vec3(world[1][3]), Vec3(1, 2, 10)), 1e-12);
  EXPECT_LT(glm::distance(Vec3(world[2][3]), Vec3(-2, 2, 10)), 1e-12);
}

TEST(RotationOf, UndoesScale) {
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    Transform t;
    t.rotation = random_rotation(random);
    t.scale = {random.uniform(0.01, 100), random.uniform(0.01, 100), random.uniform(0.01, 100)};
    EXPECT_LT(angle_between(rotation_of(t.matrix()), t.rotation), 1e-9);
  }
}

TEST(RotationOf, CommutesWithRotationsUnderAMirror) {
  Random random(12);
  for (int i = 0; i < 100; ++i) {
    const Quat a = random_rotation(random), b = random_rotation(random);
    Transform mirror;
    mirror.scale = {-2, 2, 2};
    const Mat4 parent = glm::mat4_cast(a) * mirror.matrix();
    const Mat4 child = parent * glm::mat4_cast(b);
    EXPECT_LT(angle_between(rotation_of(child), rotation_of(parent) * b), 1e-9);
  }
}

TEST(RotationOf, OfShearIsTheNearestOne) {
  // M = S·R with S symmetric positive has R as its polar factor.
  const Quat r = glm::angleAxis(0.7, glm::normalize(Vec3(1, 2, 3)));
  Mat3 m = glm::mat3_cast(r);
  m = Mat3(1.1, 0.2, 0.0, 0.2, 0.9, 0.1, 0.0, 0.1, 1.0) * m;
  const Quat q = rotation_of(Mat4(m));
  // Columns are made unit first, so it is near, not equal; and no neighbour is nearer.
  const auto distance = [&](const Quat& candidate) {
    const Mat3 c = glm::mat3_cast(candidate);
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = glm::normalize(m[k]) - c[k];
      sum += glm::dot(d, d);
    }
    return sum;
  };
  EXPECT_LT(angle_between(q, r), 0.1);
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 nudge(random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01),
                     random.uniform(-0.01, 0.01));
    EXPECT_LE(distance(q), distance(quat_from_rotation_vector(nudge) * q) + 1e-15);
  }
}

TEST(RotationOf, SurvivesFlatAndBrokenMatrices) {
  Transform flat;
  flat.rotation = glm::angleAxis(1.0, Vec3(0, 1, 0));
  flat.scale = {2, 0, 2};
  EXPECT_LT(angle_between(rotation_of(flat.matrix()), flat.rotation), 1e-9);
  for (const double bad : {0.0, std::nan(""), double{INFINITY}}) {
    const Quat q = rotation_of(Mat4(bad));
    EXPECT_NEAR(glm::length(q), 1, 1e-12);
  }
}

TEST(Decompose, RestoresTheMatrix) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Transform t;
    t.translation = {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)};
    t.rotation = random_rotation(random);
    t.scale = {random.uniform(0.1, 9), random.uniform(0.1, 9), random.uniform(0.1, 9)};
    if (i % 2 == 0) t.scale = -t.scale;
    EXPECT_LT(difference(decompose(t.matrix()).matrix(), t.matrix()), 1e-9);
  }
}

}  // namespace
}  // namespace elbowroom
