// SPDX-License-Identifier: MIT
#include "app/plan_command.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "app/delivery.h"
#include "app/exit_codes.h"
#include "app/planning_run.h"
#include "app/terminal.h"
#include "core/editing/unique_names.h"

namespace elbowroom {
namespace {

// "Elbow, flexion=20:120", degrees.
Result<std::pair<std::string, Interval>> parse_sampling(const std::string& text) {
  const auto equals = text.rfind('=');
  const auto window =
      equals == std::string::npos
          ? Result<std::optional<Interval>>(Error{"there is no \"=\" in \"" + text + "\"", "", ""})
          : parse_window(text.substr(equals + 1));
  if (!window || !*window)
    return Error{"\"" + text + "\" is no sampling interval", "--sample",
                 "the form is \"DOF=LOWER:UPPER\", degrees, such as \"Elbow, flexion=20:120\""};
  return std::pair(text.substr(0, equals),
                   Interval{(*window)->lower * kPi / 180, (*window)->upper * kPi / 180});
}

}  // namespace

void add_plan_options(CLI::App& command, PlanOptions& options, const std::string& limb_help) {
  add_scene_options(command, options.scene);
  command.add_option("--limb", options.limb, limb_help)->type_name("LIMB");
  command.add_option("--window", options.window, "what to replan (default auto)")
      ->type_name("A:B|auto");
  command.add_option("--seed", options.seed, "of the random planner (default 1)")->type_name("N");
  command
      .add_option("--alternatives", options.alternatives,
                  "ways to plan, of which the best is taken (default 1)")
      ->type_name("K")
      ->check(CLI::Range(1, 64));
  command
      .add_option("--clearance", options.clearance,
                  "distance to keep, scene units (default 5 mm for a height of 1.75 m)")
      ->type_name("D");
  command
      .add_option("--sample", options.sampling,
                  "a DOF's sampling interval in degrees, \"Elbow, flexion=20:120\"; may be given "
                  "more than once")
      ->type_name("DOF=A:B")
      ->allow_extra_args(false);
  command.add_option("-o,--out", options.out, "the corrected file")
      ->type_name("OUT.glb")
      ->required();
  command.add_option("--report", options.report, "write a report")->type_name("R.json");
  command
      .add_option("--save-project", options.save_project,
                  "write the scene, the task and its corrections as a project")
      ->type_name("P.elbow");
}

Status read_plan_options(const PlanOptions& options, Task& task) {
  if (Status scene = check_scene_options(options.scene); !scene) return scene;
  if (Status out = check_file_name(options.out, "-o"); !out) return out;
  task.limb = options.limb;
  const auto window = parse_window(options.window);
  if (!window) return window.error();
  task.window = *window;
  const auto seed = parse_seed(options.seed);
  if (!seed) return seed.error();
  const auto clearance = parse_length(options.clearance, "--clearance");
  if (!clearance) return clearance.error();
  task.wishes.seed = *seed;
  task.wishes.alternatives = options.alternatives;
  task.wishes.clearance = *clearance;
  for (const auto& text : options.sampling) {
    const auto sampling = parse_sampling(text);
    if (!sampling) return sampling.error();
    if (!task.wishes.sampling.insert(*sampling).second)
      return Error{"\"" + sampling->first + "\" is given more than one interval", "--sample",
                   "give each DOF once"};
  }
  return Done{};
}

int run_task(const PlanOptions& options, Task task, Interruption& interruption) {
  PlanningRun run;
  run.project = options.scene.project;
  run.corrections = PlanningRun::Corrections::beneath;
  run.typed = true;
  run.outputs.out = options.out;
  run.outputs.report = options.report;
  run.outputs.save_project = options.save_project;
  run.outputs.ways = options.alternatives;
  // The project is safe from the report of what is wrong with it.
  RunFiles files;
  files.reads(run.project, "the project");
  declare_outputs(run.outputs, {}, run.project, files);
  if (Status distinct = files.check_distinct(); !distinct) {
    print_error(distinct.error());
    return kExitUsage;
  }
  auto document = document_from(options.scene);
  if (!document) return refuse(document.error(), options.report, interruption);
  run.document = std::move(*document);
  task.name = unique_task_name(run.document, task.name);
  run.tasks = {std::move(task)};
  return run_planning(run, interruption);
}

}  // namespace elbowroom
