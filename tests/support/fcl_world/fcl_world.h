// SPDX-License-Identifier: MIT
// FCL's verdict on a planner's world: the same triangles at the same placements, and nothing of
// core/collision's queries. The peer checks by it, and it judges ours.
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

// FCL has no filter on triangles. Of two parts with allowed patches it is given nothing, or what is
// surely not allowed: triangles that an allowance concerns are not tested against each other.
// Either way it has less to test, and to find, than ours has.
enum class AllowedPairs { left_out, without_concerned };

// Keeps a reference to the space, whose placements it asks for.
std::unique_ptr<FclWorld> make_fcl_world(LimbPlanningSpace& space, BoxKind kind,
                                         AllowedPairs allowed);

}  // namespace elbowroom::test
