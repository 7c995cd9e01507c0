// SPDX-License-Identifier: MIT
// The document: what an animator has asked for and got. Plain data; what a project file holds.
//
// A task is the wish ("correct the right arm"), a correction what came of it: keys for one limb
// over one window, with the settings and the seed that made them. The source clip is never
// modified; the corrected clip is the source with the corrections laid over it in order.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/animation/splice.h"
#include "core/scene/scene_description.h"

namespace elbowroom {

struct Interval {
  double lower = 0, upper = 0;
};

// What the planner is told besides the problem itself. Lengths of 0 mean the scene's default.
struct PlanningWishes {
  std::uint64_t seed = 1;
  int alternatives = 1;                      // ways planned; the best is taken
  double clearance = 0;                      // scene units
  int max_iterations = 4000;                 // of Algorithm 1, for each attempt
  double max_seconds = 0;                    // 0: iterations alone bound it (same bytes again)
  std::map<std::string, Interval> sampling;  // by DOF name, radians; others: the limb's default
};

struct CorrectTask {
  std::string name;
  std::string limb = "auto";       // LIMB as on the command line
  std::optional<Interval> window;  // seconds; none: auto
  PlanningWishes wishes;
};

// One limb joint's keys inside the window.
struct JointKeys {
  std::string joint;  // name; the index is the truth where names repeat
  int node = -1;
  RotationKeys keys;
};

struct Correction {
  std::string name;
  std::string limb;          // limb_id, or FROM..TO
  float begin = 0, end = 0;  // the window, seconds, float32 as exported
  bool muted = false;
  PlanningWishes made_with;
  std::vector<JointKeys> joints;
};

struct Document {
  SceneDescription scene;
  std::vector<CorrectTask> tasks;
  std::vector<Correction> corrections;  // in order: later ones lie over earlier ones
};

}  // namespace elbowroom
