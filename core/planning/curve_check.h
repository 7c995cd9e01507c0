// SPDX-License-Identifier: MIT
// The times at which a curve is tested for collisions, and the test itself.
//
// Each span has test times of its own, from its own control points alone: a change elsewhere leaves
// what was tested there tested.
#pragma once

#include <stop_token>
#include <vector>

#include "core/planning/curve.h"
#include "core/planning/interpolation.h"

namespace elbowroom {

// Test times of the spans first ... last (3 ≤ first ≤ last < control points): neighbouring ones are
// no farther apart than the resolution, in seconds and, along the curve, in radians; spans' ends
// included. Ascending. `steps`: the world's; both sides of each are added. False if that would be
// more than 10⁸ times for a span (a hostile resolution or curve).
bool curve_test_times(const Curve& curve, int first, int last, const EdgeResolution& resolution,
                      const std::vector<double>& steps, std::vector<double>& times);

// The first time, in bisection order, at which the curve collides; those in `suspects` that lie
// among the spans are tried before. Returns true if there is none; on a stop false, with the
// collision at NaN.
bool curve_span_free(StateSpace& world, const Curve& curve, int first, int last,
                     const EdgeResolution& resolution, const std::vector<double>& suspects,
                     const std::stop_token& stop, CheckCounters& counters, double& collision);

}  // namespace elbowroom
