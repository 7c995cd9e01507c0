// SPDX-License-Identifier: MIT
#include "core/editing/correct.h"

#include <cstdlib>

#include "app/commands.h"
#include "app/delivery.h"
#include "app/exit_codes.h"
#include "app/terminal.h"
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

int run_correct(const CorrectOptions& options, std::stop_token stop) {
  auto document = document_from(options.scene);
  if (!document) {
    print_error(document.error());
    return options.scene.project.empty() ? kExitUsage : kExitBadInput;
  }
  Task task;
  task.name = "correct " + options.limb;
  task.limb = options.limb;
  const auto window = parse_window(options.window);
  if (!window) {
    print_error(window.error());
    return kExitUsage;
  }
  task.window = *window;
  task.wishes.seed = options.seed;
  task.wishes.alternatives = options.alternatives;
  task.wishes.clearance = options.clearance;
  for (const auto& text : options.sampling) {
    const auto sampling = parse_sampling(text);
    if (!sampling) {
      print_error(sampling.error());
      return kExitUsage;
    }
    task.wishes.sampling.insert(*sampling);
  }

  auto session = open_session(*document, options.limb);
  if (!session) return refuse(session.error(), options.report);
  print_warnings(session->warnings);
  const auto limbs = limbs_named(*session, options.limb);
  if (!limbs) return refuse(limbs.error(), options.report);
  const ProgressSink progress = terminal_progress();
  if (progress) progress({"looking at the scene", -1});
  auto scene = contacts_of(*session);
  if (!scene) return refuse(scene.error(), options.report);
  const auto outcome = correct(*scene, *limbs, task, stop, progress);
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
