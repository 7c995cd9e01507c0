// SPDX-License-Identifier: MIT
#include "core/planning/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/planning/curve_energy.h"

namespace elbowroom {
namespace {

Curve random_curve(std::uint64_t seed, int spans, int dofs) {
  Random random(seed);
  std::vector<double> breakpoints{-0.7};
  for (int i = 0; i < spans; ++i) {
    breakpoints.push_back(breakpoints.back() + random.uniform(0.01, 0.2));
  }
  Curve curve;
  curve.knots = clamped_knots(breakpoints);
  for (int i = 0; i < spans + 3; ++i) {
    Dofs q;
    q.count = dofs;
    for (int a = 0; a < dofs; ++a) q[a] = random.uniform(-1, 1);
    curve.control.push_back(q);
  }
  return curve;
}

TEST(Curve, MeetsItsFirstAndLastControlPointsBitForBit) {
  const Curve curve = random_curve(1, 9, 7);
  for (int a = 0; a < 7; ++a) {
    EXPECT_EQ(curve.value(curve.t_begin())[a], curve.control.front()[a]);
    EXPECT_EQ(curve.value(curve.t_end())[a], curve.control.back()[a]);
    EXPECT_EQ(curve.value(-99)[a], curve.control.front()[a]);
    EXPECT_EQ(curve.value(99)[a], curve.control.back()[a]);
  }
}

TEST(Curve, DerivativesAreThoseOfTheValue) {
  const Curve curve = random_curve(2, 12, 3);
  const double h = 1e-5;
  for (int k = 1; k < 400; ++k) {
    const double t = curve.t_begin() + (curve.t_end() - curve.t_begin()) * k / 400.0;
    for (int a = 0; a < 3; ++a) {
      const double slope = (curve.value(t + h)[a] - curve.value(t - h)[a]) / (2 * h);
      EXPECT_NEAR(curve.derivative(t)[a], slope, 1e-3 * (1 + std::abs(slope)));
      const double bend = (curve.derivative(t + h)[a] - curve.derivative(t - h)[a]) / (2 * h);
      EXPECT_NEAR(curve.second(t)[a], bend, 2e-2 * (1 + std::abs(bend)));
    }
  }
}

TEST(Curve, IsTwiceContinuouslyDifferentiableAtItsKnots) {
  const Curve curve = random_curve(3, 12, 2);
  for (std::size_t k = 4; k + 4 < curve.knots.size(); ++k) {
    const double t = curve.knots[k];
    const double before = std::nextafter(t, -1e9);
    for (int a = 0; a < 2; ++a) {
      EXPECT_NEAR(curve.value(before)[a], curve.value(t)[a], 1e-12);
      EXPECT_NEAR(curve.derivative(before)[a], curve.derivative(t)[a], 1e-9);
      EXPECT_NEAR(curve.second(before)[a], curve.second(t)[a], 1e-6);
    }
  }
}

TEST(Curve, BasisIsAPartitionOfUnity) {
  const Curve curve = random_curve(4, 20, 1);
  for (int k = 0; k <= 1000; ++k) {
    const double t = curve.t_begin() + (curve.t_end() - curve.t_begin()) * k / 1000.0;
    const int s = curve_span(curve.knots, t);
    ASSERT_GE(s, 3);
    ASSERT_LT(s, static_cast<int>(curve.control.size()));
    const CurveBasis basis = curve_basis(curve.knots, s, t);
    double sum = 0, slope = 0;
    for (int j = 0; j < 4; ++j) {
      EXPECT_GE(basis.value[0][j], -1e-12);
      sum += basis.value[0][j];
      slope += basis.value[1][j];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(slope, 0, 1e-9);
  }
}

TEST(Energy, IsTheIntegralItClaimsToBe) {
  const Curve curve = random_curve(5, 7, 2);
  const EnergyWeights weights{2, 0.3, 0.05};
  const double e = energy(energy_matrix(curve.knots, weights), curve.control);
  // Midpoint rule, span by span; the third derivative is constant in each and so is its difference.
  double sum = 0;
  for (std::size_t s = 3; s + 4 < curve.knots.size(); ++s) {
    const int n = 4000;
    const double h = (curve.knots[s + 1] - curve.knots[s]) / n;
    for (int k = 0; k < n; ++k) {
      const double t = curve.knots[s] + (k + 0.5) * h;
      const Dofs q = curve.value(t), q2 = curve.second(t);
      const Dofs a = curve.second(curve.knots[s] + 0.25 * n * h);
      const Dofs b = curve.second(curve.knots[s] + 0.75 * n * h);
      for (int i = 0; i < 2; ++i) {
        const double q3 = (b[i] - a[i]) / (0.5 * n * h);
        sum += h * (weights.position * q[i] * q[i] + weights.acceleration * q2[i] * q2[i] +
                    weights.jerk * q3 * q3);
      }
    }
  }
  EXPECT_NEAR(e / sum, 1, 1e-5);
}

TEST(Energy, MinimumIsLowerThanItsNeighboursAndLeavesTheRestAlone) {
  const Curve curve = random_curve(6, 15, 3);
  const BandMatrix g = energy_matrix(curve.knots, {1, 1e-3, 1e-6});
  std::vector<Dofs> d = curve.control;
  const std::vector<int> free{4, 5, 6, 8, 9, 13};
  ASSERT_TRUE(minimize(g, free, d));
  for (int i = 0; i < static_cast<int>(d.size()); ++i) {
    if (std::find(free.begin(), free.end(), i) != free.end()) continue;
    for (int a = 0; a < 3; ++a) {
      EXPECT_EQ(d[static_cast<std::size_t>(i)][a], curve.control[static_cast<std::size_t>(i)][a]);
    }
  }
  const double least = energy(g, d);
  EXPECT_LT(least, energy(g, curve.control));
  Random random(8);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Dofs> other = d;
    for (const int i : free)
      other[static_cast<std::size_t>(i)][trial % 3] += random.uniform(-.1, .1);
    EXPECT_GT(energy(g, other), least);
  }
}

TEST(Energy, SmoothingSplineKeepsWhatABodyDoesAndDropsKinks) {
  std::vector<double> breakpoints;
  for (int i = 0; i <= 120; ++i) breakpoints.push_back(i / 60.0);
  Curve curve;
  curve.knots = clamped_knots(breakpoints);
  const auto with_noise = [](double t) {
    Dofs q;
    q.count = 2;
    q[0] = std::sin(2 * kPi * 2 * t);
    q[1] = 0.1 * std::sin(2 * kPi * 30 * t);
    return q;
  };
  curve.control = smoothing_spline(curve.knots, with_noise, 2, 1 / (2 * kPi * 12));
  ASSERT_FALSE(curve.control.empty());
  for (int k = 10; k < 190; ++k) {
    const double t = k / 100.0;
    EXPECT_NEAR(curve.value(t)[0], std::sin(2 * kPi * 2 * t), 2e-3);
    EXPECT_NEAR(curve.value(t)[1], 0, 0.005);
  }
}

}  // namespace
}  // namespace elbowroom
