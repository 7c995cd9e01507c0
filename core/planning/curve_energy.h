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

// The step from d that takes control points first ... last, all else fixed, to the minimum of E.
// `d`: one row a control point. Returns last - first + 1 rows and, in `gain`, the energy the whole
// step saves for each DOF; a share α of it saves (2α - α²) as much. Empty if G is not definite
// there.
std::vector<Dofs> minimizing_step(const BandMatrix& g, const std::vector<Dofs>& d, int first,
                                  int last, Dofs& gain);

double energy(const BandMatrix& g, const std::vector<Dofs>& d);

}  // namespace elbowroom
