// SPDX-License-Identifier: MIT
// The final sampling routine [SKF07 4.2]: random valid space-time configurations, drawn where
// natural postures are.
//
// Time is uniform in [t_init, t_goal]. Each DOF is uniform in its sampling interval
// (Dof::sample_lower, sample_upper), the animator's control over the look of a motion, with two
// biases: flexions start near full flexion and secondary swings near what the clip does, and both
// intervals widen with the iterations of the search up to the whole sampling interval. Swing pairs
// outside their ellipse, and configurations in collision, are drawn again.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>

#include "core/base/random.h"
#include "core/planning/interpolation.h"

namespace elbowroom {

struct SamplingSettings {
  // Flexion is drawn from the upper part of its sampling interval: from this share of the interval
  // (0.9: between 90 and 100 % of flexion) at first ...
  double flexion_from = 0.9;
  // ... widening linearly to the whole interval over so many iterations; 0: whole at once.
  std::int64_t flexion_iterations = 60;
  // Secondary swings (wrist, ankle) are drawn about their value on the straight way from init to
  // goal, within this share of their sampling interval at first and that share in the end.
  double secondary_from = 0.25;
  double secondary_to = 1.0;
  std::int64_t secondary_iterations = 600;
  // Share of the samples that are drawn near a reference, the clip's own motion: its values at the
  // sample's time, of which a few DOFs are moved by up to near_reach. 0, the paper's way, draws
  // none so. A limb in tight quarters (a hand with a shield strapped to it) has few other free
  // postures, and what is near the clip keeps its style. Without a reference nothing is drawn near
  // it.
  double near_share = 0;
  double near_reach = 0.8;  // radians
  // Draws in one call before it gives up.
  int max_tries = 64;
};

// What the sampler draws for: the ends of the search, both within limits, init.t < goal.t.
struct SamplingQuery {
  const DofSpace* space = nullptr;
  Configuration init, goal;
  double speed_share = 1.0;  // of the speed limits, that the motion may use
  // The clip's parameters over the window, continuous; may be empty. It may collide.
  std::function<Dofs(double t)> reference;
};

struct SamplingCounters {
  std::int64_t draws = 0;
  std::int64_t outside_limits = 0;  // of them, outside an ellipse
  std::int64_t in_collision = 0;
};

struct SamplingInterval {
  double lower = 0, upper = 0;
};

// The interval that DOF i is drawn from at time t in the given iteration (from 0) of the search.
SamplingInterval sampling_interval(const SamplingQuery& query, const SamplingSettings& settings,
                                   std::int64_t iteration, int i, double t);

// Pulls c towards the straight way from init to goal until it can be reached from init, and goal
// from it, within the speed limits; limits that hold at both ends and at c hold for the result.
// Requires within_speed_limits(init, goal).
Configuration pull_into_reach(const SamplingQuery& query, const Configuration& c);

// SAMPLECONFIGURATION(): a valid configuration within reach of both ends. False if max_tries draws
// gave none, or on a stop.
bool sample_configuration(StateSpace& world, const SamplingQuery& query,
                          const SamplingSettings& settings, std::int64_t iteration, Random& random,
                          const std::stop_token& stop, Configuration& sample,
                          SamplingCounters& sampling, CheckCounters& checks);

}  // namespace elbowroom
