// SPDX-License-Identifier: MIT
// Path smoothing [SKF07 4.1, Path Smoothing]: linearization between two random configurations of
// the path, not necessarily landmarks, time included, as long as the path stays valid.
//
// A linearization keeps limits (they are convex) and speed limits (a mean speed is no greater than
// the greatest), so only collisions are tested.
#pragma once

#include <cstdint>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/planning/interpolation.h"

namespace elbowroom {

struct SmoothingSettings {
  EdgeResolution resolution{0.02, 1.0 / 240.0};       // of the path that comes out
  EdgeResolution trial_resolution{0.04, 1.0 / 90.0};  // of single steps; every few are confirmed
  std::int64_t max_attempts = 60;
  std::int64_t max_consecutive_failures = 20;  // "until valid replacements are difficult to find"
  // Least share of the sub-path's length that a replacement must save to be worth its test.
  double worthwhile = 1e-3;
  std::uint64_t seed = 1;
  double max_seconds = std::numeric_limits<double>::infinity();
};

struct SmoothingResult {
  bool cancelled = false;           // by the stop token; path is the last one confirmed
  std::string error;                // not empty: the path was none (times, sizes), and is untouched
  std::vector<Configuration> path;  // ends as given, bit for bit
  std::int64_t attempts = 0;        // give them as max_attempts to get the same bytes again
  std::int64_t replacements = 0;
  CheckCounters checks;
  double milliseconds = 0;  // computing time; not part of what repeats
};

// The path given must be valid at `resolution` itself.
SmoothingResult smooth_path(StateSpace& world, const std::vector<Configuration>& path,
                            const SmoothingSettings& settings, std::stop_token stop = {},
                            const ProgressSink& progress = {});

// The configuration of a path at time t, clamped to its ends. Requires a path that is not empty.
Configuration path_at(const std::vector<Configuration>& path, double t);

// Sum of the Euclidean lengths of a path's edges in the DOFs, radians.
double path_length(const std::vector<Configuration>& path);

}  // namespace elbowroom
