// SPDX-License-Identifier: MIT
// Fairing: random stretches of a curve's control points towards less energy, as far as limits and
// collisions allow.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include "core/planning/curve_fitter.h"

namespace elbowroom {
namespace {

constexpr int kMostAttempts = 8;  // in one trial
constexpr std::int64_t kConfirmEvery = 12;
constexpr int kMostTakenBack = 3;

}  // namespace

bool CurveFitter::fair() {
  Random random(settings_.seed);
  std::int64_t failures = 0;
  auto told = std::chrono::steady_clock::now();
  strain_ = limits_.strain(curve_, 0, count() - 1);
  keep();
  while (result_.trials < settings_.max_trials && failures < settings_.max_consecutive_failures) {
    if (stop_.stop_requested() || seconds() >= settings_.max_seconds) break;
    if (progress_ && std::chrono::steady_clock::now() - told > std::chrono::milliseconds(20)) {
      told = std::chrono::steady_clock::now();
      progress_({"fairing",
                 static_cast<double>(result_.trials) / static_cast<double>(settings_.max_trials)});
    }
    ++failures;
    if (try_step(random, result_.trials++)) {
      ++result_.accepted;
      failures = 0;
      if (result_.accepted - kept_.accepted == kConfirmEvery) confirm();
    }
  }
  confirm();
  result_.energy = energy(energy_matrix_, offsets_);
  return !stop_.stop_requested();
}

void CurveFitter::confirm() {
  if (result_.accepted == kept_.accepted) return;
  int first = 0, last = count() - 1;
  const auto same = [this](int i) {
    const auto k = static_cast<std::size_t>(i);
    return curve_.control[k].value == kept_.control[k].value;
  };
  while (first < last && same(first)) ++first;
  while (last > first && same(last)) --last;
  if (!stop_.stop_requested() && find_fault(first, last, settings_.resolution).none()) {
    keep();
    return;
  }
  curve_.control = kept_.control;
  offsets_ = kept_.offsets;
  result_.energy = kept_.energy;
  strain_ = kept_.strain;
  result_.accepted = kept_.accepted;
  // Where coarse tests keep missing something, steps are tested finely.
  if (++taken_back_ == kMostTakenBack) trial_resolution_ = settings_.resolution;
}

bool CurveFitter::try_step(Random& random, std::int64_t trial) {
  const bool relieve = trial > 0 && !strain_.kept() && random.uniform() < 0.5;
  const BandMatrix& matrix = relieve ? relief_matrix_ : energy_matrix_;
  const int begin = fixed_at_begin();
  const int free_count = count() - fixed_at_end() - begin;
  int first = begin, last = begin + free_count - 1, only = -1;
  if (trial > 0) {
    // Lengths are drawn by magnitude, so that short and long stretches have their turn.
    const double longest = std::log(static_cast<double>(free_count));
    const double shortest = std::min(longest, std::log(3.0));
    const int length = std::clamp(
        static_cast<int>(std::lround(std::exp(random.uniform(shortest, longest)))), 1, free_count);
    const int latest = begin + free_count - length;
    if (relieve) {
      const int back = static_cast<int>(random.below(static_cast<std::uint64_t>(length)));
      first = std::clamp(strain_.at - back, begin, latest);
    } else {
      first =
          begin + static_cast<int>(random.below(static_cast<std::uint64_t>(latest - begin + 1)));
    }
    last = first + length - 1;
    if (random.uniform() < 0.3) {
      only = static_cast<int>(random.below(static_cast<std::uint64_t>(dofs())));
    }
  }
  const std::vector<Dofs> before = curve_.control;
  std::vector<double> share(static_cast<std::size_t>(count()),
                            1.0);  // of the step, that is taken
  std::vector<bool> held(static_cast<std::size_t>(count()), true);
  std::fill(held.begin() + first, held.begin() + last + 1, false);
  std::vector<Dofs> whole;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    std::vector<Dofs> d = offsets_;
    std::vector<int> free;
    for (int i = first; i <= last; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (share[k] == 1) {
        free.push_back(i);
      } else {
        for (int a = 0; a < dofs(); ++a) d[k][a] += share[k] * (whole[k][a] - d[k][a]);
      }
    }
    if (free.empty() || !minimize(matrix, free, d)) break;
    if (attempt == 0) whole = d;
    if (only >= 0) {
      for (int i = first; i <= last; ++i) {
        const auto k = static_cast<std::size_t>(i);
        for (int a = 0; a < dofs(); ++a) {
          if (a != only) d[k][a] = offsets_[k][a];
        }
      }
    }
    const double e = energy(energy_matrix_, d);
    if (!relieve &&
        (!(e < result_.energy * (1 - settings_.worthwhile)) || !(e < result_.energy - 1e-14)))
      break;
    set_offsets(d, first, last);
    if (!keeps_accelerations(first, last, relieve)) {
      curve_.control = before;
      break;
    }
    const Fault fault = find_fault(first, last, trial_resolution_);
    if (fault.none()) {
      offsets_ = std::move(d);
      result_.energy = e;
      if (!strain_.kept()) strain_ = limits_.strain(curve_, 0, count() - 1);
      return true;
    }
    curve_.control = before;
    if (stop_.stop_requested()) break;
    const int hold = nearest_free(held, fault);
    if (hold < 0) break;
    const auto k = static_cast<std::size_t>(hold);
    share[k] = share[k] == 1 ? 0.5 : 0;
    held[k] = share[k] == 0;
  }
  return false;
}

bool CurveFitter::keeps_accelerations(int first, int last, bool relieve) const {
  if (relieve)
    return limits_.strain(curve_, 0, count() - 1).share <
           strain_.share * (1 - settings_.worthwhile);
  const CurveLimits::Strain strain = limits_.strain(curve_, first, last);
  return strain.kept() || strain.share <= strain_.share;
}

}  // namespace elbowroom
