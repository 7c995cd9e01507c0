// SPDX-License-Identifier: MIT
#include "core/base/dof_space.h"

#include <gtest/gtest.h>

#include <array>

#include <algorithm>

#include <cmath>
#include <limits>

#include "core/base/math.h"
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

DofSpace with_polygon(std::vector<std::array<double, 2>> corners) {
  DofSpace space;
  for (int i = 0; i < 2; ++i) {
    Dof dof;
    dof.lower = dof.sample_lower = -3;
    dof.upper = dof.sample_upper = 3;
    dof.speed_limit = 1;
    space.dofs.push_back(dof);
  }
  const auto polygon = make_polygon_limit(0, 1, std::move(corners));
  EXPECT_TRUE(polygon.ok());
  if (polygon) space.polygons.push_back(*polygon);
  return space;
}

Dofs two(double a, double b) {
  Dofs q;
  q.count = 2;
  q[0] = a;
  q[1] = b;
  return q;
}

TEST(PolygonLimits, HoldWhatIsInside) {
  // Either way round.
  for (const bool turned : {false, true}) {
    std::vector<std::array<double, 2>> corners = {{1, -0.5}, {1, 1}, {-0.5, 1}, {-0.5, -0.5}};
    if (turned) std::reverse(corners.begin(), corners.end());
    const DofSpace space = with_polygon(corners);
    EXPECT_TRUE(space.within_limits(two(0, 0)));
    EXPECT_TRUE(space.within_limits(two(1, 1)));
    EXPECT_TRUE(space.within_limits(two(-0.5, 0.99)));
    EXPECT_FALSE(space.within_limits(two(1.01, 0)));
    EXPECT_FALSE(space.within_limits(two(0, -0.51)));
    EXPECT_FALSE(space.within_limits(two(std::nan(""), 0)));
    EXPECT_NEAR(space.polygons[0].gauge(0.5, 0), 0.5, 1e-12);
    EXPECT_NEAR(space.polygons[0].gauge(0, -1), 2, 1e-12);
  }
}

TEST(PolygonLimits, AreConvexSoThatEdgesKeepThem) {
  const DofSpace space = with_polygon({{2, 0}, {0.5, 1.5}, {-1, 1}, {-1.5, -0.5}, {0.2, -2}});
  Random random(4);
  std::vector<Dofs> inside;
  while (inside.size() < 200) {
    const Dofs q = two(random.uniform(-3, 3), random.uniform(-3, 3));
    if (space.within_limits(q)) inside.push_back(q);
  }
  for (std::size_t i = 1; i < inside.size(); ++i) {
    for (double u = 0; u <= 1; u += 0.1) {
      const Dofs& a = inside[i - 1];
      const Dofs& b = inside[i];
      EXPECT_TRUE(space.within_limits(two(a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1]))));
    }
  }
}

TEST(PolygonLimits, WidenToTheHull) {
  const DofSpace space = with_polygon({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  Random random(5);
  for (int n = 0; n < 500; ++n) {
    const Dofs q = two(random.uniform(-2.9, 2.9), random.uniform(-2.9, 2.9));
    DofSpace wide = space;
    const auto widened = wide.widen_to(q);
    EXPECT_EQ(widened.empty(), space.within_limits(q, 0));
    EXPECT_TRUE(wide.within_limits(q));
    for (const auto& corner : space.polygons[0].corners)
      EXPECT_TRUE(wide.within_limits(two(corner[0], corner[1])));
    EXPECT_TRUE(make_polygon_limit(0, 1, wide.polygons[0].corners).ok());
  }
}

TEST(PolygonLimits, WhatIsNoPolygonAboutZeroIsRefused) {
  using Corners = std::vector<std::array<double, 2>>;
  const double nan = std::nan("");
  Corners star;
  for (int i = 0; i < 5; ++i)
    star.push_back({std::cos(i * 4 * kPi / 5), std::sin(i * 4 * kPi / 5)});
  for (const Corners& corners :
       {Corners{}, Corners{{1, 0}, {0, 1}}, Corners{{1, 0}, {0, 1}, {nan, 0}},
        Corners{{1, 1}, {2, 1}, {2, 2}, {1, 2}}, Corners{{1e3, 0}, {0, 1}, {-1, -1}},
        Corners{{1, 0}, {0, 1}, {-1, 0}}, Corners{{2, 0}, {0.1, 0.1}, {0, 2}, {-1, -1}}, star}) {
    const auto polygon = make_polygon_limit(0, 1, corners);
    ASSERT_FALSE(polygon.ok()) << corners.size();
    EXPECT_FALSE(polygon.error().what.empty());
  }
  EXPECT_FALSE(make_polygon_limit(1, 1, {{1, 0}, {0, 1}, {-1, -1}}).ok());
  EXPECT_TRUE(make_polygon_limit(0, 1, {{1, 0}, {0, 1}, {-1, -1}}).ok());
}

}  // namespace
}  // namespace elbowroom
