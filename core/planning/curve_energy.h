// SPDX-License-Identifier: MIT
// The quadratic form that fairing lowers (curve_fit.h), over the control points of a cubic
// B-spline:
//
//     E(P) = Σ over DOFs of dᵀ G d,   d = P - R,   G_ij = ∫ Σ_k w_k B_i⁽ᵏ⁾ B_j⁽ᵏ⁾ dt
//
// G is symmetric, positive definite (or semidefinite without w_0) and banded: basis functions more
// than three apart do not overlap. Integrals are exact (Gauss, four points a span).
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/base/dof_space.h"

namespace elbowroom {

struct EnergyWeights {
  double position = 1, acceleration = 0, jerk = 0;  // of k = 0, 2, 3
};

// G's lower band: row i holds G_i,i-3 ... G_i,i.
struct BandMatrix {
  std::vector<std::array<double, 4>> rows;

  int size() const { return static_cast<int>(rows.size()); }
  double at(int i, int j) const;  // 0 outside the band
};

BandMatrix energy_matrix(const std::vector<double>& knots, const EnergyWeights& weights);

// Control points of the spline that is nearest to a function in the mean, smoothed: the minimum of
// ∫ |R - r|² + smoothing_time⁶ |R'''|² dt, ends free. Passes components below 1 / (2π
// smoothing_time) Hz and drops those above.
std::vector<Dofs> smoothing_spline(const std::vector<double>& knots,
                                   const std::function<Dofs(double)>& function, int dofs,
                                   double smoothing_time);

// Takes the control points listed (ascending) to the minimum of E, all else fixed. `d`: one row a
// control point. False, and d as it was, if G is not definite there.
bool minimize(const BandMatrix& g, const std::vector<int>& free, std::vector<Dofs>& d);

double energy(const BandMatrix& g, const std::vector<Dofs>& d);

}  // namespace elbowroom
