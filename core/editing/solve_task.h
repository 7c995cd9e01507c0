// SPDX-License-Identifier: MIT
// Tasks of whatever kind, on the clip that the scene plays.
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

// All of them in order, each on the clip that those before it have left. `before` and `other` are
// of the clip that the scene played at first, `after` of the outcome's, both over all the tasks'
// limbs. A stop request leaves the rest undone. Errors: those of solve_task, before any is begun
// where a limb is not there.
Result<CorrectionOutcome> solve_tasks(SceneCollision& scene, const Session& session,
                                      const std::vector<Task>& tasks, std::stop_token stop = {},
                                      const ProgressSink& progress = {});

// The same where corrections have been accepted: those that hold (core/editing/accepted.h) come out
// key by key as they are, before all else; tasks of which one doesn't, or which have none yet, are
// planned on top of them. `notes` tells of what was not kept.
// A task to correct without a window also sees to what is left of its limbs' contacts, unless one
// of its corrections is muted: muted ones are not made again. What holds no more and has no task
// among these is planned anew as it was made.
Result<CorrectionOutcome> solve_over_accepted(SceneCollision& scene, const Session& session,
                                              const std::vector<Task>& tasks,
                                              const std::vector<Correction>& accepted,
                                              std::stop_token stop = {},
                                              const ProgressSink& progress = {});

}  // namespace elbowroom
