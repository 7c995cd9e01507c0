// SPDX-License-Identifier: MIT
// The planner tab: numbers, dragged and typed.
#include "app/editor/key_names.h"
#include "tests/gui/panels/panels_fixture.h"

namespace elbowroom {
namespace {

using namespace command;

TEST_F(Panels, PlannerTabNumbersAreOneStepEach) {
  driver().handle(SelectProblem{arm, 0});
  driver().view().tab = InspectorTab::planner;
  ui().frame(3);
  const PlanningWishes before = wishes();
  expect_one_step([&] { ui().drag("Inspector/Seed", {9, 0}); }, "Seed");
  EXPECT_GT(wishes().seed, before.seed);
  expect_one_step([&] { ui().drag("Clearance", {30, 0}); }, "Clearance");
  EXPECT_GT(wishes().clearance, 0);
  expect_one_step([&] { ui().drag("Iterations", {-20, 0}); }, "Iterations");
  EXPECT_LT(wishes().max_iterations, before.max_iterations);
  expect_one_step([&] { ui().drag("Ways around", {40, 0}); }, "Ways around");
  EXPECT_GT(wishes().alternatives, before.alternatives);
  const Interval window = *draft().window;
  expect_one_step([&] { ui().drag("From", {20, 0}); }, "From");
  EXPECT_GT(draft().window->lower, window.lower);
  expect_one_step([&] { ui().drag("To", {-20, 0}); }, "To");
  EXPECT_LT(draft().window->upper, window.upper);
  for (const char* name :
       {"Inspector/Seed", "Clearance", "Iterations", "Ways around", "From", "To"}) {
    expect_no_step([&] { drag_and_escape(name, {15, 0}); }, name);
    expect_no_step(
        [&] {
          const ImVec2 at = ui().centre(name);
          ui().wait(1);
          ui().move_to(at);
          ui().press();
          for (const float x : {6.0f, 12.0f, 6.0f, 0.0f}) {
            ImGui::GetIO().MousePos = {at.x + x, at.y};
            ui().frame();
          }
          ui().release();
        },
        name);
  }
  // Slowly, a pixel a frame, a coarse number still follows.
  const int ways = wishes().alternatives;
  expect_one_step(
      [&] {
        const ImVec2 at = ui().centre("Ways around");
        ui().drag(at, {at.x - 30, at.y}, 30);
      },
      "Ways around, slowly");
  EXPECT_LT(wishes().alternatives, ways);
  // Typed.
  ui().double_click("Inspector/Seed");
  ui().key('A', {.control = true});
  ui().type("4711");
  ui().key(keys::kEnter);
  EXPECT_EQ(wishes().seed, 4711u);
  // What is typed is no shortcut.
  EXPECT_FALSE(state().planning.active);
}

}  // namespace
}  // namespace elbowroom
