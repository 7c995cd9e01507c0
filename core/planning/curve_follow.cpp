// SPDX-License-Identifier: MIT
// A curve that follows a path closely enough to be free, and as smooth as that allows.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "core/planning/curve_check.h"
#include "core/planning/curve_fitter.h"
#include "core/planning/smoothing.h"

namespace elbowroom {
namespace {

constexpr int kMostRefinements = 12;
constexpr std::size_t kMostSuspects = 6;
constexpr int kMostNudges = 32;
constexpr double kSmallestNudge = 0.004;  // rad
constexpr double kNudgeGrowth = 1.1;      // to 0.08 rad
constexpr double kRelief = 30;            // times accelerations weigh where they are exceeded

}  // namespace

CurveFitter::Followed CurveFitter::follow_path() {
  for (;; ++result_.refinements) {
    place_on_path();
    prepare_energy();
    std::vector<bool> bad(breakpoints_.size() - 1, false);
    if (hold_to_path(bad)) {
      result_.energy_first = result_.energy = energy(energy_matrix_, offsets_);
      return Followed::yes;
    }
    if (stop_.stop_requested()) return Followed::stopped;
    if (result_.refinements == kMostRefinements || !refine(bad)) return Followed::no;
  }
}

void CurveFitter::place_on_path() {
  const std::vector<Configuration>& path = query_.path;
  curve_.knots = clamped_knots(breakpoints_);
  const int n = static_cast<int>(curve_.knots.size()) - 4;
  curve_.control.clear();
  for (int i = 0; i < n; ++i) {
    curve_.control.push_back(path_at(path, greville_abscissa(curve_.knots, i)).q);
  }
  control(0) = path.front().q;
  control(n - 1) = path.back().q;
  // q'(t_init) = 3 (P1 - P0) / (k4 - k1), and q'' there = 2 (Q1 - Q0) / (k4 - k2) with the
  // derivative's control points Q_i = 3 (P_{i+1} - P_i) / (k_{i+4} - k_{i+1}); likewise at the
  // end.
  for (int a = 0; a < dofs(); ++a) {
    control(1)[a] = control(0)[a] + query_.velocity_init[a] * (knot(4) - knot(1)) / 3;
    control(n - 2)[a] =
        control(n - 1)[a] - query_.velocity_goal[a] * (knot(n + 2) - knot(n - 1)) / 3;
    if (query_.acceleration_init) {
      const double next =
          query_.velocity_init[a] + (*query_.acceleration_init)[a] * (knot(4) - knot(2)) / 2;
      control(2)[a] = control(1)[a] + next * (knot(5) - knot(2)) / 3;
    }
    if (query_.acceleration_goal) {
      const double next = query_.velocity_goal[a] -
                          (*query_.acceleration_goal)[a] * (knot(n + 1) - knot(n - 1)) / 2;
      control(n - 3)[a] = control(n - 2)[a] - next * (knot(n + 1) - knot(n - 2)) / 3;
    }
  }
  limits_ = CurveLimits(*query_.space);
  limits_.widen_to_ends(curve_, fixed_at_begin(), fixed_at_end());
  slow_down();
}

void CurveFitter::slow_down() {
  const int n = count();
  const auto draw = [&](int i, int neighbour, double span) {
    for (int a = 0; a < dofs(); ++a) {
      const double way = limits_.space().dofs[static_cast<std::size_t>(a)].speed_limit * span / 3;
      const double middle = control(neighbour)[a];
      control(i)[a] = std::clamp(control(i)[a], middle - way, middle + way);
    }
  };
  for (int i = fixed_at_begin(); i < n - fixed_at_end(); ++i) {
    draw(i, i - 1, knot(i + 3) - knot(i));
  }
  for (int i = n - fixed_at_end() - 1; i >= fixed_at_begin(); --i) {
    draw(i, i + 1, knot(i + 4) - knot(i + 1));
  }
}

bool CurveFitter::hold_to_path(std::vector<bool>& bad) {
  std::vector<Dofs> on_path = offsets_;
  Random random(settings_.seed);
  const int begin = fixed_at_begin(), end = count() - fixed_at_end();
  std::vector<bool> held(static_cast<std::size_t>(count()), true);
  std::fill(held.begin() + begin, held.begin() + end, false);
  std::vector<int> free;
  for (;;) {
    free.clear();
    for (int i = begin; i < end; ++i) {
      if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
    }
    std::vector<Dofs> d = on_path;
    if (!minimize(energy_matrix_, free, d)) d = on_path;
    set_offsets(d, begin, end - 1);
    Fault fault = find_fault(begin, end - 1, trial_resolution_);
    if (fault.none()) fault = find_fault(begin, end - 1, settings_.resolution);
    if (fault.none()) {
      offsets_ = std::move(d);
      return true;
    }
    if (stop_.stop_requested()) return false;
    const int hold = nearest_free(held, fault);
    if (hold < 0 && fault.collision && nudge(fault, d, random)) {
      for (int i = fault.first; i <= fault.last; ++i) {
        on_path[static_cast<std::size_t>(i)] = d[static_cast<std::size_t>(i)];
      }
      continue;
    }
    if (stop_.stop_requested()) return false;
    if (hold < 0) {
      char place[96];
      std::snprintf(place, sizeof place, "the curve %s at %.4f s",
                    fault.collision ? "collides" : "cannot keep its limits", fault.time);
      result_.reason = place;
      for (int s = std::max(3, fault.first_span); s <= std::min(count() - 1, fault.last_span);
           ++s) {
        bad[static_cast<std::size_t>(s - 3)] = true;
      }
      return false;
    }
    held[static_cast<std::size_t>(hold)] = true;
  }
}

bool CurveFitter::nudge(const Fault& fault, std::vector<Dofs>& d, Random& random) {
  if (fault.first < fixed_at_begin() || fault.last >= count() - fixed_at_end()) return false;
  double size = kSmallestNudge;
  for (int attempt = 0; attempt < kMostNudges; ++attempt, size *= kNudgeGrowth) {
    Dofs shift;
    shift.count = dofs();
    double square = 0;
    for (int a = 0; a < shift.count; ++a) {
      shift[a] = random.uniform(-1, 1);
      square += shift[a] * shift[a];
    }
    std::vector<Dofs> shifted = d;
    for (int i = fault.first; i <= fault.last; ++i) {
      for (int a = 0; a < shift.count; ++a) {
        shifted[static_cast<std::size_t>(i)][a] += size * shift[a] / std::sqrt(square);
      }
    }
    set_offsets(shifted, fault.first, fault.last);
    if (find_fault(fault.first, fault.last, settings_.resolution).none()) {
      d = std::move(shifted);
      return true;
    }
    if (stop_.stop_requested()) break;
  }
  set_offsets(d, fault.first, fault.last);
  return false;
}

bool CurveFitter::refine(const std::vector<bool>& bad) {
  std::vector<double> finer;
  bool halved = false;
  for (std::size_t s = 0; s < bad.size(); ++s) {
    finer.push_back(breakpoints_[s]);
    const bool near = bad[s] || (s > 0 && bad[s - 1]) || (s + 1 < bad.size() && bad[s + 1]);
    const double half = 0.5 * (breakpoints_[s + 1] - breakpoints_[s]);
    if (near && half >= settings_.smallest_knot_spacing) {
      finer.push_back(breakpoints_[s] + half);
      halved = true;
    }
  }
  finer.push_back(breakpoints_.back());
  breakpoints_ = std::move(finer);
  return halved;
}

void CurveFitter::prepare_energy() {
  const double t_a = settings_.acceleration_time, t_j = settings_.jerk_time;
  EnergyWeights weights{1, t_a * t_a * t_a * t_a, t_j * t_j * t_j * t_j * t_j * t_j};
  reference_.clear();
  if (query_.reference) {
    // 12 Hz: what a body does is below, the kinks of linear keys are above.
    reference_ = smoothing_spline(curve_.knots, query_.reference, dofs(), 1 / (2 * kPi * 12));
  }
  if (reference_.empty()) {
    weights.position = 0;
    Dofs zero;
    zero.count = dofs();
    reference_.assign(curve_.control.size(), zero);
  }
  limits_.widen_to_accelerations({curve_.knots, reference_});
  energy_matrix_ = energy_matrix(curve_.knots, weights);
  weights.acceleration *= kRelief;
  weights.jerk *= kRelief;
  relief_matrix_ = energy_matrix(curve_.knots, weights);
  offsets_ = curve_.control;
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    for (int a = 0; a < dofs(); ++a) offsets_[i][a] -= reference_[i][a];
  }
}

int CurveFitter::nearest_free(const std::vector<bool>& held, const Fault& fault) const {
  int nearest = -1;
  double distance = 0;
  for (int i = fault.first; i <= fault.last; ++i) {
    if (held[static_cast<std::size_t>(i)]) continue;
    const double d = std::abs(greville_abscissa(curve_.knots, i) - fault.time);
    if (nearest < 0 || d < distance) {
      nearest = i;
      distance = d;
    }
  }
  return nearest;
}

void CurveFitter::set_offsets(const std::vector<Dofs>& d, int first, int last) {
  for (int i = first; i <= last; ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (int a = 0; a < dofs(); ++a) control(i)[a] = reference_[k][a] + d[k][a];
  }
}

CurveFitter::Fault CurveFitter::find_fault(int first, int last, const EdgeResolution& resolution) {
  for (int i = first; i <= last; ++i) {
    if (!limits_.keeps_limits(curve_, i))
      return {i, i, i, i + 3, greville_abscissa(curve_.knots, i), false};
  }
  for (int i = first - 1; i <= last; ++i) {
    if (!limits_.keeps_speed(curve_, i))
      return {i, i + 1, i + 1, i + 3, greville_abscissa(curve_.knots, i), false};
  }
  double collision = 0;
  if (curve_span_free(world_, curve_, std::max(3, first), std::min(count() - 1, last + 3),
                      resolution, suspects_, stop_, result_.checks, collision)) {
    return {};
  }
  if (std::isnan(collision)) return {first, last, 3, 3, 0, false};
  // Where one curve collided the next one is likely to: the last few such times are tried first.
  const auto known = std::find(suspects_.begin(), suspects_.end(), collision);
  if (known != suspects_.end()) suspects_.erase(known);
  suspects_.insert(suspects_.begin(), collision);
  if (suspects_.size() > kMostSuspects) suspects_.pop_back();
  const int span = curve_span(curve_.knots, collision);
  return {span - 3, span, span, span, collision, true};
}

}  // namespace elbowroom
