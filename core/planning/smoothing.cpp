// SPDX-License-Identifier: MIT
#include "core/planning/smoothing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include "core/base/random.h"
#include "core/planning/space_check.h"

namespace elbowroom {
namespace {

using Clock = std::chrono::steady_clock;

double distance(const Dofs& a, const Dofs& b) {
  double square = 0;
  for (int i = 0; i < a.count; ++i) square += (b[i] - a[i]) * (b[i] - a[i]);
  return std::sqrt(square);
}

// Index of the edge (i, i + 1) that holds t.
std::size_t edge_at(const std::vector<Configuration>& path, double t) {
  const auto after = std::upper_bound(
      path.begin(), path.end(), t, [](double time, const Configuration& c) { return time < c.t; });
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - path.begin() - 1, 0));
  return std::min(i, path.size() - 2);
}

// How much the way along the path from a (on edge i) to b (on edge j > i) exceeds the straight one,
// as a share of it. A path that only changes its pace is as long as a straight one, so time counts
// as a coordinate too, scaled such that the path's whole duration is as long as the path.
double detour(const std::vector<Configuration>& path, std::size_t i, std::size_t j,
              const Configuration& a, const Configuration& b, double time_scale) {
  const auto length = [time_scale](const Configuration& c, const Configuration& d) {
    return std::hypot(distance(c.q, d.q), time_scale * (d.t - c.t));
  };
  double along = length(a, path[i + 1]) + length(path[j], b);
  for (std::size_t k = i + 1; k < j; ++k) along += length(path[k], path[k + 1]);
  return along > 0 ? (along - length(a, b)) / along : 0;
}

}  // namespace

Configuration path_at(const std::vector<Configuration>& path, double t) {
  if (path.size() < 2 || t <= path.front().t) return path.front();
  if (t >= path.back().t) return path.back();
  const std::size_t i = edge_at(path, t);
  return interpolate_at(path[i], path[i + 1], t);
}

double path_length(const std::vector<Configuration>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1].q, path[i].q);
  return length;
}

SmoothingResult smooth_path(StateSpace& world, const std::vector<Configuration>& path,
                            const SmoothingSettings& settings, std::stop_token stop,
                            const ProgressSink& progress) {
  const Clock::time_point start = Clock::now();
  const auto elapsed = [start] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  SmoothingResult result;
  result.path = path;
  result.error = path_fault(path);
  if (result.error.empty() &&
      (!(settings.resolution.radians > 0) || !(settings.resolution.seconds > 0))) {
    result.error = "the resolution of the edge check is not positive";
  }
  if (!result.error.empty()) return result;

  std::vector<Configuration>& smooth = result.path;
  Random random(settings.seed);
  const double t_init = path.front().t;
  const double t_goal = path.back().t;
  const double time_scale = path_length(path) / (t_goal - t_init);
  const double smallest = 1e-3 * (t_goal - t_init);  // shorter sub-paths are not worth a test
  std::int64_t failures = 0;
  Clock::time_point told = start;
  std::vector<Configuration> replaced;
  while (smooth.size() > 2 && result.attempts < settings.max_attempts &&
         failures < settings.max_consecutive_failures) {
    if (stop.stop_requested() || elapsed() >= settings.max_seconds) break;
    if (progress && Clock::now() - told > std::chrono::milliseconds(20)) {
      told = Clock::now();
      progress({"smoothing", std::min(1.0, static_cast<double>(result.attempts) /
                                               static_cast<double>(settings.max_attempts))});
    }
    ++result.attempts;
    ++failures;
    double t_a = random.uniform(t_init, t_goal);
    double t_b = random.uniform(t_init, t_goal);
    if (t_a > t_b) std::swap(t_a, t_b);
    if (t_b - t_a < smallest) continue;
    const std::size_t i = edge_at(smooth, t_a);
    const std::size_t j = edge_at(smooth, t_b);
    if (i == j) continue;
    // Landmarks that stand next to a chosen point take its place: no slivers of edges.
    Configuration a = interpolate_at(smooth[i], smooth[i + 1], t_a);
    Configuration b = interpolate_at(smooth[j], smooth[j + 1], t_b);
    if (a.t - smooth[i].t < smallest) a = smooth[i];
    if (smooth[j + 1].t - b.t < smallest) b = smooth[j + 1];
    if (detour(smooth, i, j, a, b, time_scale) < settings.worthwhile) continue;
    // The rests of the two edges that are cut are tested too: a part of an edge has other test
    // points than the whole had, and every edge of the result is to be valid at its own.
    const auto free = [&](const Configuration& from, const Configuration& to) {
      return !(from.t < to.t) ||
             interpolation_free(world, settings.resolution, from, to, stop, result.checks);
    };
    const auto valid = [&](const Configuration& c) {
      ++result.checks.validity_checks;
      return world.valid(c);
    };
    if (!free(a, b)) continue;
    const bool cut_a = a.t > smooth[i].t;
    const bool cut_b = b.t < smooth[j + 1].t;
    if (cut_a && (!valid(a) || !free(smooth[i], a))) continue;
    if (cut_b && (!valid(b) || !free(b, smooth[j + 1]))) continue;

    replaced.assign(smooth.begin(), smooth.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    if (a.t > replaced.back().t) replaced.push_back(a);
    replaced.push_back(b);
    for (std::size_t k = j + 1; k < smooth.size(); ++k) {
      if (smooth[k].t > replaced.back().t) replaced.push_back(smooth[k]);
    }
    smooth.swap(replaced);
    ++result.replacements;
    failures = 0;
  }
  result.cancelled = stop.stop_requested();
  result.milliseconds = 1e3 * elapsed();
  return result;
}

}  // namespace elbowroom
