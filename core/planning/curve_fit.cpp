// SPDX-License-Identifier: MIT
#include "core/planning/curve_fit.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "core/planning/curve_fitter.h"
#include "core/planning/space_check.h"

namespace elbowroom {

void CurveFitter::report() {
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
        result_.peak_acceleration = std::max(result_.peak_acceleration, std::abs(acceleration[i]));
      }
    }
  }
  result_.limit_excess = limits_.limit_excess();
  result_.speed_excess = limits_.speed_excess();
  result_.acceleration_excess = limits_.acceleration_excess(curve_);
  result_.acceleration_kept = limits_.strain(curve_, 0, count() - 1).kept();
}

namespace {

constexpr double kMostSpans = 50000;

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
  const auto start = std::chrono::steady_clock::now();
  CurveResult result;
  result.reason = query_fault(query, settings);
  if (result.reason.empty()) {
    CurveFitter fit(world, query, settings, stop, progress, result);
    switch (fit.follow_path()) {
      case CurveFitter::Followed::yes:
        result.reason.clear();
        result.status = fit.fair() ? CurveStatus::solved : CurveStatus::cancelled;
        fit.report();
        break;
      case CurveFitter::Followed::no:
        result.status = CurveStatus::no_curve;
        break;
      case CurveFitter::Followed::stopped:
        result.status = CurveStatus::cancelled;
        break;
    }
    if (result.status == CurveStatus::cancelled) result.reason = "cancelled";
  }
  result.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace elbowroom
