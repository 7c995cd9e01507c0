// SPDX-License-Identifier: MIT
// The problems of the planner's benchmark: the demo scene and two harder ones in its place.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/collision/limb_planning_space.h"
#include "core/collision/scene_collision.h"
#include "core/editing/limb_track.h"

namespace elbowroom::bench {

// One limb over one window, as `correct` would ask it.
struct Problem {
  std::string name, about;
  std::unique_ptr<SceneCollision> scene;
  std::unique_ptr<LimbTrack> track;  // the clip's own parameters
  int limb = -1;
  double begin = 0, end = 0;  // the window, seconds
  LimbState at_init, at_goal;
  Dofs velocity_init, velocity_goal;
  DofSpace space;  // limits and speed limits, widened to the clip's own
  double length_unit = 1;
  std::size_t triangles_limb = 0, triangles_rest = 0;

  Configuration init() const { return {at_init.q, begin}; }
  Configuration goal() const { return {at_goal.q, end}; }
  std::unique_ptr<LimbPlanningSpace> planning_space(double clearance) const;
};

// Names, in a fixed order.
std::vector<std::string> problem_names();

// An error where its scene can't be had or there is no such problem.
Result<Problem> make_problem(const std::string& name);

}  // namespace elbowroom::bench
