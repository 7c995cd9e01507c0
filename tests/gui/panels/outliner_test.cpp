// SPDX-License-Identifier: MIT
// The outliner: limbs and their problems, objects, the stack of corrections.
#include "app/editor/key_names.h"
#include "core/io/project_file.h"
#include "tests/gui/panels/panels_fixture.h"

namespace elbowroom {
namespace {

using namespace command;

TEST_F(Panels, OutlinerListsLimbsWithTheirProblems) {
  for (std::size_t i = 0; i < state().session->limbs.size(); ++i) {
    const auto problems = state().strip->limbs[i].windows.size();
    EXPECT_EQ(ui().value("Outliner/" + title(static_cast<int>(i))),
              problems == 0
                  ? "clear"
                  : std::to_string(problems) + (problems == 1 ? " problem" : " problems"));
  }
  ui().click("Outliner/" + title(other));
  EXPECT_EQ(state().limb, other);
  EXPECT_FALSE(draft().window.has_value());
  EXPECT_TRUE(ui().widget("Outliner/" + title(other))->selected);
  ui().double_click("Outliner/" + title(arm));
  EXPECT_EQ(state().limb, arm);
  EXPECT_TRUE(draft().window.has_value());
  // A double-click on a limb without problems chooses the limb.
  ui().double_click("Outliner/" + title(other));
  EXPECT_EQ(state().limb, other);
}

TEST_F(Panels, OutlinerHoldsObjectsInHands) {
  const auto held = state().document->scene.attachments.front();
  const std::string name = held.file.stem().string();
  ui().click("Outliner/" + name, 1);
  ui().frame(2);
  EXPECT_TRUE(ui().has("Put down"));
  EXPECT_TRUE(ui().has("Hold in the left hand"));
  driver().said.clear();
  driver().carry_out = false;
  ui().click("Hold in the left hand");
  driver().carry_out = true;
  ASSERT_EQ(driver().said.size(), 1u);
  const auto* attach = std::get_if<AttachObject>(&driver().said.front());
  ASSERT_NE(attach, nullptr);
  EXPECT_EQ(attach->file, held.file);
  EXPECT_NE(attach->joint, held.joint);
  // An obstacle can be taken, not put down.
  ui().click("Outliner/" + state().document->scene.obstacles.front().stem().string(), 1);
  ui().frame(2);
  EXPECT_FALSE(ui().has("Put down"));
  EXPECT_TRUE(ui().has("Remove from the scene"));
  ui().key(keys::kEscape);
  ui().click(ImVec2{800, 300});
}

TEST_F(Panels, CorrectionsAreRenamedInTheirRow) {
  ASSERT_TRUE(driver().plan(arm));
  driver().handle(Accept{});
  ui().frame(2);
  const auto name = [&] { return state().document->corrections.front().name; };
  const std::string first = name();
  ASSERT_TRUE(driver().settle());
  ASSERT_TRUE(state().strip_is_current);
  const auto motion = state().clip;
  const auto type = [&](const std::string& text) {
    ui().frame(3);
    ASSERT_TRUE(ui().has("Correction name"));
    ui().key('A', {.control = true});
    ui().type(text);
  };
  // By a double click; Enter keeps it, and is not taken for Accept.
  expect_one_step(
      [&] {
        ui().double_click("Outliner/" + first);
        type("Past the post");
        ui().key(keys::kEnter);
        ui().frame(2);
      },
      "rename");
  EXPECT_EQ(name(), "Past the post");
  EXPECT_EQ(state().clip, motion) << "another name is no other motion";
  EXPECT_TRUE(state().strip_is_current) << "and what is known of it stays known";
  ui().frame(2);
  EXPECT_FALSE(ui().has("Correction name"));
  EXPECT_TRUE(ui().has("Outliner/Past the post"));
  EXPECT_EQ(ui().value("Clip time.mark.0"), "Past the post") << "the timeline says so too";
  // By F2; Esc gives it up.
  ui().click("Outliner/Past the post");
  ui().wait(1);
  expect_no_step(
      [&] {
        ui().key(291);  // F2
        type("no");
        ui().key(keys::kEscape);
        ui().frame(2);
      },
      "Esc");
  EXPECT_FALSE(ui().has("Correction name"));
  EXPECT_EQ(name(), "Past the post");
  EXPECT_EQ(driver().view().dialog, Dialog::none);
  // Nothing is no name; the same one is no step; a click elsewhere keeps what is typed.
  expect_no_step(
      [&] {
        ui().key(291);
        ui().frame(3);
        ui().key('A', {.control = true});
        ui().key(keys::kBackspace);
        ui().key(keys::kEnter);
        ui().frame(2);
      },
      "no name");
  expect_no_step(
      [&] {
        ui().key(291);
        ui().frame(3);
        ui().key(keys::kEnter);
        ui().frame(2);
      },
      "the same name");
  EXPECT_FALSE(ui().has("Correction name"));
  expect_one_step(
      [&] {
        ui().key(291);
        type("Around it");
        ui().click("Outliner/Scene");
        ui().frame(2);
      },
      "a click elsewhere");
  EXPECT_EQ(name(), "Around it");
  // It is kept in the project, and when the correction is planned anew.
  const auto file = folder_->path() / "renamed.elbow";
  ASSERT_TRUE(write_project(file, *state().document).ok());
  const auto read = read_project(file);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->corrections.front().name, "Around it");
  driver().handle(ReplanCorrection{0});
  ASSERT_TRUE(driver().wait_until([&] { return !state().planning.active; }));
  ASSERT_TRUE(state().candidate.has_value());
  driver().handle(Accept{});
  EXPECT_EQ(name(), "Around it");
  // The next test finds the clip as it is in the file.
  while (!state().undo_name.empty()) driver().handle(Undo{});
  ASSERT_TRUE(driver().settle());
}

}  // namespace
}  // namespace elbowroom
