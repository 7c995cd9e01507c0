// SPDX-License-Identifier: MIT
// One task of whatever kind, on the clip that the scene plays.
#pragma once

#include "core/editing/correct.h"
#include "core/editing/session.h"

namespace elbowroom {

// Finds the task's limbs in the session and does what its kind asks (core/editing/correct.h,
// core/editing/reach.h). The scene plays the outcome's clip afterwards.
// Errors: no such limb; a reach that names none or several; those of the kind.
Result<CorrectionOutcome> solve_task(SceneCollision& scene, const Session& session,
                                     const Task& task, std::stop_token stop = {},
                                     const ProgressSink& progress = {});

}  // namespace elbowroom
