// SPDX-License-Identifier: MIT
#include "core/planning/curve_energy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "core/planning/curve.h"

namespace elbowroom {
namespace {

// Gauss–Legendre nodes and weights on [-1, 1]: exact to degree 7, and B_i B_j has degree 6.
constexpr double kNodes[4] = {-0.86113631159405257522, -0.33998104358485626480,
                              0.33998104358485626480, 0.86113631159405257522};
constexpr double kWeights[4] = {0.34785484513745385737, 0.65214515486254614263,
                                0.65214515486254614263, 0.34785484513745385737};

template <typename Visit>  // visit(span, time, weight)
void integrate(const std::vector<double>& knots, Visit&& visit) {
  const int n = static_cast<int>(knots.size()) - 4;
  for (int s = 3; s < n; ++s) {
    const double begin = knots[static_cast<std::size_t>(s)];
    const double end = knots[static_cast<std::size_t>(s) + 1];
    for (int g = 0; g < 4; ++g) {
      visit(s, 0.5 * (begin + end) + 0.5 * (end - begin) * kNodes[g],
            0.5 * (end - begin) * kWeights[g]);
    }
  }
}

// Cholesky factor of the rows and columns listed of a banded matrix (they are banded again, since
// leaving rows out brings others closer); false if they are not positive definite.
bool factor(const BandMatrix& g, const std::vector<int>& free,
            std::vector<std::array<double, 4>>& l) {
  const int m = static_cast<int>(free.size());
  const auto index = [&free](int i) { return free[static_cast<std::size_t>(i)]; };
  l.assign(free.size(), {});
  for (int i = 0; i < m; ++i) {
    auto& row = l[static_cast<std::size_t>(i)];
    for (int j = std::max(0, i - 3); j <= i; ++j) {
      const auto& other = l[static_cast<std::size_t>(j)];
      double sum = g.at(index(i), index(j));
      for (int k = std::max({0, i - 3, j - 3}); k < j; ++k) {
        sum -=
            row[static_cast<std::size_t>(k - i + 3)] * other[static_cast<std::size_t>(k - j + 3)];
      }
      if (i == j) {
        if (!(sum > 0)) return false;
        row[3] = std::sqrt(sum);
      } else {
        row[static_cast<std::size_t>(j - i + 3)] = sum / other[3];
      }
    }
  }
  return true;
}

// L Lᵀ x = x, for all DOFs at once.
void solve(const std::vector<std::array<double, 4>>& l, std::vector<Dofs>& x) {
  const int m = static_cast<int>(l.size());
  const int dofs = x.empty() ? 0 : x.front().count;
  for (int i = 0; i < m; ++i) {
    const auto& row = l[static_cast<std::size_t>(i)];
    Dofs& xi = x[static_cast<std::size_t>(i)];
    for (int k = std::max(0, i - 3); k < i; ++k) {
      const Dofs& xk = x[static_cast<std::size_t>(k)];
      for (int a = 0; a < dofs; ++a) xi[a] -= row[static_cast<std::size_t>(k - i + 3)] * xk[a];
    }
    for (int a = 0; a < dofs; ++a) xi[a] /= row[3];
  }
  for (int i = m - 1; i >= 0; --i) {
    Dofs& xi = x[static_cast<std::size_t>(i)];
    for (int k = i + 1; k < std::min(m, i + 4); ++k) {
      const double factor_ki = l[static_cast<std::size_t>(k)][static_cast<std::size_t>(i - k + 3)];
      const Dofs& xk = x[static_cast<std::size_t>(k)];
      for (int a = 0; a < dofs; ++a) xi[a] -= factor_ki * xk[a];
    }
    for (int a = 0; a < dofs; ++a) xi[a] /= l[static_cast<std::size_t>(i)][3];
  }
}

// (G d)_i.
Dofs product(const BandMatrix& g, const std::vector<Dofs>& d, int i) {
  Dofs sum;
  sum.count = d.front().count;
  for (int j = std::max(0, i - 3); j <= std::min(g.size() - 1, i + 3); ++j) {
    const double gij = g.at(i, j);
    for (int a = 0; a < sum.count; ++a) sum[a] += gij * d[static_cast<std::size_t>(j)][a];
  }
  return sum;
}

}  // namespace

double BandMatrix::at(int i, int j) const {
  if (j > i) std::swap(i, j);
  return i - j > 3 ? 0 : rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j - i + 3)];
}

BandMatrix energy_matrix(const std::vector<double>& knots, const EnergyWeights& weights) {
  BandMatrix g;
  g.rows.assign(knots.size() - 4, {});
  const double by_order[4] = {weights.position, 0, weights.acceleration, weights.jerk};
  integrate(knots, [&](int s, double t, double weight) {
    const CurveBasis basis = curve_basis(knots, s, t);
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b <= a; ++b) {
        double sum = 0;
        for (int k = 0; k < 4; ++k) sum += by_order[k] * basis.value[k][a] * basis.value[k][b];
        g.rows[static_cast<std::size_t>(s - 3 + a)][static_cast<std::size_t>(b - a + 3)] +=
            weight * sum;
      }
    }
  });
  return g;
}

std::vector<Dofs> smoothing_spline(const std::vector<double>& knots,
                                   const std::function<Dofs(double)>& function, int dofs,
                                   double smoothing_time) {
  Dofs zero;
  zero.count = dofs;
  std::vector<Dofs> control(knots.size() - 4, zero);
  integrate(knots, [&](int s, double t, double weight) {
    const CurveBasis basis = curve_basis(knots, s, t);
    const Dofs r = function(t);
    for (int j = 0; j < 4; ++j) {
      Dofs& row = control[static_cast<std::size_t>(s - 3 + j)];
      for (int a = 0; a < dofs; ++a) row[a] += weight * basis.value[0][j] * r[a];
    }
  });
  const BandMatrix g = energy_matrix(knots, {1, 0, std::pow(smoothing_time, 6)});
  std::vector<int> all(control.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::array<double, 4>> l;
  if (!factor(g, all, l)) return {};
  solve(l, control);
  return control;
}

bool minimize(const BandMatrix& g, const std::vector<int>& free, std::vector<Dofs>& d) {
  if (free.empty()) return true;
  std::vector<std::array<double, 4>> l;
  if (!factor(g, free, l)) return false;
  // With the gradient's half r = (G d)_F the step is -G_FF⁻¹ r.
  std::vector<Dofs> step;
  for (const int i : free) step.push_back(product(g, d, i));
  solve(l, step);
  for (std::size_t k = 0; k < free.size(); ++k) {
    Dofs& row = d[static_cast<std::size_t>(free[k])];
    for (int a = 0; a < row.count; ++a) row[a] -= step[k][a];
  }
  return true;
}

double energy(const BandMatrix& g, const std::vector<Dofs>& d) {
  double sum = 0;
  for (int i = 0; i < g.size(); ++i) {
    const Dofs row = product(g, d, i);
    for (int a = 0; a < row.count; ++a) sum += row[a] * d[static_cast<std::size_t>(i)][a];
  }
  return sum;
}

}  // namespace elbowroom
