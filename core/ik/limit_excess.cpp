// SPDX-License-Identifier: MIT
#include "core/ik/limit_excess.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace elbowroom {
namespace {

double share(double value, double half) {
  if (half > 0) return std::abs(value) / half;
  return value == 0 ? 0.0 : std::numeric_limits<double>::infinity();
}

}  // namespace

LimitExcess limit_excess(const DofSpace& space, const Dofs& q) {
  LimitExcess worst{-std::numeric_limits<double>::infinity(), -1};
  const auto note = [&](double excess, int dof) {
    if (std::isnan(excess)) excess = std::numeric_limits<double>::infinity();
    if (excess > worst.radians) worst = {excess, dof};
  };
  for (int i = 0; i < q.count; ++i) {
    const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
    note(std::isnan(q[i]) ? q[i] : std::max(dof.lower - q[i], q[i] - dof.upper), i);
  }
  for (const EllipseLimit& ellipse : space.ellipses) {
    const double a = share(q[ellipse.first], ellipse.half_first);
    const double b = share(q[ellipse.second], ellipse.half_second);
    const double ratio = std::hypot(a, b);
    const double length = std::hypot(q[ellipse.first], q[ellipse.second]);
    // At the middle there is no ray: the nearer half-axis is the distance.
    const double excess = ratio > 1e-9 ? length * (1 - 1 / ratio)
                                       : -std::min(ellipse.half_first, ellipse.half_second);
    note(excess, a >= b ? ellipse.first : ellipse.second);
  }
  for (const PolygonLimit& polygon : space.polygons) {
    const double a = q[polygon.first], b = q[polygon.second];
    const double ratio = polygon.gauge(a, b), length = std::hypot(a, b);
    double excess = length * (1 - 1 / ratio);
    if (!(ratio > 1e-9)) {
      // In the middle there is no ray: the nearest edge is the distance.
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
        const auto& p = polygon.corners[i];
        const auto& e = polygon.corners[(i + 1) % polygon.corners.size()];
        nearest = std::min(
            nearest, std::abs(p[0] * e[1] - p[1] * e[0]) / std::hypot(e[0] - p[0], e[1] - p[1]));
      }
      excess = -nearest;
    }
    if (std::isinf(ratio)) excess = ratio;
    note(excess, std::abs(a) >= std::abs(b) ? polygon.first : polygon.second);
  }
  return worst;
}

Dofs clamp_to_limits(const DofSpace& space, Dofs q) {
  for (int i = 0; i < q.count; ++i) {
    const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
    if (std::isnan(q[i])) q[i] = 0.5 * (dof.lower + dof.upper);
    q[i] = std::max(dof.lower, std::min(dof.upper, q[i]));
  }
  for (const EllipseLimit& ellipse : space.ellipses) {
    // Towards zero into the ellipse may lead out of a range that does not hold zero, and back.
    for (int round = 0; round < 200; ++round) {
      const double ratio = std::hypot(share(q[ellipse.first], ellipse.half_first),
                                      share(q[ellipse.second], ellipse.half_second));
      if (!(ratio > 1)) break;
      const double shrink = std::isfinite(ratio) ? (1 - 1e-12) / ratio : 0.0;
      for (const int i : {ellipse.first, ellipse.second}) {
        const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
        q[i] = std::max(dof.lower, std::min(dof.upper, q[i] * shrink));
      }
      // Going to and fro is slow where a range almost leaves the ellipse: settle it along each.
      if (round % 20 != 19) continue;
      for (const auto& [still, half_still, moved, half_moved] :
           {std::tuple(ellipse.first, ellipse.half_first, ellipse.second, ellipse.half_second),
            std::tuple(ellipse.second, ellipse.half_second, ellipse.first, ellipse.half_first)}) {
        const double left = 1 - std::pow(share(q[still], half_still), 2);
        const double most = left > 0 ? half_moved * std::sqrt(left) * (1 - 1e-12) : 0.0;
        const Dof& dof = space.dofs[static_cast<std::size_t>(moved)];
        q[moved] = std::max(dof.lower, std::min(dof.upper, std::clamp(q[moved], -most, most)));
      }
    }
  }
  for (const PolygonLimit& polygon : space.polygons) {
    for (int round = 0; round < 200; ++round) {
      const double ratio = polygon.gauge(q[polygon.first], q[polygon.second]);
      if (!(ratio > 1)) break;
      const double shrink = std::isfinite(ratio) ? (1 - 1e-12) / ratio : 0.0;
      for (const int i : {polygon.first, polygon.second}) {
        const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
        q[i] = std::max(dof.lower, std::min(dof.upper, q[i] * shrink));
      }
    }
  }
  return q;
}

}  // namespace elbowroom
