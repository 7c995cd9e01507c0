// SPDX-License-Identifier: MIT
// A limb's posture for a target at one time of what the scene plays: inverse kinematics with the
// clip's placement and lengths there, free on the deformed skin; or why there is none.
#pragma once

#include <array>
#include <stop_token>
#include <string>

#include "core/collision/scene_collision.h"
#include "core/ik/swivel_search.h"

namespace elbowroom {

// The limb's inverse kinematics at time t of what the scene plays, with these residuals; for
// editors that show the posture while a target is dragged. Errors: those of LimbIk::build.
Result<LimbIk> limb_ik_at(const SceneCollision& scene, int limb, double t,
                          const std::array<Quat, 3>& residual);

// A posture for the target that keeps `clearance` on the deformed skin at time t. The scene poses
// the limb by its clip again afterwards.
IkResult search_free_posture(SceneCollision& scene, int limb, const LimbIk& ik, double t,
                             const IkTarget& target, const SwivelSearch& settings, double clearance,
                             const std::stop_token& stop = {});

// Why there is no posture, for people; empty if there is one.
std::string ik_reason(const IkResult& result, const LimbModel& limb);

}  // namespace elbowroom
