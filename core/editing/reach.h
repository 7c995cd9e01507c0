// SPDX-License-Identifier: MIT
// Reaching a target and coming back [SKF07 6.2]: a posture at the target's time t_b by the swivel
// search, valid on the deformed skin; a plan from the clip at t_a to that posture and one from it
// back to the clip at t_c, which meet there with equal velocity: that of holding the target still
// in the world, at the same swivel, while the body moves on.
//
// One correction over [t_a, t_c] comes of it, with a key at t_b exactly (its float32 value), found
// and verified as every correction is (core/editing/correct.h). Residuals are those of the window
// (DESIGN.md, "Residual"), at t_b too.
//
// A target with `grasp` is the palm's (core/editing/wrist_target.h). Where there is no way to the
// first posture, others that reach the target are planned to, up to three in all, each the farthest
// in swivel from those tried; the report's `attempts` has them all.
//
// Without a window in the task, t_a and t_c are 0.8 s before and after t_b, moved until the limb is
// free at both ends and its speed limits leave time for the way, within the clip.
#pragma once

#include "core/editing/correct.h"
#include "core/editing/plan_window.h"
#include "core/editing/target_posture.h"
#include "core/editing/wrist_target.h"

namespace elbowroom {

// Does a task of kind reach with limb `limb` (an index) on the clip that `scene` plays, which may
// hold earlier corrections. The scene plays the outcome's clip afterwards. One window is reported;
// where there is no posture its reason says why: out of reach by how much, at which DOF's limit, in
// collision with what (blocked_by). A window that was given and does not do is followed by one that
// is chosen: whether that would is among the report's suggestions.
// Errors: no clip; no target, or one that isn't finite; a time that isn't inside the clip and the
// window; a limb the scene does not have; a sampling interval for a DOF that the limb has not.
// Runs on the calling thread; stop tokens are answered within 50 ms or one contact query.
Result<CorrectionOutcome> reach(SceneCollision& scene, int limb, const Task& task,
                                std::stop_token stop = {}, const ProgressSink& progress = {});

// The same without looking at the rest of the clip before and after: what an editor asks, which
// knows its contacts. Its report and its correction, which is not yet laid over.
Result<WindowPlan> plan_reach(SceneCollision& scene, int limb, const Task& task,
                              const std::stop_token& stop = {}, const ProgressSink& progress = {});

}  // namespace elbowroom
