// SPDX-License-Identifier: MIT
#include "core/editing/solve_task.h"

#include <algorithm>
#include <set>

#include "core/editing/accepted.h"
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

namespace {

// The limbs of tasks and corrections. Error: one is not there.
Result<std::vector<int>> limbs_of(const Session& session, const std::vector<Task>& tasks,
                                  const std::vector<Correction>& accepted) {
  std::set<int> limbs;
  std::set<std::string> names;
  for (const Task& task : tasks) names.insert(task.limb);
  for (const Correction& correction : accepted)
    if (!correction.muted && session.is_of_clip(correction.clip)) names.insert(correction.limb);
  for (const std::string& name : names) {
    const auto named = limbs_named(session, name);
    if (!named) return named.error();
    limbs.insert(named->begin(), named->end());
  }
  return std::vector<int>(limbs.begin(), limbs.end());
}

void add(CorrectionOutcome& whole, CorrectionOutcome&& part) {
  for (auto& way : part.other_ways) {
    way.window += whole.windows.size();
    whole.other_ways.push_back(std::move(way));
  }
  for (auto& window : part.windows) whole.windows.push_back(std::move(window));
  for (auto& correction : part.corrections) whole.corrections.push_back(std::move(correction));
  whole.clip = part.clip;
}

// A task that makes the same correction again.
Task task_again(const Correction& correction) {
  Task task;
  task.name = correction.task.empty() ? correction.name : correction.task;
  task.clip = correction.clip;
  task.limb = correction.limb;
  task.window =
      Interval{static_cast<double>(correction.begin), static_cast<double>(correction.end)};
  task.even_if_free = true;
  task.wishes = correction.made_with;
  return task;
}

// What of a task is to be planned where some of its corrections, or none, hold.
std::vector<Task> left_of(const Task& task, const Session& session,
                          const std::vector<Correction>& accepted, const Accepted& now) {
  bool any = false, muted = false;
  for (const Correction& correction : accepted) {
    if (task.name.empty() || correction.task != task.name) continue;
    if (!session.is_of_clip(correction.clip)) continue;
    any = true;
    muted = muted || correction.muted;
  }
  const bool all_contacts = task.kind == TaskKind::correct && !task.window;
  if (!any || (all_contacts && !muted)) return {task};
  std::vector<Task> left;
  for (const auto& dropped : now.dropped) {
    if (dropped.correction.task != task.name) continue;
    Task again = all_contacts ? task_again(dropped.correction) : task;
    if (again.limb == "auto") again.limb = dropped.correction.limb;
    if (std::find(left.begin(), left.end(), again) == left.end()) left.push_back(std::move(again));
  }
  return left;
}

}  // namespace

Result<CorrectionOutcome> solve_tasks(SceneCollision& scene, const Session& session,
                                      const std::vector<Task>& tasks, std::stop_token stop,
                                      const ProgressSink& progress) {
  if (tasks.size() == 1) return solve_task(scene, session, tasks.front(), stop, progress);
  return solve_over_accepted(scene, session, tasks, {}, stop, progress);
}

Result<CorrectionOutcome> solve_over_accepted(SceneCollision& scene, const Session& session,
                                              const std::vector<Task>& tasks,
                                              const std::vector<Correction>& accepted,
                                              std::stop_token stop, const ProgressSink& progress) {
  const auto limbs = limbs_of(session, tasks, accepted);
  if (!limbs) return limbs.error();
  CorrectionOutcome whole;
  whole.clip = scene.world().actors[static_cast<std::size_t>(scene.actor())].clip;
  if (!whole.clip)
    return Error{"the character has no clip to correct", session.document.scene.character.string(),
                 "give a file with an animation"};
  if (progress) progress({"looking for contacts", -1});
  look_at_contacts(scene, *limbs, whole.before, &whole.other, stop);

  Accepted now = keep_accepted(scene, session, accepted, tasks, stop, progress);
  whole.clip = now.clip;
  for (auto& kept : now.kept) {
    whole.windows.push_back(std::move(kept.report));
    whole.corrections.push_back(std::move(kept.correction));
  }
  std::vector<Task> left;
  for (const Task& task : tasks)
    for (Task& part : left_of(task, session, accepted, now)) left.push_back(std::move(part));
  for (const auto& [correction, why] : now.dropped) {
    whole.notes.push_back("\"" + correction.name + "\" is planned anew: " + why);
    const bool has_task = std::any_of(tasks.begin(), tasks.end(), [&](const Task& task) {
      return !task.name.empty() && task.name == correction.task;
    });
    if (!has_task) left.push_back(task_again(correction));
  }

  for (const Task& task : left) {
    if (stop.stop_requested()) break;
    auto outcome = solve_task(scene, session, task, stop, progress);
    if (!outcome) return outcome.error();
    add(whole, std::move(*outcome));
  }
  if (progress) progress({"looking at the result", -1});
  if (whole.corrections.empty())
    whole.after = whole.before;
  else if (!stop.stop_requested())
    look_at_contacts(scene, *limbs, whole.after, nullptr, stop);
  whole.interrupted = stop.stop_requested();
  return whole;
}

}  // namespace elbowroom
