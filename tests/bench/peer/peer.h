// SPDX-License-Identifier: MIT
// The peer: OMPL's RRTConnect with FCL deciding collisions, on the very parts, pairs, placements,
// limits and speed limits that our own planner is given.
//
// State space: R^n of the limb's parameters plus time. Motions are directed (time must advance, the
// speed limits hold) and tested by bisection at the resolution given; nearest neighbours are looked
// for linearly, as ours are. FCL knows no clearance short of a distance query (over 100 times as
// dear), so the peer keeps none.
//
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/dof_space.h"
#include "core/planning/interpolation.h"
#include "tests/support/fcl_world/fcl_world.h"

namespace elbowroom::bench {

using test::FclWorld;

// What the peer is asked: the limb's own question, without a clearance.
struct PeerProblem {
  const DofSpace* space = nullptr;  // limits and speed limits
  Configuration init, goal;
  std::vector<double> steps;  // times at which the world jumps
};

struct PeerSettings {
  double range = 0.8;  // RRTConnect's, in the norm of (parameters, time)
  EdgeResolution resolution{0.04, 1.0 / 90.0};
  int shortcuts = 100;
  double max_seconds = 10;
  std::uint64_t seed = 1;
};

struct PeerRun {
  bool solved = false;
  std::int64_t checks_plan = 0, checks_smooth = 0;
  double ms_plan = 0, ms_smooth = 0;
  std::vector<Configuration> first, smooth;
};

PeerRun run_peer(const PeerProblem& problem, FclWorld& world, const PeerSettings& settings);

}  // namespace elbowroom::bench
