// SPDX-License-Identifier: MIT
#include "core/editing/solve_task.h"

#include <set>

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

Result<CorrectionOutcome> solve_tasks(SceneCollision& scene, const Session& session,
                                      const std::vector<Task>& tasks, std::stop_token stop,
                                      const ProgressSink& progress) {
  if (tasks.size() == 1) return solve_task(scene, session, tasks.front(), stop, progress);
  std::set<int> limbs;
  for (const Task& task : tasks) {
    const auto named = limbs_named(session, task.limb);
    if (!named) return named.error();
    limbs.insert(named->begin(), named->end());
  }
  CorrectionOutcome whole;
  whole.clip = scene.world().actors[static_cast<std::size_t>(scene.actor())].clip;
  if (!whole.clip)
    return Error{"the character has no clip to correct", session.document.scene.character.string(),
                 "give a file with an animation"};
  if (progress) progress({"looking for contacts", -1});
  look_at_contacts(scene, {limbs.begin(), limbs.end()}, whole.before, &whole.other, stop);
  for (const Task& task : tasks) {
    if (stop.stop_requested()) break;
    auto outcome = solve_task(scene, session, task, stop, progress);
    if (!outcome) return outcome.error();
    for (auto& way : outcome->other_ways) {
      way.window += whole.windows.size();
      whole.other_ways.push_back(std::move(way));
    }
    for (auto& window : outcome->windows) whole.windows.push_back(std::move(window));
    for (auto& correction : outcome->corrections)
      whole.corrections.push_back(std::move(correction));
    whole.clip = outcome->clip;
  }
  if (progress) progress({"looking at the result", -1});
  if (whole.corrections.empty())
    whole.after = whole.before;
  else if (!stop.stop_requested())
    look_at_contacts(scene, {limbs.begin(), limbs.end()}, whole.after, nullptr, stop);
  whole.interrupted = stop.stop_requested();
  return whole;
}

}  // namespace elbowroom
