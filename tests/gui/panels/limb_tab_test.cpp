// SPDX-License-Identifier: MIT
// The limb tab: sampling intervals as ranges, presets.
#include "app/editor/key_names.h"
#include "core/editing/sampling_presets.h"
#include "tests/gui/panels/panels_fixture.h"

namespace elbowroom {
namespace {

using namespace command;

TEST_F(Panels, LimbTabRangesArePresetsOrOwn) {
  driver().handle(SelectLimb{arm});
  ASSERT_FALSE(state().dofs.empty());
  const DofView dof = state().dofs[1];
  const LimbModel& limb = *state().limb_model();
  EXPECT_EQ(ui().value("Preset"), preset_title(SamplingPreset::paper, limb.limb));
  const auto sampling = [&] { return wishes().sampling; };
  EXPECT_TRUE(sampling().empty());

  expect_one_step([&] { ui().drag(dof.name + ".low", {25, 0}); }, "a range's drag");
  ASSERT_TRUE(sampling().contains(dof.name));
  EXPECT_GT(sampling().at(dof.name).lower, dof.default_lower);
  EXPECT_NEAR(sampling().at(dof.name).upper, dof.default_upper, 1e-9);
  EXPECT_EQ(ui().value("Preset"), "Own");
  EXPECT_TRUE(state().dofs[1].custom);
  expect_no_step([&] { drag_and_escape(dof.name + ".high", {-20, 0}); }, "Esc puts it back");
  expect_no_step(
      [&] {
        const ImVec2 at = ui().centre(dof.name + ".high");
        ui().wait(1);
        ui().move_to(at);
        ui().press();
        for (const float x : {-5.0f, -15.0f, 0.0f}) {
          ImGui::GetIO().MousePos = {at.x + x, at.y};
          ui().frame();
        }
        ui().release();
      },
      "a drag that comes back");
  // Arrows belong to the slider that was clicked last, not to the clip.
  const double time = state().time;
  expect_one_step([&] { ui().key(keys::kLeft); }, "an arrow key");
  EXPECT_EQ(state().time, time);
  // A double-click gives the limb's own interval back, and the preset with it.
  ui().double_click(dof.name + ".bar");
  EXPECT_FALSE(sampling().contains(dof.name));
  EXPECT_EQ(ui().value("Preset"), preset_title(SamplingPreset::paper, limb.limb));
  // Presets by the list.
  for (const SamplingPreset preset : {SamplingPreset::low, SamplingPreset::high,
                                      SamplingPreset::close_to_body, SamplingPreset::paper}) {
    ui().click("Preset");
    ui().frame(2);
    expect_one_step([&] { ui().click("Preset/" + preset_title(preset, limb.limb)); }, "a preset");
    EXPECT_EQ(sampling(), preset_intervals(limb, preset));
    EXPECT_EQ(ui().value("Preset"), preset_title(preset, limb.limb));
  }
}

}  // namespace
}  // namespace elbowroom
