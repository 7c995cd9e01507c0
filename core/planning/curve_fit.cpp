// SPDX-License-Identifier: MIT
#include "core/planning/curve_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "core/base/random.h"
#include "core/planning/curve_check.h"
#include "core/planning/curve_energy.h"
#include "core/planning/curve_limits.h"
#include "core/planning/smoothing.h"
#include "core/planning/space_check.h"

namespace elbowroom {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostRefinements = 12;
constexpr double kMostSpans = 50000;
constexpr std::size_t kMostSuspects = 6;
constexpr int kMostAttempts = 8;  // in one trial
constexpr std::int64_t kConfirmEvery = 12;
constexpr int kMostTakenBack = 3;
constexpr int kMostNudges = 32;
constexpr double kSmallestNudge = 0.004;  // rad
constexpr double kNudgeGrowth = 1.1;      // to 0.08 rad
constexpr double kRelief = 30;            // times accelerations weigh where they are exceeded

enum class Followed { yes, no, stopped };

class Fit {
 public:
  Fit(StateSpace& world, const CurveQuery& query, const CurveSettings& settings,
      std::stop_token stop, const ProgressSink& progress, CurveResult& result)
      : world_(world),
        query_(query),
        settings_(settings),
        stop_(std::move(stop)),
        progress_(progress),
        result_(result),
        limits_(*query.space),
        trial_resolution_(settings.trial_resolution),
        start_(Clock::now()) {
    const double window = query.path.back().t - query.path.front().t;
    const int spans = std::max(4, static_cast<int>(std::lround(window / settings.knot_spacing)));
    for (int i = 0; i <= spans; ++i) {
      breakpoints_.push_back(i == spans ? query.path.back().t
                                        : query.path.front().t + window * i / spans);
    }
  }

  // A valid curve: the smoothest one that is held to the path at as few control points as
  // collisions and limits ask for. Where holding all of them is not enough, knots are added.
  Followed follow_path() {
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

  // Lowers the energy by valid steps; false on a stop. What is left stands confirmed.
  bool fair() {
    Random random(settings_.seed);
    std::int64_t failures = 0;
    Clock::time_point told = Clock::now();
    strain_ = limits_.strain(curve_, 0, count() - 1);
    keep();
    while (result_.trials < settings_.max_trials && failures < settings_.max_consecutive_failures) {
      if (stop_.stop_requested() || seconds() >= settings_.max_seconds) break;
      if (progress_ && Clock::now() - told > std::chrono::milliseconds(20)) {
        told = Clock::now();
        progress_({"fairing", static_cast<double>(result_.trials) /
                                  static_cast<double>(settings_.max_trials)});
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

  void report() {
    result_.curve = curve_;
    // Speed is piecewise quadratic, acceleration piecewise linear: the latter peaks at knots.
    for (std::size_t s = 3; s + 4 < curve_.knots.size(); ++s) {
      for (int k = 0; k <= 8; ++k) {
        const double t = curve_.knots[s] + (curve_.knots[s + 1] - curve_.knots[s]) * k / 8;
        const Dofs speed = curve_.derivative(t);
        for (int i = 0; i < speed.count; ++i) {
          result_.peak_speed = std::max(result_.peak_speed, std::abs(speed[i]));
        }
      }
      for (const double t : {curve_.knots[s], curve_.knots[s + 1]}) {
        const Dofs acceleration = curve_.second(t);
        for (int i = 0; i < acceleration.count; ++i) {
          result_.peak_acceleration =
              std::max(result_.peak_acceleration, std::abs(acceleration[i]));
        }
      }
    }
    result_.limit_excess = limits_.limit_excess();
    result_.speed_excess = limits_.speed_excess();
    result_.acceleration_excess = limits_.acceleration_excess(curve_);
    result_.acceleration_kept = limits_.strain(curve_, 0, count() - 1).kept();
  }

 private:
  // What is wrong with the curve: control points first ... last act on the place at fault, in spans
  // first_span ... last_span.
  struct Fault {
    int first = 0, last = -1;
    int first_span = 0, last_span = -1;
    double time = 0;         // of the place
    bool collision = false;  // or else a limit is broken
    bool none() const { return last < first; }
  };

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  int count() const { return static_cast<int>(curve_.control.size()); }
  int dofs() const { return query_.space->count(); }
  int fixed_at_begin() const { return query_.acceleration_init ? 3 : 2; }
  int fixed_at_end() const { return query_.acceleration_goal ? 3 : 2; }
  double knot(int i) const { return curve_.knots[static_cast<std::size_t>(i)]; }
  Dofs& control(int i) { return curve_.control[static_cast<std::size_t>(i)]; }

  // Control points on the path at their Greville abscissae, which makes the differences of control
  // points slopes of the path; those at the ends as values, velocities and accelerations ask.
  void place_on_path() {
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

  // Next to the ends the path may be too fast to be caught up with: the first free control points
  // are drawn into the cone of speeds of their neighbours, from both ends.
  void slow_down() {
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

  // Minimizes the energy with some control points held to the path: none at first, then one more
  // wherever the minimum collides or breaks a limit. False, with the spans at fault marked, when
  // all that act on such a place are held already; or on a stop.
  bool hold_to_path(std::vector<bool>& bad) {
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

  // Where even the path itself collides (its tests missed something thin, or its corner is cut
  // there), a small common shift of the control points that act on the place often helps. True,
  // with d shifted, if one was found.
  bool nudge(const Fault& fault, std::vector<Dofs>& d, Random& random) {
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

  // A curve tested at the resolution that is promised.
  struct Kept {
    std::vector<Dofs> control, offsets;
    double energy = 0;
    CurveLimits::Strain strain;
    std::int64_t accepted = 0;
  };
  void keep() { kept_ = {curve_.control, offsets_, result_.energy, strain_, result_.accepted}; }

  // Tests what has changed since the last curve kept; keeps it, or goes back to that one.
  void confirm() {
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

  // The first thing wrong with control points first ... last and the curve they act on.
  Fault find_fault(int first, int last, const EdgeResolution& resolution) {
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

  // Of the control points that act on the fault and are not held, the one nearest to it; or -1.
  int nearest_free(const std::vector<bool>& held, const Fault& fault) const {
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

  void set_offsets(const std::vector<Dofs>& d, int first, int last) {
    for (int i = first; i <= last; ++i) {
      const auto k = static_cast<std::size_t>(i);
      for (int a = 0; a < dofs(); ++a) control(i)[a] = reference_[k][a] + d[k][a];
    }
  }

  // Halves the spans marked and their neighbours; false if none can be halved.
  bool refine(const std::vector<bool>& bad) {
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

  void prepare_energy() {
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

  // One trial: a stretch of control points, all DOFs or one, towards the minimum of the energy.
  // Where that collides, a control point is first held half-way, then where it was, and the others
  // go on. The first trial takes everything there is. While an acceleration limit is exceeded every
  // other trial is a stretch about that place, towards where accelerations weigh more.
  bool try_step(Random& random, std::int64_t trial) {
    const bool relieve = trial > 0 && !strain_.kept() && random.uniform() < 0.5;
    const BandMatrix& matrix = relieve ? relief_matrix_ : energy_matrix_;
    const int begin = fixed_at_begin();
    const int free_count = count() - fixed_at_end() - begin;
    int first = begin, last = begin + free_count - 1, only = -1;
    if (trial > 0) {
      // Lengths are drawn by magnitude, so that short and long stretches have their turn.
      const double longest = std::log(static_cast<double>(free_count));
      const double shortest = std::min(longest, std::log(3.0));
      const int length =
          std::clamp(static_cast<int>(std::lround(std::exp(random.uniform(shortest, longest)))), 1,
                     free_count);
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

  // A step of these control points exceeds no acceleration limit; or, as long as one is exceeded,
  // does so no more than before, or less if that is what it is for.
  bool keeps_accelerations(int first, int last, bool relieve) const {
    if (relieve)
      return limits_.strain(curve_, 0, count() - 1).share <
             strain_.share * (1 - settings_.worthwhile);
    const CurveLimits::Strain strain = limits_.strain(curve_, first, last);
    return strain.kept() || strain.share <= strain_.share;
  }

  StateSpace& world_;
  const CurveQuery& query_;
  const CurveSettings& settings_;
  std::stop_token stop_;
  const ProgressSink& progress_;
  CurveResult& result_;
  CurveLimits limits_;
  EdgeResolution trial_resolution_;
  Clock::time_point start_;
  std::vector<double> breakpoints_;
  Curve curve_;
  BandMatrix energy_matrix_, relief_matrix_;
  std::vector<Dofs> reference_;  // the clip's control points, smoothed; 0 without a clip
  std::vector<Dofs> offsets_;    // control points less those of the reference
  Kept kept_;
  CurveLimits::Strain strain_;
  int taken_back_ = 0;
  std::vector<double> suspects_;  // times of recent collisions, latest first
};

std::string query_fault(const CurveQuery& query, const CurveSettings& settings) {
  if (!query.space) return "no DOF space is given";
  std::string fault = dof_space_fault(*query.space);
  if (fault.empty()) fault = path_fault(query.path);
  if (fault.empty()) fault = dofs_fault(*query.space, query.path.front().q);
  if (fault.empty()) fault = dofs_fault(*query.space, query.velocity_init);
  if (fault.empty()) fault = dofs_fault(*query.space, query.velocity_goal);
  if (fault.empty() && query.acceleration_init) {
    fault = dofs_fault(*query.space, *query.acceleration_init);
  }
  if (fault.empty() && query.acceleration_goal) {
    fault = dofs_fault(*query.space, *query.acceleration_goal);
  }
  if (!fault.empty()) return fault;
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (!positive(settings.knot_spacing) || !positive(settings.smallest_knot_spacing) ||
      !positive(settings.resolution.radians) || !positive(settings.resolution.seconds) ||
      !positive(settings.trial_resolution.radians) ||
      !positive(settings.trial_resolution.seconds) || !positive(settings.acceleration_time) ||
      !positive(settings.jerk_time)) {
    return "a setting of the curve is not positive";
  }
  if (std::isnan(settings.max_seconds)) return "the time budget is not a number";
  const double window = query.path.back().t - query.path.front().t;
  if (window / settings.knot_spacing > kMostSpans) return "the window is too long for its knots";
  if (window < 1e-4) return "the window is empty";
  if (query.reference) {
    for (int k = 0; k <= 64; ++k) {
      const Dofs r = query.reference(query.path.front().t + window * k / 64);
      if (fault = dofs_fault(*query.space, r); !fault.empty()) return "reference: " + fault;
    }
  }
  return {};
}

}  // namespace

const char* curve_status_id(CurveStatus status) {
  switch (status) {
    case CurveStatus::solved:
      return "solved";
    case CurveStatus::no_curve:
      return "no_curve";
    case CurveStatus::cancelled:
      return "cancelled";
    case CurveStatus::invalid_query:
      return "invalid_query";
  }
  return "unknown";
}

CurveResult fit_curve(StateSpace& world, const CurveQuery& query, const CurveSettings& settings,
                      std::stop_token stop, const ProgressSink& progress) {
  const Clock::time_point start = Clock::now();
  CurveResult result;
  result.reason = query_fault(query, settings);
  if (result.reason.empty()) {
    Fit fit(world, query, settings, stop, progress, result);
    switch (fit.follow_path()) {
      case Followed::yes:
        result.reason.clear();
        result.status = fit.fair() ? CurveStatus::solved : CurveStatus::cancelled;
        fit.report();
        break;
      case Followed::no:
        result.status = CurveStatus::no_curve;
        break;
      case Followed::stopped:
        result.status = CurveStatus::cancelled;
        break;
    }
    if (result.status == CurveStatus::cancelled) result.reason = "cancelled";
  }
  result.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return result;
}

}  // namespace elbowroom
