// SPDX-License-Identifier: MIT
#include <algorithm>

#include "app/commands.h"
#include "app/delivery.h"
#include "app/exit_codes.h"
#include "app/terminal.h"
#include "core/editing/solve_task.h"
#include "core/io/project_file.h"

namespace elbowroom {

int run_solve(const SolveOptions& options, std::stop_token stop) {
  const auto document = read_project(options.project);
  if (!document) return refuse(document.error(), options.report);
  // Limbs named by joints are fitted besides the usual ones; a project may name one.
  std::string extra;
  for (const auto& task : document->tasks)
    if (task.limb.find("..") != std::string::npos) extra = task.limb;
  auto session = open_session(*document, extra);
  if (!session) return refuse(session.error(), options.report);
  print_warnings(session->warnings);
  const ProgressSink progress = terminal_progress();
  auto scene = contacts_of(*session, stop);
  if (!scene && stop.stop_requested()) return kExitInterrupted;
  if (!scene) return refuse(scene.error(), options.report);

  // A task all of whose corrections the animator has muted is passed over.
  const auto muted = [&](const Task& task) {
    bool any = false;
    for (const Correction& correction : document->corrections) {
      if (task.name.empty() || correction.task != task.name) continue;
      if (!correction.muted) return false;
      any = true;
    }
    return any;
  };

  const auto of_others =
      std::count_if(document->tasks.begin(), document->tasks.end(),
                    [&](const Task& task) { return !session->is_of_clip(task.clip); });
  if (of_others > 0)
    print_warnings({std::to_string(of_others) + (of_others == 1 ? " task" : " tasks") +
                    " of other clips passed over; this is " + session->clip_name()});

  CorrectionOutcome whole;
  whole.clip = session->clip();
  for (const auto& task : document->tasks) {
    if (muted(task) || !session->is_of_clip(task.clip)) continue;
    auto outcome = solve_task(*scene, *session, task, stop, progress);  // on the last one's clip
    if (!outcome) return refuse(outcome.error(), options.report);
    for (const auto& contact : outcome->before) whole.before.push_back(contact);
    whole.after = outcome->after;
    if (whole.other.empty()) whole.other = outcome->other;
    for (auto& window : outcome->windows) whole.windows.push_back(std::move(window));
    for (auto& correction : outcome->corrections)
      whole.corrections.push_back(std::move(correction));
    whole.clip = outcome->clip;
    if (stop.stop_requested()) break;
  }
  return deliver(*session, *scene, whole, {options.out, options.report, options.per_file});
}

}  // namespace elbowroom
