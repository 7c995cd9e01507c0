// SPDX-License-Identifier: MIT
// The document: what an animator has asked for and got. Plain data; what a project file holds.
//
// A task is the wish ("correct the right arm"), a correction what came of it: keys for one limb
// over one window, with the settings and the seed that made them. The source clip is never
// modified; the corrected clip is the source with the corrections laid over it in order. Tasks and
// corrections belong to a clip: those of others are kept and come back with theirs.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/anatomy/limb.h"
#include "core/animation/splice.h"
#include "core/base/swing_polygon.h"
#include "core/scene/scene_description.h"

namespace elbowroom {

struct Interval {
  double lower = 0, upper = 0;
  bool operator==(const Interval&) const = default;
};

// What the planner is told besides the problem itself. Lengths of 0 mean the scene's default.
struct PlanningWishes {
  std::uint64_t seed = 1;
  int alternatives = 1;                      // ways planned; the best is taken
  double clearance = 0;                      // scene units
  int max_iterations = 4000;                 // of Algorithm 1, for each attempt
  double max_seconds = 0;                    // 0: iterations alone bound it (same bytes again)
  std::map<std::string, Interval> sampling;  // by DOF name, radians; others: the limb's default
  bool operator==(const PlanningWishes&) const = default;
};

// Where the end of a limb shall be at a time [SKF07 5]: the wrist's (ankle's) own origin, in the
// world, scene units.
struct HandTarget {
  double time = 0;  // seconds
  Vec3 position{0.0};
  std::optional<Quat> orientation;  // world_from_joint rotation of the end joint; none: free
  // Position and orientation are those of the palm's (sole's) grasp frame instead; without an
  // orientation the hand keeps the one that it has in the clip.
  bool grasp = false;
  bool operator==(const HandTarget&) const = default;
};

enum class TaskKind {
  correct,  // around what the limb collides with [SKF07 6.1]
  reach,    // to a target and back, around what is in the way [SKF07 6.2]
};
// As in the project file.
inline const char* task_kind_id(TaskKind kind) {
  return kind == TaskKind::reach ? "reach" : "correct";
}

struct Task {
  TaskKind kind = TaskKind::correct;
  std::string name;
  std::string clip;                  // whose task it is, by name or index; empty: any clip's
  std::string limb = "auto";         // LIMB as on the command line; a reach names one
  std::optional<Interval> window;    // seconds; none: auto
  std::optional<HandTarget> target;  // of a reach
  bool even_if_free = false;         // plan the window though nothing collides in it
  PlanningWishes wishes;
  bool operator==(const Task&) const = default;
};

// One limb joint's keys inside the window.
struct JointKeys {
  std::string joint;  // name; the index is the truth where names repeat
  int node = -1;
  RotationKeys keys;
  // Of a joint that follows the limb from elsewhere in the tree: one for each of keys.times. Else
  // none; the joint keeps its clip's.
  std::vector<Vec3> translations{};
  bool operator==(const JointKeys&) const = default;
};

struct Correction {
  std::string name;
  std::string task;          // name of the task it came of; empty: of none that is kept
  std::string clip;          // that it lies over, by name or index; empty: any clip
  std::string limb;          // limb_id, or FROM..TO
  float begin = 0, end = 0;  // the window, seconds, float32 as exported
  bool muted = false;
  PlanningWishes made_with;
  std::vector<JointKeys> joints;
  bool operator==(const Correction&) const = default;
};

// What the animator is preparing: the next task, not yet asked for.
struct Draft {
  std::string limb;                              // name; empty: none chosen
  std::optional<Interval> window;                // seconds
  std::optional<HandTarget> target;              // set: the next task is a reach
  std::map<std::string, PlanningWishes> wishes;  // by limb name
  bool operator==(const Draft&) const = default;
};

// How far a limb's joints may swing, as the animator says, by the limb's name: polygons of its
// root, middle and end. Empty: as far as the joint's own limit. A limb without any has no entry.
using SwingLimits = std::map<std::string, std::array<SwingPolygon, 3>>;

struct Document {
  SceneDescription scene;
  LimbOverrides limbs;  // which joints the animator says a limb has; by limb_id, or chains by name
  SwingLimits swing_limits;
  Draft draft;
  std::vector<Task> tasks;
  std::vector<Correction> corrections;  // in order: later ones lie over earlier ones
  bool operator==(const Document&) const = default;
};

}  // namespace elbowroom
