// SPDX-License-Identifier: MIT
// What would do instead, where a window could not be corrected: a wider window, wider sampling
// intervals, another limb. Each is tried for real, so a suggestion that works is one that holds.
//
// (Less clearance is no suggestion: plan_window has tried that itself.)
#pragma once

#include "core/editing/correct.h"

namespace elbowroom {

// For the window of `failed`, on the clip that the scene plays, which it plays again afterwards:
// its suggestions, and where an end of the window is not free, what can be done about that, in its
// reason. Wider windows are those that would be chosen for its contacts (propose_windows), and some
// about it. Suggestions that are there already are not tried again. Stops at the first that works;
// a stop request ends it too. Each is tried in brief (plan_window.h). Cost: a scan, and theirs.
void try_suggestions(SceneCollision& scene, WindowReport& failed, const PlanningWishes& wishes,
                     const std::stop_token& stop, const ProgressSink& progress);

}  // namespace elbowroom
