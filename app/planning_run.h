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
  // On top of the document's corrections that are not muted; else on the clip as it is in the file.
  bool over_corrections = false;
  // The tasks' wishes were typed: what is wrong with them is wrong usage.
  bool typed = false;
  Outputs outputs;
};

// Checks where outputs would go before anything else; opens the scene, does the tasks, delivers.
// Prints, and returns the exit code.
int run_planning(const PlanningRun& run, Interruption& interruption);

}  // namespace elbowroom
