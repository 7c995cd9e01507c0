// SPDX-License-Identifier: MIT
// What [SKF07 3] asks of a path and [SKF07 4.1] of the search, on worlds whose collisions are
// formulas.
#include "core/planning/planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "core/planning/smoothing.h"
#include "spaces.h"

namespace elbowroom {
namespace {

using test::Problem;

constexpr int kSeeds = 25;

PlannerQuery query_of(const Problem& p) {
  return {&p.world.space, p.init, p.goal, p.world.length_unit, {}};
}

bool same_bytes(const std::vector<Configuration>& a, const std::vector<Configuration>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a[i].t, &b[i].t, sizeof a[i].t) != 0 || a[i].q.count != b[i].q.count ||
        std::memcmp(a[i].q.value.data(), b[i].q.value.data(), sizeof a[i].q.value) != 0) {
      return false;
    }
  }
  return true;
}

// Conditions 1 to 3 of [SKF07 3], and what DESIGN.md adds to them.
void expect_path(Problem& p, const std::vector<Configuration>& path,
                 const EdgeResolution& resolution) {
  ASSERT_GE(path.size(), 2u);
  EXPECT_TRUE(same_bytes({path.front(), path.back()}, {p.init, p.goal}));
  CheckCounters counters;
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_TRUE(p.world.space.within_limits(path[i].q));
    EXPECT_TRUE(p.world.valid(path[i]));
    if (i == 0) continue;
    ASSERT_LT(path[i - 1].t, path[i].t);
    EXPECT_TRUE(within_speed_limits(p.world.space, path[i - 1], path[i]));
    EXPECT_TRUE(interpolation_free(p.world, resolution, path[i - 1], path[i], {}, counters));
    // Limits are convex: they hold inside the edge too.
    for (int k = 1; k < 10; ++k) {
      EXPECT_TRUE(p.world.space.within_limits(interpolate(path[i - 1], path[i], 0.1 * k).q));
    }
  }
}

// Colliding ones among samples of a path ten times as dense as its edges were tested.
std::pair<int, int> misses(Problem& p, const std::vector<Configuration>& path,
                           const EdgeResolution& resolution) {
  std::pair<int, int> found{0, 0};
  const int n = static_cast<int>(10 * (path.back().t - path.front().t) / resolution.seconds);
  for (int k = 0; k <= n; ++k) {
    const double t = path.front().t + (path.back().t - path.front().t) * k / n;
    found.first += !p.world.valid(path_at(path, t));
    ++found.second;
  }
  return found;
}

TEST(Planner, PathsHoldWhatTheProblemFormulationAsks) {
  for (Problem& p : test::problems()) {
    SCOPED_TRACE(p.world.name);
    int solved = 0, paths_with_misses = 0;
    std::pair<int, int> missed{0, 0};
    for (int seed = 1; seed <= kSeeds; ++seed) {
      PlannerSettings settings;
      settings.seed = static_cast<std::uint64_t>(seed);
      const PlannerResult result = plan(p.world, query_of(p), settings);
      ASSERT_EQ(result.status, PlannerStatus::solved) << result.reason << ", seed " << seed;
      ++solved;
      expect_path(p, result.path, settings.path_resolution);
      EXPECT_EQ(result.stats.landmarks, static_cast<std::int64_t>(result.path.size()));
      const auto m = misses(p, result.path, settings.path_resolution);
      missed.first += m.first;
      missed.second += m.second;
      paths_with_misses += m.first > 0;
    }
    std::printf(
        "[ misses   ] %s: %d of %d paths solved; at ten times the resolution %d of %d samples "
        "collide, on %d paths\n",
        p.world.name.c_str(), solved, kSeeds, missed.first, missed.second, paths_with_misses);
    EXPECT_LT(missed.first, 0.01 * missed.second);
  }
}

TEST(Planner, ASmallLimbIsPlannedAsALargeOne) {
  // Lengths scale with the limb: ten times as large, in a world ten times as large.
  for (const double scale : {0.01, 10.0}) {
    auto all = test::problems();
    Problem& p = all[3];
    const PlannerResult here = plan(p.world, query_of(p), {});
    Problem q = p;
    const auto place = p.world.place;
    q.world.place = [place, scale](const Configuration& c,
                                   std::vector<test::SegmentSpace::Segment>& out) {
      place(c, out);
      for (auto& s : out) s = {s.from * scale, s.to * scale, s.radius * scale};
    };
    for (auto& post : q.world.posts) {
      post = {post.from * scale, post.to * scale, post.radius * scale};
    }
    q.world.length_unit *= scale;
    const PlannerResult there = plan(q.world, query_of(q), {});
    ASSERT_EQ(here.status, PlannerStatus::solved);
    ASSERT_EQ(there.status, PlannerStatus::solved);
    EXPECT_EQ(here.stats.iterations, there.stats.iterations);
    ASSERT_EQ(here.path.size(), there.path.size());
    for (std::size_t i = 0; i < here.path.size(); ++i) {
      EXPECT_NEAR(here.path[i].t, there.path[i].t, 1e-9);
      for (int a = 0; a < 7; ++a) EXPECT_NEAR(here.path[i].q[a], there.path[i].q[a], 1e-9);
    }
  }
}

TEST(Planner, SameSeedAndBudgetSameBytes) {
  for (Problem& p : test::problems()) {
    SCOPED_TRACE(p.world.name);
    PlannerSettings settings;
    settings.seed = 42;
    const PlannerResult first = plan(p.world, query_of(p), settings);
    const PlannerResult second = plan(p.world, query_of(p), settings);
    EXPECT_TRUE(same_bytes(first.path, second.path));
    EXPECT_EQ(first.stats.iterations, second.stats.iterations);
    EXPECT_EQ(first.stats.checks.validity_checks, second.stats.checks.validity_checks);
    // The iterations it came to, as a budget: the same; one less: none.
    settings.max_iterations = first.stats.iterations;
    EXPECT_TRUE(same_bytes(plan(p.world, query_of(p), settings).path, first.path));
    settings.max_iterations = first.stats.iterations - 1;
    EXPECT_EQ(plan(p.world, query_of(p), settings).status, PlannerStatus::no_path);
    settings.max_iterations = 20000;
    settings.seed = 43;
    if (first.stats.iterations > 3) {
      EXPECT_FALSE(same_bytes(plan(p.world, query_of(p), settings).path, first.path));
    }
  }
}

// The first problem with its doors shut.
Problem without_answer() {
  Problem p = std::move(test::problems().front());
  for (int i = 0; i < 50; ++i)
    p.world.balls.push_back({{0.1, -1.2 + 0.05 * i, 0}, {0, 0, 0}, 0.06});
  return p;
}

TEST(Planner, ATimeBudgetIsRecordedAsIterations) {
  Problem p = without_answer();
  PlannerSettings settings;
  settings.max_seconds = 0.05;
  settings.max_iterations = std::numeric_limits<std::int64_t>::max();
  const PlannerResult timed = plan(p.world, query_of(p), settings);
  ASSERT_EQ(timed.status, PlannerStatus::no_path);
  EXPECT_FALSE(timed.reason.empty());
  EXPECT_GT(timed.stats.iterations, 10);
  EXPECT_LT(timed.milliseconds, 1000);
  settings.max_seconds = std::numeric_limits<double>::infinity();
  settings.max_iterations = timed.stats.iterations;
  const PlannerResult counted = plan(p.world, query_of(p), settings);
  EXPECT_EQ(counted.stats.checks.validity_checks, timed.stats.checks.validity_checks);
  EXPECT_EQ(counted.stats.nodes_init, timed.stats.nodes_init);
  EXPECT_EQ(counted.stats.nodes_goal, timed.stats.nodes_goal);
  EXPECT_EQ(counted.stats.sampling.draws, timed.stats.sampling.draws);
}

TEST(Planner, ASearchEndsByItsChecksToo) {
  Problem p = without_answer();
  PlannerSettings settings;
  settings.max_iterations = std::numeric_limits<std::int64_t>::max();
  settings.max_validity_checks = 3000;
  const PlannerResult checked = plan(p.world, query_of(p), settings);
  ASSERT_EQ(checked.status, PlannerStatus::no_path);
  EXPECT_GE(checked.stats.checks.validity_checks, 3000);
  EXPECT_LT(checked.stats.checks.validity_checks, 6000) << "an iteration goes to its end";
  settings.max_validity_checks = std::numeric_limits<std::int64_t>::max();
  settings.max_iterations = checked.stats.iterations;
  EXPECT_EQ(plan(p.world, query_of(p), settings).stats.checks.validity_checks,
            checked.stats.checks.validity_checks)
      << "its iterations give it again";
}

TEST(Planner, AStopIsAnsweredWithin50Milliseconds) {
  Problem p = without_answer();
  PlannerSettings settings;
  settings.max_iterations = std::numeric_limits<std::int64_t>::max();
  // The best of a few: a busy machine may keep any one of them waiting for its turn.
  double least = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < 8 && !(least < 0.05); ++attempt) {
    std::stop_source source;
    std::atomic<bool> returned{false};
    PlannerResult result;
    int told = 0;
    std::thread thread([&] {
      result = plan(p.world, query_of(p), settings, source.get_token(),
                    [&told](const Progress&) { ++told; });
      returned = true;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    EXPECT_FALSE(returned);
    const auto asked = std::chrono::steady_clock::now();
    source.request_stop();
    thread.join();
    least = std::min(
        least, std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count());
    EXPECT_EQ(result.status, PlannerStatus::cancelled);
    EXPECT_TRUE(result.path.empty());
    EXPECT_GT(told, 0);
  }
  EXPECT_LT(least, 0.05);
}

TEST(Planner, AStopInsideAnySingleCheckIsAnsweredByTheNext) {
  Problem p = std::move(test::problems()[3]);
  const std::int64_t all = plan(p.world, query_of(p), {}).stats.checks.validity_checks;
  for (std::int64_t at = 1; at < all; at += 1 + all / 40) {
    std::stop_source source;
    std::int64_t calls = 0;
    p.world.on_call = [&] {
      if (++calls == at) source.request_stop();
    };
    const PlannerResult result = plan(p.world, query_of(p), {}, source.get_token());
    EXPECT_EQ(result.status, PlannerStatus::cancelled);
    EXPECT_LE(calls, at + 1);
    p.world.on_call = nullptr;
  }
}

TEST(Planner, InvalidEndsAreReported) {
  Problem p = std::move(test::problems()[1]);
  const auto status = [&p] {
    const PlannerResult result = plan(p.world, query_of(p), {});
    EXPECT_EQ(result.reason.empty(), result.status == PlannerStatus::solved);
    EXPECT_TRUE(result.status == PlannerStatus::solved || result.path.empty());
    return result.status;
  };
  const Problem good = p;
  ASSERT_EQ(status(), PlannerStatus::solved);
  p.init.q[0] = 2.6;  // beyond its limit
  EXPECT_EQ(status(), PlannerStatus::invalid_start);
  p = good;
  p.goal.q[1] = -2.6;
  EXPECT_EQ(status(), PlannerStatus::invalid_goal);
  p = good;
  p.world.balls.push_back({{0.3, -0.2, 0}, {0, 0, 0}, 0.3, -1e30, 0.6});
  EXPECT_EQ(status(), PlannerStatus::invalid_start);
  p = good;
  p.world.balls.push_back({{0.3, 0.9, 0}, {0, 0, 0}, 0.6, 1.9, 1e30});
  EXPECT_EQ(status(), PlannerStatus::invalid_goal);
}

TEST(Planner, AWindowTooShortForTheSpeedLimitsIsNoPath) {
  Problem p = std::move(test::problems()[1]);
  p.world.balls.clear();
  p.goal.t = p.init.t + 0.05;
  const PlannerResult result = plan(p.world, query_of(p), {});
  EXPECT_EQ(result.status, PlannerStatus::no_path);
  EXPECT_NE(result.reason.find("speed limit"), std::string::npos);
}

TEST(Planner, HostileQueriesAreRefused) {
  const Problem good = std::move(test::problems()[1]);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto refused = [&](const std::function<void(Problem&, PlannerSettings&)>& spoil) {
    Problem p = good;
    PlannerSettings settings;
    spoil(p, settings);
    const PlannerResult result = plan(p.world, query_of(p), settings);
    EXPECT_FALSE(result.reason.empty());
    return result.status == PlannerStatus::invalid_query && result.path.empty();
  };
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.init.q[0] = nan; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.goal.q[2] = inf; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.init.t = nan; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.goal.t = inf; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.goal.t = p.init.t; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.goal.t = p.init.t - 1; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.init.q.count = 2; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.goal.q.count = 99; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.world.length_unit = 0; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.world.length_unit = nan; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.world.space.dofs[1].lower = nan; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) { p.world.space.dofs[1].upper = -9; }));
  EXPECT_TRUE(
      refused([&](Problem& p, PlannerSettings&) { p.world.space.dofs[1].speed_limit = 0; }));
  EXPECT_TRUE(
      refused([&](Problem& p, PlannerSettings&) { p.world.space.dofs[1].sample_upper = 99; }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) {
    p.world.space.ellipses = {{0, 7, 1, 1}};
  }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) {
    p.world.space.ellipses = {{0, 1, nan, 1}};
  }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) {
    p.world.space.dofs.clear();
    p.init.q.count = p.goal.q.count = 0;
  }));
  EXPECT_TRUE(refused([&](Problem& p, PlannerSettings&) {
    p.world.space.dofs.resize(kMaxDofs + 1, p.world.space.dofs[0]);
  }));
  EXPECT_TRUE(refused([&](Problem&, PlannerSettings& s) { s.step = nan; }));
  EXPECT_TRUE(refused([&](Problem&, PlannerSettings& s) { s.time_weight = -1; }));
  EXPECT_TRUE(refused([&](Problem&, PlannerSettings& s) { s.resolution.radians = 0; }));
  EXPECT_TRUE(refused([&](Problem&, PlannerSettings& s) { s.path_resolution.seconds = nan; }));
  PlannerQuery query = query_of(good);
  query.space = nullptr;
  Problem p = good;
  EXPECT_EQ(plan(p.world, query, {}).status, PlannerStatus::invalid_query);
}

TEST(Smoothing, KeepsWhatMakesAPathAndShortensIt) {
  for (Problem& p : test::problems()) {
    SCOPED_TRACE(p.world.name);
    double before = 0, after = 0;
    std::pair<int, int> missed{0, 0};
    for (int seed = 1; seed <= kSeeds; ++seed) {
      PlannerSettings settings;
      settings.seed = static_cast<std::uint64_t>(seed);
      const PlannerResult found = plan(p.world, query_of(p), settings);
      ASSERT_EQ(found.status, PlannerStatus::solved);
      SmoothingSettings smoothing;
      smoothing.seed = settings.seed;
      const SmoothingResult smooth = smooth_path(p.world, found.path, smoothing);
      EXPECT_TRUE(smooth.error.empty());
      expect_path(p, smooth.path, smoothing.resolution);
      EXPECT_LE(path_length(smooth.path), path_length(found.path) * (1 + 1e-9));
      before += path_length(found.path);
      after += path_length(smooth.path);
      const auto m = misses(p, smooth.path, smoothing.resolution);
      missed.first += m.first;
      missed.second += m.second;
      EXPECT_TRUE(same_bytes(smooth.path, smooth_path(p.world, found.path, smoothing).path));
      smoothing.max_attempts = smooth.attempts;
      smoothing.max_consecutive_failures = std::numeric_limits<std::int64_t>::max();
      EXPECT_TRUE(same_bytes(smooth.path, smooth_path(p.world, found.path, smoothing).path));
    }
    std::printf("[ misses   ] %s, smoothed (length × %.2f): %d of %d samples collide\n",
                p.world.name.c_str(), after / before, missed.first, missed.second);
    EXPECT_LT(missed.first, 0.01 * missed.second);
  }
}

TEST(Smoothing, HostilePathsAreLeftAlone) {
  Problem p = std::move(test::problems()[1]);
  EXPECT_FALSE(smooth_path(p.world, {}, {}).error.empty());
  EXPECT_FALSE(smooth_path(p.world, {p.init}, {}).error.empty());
  EXPECT_FALSE(smooth_path(p.world, {p.goal, p.init}, {}).error.empty());
  Configuration bad = p.goal;
  bad.q[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(smooth_path(p.world, {p.init, bad}, {}).error.empty());
  bad = p.goal;
  bad.q.count = 1;
  EXPECT_FALSE(smooth_path(p.world, {p.init, bad}, {}).error.empty());
  std::stop_source source;
  source.request_stop();
  const PlannerResult found = plan(p.world, query_of(p), {});
  const SmoothingResult stopped = smooth_path(p.world, found.path, {}, source.get_token());
  EXPECT_TRUE(stopped.cancelled);
  EXPECT_TRUE(same_bytes(stopped.path, found.path));
}

}  // namespace
}  // namespace elbowroom
