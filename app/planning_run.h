// SPDX-License-Identifier: MIT
// From tasks to delivered files: what `correct`, `reach` and `solve` have in common.
#pragma once

#include <filesystem>
#include <vector>

#include "app/interruption.h"
#include "app/outputs.h"
#include "core/editing/document.h"

namespace elbowroom {

struct PlanningRun {
  Document document;
  std::filesystem::path project;  // that the document was read from; empty: none
  std::vector<Task> tasks;        // to do, in this order
  // What becomes of the document's corrections that are not muted. beneath: the tasks are done on
  // top of them, as they are. kept: they are what has been done of the tasks already, as far as
  // they hold (solve_over_accepted). ignored: the tasks are done on the clip as it is in the file.
  enum class Corrections { ignored, beneath, kept } corrections = Corrections::ignored;
  // The tasks' wishes were typed: what is wrong with them is wrong usage.
  bool typed = false;
  Outputs outputs;
};

// Checks where outputs would go before anything else; opens the scene, does the tasks, delivers.
// Prints, and returns the exit code.
int run_planning(const PlanningRun& run, Interruption& interruption);

}  // namespace elbowroom
