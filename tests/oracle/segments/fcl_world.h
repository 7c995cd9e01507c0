// SPDX-License-Identifier: MIT
// FCL's verdict on a planner's world: the same triangles at the same placements, and nothing of
// core/collision's queries.
//
// FCL has no filter on triangles: pairs of parts with allowed patches are left out of its world,
// which leaves it less to test, and to find, than ours has; the tests here are about obstacles.
#pragma once

#include <memory>

#include "core/collision/limb_planning_space.h"

namespace elbowroom::test {

class FclWorld {
 public:
  virtual ~FclWorld() = default;
  virtual bool free(const Configuration& c) = 0;
};

enum class BoxKind { obbrss_double, obb_float };
// Keeps a reference to the space, whose placements it asks for.
std::unique_ptr<FclWorld> make_fcl_world(LimbPlanningSpace& space, BoxKind kind);

}  // namespace elbowroom::test
