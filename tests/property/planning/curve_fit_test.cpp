// SPDX-License-Identifier: MIT
// The curve through a path: what it promises at its ends, between them, and to whoever stops it.
#include "core/planning/curve_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/planning/planner.h"
#include "core/planning/smoothing.h"
#include "spaces.h"

namespace elbowroom {
namespace {

using test::Problem;

constexpr int kSeeds = 12;

CurveQuery query_of(Problem& p, std::uint64_t seed) {
  PlannerSettings settings;
  settings.seed = seed;
  const PlannerResult found =
      plan(p.world, {&p.world.space, p.init, p.goal, p.world.length_unit, {}}, settings);
  EXPECT_EQ(found.status, PlannerStatus::solved);
  SmoothingSettings smoothing;
  smoothing.seed = seed;
  CurveQuery query;
  query.space = &p.world.space;
  query.path = smooth_path(p.world, found.path, smoothing).path;
  query.velocity_init = p.velocity_init;
  query.velocity_goal = p.velocity_goal;
  query.reference = p.clip;
  return query;
}

bool same_bytes(const Curve& a, const Curve& b) {
  if (a.knots != b.knots || a.control.size() != b.control.size()) return false;
  for (std::size_t i = 0; i < a.control.size(); ++i) {
    if (std::memcmp(a.control[i].value.data(), b.control[i].value.data(),
                    sizeof a.control[i].value) != 0) {
      return false;
    }
  }
  return true;
}

void expect_curve(const Problem& p, const CurveQuery& query, const CurveResult& result) {
  const Curve& curve = result.curve;
  ASSERT_FALSE(curve.empty());
  EXPECT_EQ(curve.t_begin(), p.init.t);
  EXPECT_EQ(curve.t_end(), p.goal.t);
  const int dofs = p.world.space.count();
  for (int a = 0; a < dofs; ++a) {
    EXPECT_EQ(curve.value(p.init.t)[a], p.init.q[a]);
    EXPECT_EQ(curve.value(p.goal.t)[a], p.goal.q[a]);
    EXPECT_NEAR(curve.derivative(p.init.t)[a], query.velocity_init[a], 1e-9);
    EXPECT_NEAR(curve.derivative(p.goal.t)[a], query.velocity_goal[a], 1e-9);
    if (query.acceleration_init) {
      EXPECT_NEAR(curve.second(p.init.t)[a], (*query.acceleration_init)[a], 1e-6);
    }
    if (query.acceleration_goal) {
      EXPECT_NEAR(curve.second(p.goal.t)[a], (*query.acceleration_goal)[a], 1e-6);
    }
  }
  // Between tests of its own: values, speeds, ellipses.
  for (int k = 0; k <= 3000; ++k) {
    const double t = p.init.t + (p.goal.t - p.init.t) * k / 3000.0;
    EXPECT_TRUE(p.world.space.within_limits(curve.value(t), 1e-9));
    const Dofs speed = curve.derivative(t);
    for (int a = 0; a < dofs; ++a) {
      EXPECT_LE(std::abs(speed[a]),
                p.world.space.dofs[static_cast<std::size_t>(a)].speed_limit * (1 + 1e-8));
      EXPECT_LE(std::abs(speed[a]), result.peak_speed + 0.05 * (1 + result.peak_speed));
    }
  }
  // C2: knots are simple inside the window.
  for (std::size_t i = 3; i + 4 < curve.knots.size(); ++i) {
    EXPECT_LT(curve.knots[i], curve.knots[i + 1]);
  }
}

TEST(CurveFit, CurvesHoldTheirPromises) {
  for (Problem& p : test::problems()) {
    SCOPED_TRACE(p.world.name);
    int missed = 0, samples = 0;
    double acceleration = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const CurveQuery query = query_of(p, seed);
      const CurveSettings settings;
      const CurveResult result = fit_curve(p.world, query, settings);
      ASSERT_EQ(result.status, CurveStatus::solved) << result.reason << ", seed " << seed;
      expect_curve(p, query, result);
      EXPECT_TRUE(result.limit_excess.empty());
      EXPECT_TRUE(result.speed_excess.empty());
      EXPECT_LE(result.energy, result.energy_first);
      CheckCounters counters;
      EXPECT_TRUE(
          curve_free(p.world, result.curve, p.init.t, p.goal.t, settings.resolution, {}, counters));
      for (int k = 0; k <= 5000; ++k, ++samples) {
        const double t = p.init.t + (p.goal.t - p.init.t) * k / 5000.0;
        missed += !p.world.valid({result.curve.value(t), t});
      }
      acceleration = std::max(acceleration, result.peak_acceleration);
    }
    std::printf("[ misses   ] %s, curve: %d of %d samples collide; peak acceleration %.1f rad/s²\n",
                p.world.name.c_str(), missed, samples, acceleration);
    EXPECT_LT(missed, 0.01 * samples);
  }
}

TEST(CurveFit, AccelerationsAreMetWhereGiven) {
  Problem p = std::move(test::problems()[3]);
  CurveQuery query = query_of(p, 3);
  Dofs a;
  a.count = 7;
  for (int i = 0; i < 7; ++i) a[i] = 0.3 * (i - 3);
  query.acceleration_init = a;
  EXPECT_EQ(fit_curve(p.world, query, {}).status, CurveStatus::solved);
  expect_curve(p, query, fit_curve(p.world, query, {}));
  query.acceleration_goal = a;
  query.acceleration_init.reset();
  expect_curve(p, query, fit_curve(p.world, query, {}));
}

TEST(CurveFit, WhereNothingIsInTheWayTheCurveIsTheClip) {
  Problem p = std::move(test::problems()[3]);
  p.world.posts.clear();
  const CurveQuery query = query_of(p, 1);
  const CurveResult result = fit_curve(p.world, query, {});
  ASSERT_EQ(result.status, CurveStatus::solved);
  for (int k = 0; k <= 1000; ++k) {
    const double t = p.init.t + (p.goal.t - p.init.t) * k / 1000.0;
    for (int a = 0; a < 7; ++a) EXPECT_NEAR(result.curve.value(t)[a], p.clip(t)[a], 2e-3);
  }
}

TEST(CurveFit, WithoutAClipAFreeCurveHasNoWobble) {
  // From rest to rest in the open: monotone, peak speed near that of a minimum-jerk reach (1.875
  // times the mean).
  Problem p = std::move(test::problems()[1]);
  p.world.balls.clear();
  CurveQuery query = query_of(p, 1);
  query.reference = nullptr;
  for (int a = 0; a < 3; ++a) query.velocity_init[a] = query.velocity_goal[a] = 0;
  const CurveResult result = fit_curve(p.world, query, {});
  ASSERT_EQ(result.status, CurveStatus::solved);
  const double mean = (p.goal.q[0] - p.init.q[0]) / (p.goal.t - p.init.t);
  for (int k = 0; k <= 1000; ++k) {
    const double t = p.init.t + (p.goal.t - p.init.t) * k / 1000.0;
    EXPECT_GE(result.curve.derivative(t)[0], -1e-6);
  }
  EXPECT_LT(result.peak_speed, 2.0 * mean);
}

TEST(CurveFit, ForcedExcessIsReported) {
  Problem p = std::move(test::problems()[3]);
  CurveQuery query = query_of(p, 1);
  query.velocity_init[2] = 13;  // its limit is 12
  const CurveResult fast = fit_curve(p.world, query, {});
  ASSERT_EQ(fast.status, CurveStatus::solved) << fast.reason;
  ASSERT_EQ(fast.speed_excess.size(), 1u);
  EXPECT_EQ(fast.speed_excess[0].dof, 2);
  EXPECT_NEAR(fast.speed_excess[0].amount, 1, 1e-9);
  EXPECT_NEAR(fast.curve.derivative(p.init.t)[2], 13, 1e-9);

  // At its limit and still going outward: it cannot but overshoot, and says by how much.
  p.world.space.dofs[3].lower = p.world.space.dofs[3].sample_lower = p.init.q[3];
  query = query_of(p, 1);
  query.velocity_init[3] = -0.5;
  const CurveResult beyond = fit_curve(p.world, query, {});
  ASSERT_EQ(beyond.status, CurveStatus::solved) << beyond.reason;
  ASSERT_EQ(beyond.limit_excess.size(), 1u);
  EXPECT_EQ(beyond.limit_excess[0].dof, 3);
  for (int k = 0; k <= 1000; ++k) {
    const double t = p.init.t + (p.goal.t - p.init.t) * k / 1000.0;
    EXPECT_GE(beyond.curve.value(t)[3], p.init.q[3] - beyond.limit_excess[0].amount - 1e-9);
  }
}

// What a curve without a limit comes to says what can be asked of one with it.
TEST(CurveFit, AccelerationLimitsAreKept) {
  int fits = 0, kept = 0;
  for (Problem& p : test::problems()) {
    SCOPED_TRACE(p.world.name);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      for (Dof& dof : p.world.space.dofs)
        dof.acceleration_limit = std::numeric_limits<double>::infinity();
      const CurveQuery query = query_of(p, seed);
      const CurveResult free = fit_curve(p.world, query, {});
      ASSERT_EQ(free.status, CurveStatus::solved);
      EXPECT_TRUE(free.acceleration_kept);
      const double limit = 0.85 * free.peak_acceleration;
      for (Dof& dof : p.world.space.dofs) dof.acceleration_limit = limit;
      const CurveResult result = fit_curve(p.world, query, {});
      ASSERT_EQ(result.status, CurveStatus::solved);
      expect_curve(p, query, result);
      ++fits;
      kept += result.acceleration_kept;
      double most = 0;
      for (int k = 0; k <= 3000; ++k) {
        const Dofs a = result.curve.second(p.init.t + (p.goal.t - p.init.t) * k / 3000.0);
        for (int i = 0; i < a.count; ++i) most = std::max(most, std::abs(a[i]));
      }
      EXPECT_LE(most, free.peak_acceleration * (1 + 1e-6));
      if (result.acceleration_excess.empty()) {
        EXPECT_LE(most, limit * (1 + 1e-6));
        EXPECT_TRUE(result.acceleration_kept);
      } else {
        double excess = 0;
        for (const auto& each : result.acceleration_excess) excess = std::max(excess, each.amount);
        EXPECT_LE(most, (limit + excess) * (1 + 1e-6));
        EXPECT_GE(most, limit);
      }
      CheckCounters counters;
      EXPECT_TRUE(curve_free(p.world, result.curve, p.init.t, p.goal.t, CurveSettings{}.resolution,
                             {}, counters));
    }
  }
  std::printf("[ limits   ] %d of %d keep an acceleration 0.85 times that without a limit\n", kept,
              fits);
  EXPECT_GE(kept, 0.5 * fits);
}

TEST(CurveFit, ForcedAccelerationIsReported) {
  Problem p = std::move(test::problems()[3]);
  for (Dof& dof : p.world.space.dofs) dof.acceleration_limit = 200;
  CurveQuery query = query_of(p, 3);
  Dofs a;
  a.count = 7;
  a[2] = 230;
  query.acceleration_init = a;
  const CurveResult result = fit_curve(p.world, query, {});
  ASSERT_EQ(result.status, CurveStatus::solved) << result.reason;
  EXPECT_TRUE(result.acceleration_kept);
  ASSERT_EQ(result.acceleration_excess.size(), 1u);
  EXPECT_EQ(result.acceleration_excess[0].dof, 2);
  EXPECT_NEAR(result.acceleration_excess[0].amount, 30, 1e-6);
}

TEST(CurveFit, SameSeedAndTrialsSameBytes) {
  for (Problem& p : test::problems()) {
    SCOPED_TRACE(p.world.name);
    const CurveQuery query = query_of(p, 5);
    CurveSettings settings;
    const CurveResult first = fit_curve(p.world, query, settings);
    EXPECT_TRUE(same_bytes(first.curve, fit_curve(p.world, query, settings).curve));
    settings.max_trials = first.trials;
    settings.max_relief_trials = first.relief_trials;
    settings.max_consecutive_failures = std::numeric_limits<std::int64_t>::max();
    EXPECT_TRUE(same_bytes(first.curve, fit_curve(p.world, query, settings).curve));
    settings.max_trials = std::numeric_limits<std::int64_t>::max();
    settings.max_seconds = 0.01;
    const CurveResult timed = fit_curve(p.world, query, settings);
    settings.max_trials = timed.trials;
    settings.max_seconds = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(same_bytes(timed.curve, fit_curve(p.world, query, settings).curve));
  }
}

TEST(CurveFit, AStopInsideAnySingleCheckIsAnsweredByTheNext) {
  Problem p = std::move(test::problems()[3]);
  const CurveQuery query = query_of(p, 2);
  const std::int64_t all = fit_curve(p.world, query, {}).checks.validity_checks;
  for (std::int64_t at = 1; at < all; at += 1 + all / 40) {
    std::stop_source source;
    std::int64_t calls = 0;
    p.world.on_call = [&] {
      if (++calls == at) source.request_stop();
    };
    const CurveResult result = fit_curve(p.world, query, {}, source.get_token());
    p.world.on_call = nullptr;
    EXPECT_EQ(result.status, CurveStatus::cancelled);
    EXPECT_LE(calls, at + 1);
    if (!result.curve.empty()) {  // a valid one all the same
      CheckCounters counters;
      EXPECT_TRUE(curve_free(p.world, result.curve, p.init.t, p.goal.t, CurveSettings{}.resolution,
                             {}, counters));
    }
  }
}

TEST(CurveFit, APathThroughAnObstacleGivesNoCurve) {
  Problem p = std::move(test::problems()[1]);
  CurveQuery query = query_of(p, 1);
  query.path = {p.init, p.goal};
  const CurveResult result = fit_curve(p.world, query, {});
  EXPECT_EQ(result.status, CurveStatus::no_curve);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_TRUE(result.curve.empty());
}

TEST(CurveFit, HostileQueriesAreRefused) {
  Problem p = std::move(test::problems()[1]);
  const CurveQuery good = query_of(p, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const std::function<void(CurveQuery&, CurveSettings&)>& spoil) {
    CurveQuery query = good;
    CurveSettings settings;
    spoil(query, settings);
    const CurveResult result = fit_curve(p.world, query, settings);
    EXPECT_FALSE(result.reason.empty());
    return result.status == CurveStatus::invalid_query && result.curve.empty();
  };
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.space = nullptr; }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.path.clear(); }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.path.resize(1); }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.path.back().t = nan; }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.path.back().t = q.path.front().t; }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.path.back().t = 1e12; }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.path.front().q[1] = nan; }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.velocity_init[0] = nan; }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.velocity_goal.count = 1; }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.acceleration_init = Dofs{}; }));
  EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) {
    q.reference = [nan](double) { return test::dofs({0, nan, 0}); };
  }));
  EXPECT_TRUE(
      refused([&](CurveQuery& q, CurveSettings&) { q.reference = [](double) { return Dofs{}; }; }));
  for (const double no_limit : {0.0, -1.0, nan}) {
    DofSpace space = *good.space;
    space.dofs[1].acceleration_limit = no_limit;
    EXPECT_TRUE(refused([&](CurveQuery& q, CurveSettings&) { q.space = &space; }));
  }
  EXPECT_TRUE(refused([&](CurveQuery&, CurveSettings& s) { s.knot_spacing = 0; }));
  EXPECT_TRUE(refused([&](CurveQuery&, CurveSettings& s) { s.resolution.seconds = nan; }));
  EXPECT_TRUE(refused([&](CurveQuery&, CurveSettings& s) { s.jerk_time = -1; }));
}

}  // namespace
}  // namespace elbowroom
