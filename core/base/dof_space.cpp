// SPDX-License-Identifier: MIT
#include "core/base/dof_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace elbowroom {
namespace {

// An ellipse without width along an axis allows nothing along it.
double ratio(double value, double half) {
  if (half > 0) return value / half;
  return value == 0 ? 0.0 : INFINITY;
}

using Corner = std::array<double, 2>;

double cross(const Corner& o, const Corner& a, const Corner& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

// Counter-clockwise, without corners on an edge [Andrew 1979].
std::vector<Corner> convex_hull(std::vector<Corner> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Corner> hull(2 * points.size());
  std::size_t k = 0;
  const auto add = [&](const Corner& p, std::size_t least) {
    while (k >= least + 2 && !(cross(hull[k - 2], hull[k - 1], p) > 0)) --k;
    hull[k++] = p;
  };
  for (const Corner& p : points) add(p, 0);
  const std::size_t lower = k - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.resize(k - 1);
  return hull;
}

}  // namespace

double PolygonLimit::gauge(double a, double b) const {
  if (corners.size() < 3 || !std::isfinite(a) || !std::isfinite(b)) return INFINITY;
  double most = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& p = corners[i];
    const Corner& q = corners[(i + 1) % corners.size()];
    // Outward normal of the edge, and its distance from zero times the normal's length.
    const double x = q[1] - p[1], y = p[0] - q[0];
    const double distance = x * p[0] + y * p[1];
    if (!(distance > 0)) return INFINITY;
    most = std::max(most, (x * a + y * b) / distance);
  }
  return most;
}

Result<PolygonLimit> make_polygon_limit(int first, int second,
                                        std::vector<std::array<double, 2>> corners) {
  const auto wrong = [](const std::string& what) {
    return Error{what, "swing polygon", "give its corners in order round the zero pose"};
  };
  constexpr std::size_t kMostCorners = 1000;
  constexpr double kFarthest = 100;  // clips may swing past half a turn and widen a limit to it
  if (first < 0 || second < 0 || first == second) return wrong("it needs two DOFs");
  if (corners.size() < 3) return wrong("it needs three corners at least");
  if (corners.size() > kMostCorners) return wrong("it has too many corners");
  for (const Corner& corner : corners) {
    // Written so that NaN is wrong.
    if (!(std::hypot(corner[0], corner[1]) <= kFarthest))
      return wrong("a corner is no place in a swing");
  }
  double area = 0, turns = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& a = corners[i];
    const Corner& b = corners[(i + 1) % corners.size()];
    area += cross({0, 0}, a, b);
    turns += std::atan2(cross({0, 0}, a, b), a[0] * b[0] + a[1] * b[1]);
  }
  // A star is convex at each corner too.
  if (std::abs(turns) > 7) return wrong("it goes round the zero pose more than once");
  if (area < 0) std::reverse(corners.begin(), corners.end());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& a = corners[i];
    const Corner& b = corners[(i + 1) % corners.size()];
    const Corner& c = corners[(i + 2) % corners.size()];
    if (cross(a, b, c) < -1e-12) return wrong("it is not convex");
    if (!(cross({0, 0}, a, b) > 0)) return wrong("the zero pose is not inside it");
  }
  PolygonLimit limit{first, second, convex_hull(std::move(corners))};
  if (limit.corners.size() < 3) return wrong("it has no area");
  return limit;
}

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
  for (const PolygonLimit& polygon : polygons) {
    if (!(polygon.gauge(q[polygon.first], q[polygon.second]) <= 1.0 + tolerance)) return false;
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
  for (PolygonLimit& polygon : polygons) {
    const double a = q[polygon.first], b = q[polygon.second];
    if (!std::isfinite(a) || !std::isfinite(b) || polygon.gauge(a, b) <= 1.0) continue;
    const double grow = 1.0 + 1e-12;  // so that q is inside in floating point too
    std::vector<Corner> corners = polygon.corners;
    corners.push_back({a * grow, b * grow});
    polygon.corners = convex_hull(std::move(corners));
    note(polygon.first);
    note(polygon.second);
  }
  std::sort(widened.begin(), widened.end());
  return widened;
}

}  // namespace elbowroom
