// SPDX-License-Identifier: MIT
// What the program's exit says to a script.
#pragma once

namespace elbowroom {

enum ExitCode {
  kExitDone = 0,           // also when there was nothing to correct
  kExitUsage = 1,          // wrong usage
  kExitBadInput = 2,       // file, node and reason are named
  kExitNoMotion = 3,       // no valid motion found within the budget
  kExitContacts = 4,       // from `check`: contacts found
  kExitInterrupted = 130,  // SIGINT
};

}  // namespace elbowroom
