// SPDX-License-Identifier: MIT
// What the commands that plan one task have in common: their options, and the way from a task to
// delivered files.
#pragma once

#include <string>
#include <vector>

#include "app/interruption.h"
#include "app/options.h"
#include "core/base/result.h"
#include "core/editing/document.h"

namespace elbowroom {

struct PlanOptions {
  SceneOptions scene;
  std::string limb = "auto";
  std::string window = "auto";
  std::string seed = "1";
  int alternatives = 1;
  std::string clearance = "0";
  std::vector<std::string> sampling;  // "DOF=LOWER:UPPER" in degrees
  std::string out;
  std::string report;
  std::string save_project;
};

// Adds them all to a command; `limb_help` says what LIMB may be left to be.
void add_plan_options(CLI::App& command, PlanOptions& options, const std::string& limb_help);

// Limb, window and wishes as typed. Errors are wrong usage.
Status read_plan_options(const PlanOptions& options, Task& task);

// Solves the task in the scene of the options, on top of the corrections that a project has;
// delivers the outcome and saves the project if asked to. Prints, and returns the exit code.
int run_task(const PlanOptions& options, Task task, Interruption& interruption);

}  // namespace elbowroom
