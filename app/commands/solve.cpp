// SPDX-License-Identifier: MIT
#include <algorithm>

#include "app/commands.h"
#include "app/delivery.h"
#include "app/exit_codes.h"
#include "app/planning_run.h"
#include "app/terminal.h"
#include "core/io/project_file.h"

namespace elbowroom {
namespace {

// A task all of whose corrections the animator has muted is passed over.
bool is_muted(const Document& document, const Task& task) {
  bool any = false;
  for (const Correction& correction : document.corrections) {
    if (task.name.empty() || correction.task != task.name) continue;
    if (!correction.muted) return false;
    any = true;
  }
  return any;
}

}  // namespace

int run_solve(const SolveOptions& options, Interruption& interruption) {
  PlanningRun run;
  run.project = options.project;
  run.outputs.out = options.out;
  run.outputs.report = options.report;
  run.outputs.per_file = options.per_file;
  if (!options.anew) run.corrections = PlanningRun::Corrections::kept;
  Status usage = check_file_name(options.project, "PROJECT");
  if (usage) usage = check_file_name(options.out, "-o");
  // The project's own name is safe from the report of what is wrong with it.
  RunFiles files;
  files.reads(run.project, "the project");
  declare_outputs(run.outputs, {}, {}, files);
  if (usage) usage = files.check_distinct();
  if (!usage) {
    print_error(usage.error());
    return kExitUsage;
  }
  auto document = read_project(options.project);
  if (!document) return refuse(document.error(), options.report, interruption);
  run.document = std::move(*document);
  for (const Task& task : run.document.tasks) {
    if (is_muted(run.document, task)) continue;
    run.outputs.ways = std::max(run.outputs.ways, task.wishes.alternatives);
    run.tasks.push_back(task);
  }
  return run_planning(run, interruption);
}

}  // namespace elbowroom
