// SPDX-License-Identifier: MIT
// What would do instead, where a window could not be corrected: a wider window, wider sampling
// intervals, another limb. Each is tried for real, so a suggestion that works is one that holds.
//
// (Less clearance is no suggestion: plan_window has tried that itself.)
#pragma once

#include "core/editing/correct.h"

namespace elbowroom {

// For the window of `failed`, on the clip that the scene plays, which it plays again afterwards.
// Those of its suggestions that were tried already come first and are not tried again. Stops at the
// first that works; a stop request ends it too. Each is tried in brief (plan_window.h).
std::vector<Suggestion> try_suggestions(SceneCollision& scene, const WindowReport& failed,
                                        const PlanningWishes& wishes, const std::stop_token& stop,
                                        const ProgressSink& progress);

}  // namespace elbowroom
