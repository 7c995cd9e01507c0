// SPDX-License-Identifier: MIT
#include "core/editing/solve_task.h"

#include "core/editing/reach.h"

namespace elbowroom {

Result<CorrectionOutcome> solve_task(SceneCollision& scene, const Session& session,
                                     const Task& task, std::stop_token stop,
                                     const ProgressSink& progress) {
  const auto limbs = limbs_named(session, task.limb);
  if (!limbs) return limbs.error();
  switch (task.kind) {
    case TaskKind::correct:
      return correct(scene, *limbs, task, stop, progress);
    case TaskKind::reach:
      break;
  }
  if (task.limb == "auto" || limbs->size() != 1)
    return Error{"a target is reached by one limb", session.document.scene.character.string(),
                 "name it: left_arm, right_arm, left_leg, right_leg or FROM..TO"};
  return reach(scene, limbs->front(), task, stop, progress);
}

}  // namespace elbowroom
