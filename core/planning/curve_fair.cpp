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
constexpr double kReliefShare = 0.7;  // of the steps while an acceleration limit is exceeded

}  // namespace

bool CurveFitter::fair() {
  Random random(settings_.seed);
  strain_ = limits_.strain(curve_, 0, count() - 1);
  keep();
  std::int64_t failures = 0;
  while (result_.trials < settings_.max_trials && failures < settings_.max_consecutive_failures &&
         goes_on(result_.trials, settings_.max_trials)) {
    ++failures;
    if (try_step(random, Step::smoother, result_.trials++ == 0)) failures = 0;
  }
  confirm();
  strain_ = limits_.strain(curve_, 0, count() - 1);
  failures = 0;
  while (!strain_.kept() && result_.relief_trials < settings_.max_relief_trials &&
         failures < settings_.max_consecutive_failures &&
         goes_on(result_.relief_trials, settings_.max_relief_trials)) {
    ++failures;
    ++result_.relief_trials;
    const Step step = random.uniform() < kReliefShare ? Step::gentler : Step::smoother_as_gentle;
    if (try_step(random, step, false)) failures = 0;
    // Not before what was promised is confirmed.
    if (strain_.kept()) confirm();
  }
  confirm();
  result_.energy = energy(energy_matrix_, offsets_);
  return !stop_.stop_requested();
}

// No stop, and time left; tells how far it is.
bool CurveFitter::goes_on(std::int64_t trial, std::int64_t most) {
  if (stop_.stop_requested() || seconds() >= settings_.max_seconds) return false;
  const auto now = std::chrono::steady_clock::now();
  if (progress_ && now - told_ > std::chrono::milliseconds(20)) {
    told_ = now;
    progress_({"fairing", static_cast<double>(trial) / static_cast<double>(most)});
  }
  return true;
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

bool CurveFitter::try_step(Random& random, Step step, bool everything) {
  const bool relieve = step == Step::gentler;
  const BandMatrix& matrix = relieve ? relief_matrix_ : energy_matrix_;
  const int begin = fixed_at_begin();
  const int free_count = count() - fixed_at_end() - begin;
  int first = begin, last = begin + free_count - 1, only = -1;
  if (!everything) {
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
  const double part = relieve ? random.uniform(0.2, 1) : 1;  // what would relieve may overshoot
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
    for (int i = first; i <= last; ++i) {
      const auto k = static_cast<std::size_t>(i);
      for (int a = 0; a < dofs(); ++a) {
        if (only >= 0 && a != only)
          d[k][a] = offsets_[k][a];
        else if (part < 1)
          d[k][a] = offsets_[k][a] + part * (d[k][a] - offsets_[k][a]);
      }
    }
    const double e = energy(energy_matrix_, d);
    if (!relieve &&
        (!(e < result_.energy * (1 - settings_.worthwhile)) || !(e < result_.energy - 1e-14)))
      break;
    set_offsets(d, first, last);
    if (step != Step::smoother && !is_gentler(relieve)) {
      curve_.control = before;
      break;
    }
    const Fault fault = find_fault(first, last, trial_resolution_);
    if (fault.none()) {
      offsets_ = std::move(d);
      result_.energy = e;
      if (step != Step::smoother) strain_ = limits_.strain(curve_, 0, count() - 1);
      if (++result_.accepted - kept_.accepted == kConfirmEvery) confirm();
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

bool CurveFitter::is_gentler(bool by_much) const {
  const double overload = limits_.strain(curve_, 0, count() - 1).overload;
  return overload <= strain_.overload * (by_much ? 1 - settings_.worthwhile : 1);
}

}  // namespace elbowroom
