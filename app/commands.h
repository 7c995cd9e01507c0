// SPDX-License-Identifier: MIT
// The program's commands (DESIGN.md, "The command line"). Each prints for people on standard
// output, errors on standard error, and returns its exit code.
#pragma once

#include <string>
#include <vector>

#include "app/interruption.h"
#include "app/options.h"
#include "app/plan_command.h"

namespace elbowroom {

struct InfoOptions {
  std::string file;
  bool json = false;
};
int run_info(const InfoOptions& options);

struct CheckOptions {
  SceneOptions scene;
  std::string report;
};
int run_check(const CheckOptions& options, Interruption& interruption);

using CorrectOptions = PlanOptions;
int run_correct(const CorrectOptions& options, Interruption& interruption);

struct ReachOptions {
  PlanOptions plan;
  std::string target;  // "X,Y,Z[,QX,QY,QZ,QW]"
  std::string at;      // seconds
  bool grasp = false;  // the target is the palm's
};
int run_reach(const ReachOptions& options, Interruption& interruption);

struct SolveOptions {
  std::string project;
  std::string out;
  std::string report;
  std::string per_file;  // folder: each source that was changed, under its own name
  bool anew = false;     // accepted corrections are not kept but planned again
};
int run_solve(const SolveOptions& options, Interruption& interruption);

struct RenderOptions {
  SceneOptions scene;
  std::string times;
  std::string out;
  int columns = 0;            // 0: chosen
  int width = 0, height = 0;  // of one frame, pixels; 0: chosen
  std::string compare_clip;   // a second row that plays this clip
};
int run_render(const RenderOptions& options, Interruption& interruption);

}  // namespace elbowroom
