// SPDX-License-Identifier: MIT
// From the landmarks of a path to a smooth curve: C2 inside the window, with the clip's values and
// velocities (and accelerations, if given) at its ends.
//
//     CurveSettings + CurveQuery + stop token → CurveResult
//
// First a curve that follows the path closely: control points are taken from it, and where rounding
// its corners (or bending to the end velocities) collides, knots are added until it no longer does.
// Then fairing, in the manner of the paper's linearizations: a random stretch of control points is
// moved towards the minimum of
//
//     E(q) = ∫ |q - r|² + T_a⁴ |q'' - r''|² + T_j⁶ |q''' - r'''|²  dt
//
// (all else fixed), as far as limits, speed limits and collisions allow; r is the clip's own curve.
// So the curve leaves the clip no earlier, no farther and no more suddenly than it must, keeps the
// clip's own movement on the way, and comes back to it. Without a clip r is 0 and the first term
// is left out.
//
// Where an acceleration limit is exceeded then, steps follow towards where accelerations weigh
// more, which may cost energy, until none is or nothing helps.
//
// Steps are tested coarsely and confirmed, a few at a time, at the resolution of the settings;
// those that are not are taken back. Same bytes for the same input, seed and number of trials.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/planning/curve.h"
#include "core/planning/curve_limits.h"
#include "core/planning/interpolation.h"

namespace elbowroom {

struct CurveSettings {
  double knot_spacing = 0.05;            // seconds, at first; at least 4 spans in any window
  double smallest_knot_spacing = 0.004;  // where following the path closely asks for it
  EdgeResolution resolution{0.02, 1.0 / 240.0};       // of the curve that comes out
  EdgeResolution trial_resolution{0.04, 1.0 / 90.0};  // of single steps; every few are confirmed
  double acceleration_time = 0.20;  // T_a, seconds: over about this long a detour fades
  double jerk_time = 0.12;          // T_j, seconds
  double worthwhile = 0.01;         // share of E that a step must save to be tested
  std::int64_t max_trials = 300;
  std::int64_t max_relief_trials = 300;  // more, where an acceleration limit is exceeded after them
  std::int64_t max_consecutive_failures = 60;
  std::uint64_t seed = 1;
  double max_seconds = std::numeric_limits<double>::infinity();
};

struct CurveQuery {
  const DofSpace* space = nullptr;    // must outlive the call
  std::vector<Configuration> path;    // valid landmarks, times strictly ascending
  Dofs velocity_init, velocity_goal;  // of the clip, from outside the window, rad/s
  std::optional<Dofs> acceleration_init, acceleration_goal;  // rad/s²; free if not given
  // The clip's parameters over the window, continuous (twist not wrapped); may be empty. It may
  // collide and leave limits.
  std::function<Dofs(double t)> reference;
};

enum class CurveStatus { solved, no_curve, cancelled, invalid_query };
const char* curve_status_id(CurveStatus status);

struct CurveResult {
  CurveStatus status = CurveStatus::invalid_query;
  std::string reason;  // one sentence, where status is not solved
  Curve curve;         // a valid one also when cancelled while fairing; else empty
  // DOFs whose limit, or speed limit, the values asked for at the ends forced the curve to exceed.
  // Empty where the caller's limits hold the clip's.
  std::vector<CurveLimits::Excess> limit_excess, speed_excess;
  // DOFs whose acceleration limit the curve exceeds, and by how much: because the ends or the clip
  // itself do, or, where none of these do (acceleration_kept is false), because nothing better was
  // found.
  std::vector<CurveLimits::Excess> acceleration_excess;
  bool acceleration_kept = false;
  // Give them as max_trials and max_relief_trials to get the same bytes again.
  std::int64_t trials = 0, relief_trials = 0;
  std::int64_t accepted = 0;                     // of them
  int refinements = 0;                           // rounds of added knots
  double energy_first = 0, energy = 0;           // E before and after fairing
  double peak_speed = 0, peak_acceleration = 0;  // largest of any DOF, rad/s, rad/s²
  CheckCounters checks;
  double milliseconds = 0;  // computing time; not part of what repeats
};

CurveResult fit_curve(StateSpace& world, const CurveQuery& query, const CurveSettings& settings,
                      std::stop_token stop = {}, const ProgressSink& progress = {});

// Every configuration of the curve between two times is valid at the resolution given; both sides
// of steps are tested; ends included.
bool curve_free(StateSpace& world, const Curve& curve, double begin, double end,
                const EdgeResolution& resolution, const std::stop_token& stop,
                CheckCounters& counters);

}  // namespace elbowroom
