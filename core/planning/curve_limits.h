// SPDX-License-Identifier: MIT
// Limits, speed limits and acceleration limits of a curve, kept at its control points: a spline's
// values, its derivative's and its second derivative's lie in the convex hulls of theirs.
//
// What the fit cannot mend limits give way to: values, speeds and accelerations asked for at the
// ends, and accelerations that the clip itself has, which the curve follows. By how much is
// reported. Radians, seconds.
#pragma once

#include <vector>

#include "core/planning/curve.h"

namespace elbowroom {

// Control point i of the derivative, between control points i and i + 1; of the second derivative,
// between i and i + 2. Component a.
double curve_slope(const Curve& curve, int i, int a);
double curve_bend(const Curve& curve, int i, int a);

class CurveLimits {
 public:
  explicit CurveLimits(const DofSpace& asked) : asked_(&asked), space_(asked) {}

  // Wide enough for the first and the last control points, as many as are fixed.
  void widen_to_ends(const Curve& curve, int fixed_at_begin, int fixed_at_end);
  // Wide enough for the accelerations of another curve over the same knots.
  void widen_to_accelerations(const Curve& curve);

  const DofSpace& space() const { return space_; }
  bool keeps_limits(const Curve& curve, int i) const {
    return space_.within_limits(curve.control[static_cast<std::size_t>(i)]);
  }
  // Between control points i and i + 1.
  bool keeps_speed(const Curve& curve, int i) const;
  // Of the accelerations that control points first ... last have a part in, as multiples of their
  // limits: the greatest, at most 1 if all limits are kept; the control point in the middle of it;
  // and the sum of the squares of what is beyond 1.
  struct Strain {
    double share = 0;
    int at = -1;
    double overload = 0;
    bool kept() const { return share <= 1 + 1e-9; }
  };
  Strain strain(const Curve& curve, int first, int last) const;

  // A limit that was widened, or that a curve goes beyond, and by how much at most (rad, rad/s,
  // rad/s²).
  struct Excess {
    int dof = 0;
    double amount = 0;
  };
  std::vector<Excess> limit_excess() const;
  std::vector<Excess> speed_excess() const;
  std::vector<Excess> acceleration_excess(const Curve& curve) const;

 private:
  void widen_speed(const Curve& curve, int i);
  void widen_acceleration(const Curve& curve, int i);

  const DofSpace* asked_;
  DofSpace space_;
};

}  // namespace elbowroom
