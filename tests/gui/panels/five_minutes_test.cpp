// SPDX-License-Identifier: MIT
// From a file to a corrected one, by mouse and again by keyboard alone, with what each step does to
// the editor's state.
#include <gtest/gtest.h>

#include <chrono>

#include "core/io/gltf_reader.h"
#include "tests/gui/panels/editor_driver.h"

namespace elbowroom {
namespace {

std::size_t clips_in(const std::filesystem::path& file) {
  ReadOptions options;
  options.images = false;
  const auto model = read_gltf(file, options);
  if (!model) ADD_FAILURE() << model.error().message();
  return model ? (*model)->clips.size() : 0;
}

// What is accepted lies over the clip, clears the limb there, and can be taken back.
void expect_corrected(EditorDriver& driver, int limb, const Interval& window) {
  const EditorState& state = driver.state();
  ASSERT_EQ(driver.document().corrections.size(), 1u);
  ASSERT_EQ(driver.document().tasks.size(), 1u);
  const Correction& correction = driver.document().corrections.front();
  EXPECT_EQ(correction.limb, state.session->limbs[static_cast<std::size_t>(limb)].limb.name);
  EXPECT_EQ(driver.document().tasks.front().limb, correction.limb);
  EXPECT_EQ(correction.task, driver.document().tasks.front().name);
  EXPECT_NEAR(static_cast<double>(correction.begin), window.lower, 1e-5);
  EXPECT_NEAR(static_cast<double>(correction.end), window.upper, 1e-5);
  EXPECT_FALSE(state.candidate.has_value());
  EXPECT_FALSE(driver.draft().window.has_value());
  EXPECT_NE(state.clip, state.source);
  EXPECT_TRUE(state.dirty);
  EXPECT_EQ(state.selected_correction, 0);
  ASSERT_EQ(state.corrections.size(), 1u);
  EXPECT_TRUE(state.corrections.front().fits);
  ASSERT_TRUE(driver.settle());
  const auto in_window = [&](const CollisionStrip& strip) {
    int count = 0;
    for (const auto& contact : strip.limbs[static_cast<std::size_t>(limb)].contacts)
      count += contact.begin < window.upper && contact.end > window.lower;
    return count;
  };
  EXPECT_GT(in_window(*state.source_strip), 0);
  EXPECT_EQ(in_window(*state.strip), 0);
}

TEST(FiveMinutes, ByMouse) {
  ScratchFolder folder;
  EditorDriver driver;
  EXPECT_TRUE(driver.ui.has("Open the demo"));
  ASSERT_TRUE(driver.open(demo_scene()));
  EXPECT_FALSE(driver.state().dirty);
  // The strip turns up by itself, and grows.
  ASSERT_TRUE(driver.wait_until([&] { return driver.state().strip != nullptr; }));
  ASSERT_TRUE(driver.wait_until([&] { return driver.state().strip->complete(); }));
  const int limb = driver.colliding_limb();
  ASSERT_GE(limb, 0) << "the demo has to collide";
  const ProposedWindow problem =
      driver.state().strip->limbs[static_cast<std::size_t>(limb)].windows.front();

  driver.ui.click(driver.row_name(limb) + ".bump.0");
  EXPECT_EQ(driver.state().limb, limb);
  ASSERT_TRUE(driver.draft().window.has_value());
  EXPECT_EQ(*driver.draft().window, (Interval{problem.begin, problem.end}));
  EXPECT_GE(driver.state().time, problem.begin);
  EXPECT_LE(driver.state().time, problem.end);
  EXPECT_FALSE(driver.state().undo_name.empty());

  driver.ui.click("Plan/Plan");
  EXPECT_TRUE(driver.state().planning.active);
  ASSERT_TRUE(driver.wait_until([&] { return !driver.state().planning.active; }));
  ASSERT_TRUE(driver.state().candidate.has_value())
      << (driver.state().failure ? driver.state().failure->reason : "");
  EXPECT_EQ(driver.state().candidate->report.status, CorrectionStatus::corrected);
  EXPECT_TRUE(driver.document().corrections.empty()) << "a plan is no correction yet";
  EXPECT_EQ(driver.state().clip, driver.state().source);

  driver.ui.click("Accept");
  expect_corrected(driver, limb, {problem.begin, problem.end});
  if (HasFatalFailure()) return;

  const auto file = folder / "corrected.glb";
  driver.choose_menu("File", "Export clip…");
  EXPECT_EQ(driver.view().dialog, Dialog::export_clip);
  driver.view().dialog = Dialog::none;  // typing a path is tested with the dialogs
  driver.ui.frame(3);
  driver.handle(command::Export{file});
  ASSERT_TRUE(driver.settle());
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(clips_in(file), clips_in(demo_scene().scene.character) + 1);
}

TEST(FiveMinutes, ByKeyboardAlone) {
  ScratchFolder folder;
  EditorDriver driver;
  ASSERT_TRUE(driver.open_demo());
  driver.ui.key('N');
  const int limb = driver.state().limb;
  ASSERT_GE(limb, 0);
  ASSERT_TRUE(driver.draft().window.has_value());
  const Interval window = *driver.draft().window;
  driver.ui.key('P');
  EXPECT_TRUE(driver.state().planning.active);
  ASSERT_TRUE(driver.wait_until([&] { return !driver.state().planning.active; }));
  ASSERT_TRUE(driver.state().candidate.has_value());
  driver.ui.key(keys::kEnter);
  expect_corrected(driver, limb, window);
  if (HasFatalFailure()) return;
  const auto file = folder / "corrected.glb";
  driver.ui.key('E', {.control = true});
  ASSERT_EQ(driver.view().dialog, Dialog::export_clip);
  driver.ui.key('A', {.control = true});
  driver.ui.type(file.string());
  driver.ui.key(keys::kEnter);
  EXPECT_EQ(driver.view().dialog, Dialog::none);
  ASSERT_TRUE(driver.settle());
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(clips_in(file), clips_in(demo_scene().scene.character) + 1);
}

// P with nothing chosen: the first problem from here on, by name in task and correction.
TEST(FiveMinutes, PlanWithNothingChosen) {
  EditorDriver driver;
  ASSERT_TRUE(driver.open_demo());
  ASSERT_LT(driver.state().limb, 0);
  driver.ui.key('P');
  const int limb = driver.state().limb;
  ASSERT_GE(limb, 0);
  ASSERT_TRUE(driver.draft().window.has_value());
  const Interval window = *driver.draft().window;
  ASSERT_TRUE(driver.wait_until([&] { return !driver.state().planning.active; }));
  ASSERT_TRUE(driver.state().candidate.has_value());
  EXPECT_EQ(driver.state().candidate->task.limb, driver.draft().limb);
  driver.ui.key(keys::kEnter);
  expect_corrected(driver, limb, window);
}

}  // namespace
}  // namespace elbowroom
