// SPDX-License-Identifier: MIT
// Edges and trees: [SKF07 4.1], lines 3 to 5 of Algorithm 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/random.h"
#include "core/planning/interpolation.h"
#include "core/planning/tree.h"

namespace elbowroom {
namespace {

class Recorder : public StateSpace {
 public:
  bool valid(const Configuration& c) override {
    tested.push_back(c);
    return !blocked || !blocked(c);
  }
  void metric_points(const Configuration& c, std::vector<Vec3>& points) override {
    points = {Vec3(c.q[0], 0, 0)};
  }
  const std::vector<double>& step_times() const override { return steps; }
  std::vector<Configuration> tested;
  std::vector<double> steps;
  std::function<bool(const Configuration&)> blocked;
};

Configuration at(double q, double t) {
  Configuration c;
  c.q.count = 1;
  c.q[0] = q;
  c.t = t;
  return c;
}

TEST(Bisection, VisitsEveryPlaceOnceHalvesFirst) {
  for (std::int64_t n = 0; n < 200; ++n) {
    std::vector<int> visits(static_cast<std::size_t>(std::max<std::int64_t>(n, 1)), 0);
    bool first = true;
    EXPECT_TRUE(visit_by_bisection(n, [&](std::int64_t k) {
      if (first && n == 64) {
        EXPECT_EQ(k, 32);
      }
      first = false;
      ++visits[static_cast<std::size_t>(k)];
      return true;
    }));
    for (std::int64_t k = 1; k < n; ++k) EXPECT_EQ(visits[static_cast<std::size_t>(k)], 1);
  }
}

TEST(Edge, IsTestedAtTheResolutionInRadiansAndInSeconds) {
  const auto largest_gaps = [](const Configuration& a, const Configuration& b) {
    Recorder world;
    CheckCounters counters;
    EXPECT_TRUE(interpolation_free(world, {0.1, 0.02}, a, b, {}, counters));
    EXPECT_EQ(counters.validity_checks, static_cast<std::int64_t>(world.tested.size()));
    std::vector<Configuration> all = world.tested;
    all.push_back(a);
    all.push_back(b);
    std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.t < y.t; });
    for (std::size_t i = 1; i < all.size(); ++i) {
      EXPECT_LE(std::abs(all[i].q[0] - all[i - 1].q[0]), 0.1 + 1e-12);
      EXPECT_LE(all[i].t - all[i - 1].t, 0.02 + 1e-12);
    }
    return all.size();
  };
  largest_gaps(at(0, 0), at(3, 0.1));
  EXPECT_GT(largest_gaps(at(1, 0), at(1, 2)), 100u);  // a still limb moves too: the world does
}

TEST(Edge, BothSidesOfAStepAreTested) {
  Recorder world;
  world.steps = {-1, 0.3, 0.5, 1.0, 2};
  CheckCounters counters;
  ASSERT_TRUE(interpolation_free(world, {10, 10}, at(0, 0), at(1, 1), {}, counters));
  const auto tested = [&world](double t) {
    return std::any_of(world.tested.begin(), world.tested.end(),
                       [t](const Configuration& c) { return c.t == t; });
  };
  const auto before = [](double t) { return std::nextafter(t, -1e30); };
  for (const double t : {0.3, before(0.3), 0.5, before(0.5), before(1.0)}) EXPECT_TRUE(tested(t));
  // An obstacle there for an instant on one side of the step only is seen.
  world.blocked = [&](const Configuration& c) { return c.t > 0.299 && c.t < 0.3; };
  EXPECT_FALSE(interpolation_free(world, {10, 10}, at(0, 0), at(1, 1), {}, counters));
}

TEST(Edge, HostileResolutionsAreRefused) {
  Recorder world;
  CheckCounters counters;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const EdgeResolution& r :
       {EdgeResolution{0, 1}, EdgeResolution{1, 0}, EdgeResolution{nan, 1}, EdgeResolution{1, nan},
        EdgeResolution{1e-300, 1}}) {
    EXPECT_FALSE(interpolation_free(world, r, at(0, 0), at(1, 1), {}, counters));
  }
}

TEST(Edge, SpeedLimits) {
  DofSpace space;
  space.dofs.push_back({"x", DofRole::swing, -9, 9, -9, 9, 2.0});
  EXPECT_TRUE(within_speed_limits(space, at(0, 0), at(2, 1)));
  EXPECT_FALSE(within_speed_limits(space, at(0, 0), at(2.001, 1)));
  EXPECT_FALSE(within_speed_limits(space, at(0, 0), at(2, 1), 0.9));
  EXPECT_FALSE(within_speed_limits(space, at(0, 1), at(0, 1)));
  EXPECT_FALSE(within_speed_limits(space, at(0, 1), at(0, 0.5)));
}

TEST(Edge, InterpolationIsExactAtItsEnds) {
  const Configuration a = at(0.1, 0.3), b = at(0.7, 1.1);
  EXPECT_EQ(interpolate(a, b, 0).q[0], a.q[0]);
  EXPECT_EQ(interpolate(a, b, 1).q[0], b.q[0]);
  EXPECT_EQ(interpolate(a, b, 1).t, b.t);
  EXPECT_EQ(interpolate_at(a, b, 0.5).t, 0.5);
  EXPECT_EQ(interpolate_at(a, b, 5).q[0], b.q[0]);
}

TEST(Tree, NearestIsThatOfALinearSearchOnTheRightSideOfTime) {
  Random random(11);
  const MetricWeights weights{0.7, 1.3};
  for (const auto direction : {Tree::Direction::forward, Tree::Direction::backward}) {
    Tree tree(direction, weights);
    std::vector<std::vector<Vec3>> points;
    std::vector<Configuration> nodes;
    for (int i = 0; i < 300; ++i) {
      nodes.push_back(at(0, random.uniform()));
      points.emplace_back();
      for (int k = 0; k < 5; ++k) {
        points.back().push_back({random.uniform(), random.uniform(), random.uniform()});
      }
      EXPECT_EQ(tree.add(nodes.back(), points.back(), i - 1), i);
    }
    for (int i = 250; i < 260; ++i) EXPECT_FALSE(tree.is_cut(i));
    tree.cut(260);
    EXPECT_TRUE(tree.is_cut(299));  // all that grew from it
    for (int trial = 0; trial < 200; ++trial) {
      const std::size_t from = random.below(300);
      const double t = random.uniform(-0.1, 1.1);
      int best = -1;
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 260; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double ahead =
            direction == Tree::Direction::forward ? t - nodes[k].t : nodes[k].t - t;
        if (ahead < 0.05) continue;
        const double d = metric_distance(weights, nodes[k].t, points[k], t, points[from]);
        if (d < least - 1e-15) {
          least = d;
          best = i;
        }
      }
      EXPECT_EQ(tree.nearest(t, points[from], 0.05), best);
    }
  }
}

}  // namespace
}  // namespace elbowroom
