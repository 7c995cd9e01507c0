// SPDX-License-Identifier: MIT
#include "core/planning/smoothing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <utility>

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

class Smoother {
 public:
  Smoother(StateSpace& world, const std::vector<Configuration>& path,
           const SmoothingSettings& settings, std::stop_token stop, SmoothingResult& result)
      : world_(world),
        settings_(settings),
        stop_(std::move(stop)),
        result_(result),
        random_(settings.seed),
        path_(path),
        confirmed_(path.size() - 1, true),
        kept_(path),
        t_init_(path.front().t),
        t_goal_(path.back().t),
        time_scale_(path_length(path) / (t_goal_ - t_init_)),
        smallest_(1e-3 * (t_goal_ - t_init_)),
        trial_suffices_(settings.trial_resolution.radians <= settings.resolution.radians &&
                        settings.trial_resolution.seconds <= settings.resolution.seconds) {}

  bool straight() const { return path_.size() <= 2; }
  const std::vector<Configuration>& kept() const { return kept_; }

  // One linearization; true if the path took it.
  bool attempt() {
    double t_a = random_.uniform(t_init_, t_goal_);
    double t_b = random_.uniform(t_init_, t_goal_);
    if (t_a > t_b) std::swap(t_a, t_b);
    if (t_b - t_a < smallest_) return false;
    const std::size_t i = edge_at(path_, t_a);
    const std::size_t j = edge_at(path_, t_b);
    if (i == j) return false;
    // Landmarks that stand next to a chosen point take its place: no slivers of edges.
    Configuration a = interpolate_at(path_[i], path_[i + 1], t_a);
    Configuration b = interpolate_at(path_[j], path_[j + 1], t_b);
    if (a.t - path_[i].t < smallest_) a = path_[i];
    if (path_[j + 1].t - b.t < smallest_) b = path_[j + 1];
    if (detour(path_, i, j, a, b, time_scale_) < settings_.worthwhile) return false;
    if (a.t > path_[i].t && !valid(a)) return false;
    if (b.t < path_[j + 1].t && !valid(b)) return false;
    if (!interpolation_free(world_, settings_.trial_resolution, a, b, stop_, result_.checks)) {
      return false;
    }
    replace(i, j, a, b);
    return true;
  }

  // Tests at the resolution promised what has changed since the last path kept (the rests of edges
  // that were cut too: a part has other test points than the whole had); keeps it, or goes back.
  void confirm() {
    bool free = !stop_.stop_requested();
    for (std::size_t k = 0; k + 1 < path_.size() && free; ++k) {
      if (confirmed_[k]) continue;
      free = interpolation_free(world_, settings_.resolution, path_[k], path_[k + 1], stop_,
                                result_.checks);
      confirmed_[k] = free;
    }
    if (free) {
      kept_ = path_;
      kept_replacements_ = result_.replacements;
    } else {
      path_ = kept_;
      confirmed_.assign(path_.size() - 1, true);
      result_.replacements = kept_replacements_;
    }
  }

  bool due() const { return result_.replacements - kept_replacements_ >= kConfirmEvery; }

 private:
  static constexpr std::int64_t kConfirmEvery = 8;

  bool valid(const Configuration& c) {
    if (stop_.stop_requested()) return false;
    ++result_.checks.validity_checks;
    return world_.valid(c);
  }

  // Puts the straight edge from a (on edge i) to b (on edge j) into the path.
  void replace(std::size_t i, std::size_t j, const Configuration& a, const Configuration& b) {
    std::vector<Configuration> path(path_.begin(),
                                    path_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    std::vector<bool> confirmed(confirmed_.begin(),
                                confirmed_.begin() + static_cast<std::ptrdiff_t>(i));
    const auto add = [&](const Configuration& c, bool is_confirmed) {
      if (!(c.t > path.back().t)) return;
      path.push_back(c);
      confirmed.push_back(is_confirmed);
    };
    add(a, false);
    add(b, trial_suffices_);
    for (std::size_t k = j + 1; k < path_.size(); ++k)
      add(path_[k], k > j + 1 && confirmed_[k - 1]);
    path_ = std::move(path);
    confirmed_ = std::move(confirmed);
  }

  StateSpace& world_;
  const SmoothingSettings& settings_;
  std::stop_token stop_;
  SmoothingResult& result_;
  Random random_;
  std::vector<Configuration> path_;
  std::vector<bool> confirmed_;      // by edge
  std::vector<Configuration> kept_;  // the last path of which every edge was confirmed
  std::int64_t kept_replacements_ = 0;
  double t_init_, t_goal_;
  double time_scale_;
  double smallest_;  // sub-paths shorter than this are not worth a test, seconds
  bool trial_suffices_;
};

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
  const auto positive = [](const EdgeResolution& r) { return r.radians > 0 && r.seconds > 0; };
  if (result.error.empty() &&
      (!positive(settings.resolution) || !positive(settings.trial_resolution))) {
    result.error = "the resolution of the edge check is not positive";
  }
  if (!result.error.empty()) return result;

  Smoother smoother(world, path, settings, stop, result);
  std::int64_t failures = 0;
  Clock::time_point told = start;
  while (!smoother.straight() && result.attempts < settings.max_attempts &&
         failures < settings.max_consecutive_failures) {
    if (stop.stop_requested() || elapsed() >= settings.max_seconds) break;
    if (progress && Clock::now() - told > std::chrono::milliseconds(20)) {
      told = Clock::now();
      progress({"smoothing", std::min(1.0, static_cast<double>(result.attempts) /
                                               static_cast<double>(settings.max_attempts))});
    }
    ++result.attempts;
    ++failures;
    if (smoother.attempt()) {
      ++result.replacements;
      failures = 0;
      // A path that has become straight can still turn out not to be free.
      if (smoother.due() || smoother.straight()) smoother.confirm();
    }
  }
  smoother.confirm();
  result.path = smoother.kept();
  result.cancelled = stop.stop_requested();
  result.milliseconds = 1e3 * elapsed();
  return result;
}

}  // namespace elbowroom
