// SPDX-License-Identifier: MIT
// Three angles for a rotation, such that editing one never moves the others.
#include "ui/euler_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace elbowroom {
namespace {

double off_by(const Quat& a, const Quat& b) {
  const Quat d = glm::conjugate(a) * b;
  return 2 * std::atan2(glm::length(Vec3(d.x, d.y, d.z)), std::abs(d.w));
}

TEST(EulerAngles, MeanTheRotation) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> degrees(-500, 500);
  for (int i = 0; i < 20000; ++i) {
    Quat q = glm::normalize(Quat(normal(random), normal(random), normal(random), normal(random)));
    const Vec3 shown(degrees(random), degrees(random), degrees(random));
    // Every tenth within the reach of rounding of Y at ±90°.
    if (i % 10 == 0) q = from_euler_degrees({shown.x, i % 20 ? 90 : -90, shown.z});
    const Vec3 angles = euler_degrees_near(q, shown);
    EXPECT_LT(off_by(q, from_euler_degrees(angles)), 2e-6);
    // No other triple with the same meaning is nearer: half turns of all three, whole turns of one.
    const auto distance = [&](const Vec3& v) {
      return std::abs(v.x - shown.x) + std::abs(v.y - shown.y) + std::abs(v.z - shown.z);
    };
    if (i % 10 == 0) continue;
    for (int axis = 0; axis < 3; ++axis)
      for (const double turn : {-360.0, 360.0}) {
        Vec3 other = angles;
        other[axis] += turn;
        EXPECT_LE(distance(angles), distance(other) + 1e-6);
        Vec3 flipped(angles.x + 180, 180 - angles.y, angles.z + 180);
        for (int a = 0; a < 3; ++a) flipped[a] += 360 * std::round((shown[a] - flipped[a]) / 360);
        EXPECT_LE(distance(angles), distance(flipped) + 1e-6);
      }
  }
}

// Whatever axis is dragged, over whole turns and through ±90°, fields that are fed back what they
// have set stay as they are.
TEST(EulerAngles, EditingOneAxisLeavesTheOthers) {
  for (const Vec3& begin : {Vec3(0, 0, 0), Vec3(41.8, -19.8, 20.1), Vec3(170, 89, -170)})
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 shown = begin;
      for (double angle = begin[axis]; angle < begin[axis] + 800; angle += 0.7) {
        Vec3 edited = shown;
        edited[axis] = angle;
        shown = euler_degrees_near(from_euler_degrees(edited), edited);
        EXPECT_EQ(shown, edited);
      }
    }
}

// And where the rotation is changed from elsewhere (undo, the gizmo), little changes stay little.
TEST(EulerAngles, FollowsARotationThatTurnsElsewhere) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 shown(10, 20, 30);
    for (double angle = 0; angle < 720; angle += 0.5) {
      Vec3 edited(10, 20, 30);
      edited[axis] = angle;
      const Vec3 next = euler_degrees_near(from_euler_degrees(edited), shown);
      if (angle > 30) {
        EXPECT_LT(glm::length(next - shown), 2) << axis << " at " << angle;
      }
      shown = next;
    }
  }
}

TEST(EulerAngles, WhatIsNoNumberIsZero) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(euler_degrees_near(Quat(none, 0, 0, 0), Vec3(1, 2, 3)), Vec3(0));
  EXPECT_EQ(euler_degrees_near(Quat(0, 0, 0, 0), Vec3(1, 2, 3)), Vec3(0));
  const Vec3 angles = euler_degrees_near(Quat(1, 0, 0, 0), Vec3(none, 0, 0));
  EXPECT_EQ(angles, Vec3(0));
  // A quaternion and its negative, and one that is not of unit length, are the same rotation.
  const Quat q = from_euler_degrees({30, 40, 50});
  EXPECT_EQ(euler_degrees_near(-q, Vec3(30, 40, 50)), Vec3(30, 40, 50));
  EXPECT_EQ(euler_degrees_near(3.0 * q, Vec3(30, 40, 50)), Vec3(30, 40, 50));
}

}  // namespace
}  // namespace elbowroom
