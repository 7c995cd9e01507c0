// SPDX-License-Identifier: MIT
// The target tab, and the target by its gizmo in the picture.
#include "app/editor/key_names.h"
#include "tests/gui/panels/panels_fixture.h"
#include "ui/toolkit/fields.h"

namespace elbowroom {
namespace {

using namespace command;

TEST_F(Panels, TargetTab) {
  driver().handle(SelectLimb{arm});
  ui().click("Tabs/Target");
  EXPECT_EQ(driver().view().tab, InspectorTab::target);
  ui().click("Place on a surface");
  EXPECT_TRUE(driver().view().placing_target);
  ui().key(keys::kEscape);
  EXPECT_FALSE(driver().view().placing_target);
  expect_one_step([&] { ui().click("Target here"); }, "Target here");
  ASSERT_TRUE(draft().target.has_value());
  EXPECT_EQ(draft().target->time, state().time);
  EXPECT_TRUE(draft().target->orientation.has_value());
  EXPECT_NE(state().target.status, TargetView::Status::none);
  const HandTarget before = *draft().target;
  const char* names[] = {"X", "Y", "Z"};
  for (int i = 0; i < 3; ++i) {
    expect_one_step([&] { ui().drag(std::string("Inspector/") + names[i], {10, 0}); }, names[i]);
    EXPECT_GT(draft().target->position[i], before.position[i]) << names[i];
    expect_no_step(
        [&] {
          drag_and_escape(std::string("Inspector/") + names[i], {15, 0});
        },
        names[i]);
  }
  expect_one_step([&] { ui().drag("Turn X", {50, 0}); }, "Turn X");
  EXPECT_NE(draft().target->orientation, before.orientation);
  EXPECT_NEAR(glm::length(*draft().target->orientation), 1, 1e-9);
  expect_one_step([&] { ui().click("Keep the hand's orientation"); }, "free");
  EXPECT_FALSE(draft().target->orientation.has_value());
  EXPECT_FALSE(ui().has("Turn X"));
  // Its time.
  driver().handle(Scrub{0.5 * (state().begin + state().end)});
  ui().frame(2);
  expect_one_step([&] { ui().click("Set to now"); }, "Set to now");
  EXPECT_EQ(draft().target->time, state().time);
  EXPECT_FALSE(ui().widget("Go there")->enabled);
  driver().handle(Scrub{state().begin});
  ui().frame(2);
  ui().click("Go there");
  EXPECT_EQ(state().time, draft().target->time);
  expect_one_step([&] { ui().drag("At", {15, 0}); }, "At");
  EXPECT_GT(draft().target->time, state().time);
  ui().click("Gizmo/Turn  R");
  EXPECT_EQ(driver().view().gizmo_mode, GizmoMode::rotate);
  ui().click("Own axes");
  EXPECT_EQ(driver().view().gizmo_space, GizmoSpace::local);
  driver().view().gizmo_space = GizmoSpace::world;
  driver().view().gizmo_mode = GizmoMode::translate;
  // Dragged along the timeline.
  expect_one_step([&] { ui().drag("Clip time.mark.0", {-60, 0}); }, "the target's mark");
  expect_no_step([&] { drag_and_escape("Clip time.mark.0", {50, 0}); }, "Esc on the mark");
  driver().handle(Scrub{state().begin});
  ui().click("Clip time.mark.0");
  EXPECT_EQ(state().time, draft().target->time);
  expect_one_step([&] { ui().click("Remove target"); }, "Remove target");
  EXPECT_FALSE(draft().target.has_value());
  EXPECT_EQ(state().target.status, TargetView::Status::none);
  ASSERT_TRUE(driver().settle());
  EXPECT_EQ(state().target.status, TargetView::Status::none);
}

// Typed or dragged, beyond ±90° too: the other fields stay, and so does the one that is edited.
TEST_F(Panels, TurnFieldsNeverMoveEachOther) {
  driver().handle(SelectLimb{arm});
  ui().click("Tabs/Target");
  ui().click("Target here");
  ui().frame(2);
  const std::vector<std::string> names = {"Turn X", "Turn Y", "Turn Z"};
  const auto shown = [&] {
    std::vector<std::string> values;
    for (const auto& name : names) values.push_back(ui().value(name));
    return values;
  };
  const auto expect_others_stay = [&](std::size_t edited, const std::vector<std::string>& before) {
    const auto after = shown();
    for (std::size_t i = 0; i < names.size(); ++i)
      if (i != edited) {
        EXPECT_EQ(after[i], before[i]) << names[i] << " moved with " << names[edited];
      }
  };
  for (const char* typed : {"150", "-120", "90", "271", "-400", "12.5"})
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto before = shown();
      ui().double_click(names[i]);
      ui().frame(2);
      ui().type(typed);
      ui().key(keys::kEnter);
      ui().frame(2);
      EXPECT_EQ(*typed_number(ui().value(names[i])), *typed_number(typed)) << names[i];
      expect_others_stay(i, before);
    }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto before = shown();
    const double from = *typed_number(before[i]);
    ui().hold({.control = true});  // faster: a degree a pixel
    expect_one_step([&] { ui().drag(names[i], {170, 0}, 40); }, names[i].c_str());
    ui().hold({});
    ui().frame(2);
    EXPECT_GT(*typed_number(ui().value(names[i])), from + 90);
    expect_others_stay(i, before);
    ui().wait(1);
    expect_no_step([&] { drag_and_escape(names[i], {60, 0}); }, "Esc");
    ui().frame(2);
    expect_others_stay(i, before);
  }
  // Off and on again: the hand's own orientation, as when the target was made.
  const Quat made = *[&] {
    driver().handle(TargetFromPosture{});
    return draft().target->orientation;
  }();
  ui().frame(2);
  ui().click("Keep the hand's orientation");
  EXPECT_FALSE(draft().target->orientation.has_value());
  ui().frame(2);
  expect_one_step([&] { ui().click("Keep the hand's orientation"); }, "keep");
  ASSERT_TRUE(draft().target->orientation.has_value());
  EXPECT_NEAR(std::abs(glm::dot(*draft().target->orientation, made)), 1, 1e-12);
}

// The hand target by its gizmo in the picture: the drag is one step, Esc takes it back.
TEST_F(Panels, GizmoDrag) {
  driver().handle(SelectLimb{arm});
  driver().handle(TargetFromPosture{});
  driver().handle(Undo{});
  driver().handle(Redo{});
  ui().frame(3);
  ASSERT_TRUE(ui().has("Hand target"));
  expect_one_step([&] { ui().drag("Hand target", {40, -25}); }, "the gizmo's drag");
  expect_no_step([&] { drag_and_escape("Hand target", {30, 30}); }, "Esc on the gizmo");
  EXPECT_FALSE(driver().panels.dragging());
  ASSERT_TRUE(driver().settle());
}

}  // namespace
}  // namespace elbowroom
