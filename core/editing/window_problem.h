// SPDX-License-Identifier: MIT
// What is asked of one window of one limb: where its motion begins and ends, through which postures
// it leads, and within which limits.
//
// Seconds, radians. Plain data; refers to the scene and its limbs, keeps the clip.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/collision/scene_collision.h"
#include "core/editing/document.h"
#include "core/editing/limb_track.h"

namespace elbowroom {

// A posture the motion meets, with its velocity (rad/s) and, if it has one to meet, acceleration.
struct PostureAt {
  double time = 0;  // float32 value
  LimbState state;
  Dofs velocity;
  std::optional<Dofs> acceleration{};  // rad/s²
};

struct WindowProblem {
  SceneCollision* scene = nullptr;
  std::shared_ptr<const Clip> clip;
  int limb_index = 0;
  const LimbModel* limb = nullptr;
  double begin = 0, end = 0;  // float32 values
  DofSpace space;             // limits and speed limits, widened to the clip's own; sampling
  std::vector<std::string> limits_widened;  // DOF names
  double length_unit = 1;                   // of the metric: the limb's length, scene units
  std::shared_ptr<const LimbTrack> track;   // what the clip does
  // First the one at `begin`, last the one at `end`; between them those of a reach, ascending. The
  // residuals of those between are residual_at their times.
  std::vector<PostureAt> postures;

  // By DOF: where the animator's sampling intervals want it; none: as the clip has it.
  std::vector<std::optional<Interval>> wanted;

  // What the motion is to be like at t: the clip, and between the postures moved into the sampling
  // intervals that the animator has set. Sampling alone would not keep a style: a curve that is
  // drawn back to the clip forgets where its path was found.
  Dofs reference_at(double t) const;

  // DESIGN.md, "Residual": from its value at `begin` to that at `end` by slerp.
  std::array<Quat, 3> residual_at(double t) const;
};

// From the clip's posture at `begin` to that at `end`, which are float32 values within the clip.
WindowProblem window_problem(SceneCollision& scene, const std::shared_ptr<const Clip>& clip,
                             int limb, double begin, double end, const PlanningWishes& wishes);

// Sampling intervals are for DOFs that one of the limbs has, hold something and reach into the
// limits; a clearance is at most a quarter of the height. Error: the first that isn't so, with what
// there is.
Status check_wishes(const SceneCollision& scene, const std::vector<int>& limbs,
                    const PlanningWishes& wishes);
// For people: sampling intervals that go beyond the limits and are cut to them.
std::vector<std::string> wishes_cut(const SceneCollision& scene, const std::vector<int>& limbs,
                                    const PlanningWishes& wishes);

}  // namespace elbowroom
