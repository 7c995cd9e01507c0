// SPDX-License-Identifier: MIT
// One window of one limb, from the question to verified keys.
//
// Attempts, in this order, until one holds: the limb's rigid parts with the clearance asked for;
// the same with a margin for what the skin does beyond them; the deformed skin itself; the deformed
// skin with less and less clearance. Each runs Algorithm 1, smoothing, the curve, then makes keys
// and verifies them on the deformed skin [SKF07 4.1, 6.1].
#pragma once

#include <optional>

#include "core/editing/correct.h"
#include "core/editing/window_problem.h"

namespace elbowroom {

struct WindowPlan {
  WindowReport report;
  std::optional<Correction> correction;  // set if and only if report.status is corrected
};

// `scene` plays `clip` when called and when it returns. The window's ends are float32 values within
// the clip.
WindowPlan plan_window(SceneCollision& scene, const std::shared_ptr<const Clip>& clip, int limb,
                       double begin, double end, const PlanningWishes& wishes,
                       const std::stop_token& stop, const ProgressSink& progress);

// The same through the problem's postures: a path and a curve from each to the next, keys at each
// of their times, one correction. Whether the postures between the ends are valid is the caller's
// to know.
WindowPlan plan_window(WindowProblem problem, const PlanningWishes& wishes,
                       const std::stop_token& stop, const ProgressSink& progress);

// The times at which a motion over [begin, end] is looked at: 240 Hz, the keys given, 1,000 random
// ones, both sides of steps; ascending, unique.
std::vector<double> verification_times(double begin, double end, const std::vector<float>& keys,
                                       const std::vector<double>& steps, std::uint64_t seed);

}  // namespace elbowroom
