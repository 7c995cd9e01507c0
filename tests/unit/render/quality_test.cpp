// SPDX-License-Identifier: MIT
// The controller on machines of known speed.
#include "render/quality.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/random.h"

namespace elbowroom::test {
namespace {

constexpr int kCoarsest = static_cast<int>(kQualities.size()) - 1;

// A machine on which full quality takes that long, and the other levels their own share.
struct Machine {
  double full = 0.4;
  std::array<double, 5> share = {1, 0.3, 0.15, 0.1, 0.07};
  double noise = 0;
  Random random{1};

  double seconds(int level) {
    return full * share[static_cast<std::size_t>(level)] * (1 + noise * random.uniform(-1, 1));
  }
};

// Draws for a while; returns the levels.
std::vector<int> run(QualityController& controller, Machine& machine, bool moving, double& now,
                     int frames) {
  std::vector<int> levels;
  for (int i = 0; i < frames; ++i) {
    levels.push_back(controller.choose(moving, now));
    const double seconds = machine.seconds(levels.back());
    controller.measured(seconds);
    now += std::max(seconds, 1.0 / 60);
  }
  return levels;
}

TEST(Quality, LaddersGoDownAndFullChangesNothing) {
  const Style style;
  const Style full = with_quality(style, kQualities[kFullQuality]);
  EXPECT_EQ(full.samples, style.samples);
  EXPECT_EQ(full.shadow_map_size, style.shadow_map_size);
  EXPECT_FALSE(full.draft);
  EXPECT_EQ(with_quality(PictureSize{1001, 701}, kQualities[kFullQuality]).width, 1001);
  for (std::size_t i = 1; i < kQualities.size(); ++i) {
    EXPECT_LT(kQualities[i].relative_cost, kQualities[i - 1].relative_cost);
    EXPECT_LE(kQualities[i].scale, kQualities[i - 1].scale);
  }
  EXPECT_EQ(with_quality(PictureSize{1, 1}, kQualities[kCoarsest]).height, 1);
  Style modest;
  modest.samples = 1;
  modest.shadow_map_size = 256;
  EXPECT_EQ(with_quality(modest, kQualities[1]).samples, 1);
  EXPECT_EQ(with_quality(modest, kQualities[1]).shadow_map_size, 256);
}

TEST(Quality, FastMachinesStayAtFullQuality) {
  QualityController controller;
  Machine machine{0.008};
  double now = 0;
  for (const bool moving : {false, true, false, true}) {
    for (const int level : run(controller, machine, moving, now, 50)) {
      EXPECT_EQ(level, kFullQuality);
    }
  }
  EXPECT_FALSE(controller.redraw_at().has_value());
}

TEST(Quality, KeepsTheBudgetWhileMovingFromTheFirstPictureOn) {
  for (const double full : {0.05, 0.1, 0.2, 0.3}) {
    QualityController controller;
    Machine machine{full};
    double now = 0;
    (void)run(controller, machine, false, now, 1);
    const auto levels = run(controller, machine, true, now, 100);
    int late = 0;
    for (const int level : levels) {
      late += machine.seconds(level) > QualityBudget{}.moving && level < kCoarsest;
    }
    EXPECT_LE(late, 4) << full;
    // And no coarser than need be.
    const int level = levels.back();
    EXPECT_GT(machine.seconds(level - 1), 0.7 * QualityBudget{}.moving) << full;
  }
}

TEST(Quality, GoesBackToFullWhenStill) {
  QualityController controller;
  Machine machine;
  double now = 10;
  (void)run(controller, machine, false, now, 1);
  const int moving = run(controller, machine, true, now, 20).back();
  EXPECT_GT(moving, kFullQuality);
  const auto due = controller.redraw_at();
  ASSERT_TRUE(due.has_value());
  // Between two moves of a drag it stays as it is.
  EXPECT_EQ(controller.choose(false, *due - 0.01), moving);
  EXPECT_EQ(controller.choose(false, *due + 0.001), kFullQuality);
  EXPECT_FALSE(controller.redraw_at().has_value());
  // The next move does not have to learn again.
  EXPECT_EQ(controller.choose(true, *due + 1), moving);
}

TEST(Quality, FollowsABusyMachineBothWays) {
  QualityController controller;
  Machine machine{0.14};
  double now = 0;
  (void)run(controller, machine, false, now, 1);
  const int alone = run(controller, machine, true, now, 60).back();
  machine.full *= 2;
  const int busy = run(controller, machine, true, now, 60).back();
  EXPECT_GT(busy, alone);
  EXPECT_LE(machine.seconds(busy), QualityBudget{}.moving);
  machine.full /= 2;
  const int again = run(controller, machine, true, now, 60).back();
  EXPECT_LE(again, alone + 1);
  EXPECT_LT(again, busy);
}

TEST(Quality, DoesNotFlickerOnNoise) {
  QualityController controller;
  Machine machine{0.19};
  machine.noise = 0.2;
  double now = 0;
  (void)run(controller, machine, false, now, 1);
  (void)run(controller, machine, true, now, 50);
  const auto levels = run(controller, machine, true, now, 300);
  int changes = 0;
  for (std::size_t i = 1; i < levels.size(); ++i) changes += levels[i] != levels[i - 1];
  EXPECT_LE(changes, 6);
}

TEST(Quality, StillPicturesKeepTheirOwnBudget) {
  QualityController controller;
  Machine machine;
  double now = 0;
  (void)run(controller, machine, false, now, 3);
  QualityBudget planning;
  planning.still = 0.15;
  controller.set_budget(planning);
  (void)run(controller, machine, true, now, 10);
  const int still = run(controller, machine, false, now, 30).back();
  EXPECT_GT(still, kFullQuality);
  EXPECT_LE(machine.seconds(still), planning.still);
  EXPECT_FALSE(controller.redraw_at().has_value());
  // Planning is over: full quality is due at once.
  controller.set_budget({});
  ASSERT_TRUE(controller.redraw_at().has_value());
  EXPECT_LE(*controller.redraw_at(), now);
  EXPECT_EQ(controller.choose(false, now), kFullQuality);
}

TEST(Quality, HostileTimesAreNotCounted) {
  QualityController controller;
  EXPECT_EQ(controller.choose(true, 0), kFullQuality);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
    controller.measured(bad);
    EXPECT_EQ(controller.choose(true, 0), kFullQuality);
  }
  controller.measured(0);
  EXPECT_EQ(controller.choose(true, 0), kFullQuality);
  controller.measured(1e9);
  EXPECT_EQ(controller.choose(true, 0), kCoarsest);
  // A clock that goes back.
  EXPECT_NO_FATAL_FAILURE((void)controller.choose(false, -1e9));
  controller.set_budget({-1, -1, -1});
  EXPECT_EQ(controller.choose(true, 0), kCoarsest);
  EXPECT_EQ(controller.expected(99), controller.expected(kCoarsest));
}

}  // namespace
}  // namespace elbowroom::test
