// SPDX-License-Identifier: MIT
// [SKF07 4.2], the final sampling routine.
#include "core/planning/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace elbowroom {
namespace {

// A world that is free but where told otherwise.
class FreeWorld : public StateSpace {
 public:
  bool valid(const Configuration& c) override { return !blocked || !blocked(c); }
  void metric_points(const Configuration& c, std::vector<Vec3>& points) override {
    points = {Vec3(c.q[0], c.q[1], 0)};
  }
  const std::vector<double>& step_times() const override { return steps_; }
  std::function<bool(const Configuration&)> blocked;

 private:
  std::vector<double> steps_;
};

DofSpace arm() {
  DofSpace space;
  const auto add = [&space](DofRole role, double lower, double upper, double speed) {
    space.dofs.push_back({"dof", role, lower, upper, lower, upper, speed});
  };
  add(DofRole::swing, -1, 1, 100);
  add(DofRole::swing, -2, 2, 100);
  add(DofRole::twist, -1, 1, 100);
  add(DofRole::flexion, 0, 2, 100);
  add(DofRole::secondary_swing, -1, 1, 100);
  space.ellipses = {{0, 1, 1, 2}};
  return space;
}

SamplingQuery query_of(const DofSpace& space) {
  SamplingQuery query;
  query.space = &space;
  query.init.q.count = query.goal.q.count = space.count();
  query.init.t = 1;
  query.goal.t = 3;
  query.init.q[3] = query.goal.q[3] = 0.3;
  query.init.q[4] = -0.8;
  query.goal.q[4] = 0.8;
  return query;
}

TEST(Sampler, FlexionStartsBetween90And100PercentAndWidensToTheWholeInterval) {
  const DofSpace space = arm();
  const SamplingQuery query = query_of(space);
  SamplingSettings settings;
  settings.flexion_iterations = 100;
  SamplingInterval interval = sampling_interval(query, settings, 0, 3, 2);
  EXPECT_DOUBLE_EQ(interval.lower, 1.8);
  EXPECT_DOUBLE_EQ(interval.upper, 2.0);
  double last = interval.lower;
  for (int iteration = 1; iteration <= 100; ++iteration) {
    interval = sampling_interval(query, settings, iteration, 3, 2);
    EXPECT_LT(interval.lower, last);
    EXPECT_DOUBLE_EQ(interval.upper, 2.0);
    last = interval.lower;
  }
  EXPECT_DOUBLE_EQ(interval.lower, 0.0);
  EXPECT_DOUBLE_EQ(sampling_interval(query, settings, 5000, 3, 2).lower, 0.0);
  settings.flexion_iterations = 0;
  EXPECT_DOUBLE_EQ(sampling_interval(query, settings, 0, 3, 2).lower, 0.0);
}

TEST(Sampler, TheAnimatorsIntervalsBoundTheSamples) {
  DofSpace space = arm();
  space.dofs[2].sample_lower = 0.2;  // as in Figure 2
  space.dofs[2].sample_upper = 0.4;
  space.dofs[3].sample_lower = 0.5;
  space.dofs[3].sample_upper = 1.5;
  const SamplingQuery query = query_of(space);
  EXPECT_DOUBLE_EQ(sampling_interval(query, {}, 0, 3, 2).upper, 1.5);
  EXPECT_DOUBLE_EQ(sampling_interval(query, {}, 0, 3, 2).lower, 1.4);
  FreeWorld world;
  Random random(1);
  SamplingCounters counters;
  CheckCounters checks;
  for (int i = 0; i < 2000; ++i) {
    Configuration c;
    ASSERT_TRUE(sample_configuration(world, query, {}, i, random, {}, c, counters, checks));
    // Speeds are high here: only next to the ends is a sample pulled in from its interval.
    if (c.t < 1.1 || c.t > 2.9) continue;
    EXPECT_GE(c.q[2], 0.2);
    EXPECT_LE(c.q[2], 0.4);
    EXPECT_GE(c.q[3], 0.5);
    EXPECT_LE(c.q[3], 1.5);
    EXPECT_LE(c.q[0] * c.q[0] + c.q[1] * c.q[1] / 4, 1.0);
  }
  EXPECT_GT(counters.outside_limits, 0);  // the corners of the swing's box lie outside its ellipse
}

TEST(Sampler, SecondarySwingsStayNarrowAboutTheClip) {
  const DofSpace space = arm();
  const SamplingQuery query = query_of(space);
  SamplingSettings settings;
  settings.secondary_from = 0.2;
  settings.secondary_to = 0.6;
  settings.secondary_iterations = 10;
  const SamplingInterval middle = sampling_interval(query, settings, 0, 4, 2);
  EXPECT_NEAR(middle.lower, -0.2, 1e-12);
  EXPECT_NEAR(middle.upper, 0.2, 1e-12);
  const SamplingInterval begin = sampling_interval(query, settings, 0, 4, 1);
  EXPECT_NEAR(begin.lower, -1.0, 1e-12);  // moved, not cut: the clip is at -0.8
  EXPECT_NEAR(begin.upper, -0.6, 1e-12);
  const SamplingInterval late = sampling_interval(query, settings, 99, 4, 2);
  EXPECT_NEAR(late.upper - late.lower, 1.2, 1e-12);
}

TEST(Sampler, TimeIsUniformInTheWindow) {
  const DofSpace space = arm();
  const SamplingQuery query = query_of(space);
  FreeWorld world;
  Random random(7);
  SamplingCounters counters;
  CheckCounters checks;
  int quarters[4] = {};
  for (int i = 0; i < 8000; ++i) {
    Configuration c;
    ASSERT_TRUE(sample_configuration(world, query, {}, i, random, {}, c, counters, checks));
    ASSERT_GE(c.t, 1.0);
    ASSERT_LE(c.t, 3.0);
    ++quarters[static_cast<int>((c.t - 1) / 0.5)];
  }
  for (const int count : quarters) EXPECT_NEAR(count, 2000, 200);
}

TEST(Sampler, CollidingDrawsAreRepeatedAndTheCountIsBounded) {
  const DofSpace space = arm();
  const SamplingQuery query = query_of(space);
  FreeWorld world;
  world.blocked = [](const Configuration& c) { return c.q[2] < 0.5; };
  Random random(3);
  SamplingCounters counters;
  CheckCounters checks;
  Configuration c;
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(sample_configuration(world, query, {}, i, random, {}, c, counters, checks));
    EXPECT_GE(c.q[2], 0.5);
  }
  EXPECT_GT(counters.in_collision, 200);
  world.blocked = [](const Configuration&) { return true; };
  SamplingSettings settings;
  settings.max_tries = 10;
  counters = {};
  EXPECT_FALSE(sample_configuration(world, query, settings, 0, random, {}, c, counters, checks));
  EXPECT_EQ(counters.draws, 10);
}

TEST(Sampler, SamplesAreWithinReachOfBothEnds) {
  DofSpace space = arm();
  for (Dof& dof : space.dofs) dof.speed_limit = 1.5;
  const SamplingQuery query = query_of(space);
  FreeWorld world;
  Random random(5);
  SamplingCounters counters;
  CheckCounters checks;
  for (int i = 0; i < 2000; ++i) {
    Configuration c;
    ASSERT_TRUE(sample_configuration(world, query, {}, i, random, {}, c, counters, checks));
    if (c.t > query.init.t) {
      EXPECT_TRUE(within_speed_limits(space, query.init, c));
    }
    if (c.t < query.goal.t) {
      EXPECT_TRUE(within_speed_limits(space, c, query.goal));
    }
    EXPECT_TRUE(space.within_limits(c.q));
  }
}

TEST(Sampler, NearTheClipFewDofsMoveAndLimitsHold) {
  const DofSpace space = arm();
  SamplingQuery query = query_of(space);
  query.reference = [](double t) {
    Dofs q;
    q.count = 5;
    for (int i = 0; i < 5; ++i) q[i] = 0.05 * i * (t - 1);
    q[3] = -0.4;  // the clip leaves the elbow's limit
    return q;
  };
  SamplingSettings settings;
  settings.near_share = 1;
  settings.near_reach = 0.5;
  FreeWorld world;
  Random random(9);
  SamplingCounters counters;
  CheckCounters checks;
  for (int i = 0; i < 2000; ++i) {
    Configuration c;
    ASSERT_TRUE(sample_configuration(world, query, settings, i, random, {}, c, counters, checks));
    ASSERT_TRUE(space.within_limits(c.q));
    if (c.t < 1.1 || c.t > 2.9) continue;  // pulled into reach there
    int moved = 0;
    for (int d = 0; d < 5; ++d) {
      if (d == 3) continue;
      const double off = std::abs(c.q[d] - query.reference(c.t)[d]);
      EXPECT_LE(off, 3 * settings.near_reach + 1e-12);
      moved += off > 1e-12;
    }
    EXPECT_LE(moved, 3);
  }
  // A reference that is none gives no samples, and no harm.
  Configuration c;
  query.reference = [](double) { return Dofs{}; };
  EXPECT_FALSE(sample_configuration(world, query, settings, 0, random, {}, c, counters, checks));
  query.reference = [](double) {
    Dofs q;
    q.count = 5;
    q[1] = std::nan("");
    return q;
  };
  EXPECT_FALSE(sample_configuration(world, query, settings, 0, random, {}, c, counters, checks));
}

}  // namespace
}  // namespace elbowroom
