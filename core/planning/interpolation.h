// SPDX-License-Identifier: MIT
// Edges of the search: straight interpolation between two space-time configurations, and its test
// by recursive bisection [SKF07 4.1, lines 5 and 9].
//
// The parameters of the joint models are interpolated linearly in time. (The paper interpolates
// each joint by slerp; that would leave the flexion–twist surface of an elbow or a knee. In the
// parameters the limits are convex, so an edge between two allowed ends keeps them.)
//
// Units: radians and seconds. Nothing here throws; nothing keeps state but the counters given.
#pragma once

#include <cstdint>
#include <stop_token>

#include "core/planning/state_space.h"

namespace elbowroom {

// How far two neighbouring tested configurations may lie apart; both bounds hold, since an edge
// with a still limb moves too: the clip and the world do.
struct EdgeResolution {
  double radians = 0.02;         // Euclidean norm of the change of the DOFs
  double seconds = 1.0 / 240.0;  // change of time
};

struct CheckCounters {
  std::int64_t validity_checks = 0;  // calls of StateSpace::valid
  std::int64_t edge_checks = 0;      // edges tested, the refused ones too
};

// The configuration at share u in [0, 1] of the way from a to b, time too; exact at both ends.
Configuration interpolate(const Configuration& a, const Configuration& b, double u);

// The configuration at time t on the edge from a to b, a.t < b.t; clamped to its ends.
Configuration interpolate_at(const Configuration& a, const Configuration& b, double t);

// |b.q - a.q| of each DOF ≤ share · its speed limit · (b.t - a.t), but for rounding. False if time
// does not advance.
bool within_speed_limits(const DofSpace& space, const Configuration& a, const Configuration& b,
                         double share = 1.0);

// INTERPOLATIONVALID without its first test: every configuration between two valid ends is valid,
// at the resolution given, in an order that finds collisions early; at each step of the world
// inside the edge both sides are tested. Requires a.t < b.t. With a stop requested it says no.
bool interpolation_free(StateSpace& world, const EdgeResolution& resolution, const Configuration& a,
                        const Configuration& b, const std::stop_token& stop,
                        CheckCounters& counters);

// Calls visit(k) for k = 1 ... n - 1 in bisection order (halves, quarters, ...) until it says
// false; returns whether it never did.
template <typename Visit>
bool visit_by_bisection(std::int64_t n, Visit&& visit) {
  std::int64_t stride = 1;
  while (stride < n) stride *= 2;
  for (stride /= 2; stride >= 1; stride /= 2) {
    for (std::int64_t k = stride; k < n; k += 2 * stride) {
      if (!visit(k)) return false;
    }
  }
  return true;
}

}  // namespace elbowroom
