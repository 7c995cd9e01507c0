// SPDX-License-Identifier: MIT
#include "core/base/dof_space.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

// An ellipse without width along an axis allows nothing along it.
double ratio(double value, double half) {
  if (half > 0) return value / half;
  return value == 0 ? 0.0 : INFINITY;
}

}  // namespace

bool DofSpace::within_limits(const Dofs& q, double tolerance) const {
  if (q.count != count()) return false;
  for (int i = 0; i < q.count; ++i) {
    const Dof& dof = dofs[static_cast<std::size_t>(i)];
    // Written so that NaN is outside.
    if (!(q[i] >= dof.lower - tolerance && q[i] <= dof.upper + tolerance)) return false;
  }
  for (const EllipseLimit& ellipse : ellipses) {
    const double a = ratio(q[ellipse.first], ellipse.half_first);
    const double b = ratio(q[ellipse.second], ellipse.half_second);
    if (!(a * a + b * b <= 1.0 + tolerance)) return false;
  }
  return true;
}

std::vector<int> DofSpace::widen_to(const Dofs& q) {
  std::vector<int> widened;
  if (q.count != count()) return widened;
  const auto note = [&](int i) {
    if (std::find(widened.begin(), widened.end(), i) == widened.end()) widened.push_back(i);
  };
  for (int i = 0; i < q.count; ++i) {
    Dof& dof = dofs[static_cast<std::size_t>(i)];
    if (!std::isfinite(q[i])) continue;
    if (q[i] < dof.lower) {
      dof.lower = q[i];
      note(i);
    }
    if (q[i] > dof.upper) {
      dof.upper = q[i];
      note(i);
    }
  }
  for (EllipseLimit& ellipse : ellipses) {
    const double a = std::abs(q[ellipse.first]);
    const double b = std::abs(q[ellipse.second]);
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    const double u = ratio(a, ellipse.half_first);
    const double v = ratio(b, ellipse.half_second);
    if (u * u + v * v <= 1.0) continue;
    // Of the ellipses that contain the old one and touch q, the one of least area. Free of the old
    // one it would have the half-axes √2·(a, b); where one of these falls short of the old one, the
    // old one stays and the other follows from the equation, at most by a factor of √2.
    const double root2 = std::sqrt(2.0);
    const double grow = 1.0 + 1e-12;  // so that q is inside in floating point too
    const double first = ellipse.half_first, second = ellipse.half_second;
    if (root2 * a >= first && root2 * b >= second) {
      ellipse.half_first = root2 * a * grow;
      ellipse.half_second = root2 * b * grow;
    } else if (root2 * a < first) {
      ellipse.half_second = b / std::sqrt(1.0 - (a / first) * (a / first)) * grow;
    } else {
      ellipse.half_first = a / std::sqrt(1.0 - (b / second) * (b / second)) * grow;
    }
    if (ellipse.half_first > first) note(ellipse.first);
    if (ellipse.half_second > second) note(ellipse.second);
  }
  std::sort(widened.begin(), widened.end());
  return widened;
}

}  // namespace elbowroom
