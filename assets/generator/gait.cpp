// SPDX-License-Identifier: MIT
#include "assets/generator/gait.h"

namespace elbowroom::demo {

PeriodicCurve::PeriodicCurve(const std::vector<Key>& keys, double scale) : keys_(keys) {
  for (Key& k : keys_) k.value *= scale;
  // Cyclic tridiagonal system for the second derivatives; Gauss-Seidel converges fast, the matrix
  // being diagonally dominant by a factor of two.
  const std::size_t n = keys_.size();
  curvature_.assign(n, 0.0);
  for (int sweep = 0; sweep < 80; ++sweep)
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
      const double h0 = keys_[i].phase - keys_[before].phase + (i == 0 ? 1.0 : 0.0);
      const double h1 = keys_[after].phase - keys_[i].phase + (after == 0 ? 1.0 : 0.0);
      const double bend = 6.0 * ((keys_[after].value - keys_[i].value) / h1 -
                                 (keys_[i].value - keys_[before].value) / h0);
      curvature_[i] = (bend - h0 * curvature_[before] - h1 * curvature_[after]) / (2.0 * (h0 + h1));
    }
}

double PeriodicCurve::operator()(double phase) const {
  phase -= std::floor(phase);
  const std::size_t n = keys_.size();
  std::size_t i = n - 1;  // the last segment wraps round
  for (std::size_t k = 0; k + 1 < n; ++k)
    if (phase >= keys_[k].phase && phase < keys_[k + 1].phase) i = k;
  const std::size_t j = (i + 1) % n;
  const double begin = i == n - 1 && phase < keys_[0].phase ? keys_[i].phase - 1 : keys_[i].phase;
  const double h = keys_[j].phase - keys_[i].phase + (j == 0 ? 1.0 : 0.0);
  const double b = (phase - begin) / h, a = 1.0 - b;
  return a * keys_[i].value + b * keys_[j].value +
         ((a * a * a - a) * curvature_[i] + (b * b * b - b) * curvature_[j]) * h * h / 6.0;
}

Gait natural_gait() {
  constexpr double degrees = kPi / 180.0;
  return Gait{
      .hip = PeriodicCurve({{0.00, 22.5},
                            {0.05, 22.0},
                            {0.10, 19.0},
                            {0.15, 14.5},
                            {0.20, 9.0},
                            {0.27, 1.0},
                            {0.35, -8.0},
                            {0.43, -15.5},
                            {0.50, -19.5},
                            {0.54, -18.8},
                            {0.60, -11.5},
                            {0.67, 3.0},
                            {0.73, 14.0},
                            {0.80, 22.5},
                            {0.86, 25.5},
                            {0.93, 24.5}},
                           degrees),
      .knee = PeriodicCurve({{0.00, 4.0},
                             {0.06, 11.5},
                             {0.14, 20.5},
                             {0.22, 18.0},
                             {0.30, 11.5},
                             {0.39, 6.5},
                             {0.46, 9.0},
                             {0.54, 22.0},
                             {0.62, 45.0},
                             {0.70, 63.0},
                             {0.74, 65.0},
                             {0.80, 55.0},
                             {0.88, 27.0},
                             {0.95, 4.5}},
                            degrees),
      .ankle = PeriodicCurve({{0.00, 0.0},
                              {0.06, -4.8},
                              {0.12, -1.5},
                              {0.20, 4.0},
                              {0.30, 7.0},
                              {0.42, 9.6},
                              {0.50, 5.0},
                              {0.56, -7.5},
                              {0.63, -19.6},
                              {0.72, -10.5},
                              {0.80, -2.0},
                              {0.88, 1.0},
                              {0.95, 0.5}},
                             degrees),
      .foot = PeriodicCurve({{0.00, 18.0},
                             {0.035, 10.5},
                             {0.08, 1.0},
                             {0.13, 0.0},
                             {0.20, 0.0},
                             {0.27, 0.0},
                             {0.34, -2.0},
                             {0.40, -6.5},
                             {0.46, -14.0},
                             {0.52, -27.0},
                             {0.57, -42.0},
                             {0.615, -55.0},
                             {0.66, -59.5},
                             {0.72, -49.0},
                             {0.79, -22.0},
                             {0.87, 6.0},
                             {0.94, 18.0}},
                            degrees),
      .shoulder = PeriodicCurve({{0.00, -21.0},
                                 {0.10, -18.0},
                                 {0.25, -5.0},
                                 {0.40, 7.5},
                                 {0.50, 11.0},
                                 {0.60, 8.5},
                                 {0.75, -4.0},
                                 {0.90, -18.0}},
                                degrees),
      .elbow = PeriodicCurve({{0.00, 18.0},
                              {0.15, 18.5},
                              {0.30, 26.0},
                              {0.50, 38.0},
                              {0.60, 38.0},
                              {0.75, 28.0},
                              {0.90, 19.5}},
                             degrees),
  };
}

}  // namespace elbowroom::demo
