// SPDX-License-Identifier: MIT
// How far postures are out of a swing's polygon, and bringing them back.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/ik/limit_excess.h"

namespace elbowroom {
namespace {

DofSpace pentagon() {
  DofSpace space;
  for (int i = 0; i < 2; ++i) {
    Dof dof;
    dof.lower = dof.sample_lower = -2.5;
    dof.upper = dof.sample_upper = 2.5;
    dof.speed_limit = 1;
    space.dofs.push_back(dof);
  }
  const auto polygon =
      make_polygon_limit(0, 1, {{2, 0}, {0.5, 1.5}, {-1, 1}, {-1.5, -0.5}, {0.2, -2}});
  EXPECT_TRUE(polygon.ok());
  if (polygon) space.polygons.push_back(*polygon);
  return space;
}

TEST(PolygonLimitExcess, IsMeasuredAlongTheRayFromZero) {
  const DofSpace space = pentagon();
  Dofs q;
  q.count = 2;
  q[0] = 2.4;
  EXPECT_NEAR(limit_excess(space, q).radians, 0.4, 1e-12);
  EXPECT_EQ(limit_excess(space, q).dof, 0);
  q[0] = 1.8;
  EXPECT_NEAR(limit_excess(space, q).radians, -0.2, 1e-12);
  q[0] = 0;
  EXPECT_LT(limit_excess(space, q).radians, -0.5);
  q[0] = std::nan("");
  EXPECT_TRUE(std::isinf(limit_excess(space, q).radians));
}

TEST(PolygonLimitExcess, ClampingKeepsLimitsAndMovesNothingThatIsInside) {
  const DofSpace space = pentagon();
  Random random(6);
  for (int n = 0; n < 2000; ++n) {
    Dofs q;
    q.count = 2;
    q[0] = random.uniform(-4, 4);
    q[1] = random.uniform(-4, 4);
    const Dofs clamped = clamp_to_limits(space, q);
    EXPECT_TRUE(space.within_limits(clamped));
    EXPECT_LE(limit_excess(space, clamped).radians, 1e-9);
    if (!space.within_limits(q, 0)) continue;
    EXPECT_EQ(clamped[0], q[0]);
    EXPECT_EQ(clamped[1], q[1]);
  }
}

}  // namespace
}  // namespace elbowroom
