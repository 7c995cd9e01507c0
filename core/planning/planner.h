// SPDX-License-Identifier: MIT
// SYNCPLANNER [SKF07 4.1, Algorithm 1]: a bidirectional RRT through space and time, whose landmarks
// have monotone time.
//
//     PlannerSettings + PlannerQuery + stop token → PlannerResult
//
// Where the paper leaves a choice:
//  * Nearest nodes are looked for among those on the right side of the sample in time (earlier in
//    T_init, later in T_goal): growth from any other would be refused as not monotone.
//  * A sample that is too far in posture for its distance in time is drawn towards the node it is
//    expanded from, at its own time, until the speed limits hold; then the step of ε is taken.
//    Samples that no motion between init and goal could visit are pulled into reach beforehand
//    (sampler.h), so that short windows do not starve.
//  * ε/d is bounded by 1: a node never goes beyond its sample. A sample at a node (d = 0) is
//  refused.
//  * A pair of nodes whose connection failed is not tested again.
//  * The trees grow at one resolution and a path found is tested at a finer one, that of smoothing
//    and curve; an edge that fails there is cut off with what grew from it, and the search goes on.
//
// The same query, settings, seed and iteration budget give the same bytes, on one thread or many
// (each with its own StateSpace). A time budget only decides how many iterations are made; their
// number is in the result and, given as max_iterations, gives the result again.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/planning/interpolation.h"
#include "core/planning/sampler.h"

namespace elbowroom {

struct PlannerSettings {
  // dist = w_t |Δt| + w_a max |Δp|, with w_t in length units a second.
  double time_weight = 0.5;
  double posture_weight = 1.0;
  double step = 0.5;                                  // ε, in length units
  EdgeResolution resolution{0.04, 1.0 / 90.0};        // of edges while the trees grow
  EdgeResolution path_resolution{0.02, 1.0 / 240.0};  // of the edges of a path found
  SamplingSettings sampling;
  // Share of the speed limits that the search may use; the rest is left to the curve that rounds
  // the path's corners. Raised, up to 1, where the way from init to goal alone needs more.
  double speed_share = 0.85;
  double smallest_time_step = 1e-4;  // seconds between landmarks, at least
  std::uint64_t seed = 1;
  std::int64_t max_iterations = 20000;
  // Where checks are dear, iterations say little: the search ends too when it has made these.
  std::int64_t max_validity_checks = std::numeric_limits<std::int64_t>::max();
  double max_seconds = std::numeric_limits<double>::infinity();
};

struct PlannerQuery {
  const DofSpace* space = nullptr;  // must outlive the call
  Configuration init, goal;         // (c_init, t_init), (c_goal, t_goal)
  double length_unit = 1;           // the limb's length, scene units: the unit of the metric
  // The clip's parameters over the window, for SamplingSettings::near_share; may be empty.
  std::function<Dofs(double t)> reference;
};

enum class PlannerStatus {
  solved,
  no_path,        // within the budget
  cancelled,      // by the stop token
  invalid_start,  // init breaks limits or collides
  invalid_goal,
  invalid_query,  // not a question: an empty window, NaN, no DOFs, ...
};
const char* planner_status_id(PlannerStatus status);  // "solved", "no_path", ...

struct PlannerStats {
  std::int64_t iterations = 0;  // made, the successful one included
  CheckCounters checks;
  SamplingCounters sampling;
  std::int64_t nodes_init = 0, nodes_goal = 0;
  std::int64_t landmarks = 0;
};

struct PlannerResult {
  PlannerStatus status = PlannerStatus::invalid_query;
  std::string reason;               // one sentence, where status is not solved
  std::vector<Configuration> path;  // landmarks: first init, last goal (bit for bit), times ascend
  PlannerStats stats;
  double milliseconds = 0;  // computing time; not part of what repeats
};

// Never throws on hostile input; a stop request is answered after at most one validity check.
PlannerResult plan(StateSpace& world, const PlannerQuery& query, const PlannerSettings& settings,
                   std::stop_token stop = {}, const ProgressSink& progress = {});

}  // namespace elbowroom
