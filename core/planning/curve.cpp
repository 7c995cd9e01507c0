// SPDX-License-Identifier: MIT
#include "core/planning/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace elbowroom {
namespace {

Dofs combine(const Curve& curve, double t, int derivative) {
  const int s = curve_span(curve.knots, t);
  const CurveBasis basis = curve_basis(curve.knots, s, t);
  Dofs sum;
  sum.count = curve.control.front().count;
  for (int j = 0; j < 4; ++j) {
    const Dofs& p = curve.control[static_cast<std::size_t>(s - 3 + j)];
    for (int i = 0; i < sum.count; ++i) sum[i] += basis.value[derivative][j] * p[i];
  }
  return sum;
}

}  // namespace

Dofs Curve::value(double t) const {
  if (t <= t_begin()) return control.front();
  if (t >= t_end()) return control.back();
  return combine(*this, t, 0);
}

Dofs Curve::derivative(double t) const {
  return combine(*this, std::clamp(t, t_begin(), t_end()), 1);
}

Dofs Curve::second(double t) const { return combine(*this, std::clamp(t, t_begin(), t_end()), 2); }

int curve_span(const std::vector<double>& knots, double t) {
  const int n = static_cast<int>(knots.size()) - 4;
  const auto after = std::upper_bound(knots.begin() + 4, knots.begin() + n, t);
  return static_cast<int>(after - knots.begin()) - 1;
}

CurveBasis curve_basis(const std::vector<double>& knots, int s, double t) {
  const auto k = [&knots](int i) { return knots[static_cast<std::size_t>(i)]; };
  // table[d][p][j]: d-th derivative of the basis function of degree p that begins at knot
  // s - p + j. Degree by degree after Cox and de Boor; derivatives are differences of the functions
  // one degree lower. The denominators are never 0: their knots enclose the span s.
  double table[4][4][4] = {};
  table[0][0][0] = 1;
  for (int p = 1; p <= 3; ++p) {
    for (int j = 0; j <= p; ++j) {
      for (int d = 0; d <= p; ++d) {
        double sum = 0;
        if (j > 0) {
          const double begin = k(s - p + j), end = k(s + j);
          const double part =
              d == 0 ? (t - begin) * table[0][p - 1][j - 1] : p * table[d - 1][p - 1][j - 1];
          sum += part / (end - begin);
        }
        if (j < p) {
          const double begin = k(s - p + j + 1), end = k(s + j + 1);
          const double part = d == 0 ? (end - t) * table[0][p - 1][j] : -p * table[d - 1][p - 1][j];
          sum += part / (end - begin);
        }
        table[d][p][j] = sum;
      }
    }
  }
  CurveBasis basis;
  for (int d = 0; d < 4; ++d) {
    for (int j = 0; j < 4; ++j) basis.value[d][j] = table[d][3][j];
  }
  return basis;
}

double greville_abscissa(const std::vector<double>& knots, int i) {
  const auto k = static_cast<std::size_t>(i);
  return (knots[k + 1] + knots[k + 2] + knots[k + 3]) / 3;
}

std::vector<double> clamped_knots(const std::vector<double>& breakpoints) {
  std::vector<double> knots(3, breakpoints.front());
  knots.insert(knots.end(), breakpoints.begin(), breakpoints.end());
  knots.insert(knots.end(), 3, breakpoints.back());
  return knots;
}

}  // namespace elbowroom
