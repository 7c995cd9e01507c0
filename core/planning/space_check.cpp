// SPDX-License-Identifier: MIT
#include "core/planning/space_check.h"

#include <cmath>
#include <cstdio>

namespace elbowroom {
namespace {

constexpr double kTolerance = 1e-9;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string dof_name(const DofSpace& space, int i) {
  const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
  return dof.name.empty() ? "DOF " + std::to_string(i) : dof.name;
}

}  // namespace

std::string dof_space_fault(const DofSpace& space) {
  if (space.dofs.empty()) return "the limb has no DOFs";
  if (space.count() > kMaxDofs) {
    return "the limb has " + std::to_string(space.count()) + " DOFs, more than " +
           std::to_string(kMaxDofs);
  }
  for (int i = 0; i < space.count(); ++i) {
    const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
    if (!std::isfinite(dof.lower) || !std::isfinite(dof.upper) || dof.lower > dof.upper) {
      return dof_name(space, i) + " has no proper limits";
    }
    if (!(dof.sample_lower >= dof.lower - kTolerance) ||
        !(dof.sample_upper <= dof.upper + kTolerance) || !(dof.sample_lower <= dof.sample_upper)) {
      return dof_name(space, i) + " has a sampling interval outside its limits";
    }
    if (!std::isfinite(dof.speed_limit) || !(dof.speed_limit > 0)) {
      return dof_name(space, i) + " has no proper speed limit";
    }
    if (!(dof.acceleration_limit > 0)) {
      return dof_name(space, i) + " has no proper acceleration limit";
    }
  }
  for (const EllipseLimit& e : space.ellipses) {
    const bool indices = e.first >= 0 && e.first < space.count() && e.second >= 0 &&
                         e.second < space.count() && e.first != e.second;
    if (!indices || !(e.half_first > 0) || !(e.half_second > 0) || !std::isfinite(e.half_first) ||
        !std::isfinite(e.half_second)) {
      return "a swing ellipse has no proper half-axes";
    }
  }
  for (const PolygonLimit& p : space.polygons) {
    if (p.first >= space.count() || p.second >= space.count() ||
        !make_polygon_limit(p.first, p.second, p.corners)) {
      return "a swing polygon is no convex polygon about the zero pose";
    }
  }
  return {};
}

std::string dofs_fault(const DofSpace& space, const Dofs& q) {
  if (q.count != space.count()) {
    return std::to_string(q.count) + " values are given for " + std::to_string(space.count()) +
           " DOFs";
  }
  for (int i = 0; i < q.count; ++i) {
    if (!std::isfinite(q[i])) return dof_name(space, i) + " is not a finite number";
  }
  return {};
}

std::string configuration_fault(const DofSpace& space, const Configuration& c) {
  if (!std::isfinite(c.t)) return "the time is not a finite number";
  return dofs_fault(space, c.q);
}

std::string limit_fault(const DofSpace& space, const Dofs& q) {
  for (int i = 0; i < space.count(); ++i) {
    const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
    if (q[i] < dof.lower - kTolerance || q[i] > dof.upper + kTolerance) {
      return dof_name(space, i) + " is " + number(q[i]) + " rad, outside its limits " +
             number(dof.lower) + " to " + number(dof.upper);
    }
  }
  for (const EllipseLimit& e : space.ellipses) {
    const double x = q[e.first] / e.half_first;
    const double y = q[e.second] / e.half_second;
    if (!(x * x + y * y <= 1 + kTolerance)) {
      return dof_name(space, e.first) + " and " + dof_name(space, e.second) + " (" +
             number(q[e.first]) + ", " + number(q[e.second]) +
             " rad) lie outside their swing ellipse";
    }
  }
  for (const PolygonLimit& p : space.polygons) {
    if (!(p.gauge(q[p.first], q[p.second]) <= 1 + kTolerance)) {
      return dof_name(space, p.first) + " and " + dof_name(space, p.second) + " (" +
             number(q[p.first]) + ", " + number(q[p.second]) +
             " rad) lie outside their swing polygon";
    }
  }
  return {};
}

std::string path_fault(const std::vector<Configuration>& path) {
  if (path.size() < 2) return "a path needs two landmarks at least";
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Configuration& c = path[i];
    if (c.q.count < 1 || c.q.count > kMaxDofs || c.q.count != path[0].q.count) {
      return "the landmarks of the path differ in their DOFs";
    }
    if (!std::isfinite(c.t) || (i > 0 && !(path[i - 1].t < c.t))) {
      return "the times of the path do not ascend";
    }
    for (int k = 0; k < c.q.count; ++k) {
      if (!std::isfinite(c.q[k])) return "a landmark of the path is not a finite number";
    }
  }
  return {};
}

}  // namespace elbowroom
