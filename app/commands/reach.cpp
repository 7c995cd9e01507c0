// SPDX-License-Identifier: MIT
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/terminal.h"

namespace elbowroom {

int run_reach(const ReachOptions& options, Interruption& interruption) {
  Task task;
  task.kind = TaskKind::reach;
  task.name = "reach " + options.plan.limb;
  Status read = read_plan_options(options.plan, task);
  const auto target = parse_target(options.target);
  if (read && !target) read = target.error();
  const auto at = parse_number(options.at, "--at");
  if (read && !at) read = at.error();
  if (read && options.plan.limb == "auto")
    read = Error{"a target is reached by one limb", "--limb",
                 "name it: left_arm, right_arm, left_leg, right_leg or FROM..TO"};
  if (!read) {
    print_error(read.error());
    return kExitUsage;
  }
  task.target = *target;
  task.target->time = *at;
  task.target->grasp = options.grasp;
  return run_task(options.plan, task, interruption);
}

}  // namespace elbowroom
