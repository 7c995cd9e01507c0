// SPDX-License-Identifier: MIT
// A twice continuously differentiable curve through joint-model parameters over time.
//
// A clamped cubic B-spline. Values, and through their differences speeds, lie in the convex hull of
// the control points; so limits, which are convex, and speed limits are kept by keeping them at the
// control points.
#pragma once

#include <vector>

#include "core/base/dof_space.h"

namespace elbowroom {

struct Curve {
  // n control points and n + 4 knots, n ≥ 4; the first four knots are equal, as are the last four,
  // and between them the knots ascend strictly. Seconds; radians.
  std::vector<double> knots;
  std::vector<Dofs> control;

  bool empty() const { return control.empty(); }
  double t_begin() const { return knots.front(); }
  double t_end() const { return knots.back(); }

  // At time t, clamped to the curve's window. The ends' values are the first and last control
  // points, bit for bit.
  Dofs value(double t) const;
  Dofs derivative(double t) const;  // rad/s
  Dofs second(double t) const;      // rad/s²
};

// The span [knots[s], knots[s + 1]) that holds t (the last one for the end); 3 ≤ s < n.
int curve_span(const std::vector<double>& knots, double t);

// The four cubic basis functions that do not vanish on span s, at t: of control points s - 3 ... s;
// row d holds their d-th derivatives, d = 0 ... 3.
struct CurveBasis {
  double value[4][4];
};
CurveBasis curve_basis(const std::vector<double>& knots, int s, double t);

// Where control point i acts in the mean: (k[i+1] + k[i+2] + k[i+3]) / 3.
double greville_abscissa(const std::vector<double>& knots, int i);

// Clamped knots for strictly ascending breakpoints (at least two).
std::vector<double> clamped_knots(const std::vector<double>& breakpoints);

}  // namespace elbowroom
