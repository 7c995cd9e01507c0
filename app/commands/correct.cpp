// SPDX-License-Identifier: MIT
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/terminal.h"

namespace elbowroom {

int run_correct(const CorrectOptions& options, Interruption& interruption) {
  Task task;
  task.name = "correct " + options.limb;
  if (Status read = read_plan_options(options, task); !read) {
    print_error(read.error());
    return kExitUsage;
  }
  return run_task(options, task, interruption);
}

}  // namespace elbowroom
