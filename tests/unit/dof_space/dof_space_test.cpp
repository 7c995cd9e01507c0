// SPDX-License-Identifier: MIT
#include "core/base/dof_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace elbowroom {
namespace {

DofSpace swing_and_flexion() {
  DofSpace space;
  for (const char* name : {"a", "b", "flexion"}) {
    Dof dof;
    dof.name = name;
    dof.lower = -2;
    dof.upper = 2;
    space.dofs.push_back(dof);
  }
  space.ellipses.push_back({0, 1, 1.5, 1.0});
  return space;
}

Dofs make(double a, double b, double c) {
  Dofs q;
  q.count = 3;
  q[0] = a;
  q[1] = b;
  q[2] = c;
  return q;
}

TEST(DofSpace, RangesAndEllipsesBothHold) {
  const DofSpace space = swing_and_flexion();
  EXPECT_TRUE(space.within_limits(make(0, 0, 0)));
  EXPECT_TRUE(space.within_limits(make(1.5, 0, 2)));
  EXPECT_FALSE(space.within_limits(make(1.5, 0.1, 0)));
  EXPECT_FALSE(space.within_limits(make(0, 0, 2.001)));
  EXPECT_TRUE(space.within_limits(make(0, 0, 2.001), 0.01));
}

TEST(DofSpace, BadNumbersAreOutside) {
  const DofSpace space = swing_and_flexion();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(space.within_limits(make(nan, 0, 0)));
  EXPECT_FALSE(space.within_limits(make(0, 0, nan)));
  EXPECT_FALSE(space.within_limits(make(0, inf, 0)));
  EXPECT_FALSE(space.within_limits(Dofs{}));
  DofSpace copy = space;
  EXPECT_TRUE(copy.widen_to(make(nan, nan, nan)).empty());
  EXPECT_TRUE(copy.widen_to(Dofs{}).empty());
  EXPECT_EQ(copy.ellipses[0].half_first, space.ellipses[0].half_first);
}

TEST(DofSpace, LimitsAreConvex) {
  const DofSpace space = swing_and_flexion();
  Random random(7);
  int inside = 0;
  while (inside < 5000) {
    Dofs p = make(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2.5, 2.5));
    Dofs q = make(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2.5, 2.5));
    if (!space.within_limits(p) || !space.within_limits(q)) continue;
    ++inside;
    const double u = random.uniform();
    Dofs between = p;
    for (int i = 0; i < 3; ++i) between[i] = p[i] * (1 - u) + q[i] * u;
    EXPECT_TRUE(space.within_limits(between));
  }
}

TEST(DofSpace, WideningHoldsTheNewAndTheOldAndSaysWhat) {
  const DofSpace space = swing_and_flexion();
  Random random(8);
  for (int i = 0; i < 5000; ++i) {
    DofSpace wide = space;
    const Dofs q = make(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
    const std::vector<int> widened = wide.widen_to(q);
    EXPECT_TRUE(wide.within_limits(q));
    EXPECT_EQ(widened.empty(), space.within_limits(q, 0));
    EXPECT_GE(wide.ellipses[0].half_first, space.ellipses[0].half_first);
    EXPECT_GE(wide.ellipses[0].half_second, space.ellipses[0].half_second);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(wide.dofs[static_cast<std::size_t>(k)].lower, -2);
      EXPECT_GE(wide.dofs[static_cast<std::size_t>(k)].upper, 2);
    }
    // Just enough: q is on the rim of what was widened.
    if (wide.ellipses[0].half_first > 1.5 || wide.ellipses[0].half_second > 1.0) {
      const double value = std::pow(q[0] / wide.ellipses[0].half_first, 2) +
                           std::pow(q[1] / wide.ellipses[0].half_second, 2);
      EXPECT_NEAR(value, 1, 1e-9);
    }
    EXPECT_TRUE(wide.widen_to(q).empty());
  }
}

TEST(DofSpace, WideningNamesEachDofOnce) {
  DofSpace space = swing_and_flexion();
  EXPECT_EQ(space.widen_to(make(3, 0, 0)), std::vector<int>{0});
  EXPECT_EQ(space.widen_to(make(0, 0, -2.5)), std::vector<int>{2});
  DofSpace flat = swing_and_flexion();
  flat.ellipses[0].half_second = 0;
  EXPECT_TRUE(flat.within_limits(make(1, 0, 0)));
  EXPECT_FALSE(flat.within_limits(make(1, 0.1, 0)));
  EXPECT_EQ(flat.widen_to(make(1, 0.1, 0)), std::vector<int>{1});
  EXPECT_TRUE(flat.within_limits(make(1, 0.1, 0)));
}

}  // namespace
}  // namespace elbowroom
