// SPDX-License-Identifier: MIT
#include "core/planning/curve_limits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace elbowroom {
namespace {

double component(const Curve& curve, int i, int a) {
  return curve.control[static_cast<std::size_t>(i)][a];
}
double knot(const Curve& curve, int i) { return curve.knots[static_cast<std::size_t>(i)]; }
int count(const Curve& curve) { return static_cast<int>(curve.control.size()); }

}  // namespace

double curve_slope(const Curve& curve, int i, int a) {
  return 3 * (component(curve, i + 1, a) - component(curve, i, a)) /
         (knot(curve, i + 4) - knot(curve, i + 1));
}

double curve_bend(const Curve& curve, int i, int a) {
  return 2 * (curve_slope(curve, i + 1, a) - curve_slope(curve, i, a)) /
         (knot(curve, i + 4) - knot(curve, i + 2));
}

void CurveLimits::widen_speed(const Curve& curve, int i) {
  for (int a = 0; a < space_.count(); ++a) {
    double& limit = space_.dofs[static_cast<std::size_t>(a)].speed_limit;
    limit = std::max(limit, std::abs(curve_slope(curve, i, a)));
  }
}

void CurveLimits::widen_acceleration(const Curve& curve, int i) {
  for (int a = 0; a < space_.count(); ++a) {
    double& limit = space_.dofs[static_cast<std::size_t>(a)].acceleration_limit;
    limit = std::max(limit, std::abs(curve_bend(curve, i, a)));
  }
}

void CurveLimits::widen_to_ends(const Curve& curve, int fixed_at_begin, int fixed_at_end) {
  const int n = count(curve);
  for (int i = 0; i < fixed_at_begin; ++i) {
    space_.widen_to(curve.control[static_cast<std::size_t>(i)]);
    if (i > 0) widen_speed(curve, i - 1);
    if (i > 1) widen_acceleration(curve, i - 2);
  }
  for (int i = n - fixed_at_end; i < n; ++i) {
    space_.widen_to(curve.control[static_cast<std::size_t>(i)]);
    if (i < n - 1) widen_speed(curve, i);
    if (i < n - 2) widen_acceleration(curve, i);
  }
}

void CurveLimits::widen_to_accelerations(const Curve& curve) {
  for (int i = 0; i + 2 < count(curve); ++i) widen_acceleration(curve, i);
}

bool CurveLimits::keeps_speed(const Curve& curve, int i) const {
  for (int a = 0; a < space_.count(); ++a) {
    const double limit = space_.dofs[static_cast<std::size_t>(a)].speed_limit;
    if (!(std::abs(curve_slope(curve, i, a)) <= limit * (1 + 1e-9) + 1e-12)) return false;
  }
  return true;
}

CurveLimits::Strain CurveLimits::strain(const Curve& curve, int first, int last) const {
  Strain worst;
  for (int i = std::max(0, first - 2); i <= std::min(last, count(curve) - 3); ++i) {
    for (int a = 0; a < space_.count(); ++a) {
      const double share = std::abs(curve_bend(curve, i, a)) /
                           space_.dofs[static_cast<std::size_t>(a)].acceleration_limit;
      if (share > 1) worst.overload += (share - 1) * (share - 1);
      if (!(share > worst.share)) continue;
      worst.share = share;
      worst.at = i + 1;
    }
  }
  return worst;
}

std::vector<CurveLimits::Excess> CurveLimits::limit_excess() const {
  std::vector<Excess> all;
  for (int i = 0; i < space_.count(); ++i) {
    const Dof& asked = asked_->dofs[static_cast<std::size_t>(i)];
    const Dof& used = space_.dofs[static_cast<std::size_t>(i)];
    const double beyond = std::max(asked.lower - used.lower, used.upper - asked.upper);
    double swing = 0;
    for (std::size_t e = 0; e < space_.ellipses.size(); ++e) {
      const EllipseLimit& from = asked_->ellipses[e];
      const EllipseLimit& to = space_.ellipses[e];
      if (from.first == i) swing = std::max(swing, to.half_first - from.half_first);
      if (from.second == i) swing = std::max(swing, to.half_second - from.half_second);
    }
    for (std::size_t e = 0; e < space_.polygons.size(); ++e) {
      const PolygonLimit& from = asked_->polygons[e];
      for (const auto& corner : space_.polygons[e].corners) {
        const double out = from.gauge(corner[0], corner[1]);
        if (!(out > 1) || (from.first != i && from.second != i)) continue;
        const double reach = std::abs(corner[from.first == i ? 0 : 1]);
        swing = std::max(swing, reach * (1 - 1 / out));
      }
    }
    if (std::max(beyond, swing) > 1e-9) all.push_back({i, std::max(beyond, swing)});
  }
  return all;
}

std::vector<CurveLimits::Excess> CurveLimits::speed_excess() const {
  std::vector<Excess> all;
  for (int i = 0; i < space_.count(); ++i) {
    const double faster = space_.dofs[static_cast<std::size_t>(i)].speed_limit -
                          asked_->dofs[static_cast<std::size_t>(i)].speed_limit;
    if (faster > 1e-9) all.push_back({i, faster});
  }
  return all;
}

std::vector<CurveLimits::Excess> CurveLimits::acceleration_excess(const Curve& curve) const {
  std::vector<Excess> all;
  for (int a = 0; a < space_.count(); ++a) {
    double most = 0;
    for (int i = 0; i + 2 < count(curve); ++i)
      most = std::max(most, std::abs(curve_bend(curve, i, a)));
    const double limit = asked_->dofs[static_cast<std::size_t>(a)].acceleration_limit;
    if (most > limit * (1 + 1e-9)) all.push_back({a, most - limit});
  }
  return all;
}

}  // namespace elbowroom
