// SPDX-License-Identifier: MIT
// What tests of panels share: one driver with the demo between the posts for all of them in a run;
// each begins with the document as it was opened.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/gui/panels/demo_stretch.h"
#include "tests/gui/panels/editor_driver.h"

namespace elbowroom {

class Panels : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    driver_ = new EditorDriver;
    ASSERT_TRUE(
        driver_->open(demo_stretch(folder_->path(), kStretchBegin, kStretchEnd, Props::all)));
    ASSERT_TRUE(driver_->wait_until(
        [] { return driver_->state().strip && driver_->state().strip->complete(); }));
    ASSERT_TRUE(driver_->settle());
  }
  static void TearDownTestSuite() {
    delete driver_;
    delete folder_;
  }
  void SetUp() override {
    ASSERT_TRUE(driver_ && driver_->colliding_limb() >= 0);
    for (int i = 0; i < 500 && !state().undo_name.empty(); ++i)
      driver_->editor.handle(command::Undo{});
    driver_->editor.handle(command::Discard{});
    driver_->editor.handle(command::Scrub{state().begin});
    driver_->view().tab = InspectorTab::limb;
    driver_->view().dialog = Dialog::none;
    driver_->view().timeline = {};
    driver_->view().placing_target = false;
    driver_->ui.move_to(ImVec2{-1000, -1000});
    driver_->ui.frame(3);
    arm = driver_->colliding_limb();
    other = arm == 0 ? 1 : 0;
  }
  EditorDriver& driver() { return *driver_; }
  UiDriver& ui() { return driver_->ui; }
  const EditorState& state() const { return driver_->state(); }
  const Draft& draft() const { return driver_->draft(); }
  std::string title(int limb) const {
    return limb_title(state().session->limbs[static_cast<std::size_t>(limb)].limb.name);
  }
  PlanningWishes wishes() const {
    const auto found = draft().wishes.find(draft().limb);
    return found == draft().wishes.end() ? PlanningWishes{} : found->second;
  }
  // Exactly one step: one undo gives the document before.
  template <typename Act>
  void expect_one_step(Act act, const char* what) {
    const Document before = driver_->document();
    act();
    EXPECT_FALSE(driver_->document() == before) << what << " changes something";
    driver_->handle(command::Undo{});
    EXPECT_TRUE(driver_->document() == before) << what << " is one step";
    driver_->handle(command::Redo{});
  }
  template <typename Act>
  void expect_no_step(Act act, const char* what) {
    const Document before = driver_->document();
    const std::string undo = state().undo_name;
    act();
    EXPECT_TRUE(driver_->document() == before) << what;
    EXPECT_EQ(state().undo_name, undo) << what;
  }
  // A drag that Escape ends while the button is down.
  void drag_and_escape(const std::string& name, ImVec2 by) {
    const ImVec2 from = ui().centre(name);
    ui().wait(1);
    ui().move_to(from);
    ui().press();
    for (int i = 1; i <= 4; ++i) {
      const float t = static_cast<float>(i) / 4;
      ImGui::GetIO().MousePos = {from.x + t * by.x, from.y + t * by.y};
      ui().frame();
    }
    ui().key(keys::kEscape);
    ui().release();
  }

  static inline ScratchFolder* folder_ = nullptr;
  static inline EditorDriver* driver_ = nullptr;
  int arm = -1, other = -1;
};

}  // namespace elbowroom
