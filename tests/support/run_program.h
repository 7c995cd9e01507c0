// SPDX-License-Identifier: MIT
// Runs the program as a person would, and says what it printed and how it ended.
#pragma once

#include <string>
#include <vector>

namespace elbowroom::test {

struct ProgramRun {
  int exit_code = -1;  // 128 + signal if a signal ended it
  std::string out, err;
};

// No shell: arguments are passed as they are. `interrupt_after_ms` > 0 sends SIGINT after that
// time, `signals` of them `apart_ms` from each other.
ProgramRun run_program(const std::string& program, const std::vector<std::string>& arguments,
                       int interrupt_after_ms = 0, int signals = 1, int apart_ms = 0);

}  // namespace elbowroom::test
