// SPDX-License-Identifier: MIT
#include "app/planning_run.h"

#include <algorithm>

#include "app/delivery.h"
#include "app/exit_codes.h"
#include "app/terminal.h"
#include "core/editing/solve_task.h"
#include "core/editing/unique_names.h"
#include "core/editing/window_problem.h"
#include "core/io/project_file.h"

namespace elbowroom {
namespace {

// The document with the tasks and what came of them.
Document with_outcome(const PlanningRun& run, const CorrectionOutcome& outcome) {
  Document document = run.document;
  document.tasks.insert(document.tasks.end(), run.tasks.begin(), run.tasks.end());
  for (Correction correction : outcome.corrections) {
    correction.name = unique_correction_name(document, correction.name);
    document.corrections.push_back(std::move(correction));
  }
  return document;
}

// Everything that is known to be wrong with the outputs before any work.
Status check_outputs(const PlanningRun& run, const RunFiles& files) {
  if (Status places = files.check_places(); !places) return places;
  if (run.outputs.save_project.empty()) return Done{};
  const auto text = project_text(run.outputs.save_project, run.document, run.project);
  if (!text) return text.error();
  return Done{};
}

// Error: the first wish that can't be.
Status check_tasks(const Session& session, const SceneCollision& scene,
                   const std::vector<Task>& tasks) {
  for (const Task& task : tasks) {
    const auto limbs = limbs_named(session, task.limb);
    if (!limbs) return limbs.error();
    if (Status sound = check_wishes(scene, *limbs, task.wishes); !sound) return sound;
    print_warnings(wishes_cut(scene, *limbs, task.wishes));
  }
  return Done{};
}

// Whether one of the tasks or corrections is said to be of a clip.
template <typename List>
bool names_a_clip(const List& list) {
  return std::any_of(list.begin(), list.end(), [](const auto& one) { return !one.clip.empty(); });
}

// Those of the clip that is played; says how many others are passed over.
std::vector<Task> tasks_of_clip(const Session& session, const std::vector<Task>& tasks) {
  std::vector<Task> own;
  for (const Task& task : tasks)
    if (session.is_of_clip(task.clip)) own.push_back(task);
  const std::size_t others = tasks.size() - own.size();
  if (others > 0)
    print_warnings({std::to_string(others) + (others == 1 ? " task" : " tasks") +
                    " of other clips passed over; this is " + session.clip_name()});
  return own;
}

}  // namespace

int run_planning(const PlanningRun& run, Interruption& interruption) {
  const auto refused = [&](const Error& error) {
    return refuse(error, run.outputs.report, interruption);
  };
  RunFiles files;
  files.reads(run.project, "the project");
  files.reads(run.document.scene);
  declare_outputs(run.outputs, run.document.scene.character, run.project, files);
  if (Status distinct = files.check_distinct(); !distinct) {
    print_error(distinct.error());
    return kExitUsage;
  }
  if (Status outputs = check_outputs(run, files); !outputs) return refused(outputs.error());

  // What limbs other clips' tasks name is not looked at: a session without limbs of its own tells
  // whose the tasks are.
  const bool keep = run.corrections == PlanningRun::Corrections::kept;
  const auto& document = run.document;
  std::vector<Task> tasks = run.tasks;
  std::vector<Correction> accepted = keep ? document.corrections : std::vector<Correction>();
  if (names_a_clip(tasks) || names_a_clip(accepted)) {
    const auto plain = open_session(document, {});
    if (!plain) return refused(plain.error());
    tasks = tasks_of_clip(*plain, run.tasks);
    std::erase_if(accepted, [&](const auto& one) { return !plain->is_of_clip(one.clip); });
  }
  std::vector<std::string> limbs;
  for (const Task& task : tasks) limbs.push_back(task.limb);
  for (const Correction& correction : accepted)
    if (!correction.muted) limbs.push_back(correction.limb);
  auto session = open_session(run.document, limbs);
  if (!session) return refused(session.error());
  print_warnings(session->warnings);
  for (const Task& task : tasks)
    if (const auto found = limbs_named(*session, task.limb); !found) return refused(found.error());
  const ProgressSink progress = terminal_progress();
  if (progress) progress({"looking at the scene", -1});
  auto scene = contacts_of(*session, interruption.token());
  if (!scene) return refused(scene.error());
  if (Status sound = check_tasks(*session, *scene, tasks); !sound) {
    if (!run.typed) return refused(sound.error());
    print_error(sound.error());
    return kExitUsage;
  }

  std::shared_ptr<const Clip> start = session->clip();
  if (run.corrections == PlanningRun::Corrections::beneath && !document.corrections.empty()) {
    std::vector<Correction> own;
    for (const Correction& correction : document.corrections)
      if (session->is_of_clip(correction.clip)) own.push_back(correction);
    auto laid = lay_over(session->scene.model().skeleton, *start, own);
    if (!laid) return refused(laid.error());
    start = std::make_shared<const Clip>(std::move(*laid));
    scene->set_clip(start);
  }
  const auto outcome =
      accepted.empty()
          ? solve_tasks(*scene, *session, tasks, interruption.token(), progress)
          : solve_over_accepted(*scene, *session, tasks, accepted, interruption.token(), progress);
  if (!outcome) return refused(outcome.error());
  print_warnings(outcome->notes);
  return deliver(
      {*session, *scene, *outcome, start, run.outputs, with_outcome(run, *outcome), run.project},
      files, interruption);
}

}  // namespace elbowroom
