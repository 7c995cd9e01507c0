// SPDX-License-Identifier: MIT
#include "render/limit_cone.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The longest step ≤ `step` along (a, b) from the zero pose that keeps ellipse and ranges.
double allowed(const DofSpace& space, int first, double a, double b, double step) {
  for (const EllipseLimit& ellipse : space.ellipses) {
    if (ellipse.first != first || ellipse.second != first + 1) continue;
    const double length = std::hypot(a / ellipse.half_first, b / ellipse.half_second);
    if (length > 0) step = std::min(step, 1.0 / length);
  }
  for (const PolygonLimit& polygon : space.polygons) {
    if (polygon.first != first || polygon.second != first + 1) continue;
    const double out = polygon.gauge(a, b);
    if (out > 0) step = std::min(step, 1.0 / out);
  }
  const double way[2] = {a, b};
  for (int i = 0; i < 2; ++i) {
    const Dof& dof = space.dofs[static_cast<std::size_t>(first + i)];
    if (way[i] > 0) step = std::min(step, std::max(dof.upper, 0.0) / way[i]);
    if (way[i] < 0) step = std::min(step, std::min(dof.lower, 0.0) / way[i]);
  }
  return step;
}

}  // namespace

LimitCone limit_cone(const LimbModel& limb, int which, const Mat4& world_from_parent,
                     const Vec3& apex, double length, int points) {
  LimitCone cone;
  if (which < 0 || which > 2) return cone;
  const JointModel& joint = limb.joints[static_cast<std::size_t>(which)];
  const bool swings = joint.kind == JointModelKind::ball || joint.kind == JointModelKind::swing;
  const int first = joint.first_dof;
  if (!swings || first < 0 || first + 1 >= limb.dof_count()) return cone;
  const Mat3 turn(world_from_parent);
  const auto end_at = [&](double a, double b) {
    const double q[3] = {a, b, 0};
    const Vec3 bone = turn * (joint.parent_from_zero * (joint_rotation(joint, q) * Vec3(1, 0, 0)));
    return apex + bone * (length / glm::length(bone));
  };
  cone.apex = apex;
  cone.zero = end_at(0, 0);
  if (!finite(cone.zero)) return {};

  points = std::clamp(points, 8, 4096);
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * kPi * i / points;
    const double a = std::cos(angle), b = std::sin(angle);
    const double step = allowed(limb.space, first, a, b, kPi);
    cone.rim.push_back(end_at(step * a, step * b));
  }
  // Round the rectangle of the sampling intervals.
  const Dof& x = limb.space.dofs[static_cast<std::size_t>(first)];
  const Dof& y = limb.space.dofs[static_cast<std::size_t>(first + 1)];
  const double corners[5][2] = {{x.sample_lower, y.sample_lower},
                                {x.sample_upper, y.sample_lower},
                                {x.sample_upper, y.sample_upper},
                                {x.sample_lower, y.sample_upper},
                                {x.sample_lower, y.sample_lower}};
  const int side = std::max(2, points / 4);
  for (int c = 0; c < 4; ++c) {
    for (int i = 0; i < side; ++i) {
      const double u = static_cast<double>(i) / side;
      const double a = corners[c][0] + u * (corners[c + 1][0] - corners[c][0]);
      const double b = corners[c][1] + u * (corners[c + 1][1] - corners[c][1]);
      const double step = allowed(limb.space, first, a, b, 1.0);
      cone.sampling.push_back(end_at(step * a, step * b));
    }
  }
  const auto all_finite = [](const std::vector<Vec3>& line) {
    return std::all_of(line.begin(), line.end(), finite);
  };
  if (!all_finite(cone.rim) || !all_finite(cone.sampling)) return {};
  return cone;
}

std::vector<Trail> cone_trails(const LimitCone& cone, Rgb colour, float opacity) {
  std::vector<Trail> trails;
  const auto add = [&](std::vector<Vec3> points, float strength, float width) {
    Trail trail;
    trail.points = std::move(points);
    trail.colours = {colour};
    trail.opacity = opacity * strength;
    trail.width = width;
    trails.push_back(std::move(trail));
  };
  const auto closed = [](std::vector<Vec3> points) {
    points.push_back(points.front());
    return points;
  };
  if (cone.rim.empty()) return trails;
  const std::size_t step = std::max<std::size_t>(1, cone.rim.size() / 12);
  for (std::size_t i = 0; i < cone.rim.size(); i += step) add({cone.apex, cone.rim[i]}, 0.4f, 1);
  add(closed(cone.rim), 1, 1.5f);
  if (!cone.sampling.empty()) add(closed(cone.sampling), 1, 2.5f);
  add({cone.apex, cone.zero}, 0.8f, 1);
  return trails;
}

}  // namespace elbowroom
