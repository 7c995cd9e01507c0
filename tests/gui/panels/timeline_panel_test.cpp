// SPDX-License-Identifier: MIT
// The timeline: time, windows, problems, the transport.
#include "tests/gui/panels/panels_fixture.h"

namespace elbowroom {
namespace {

using namespace command;

TEST_F(Panels, TimelineScrubsAndDrawsWindows) {
  const double middle = 0.5 * (state().begin + state().end);
  const float y = ui().centre("Clip time.ruler").y;
  driver().said.clear();
  ui().drag({driver().x_of(state().begin), y}, {driver().x_of(middle), y});
  EXPECT_NEAR(state().time, middle, 0.02);
  EXPECT_TRUE(state().undo_name.empty()) << "time is no step";

  // A window on an empty part of a row of another limb.
  const double a = state().begin + 0.1, b = state().begin + 0.6;
  ui().drag(driver().on_row(other, a), driver().on_row(other, b));
  EXPECT_EQ(state().limb, other);
  ASSERT_TRUE(draft().window.has_value());
  EXPECT_NEAR(draft().window->lower, a, 0.02);
  EXPECT_NEAR(draft().window->upper, b, 0.02);
  expect_one_step([&] { ui().drag("Clip time.window.low", {30, 0}); }, "the low handle");
  EXPECT_GT(draft().window->lower, a + 0.01);
  expect_one_step([&] { ui().drag("Clip time.window.high", {-30, 0}); }, "the high handle");
  const Interval window = *draft().window;
  expect_one_step([&] { ui().drag("Clip time.window.band", {40, 0}); }, "the band");
  EXPECT_NEAR(draft().window->upper - draft().window->lower, window.upper - window.lower, 1e-6);
  expect_no_step([&] { drag_and_escape("Clip time.window.high", {50, 0}); }, "Esc");
  // A click on a bump.
  ui().click(driver().row_name(arm) + ".bump.0");
  EXPECT_EQ(state().limb, arm);
  const auto& problem = state().strip->limbs[static_cast<std::size_t>(arm)].windows.front();
  EXPECT_EQ(draft().window, (Interval{problem.begin, problem.end}));
  // A click on an empty row.
  ui().click(driver().on_row(other, state().end - 0.02));
  EXPECT_EQ(state().limb, other);

  // The transport.
  ui().click("First frame");
  EXPECT_EQ(state().time, state().begin);
  ui().click("Next frame");
  EXPECT_NEAR(state().time, state().begin + 1 / state().frame_rate, 1e-6);
  ui().click("Previous frame");
  EXPECT_NEAR(state().time, state().begin, 1e-6);
  ui().click("Last frame");
  EXPECT_EQ(state().time, state().end);
  const bool loop = state().loop;
  ui().click("Timeline/Loop");
  EXPECT_NE(state().loop, loop);
  ui().click("Timeline/Loop");
  ui().click("Play");
  EXPECT_TRUE(state().playing);
  ui().click("Pause");
  EXPECT_FALSE(state().playing);
  ui().click("Speed");
  ui().frame(2);
  ui().click("Speed/2×");
  EXPECT_EQ(state().speed, 2);
  driver().handle(SetSpeed{1});
  ui().click("Next problem");
  EXPECT_EQ(state().limb, arm);
}

}  // namespace
}  // namespace elbowroom
