// SPDX-License-Identifier: MIT
#include "app/plan_command.h"

#include <CLI/CLI.hpp>

#include "app/delivery.h"
#include "app/exit_codes.h"
#include "app/terminal.h"
#include "core/editing/solve_task.h"
#include "core/io/project_file.h"

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
      ->type_name("D")
      ->check(CLI::NonNegativeNumber);
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
  task.limb = options.limb;
  const auto window = parse_window(options.window);
  if (!window) return window.error();
  task.window = *window;
  task.wishes.seed = options.seed;
  task.wishes.alternatives = options.alternatives;
  task.wishes.clearance = options.clearance;
  for (const auto& text : options.sampling) {
    const auto sampling = parse_sampling(text);
    if (!sampling) return sampling.error();
    task.wishes.sampling.insert(*sampling);
  }
  return Done{};
}

int run_task(const PlanOptions& options, const Task& task, std::stop_token stop) {
  auto document = document_from(options.scene);
  if (!document) {
    print_error(document.error());
    return options.scene.project.empty() ? kExitUsage : kExitBadInput;
  }
  auto session = open_session(*document, task.limb);
  if (!session) return refuse(session.error(), options.report);
  print_warnings(session->warnings);
  if (const auto limbs = limbs_named(*session, task.limb); !limbs)
    return refuse(limbs.error(), options.report);
  const ProgressSink progress = terminal_progress();
  if (progress) progress({"looking at the scene", -1});
  auto scene = contacts_of(*session, stop);
  if (!scene && stop.stop_requested()) return kExitInterrupted;
  if (!scene) return refuse(scene.error(), options.report);
  const auto outcome = solve_task(*scene, *session, task, stop, progress);
  if (!outcome) return refuse(outcome.error(), options.report);
  const int code = deliver(*session, *scene, *outcome, {options.out, options.report});
  if (code == kExitDone && !options.save_project.empty()) {
    document->tasks.push_back(task);
    document->corrections.insert(document->corrections.end(), outcome->corrections.begin(),
                                 outcome->corrections.end());
    if (Status saved = write_project(options.save_project, *document); !saved) {
      print_error(saved.error());
      return kExitBadInput;
    }
  }
  return code;
}

}  // namespace elbowroom
