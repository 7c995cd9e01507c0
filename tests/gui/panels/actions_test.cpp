// SPDX-License-Identifier: MIT
// Every action by its menu and by its keys, the same both ways; what is not available does nothing.
#include "ui/actions.h"

#include <gtest/gtest.h>

#include <map>

#include "app/editor/key_names.h"
#include "core/editing/session.h"
#include "tests/gui/panels/editor_driver.h"
#include "ui/editor_ui.h"

namespace elbowroom {
namespace {

// GLFW's key for a shortcut; -1 where there is none.
int glfw_key(const Shortcut& shortcut) {
  for (int key = 0; key <= 348; ++key)
    if (shortcut_of_glfw(key).key == shortcut.key && shortcut.key != Shortcut::none) return key;
  return -1;
}

// What an action comes to: the commands by their kind, and the view.
struct Effect {
  std::vector<std::size_t> commands;
  ViewState view;
};

bool same_view(const ViewState& a, const ViewState& b) {
  return a.camera == b.camera && a.compare == b.compare && a.follow == b.follow &&
         a.show_trails == b.show_trails && a.show_limb == b.show_limb &&
         a.navigation == b.navigation && a.frames == b.frames && a.light_theme == b.light_theme &&
         a.scale == b.scale && a.tab == b.tab && a.gizmo_mode == b.gizmo_mode &&
         a.gizmo_space == b.gizmo_space && a.placing_target == b.placing_target &&
         a.rename.correction == b.rename.correction && a.rename.text == b.rename.text &&
         a.dialog == b.dialog && a.frame_all == b.frame_all &&
         a.frame_selection == b.frame_selection;
}

class Actions : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto session = open_session(demo_scene());
    ASSERT_TRUE(session.ok());
    session_ = new Session(std::move(*session));
  }
  static void TearDownTestSuite() { delete session_; }

  // Two states in which, between them, everything is available: with a candidate, and planning.
  EditorState everything(bool planning) const {
    EditorState state;
    state.document = &document_;
    state.session = session_;
    state.source = state.clip = session_->clip();
    state.begin = state.source->begin;
    state.end = state.source->end;
    state.name = "demo";
    state.limb = 0;
    state.undo_name = "Set window";
    state.redo_name = "Seed 2";
    state.planning.active = planning;
    state.selected_correction = 0;
    if (!planning) {
      state.candidate.emplace();
      state.candidate->clip = state.clip;
      state.ways = {*state.candidate, *state.candidate};
    }
    return state;
  }
  Actions() {
    document_ = session_->document;
    document_.draft.limb = session_->limbs.front().limb.name;
    document_.draft.window = Interval{1, 2};
    document_.corrections.emplace_back().name = "Past the post";
  }
  static Effect effect_of(const std::function<void(ViewState&, Commands&)>& act) {
    Effect effect;
    Commands commands;
    act(effect.view, commands);
    for (const Command& command : commands) effect.commands.push_back(command.index());
    return effect;
  }

  Document document_;
  static inline Session* session_ = nullptr;
};

TEST_F(Actions, NoTwoShareAShortcutWhereBothAreAvailable) {
  for (const bool planning : {false, true}) {
    const EditorState state = everything(planning);
    const ViewState view;
    std::map<std::string, std::string> taken;
    for (const Action& action : actions()) {
      const std::string keys = shortcut_text(action.shortcut);
      if (keys.empty() || !is_enabled(action, state, view)) continue;
      const auto [other, fresh] = taken.emplace(keys, action.title);
      EXPECT_TRUE(fresh) << keys << ": " << action.title << " and " << other->second;
    }
  }
}

TEST_F(Actions, AllAreInAMenuOrHaveKeys) {
  for (const Action& action : actions()) {
    const bool in_menu = std::find(menus().begin(), menus().end(), action.menu) != menus().end();
    EXPECT_TRUE(in_menu || action.menu.empty()) << action.title;
    EXPECT_TRUE(in_menu || action.shortcut.key != Shortcut::none) << action.title;
    EXPECT_FALSE(action.title.empty());
    EXPECT_TRUE(action.run);
    if (action.shortcut.key == Shortcut::none) continue;
    EXPECT_GE(glfw_key(action.shortcut), 0)
        << action.title << ": no key is \"" << shortcut_text(action.shortcut) << '"';
  }
}

// By pressing the keys and by choosing in the menu, in a drawn window.
TEST_F(Actions, KeysAndMenusDoWhatTheTableSays) {
  UiDriver driver(1600, 1000);
  ImGui::GetIO().ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  EditorUi panels;
  EditorState state;
  ViewState view;
  Commands said;
  bool draw_panels = false;
  driver.show([&](Ui& ui) {
    press_keys(ui, state, view, said);
    if (draw_panels) panels.draw(ui, state, view, said);
  });
  int tried = 0;
  for (const Action& action : actions()) {
    state = everything(false);
    if (!is_enabled(action, state, ViewState{})) state = everything(true);
    ASSERT_TRUE(is_enabled(action, state, ViewState{})) << action.title;
    const auto run = [&](ViewState& v, Commands& c) { action.run(state, v, c); };
    if (action.shortcut.key != Shortcut::none) {
      const Effect table = effect_of(run);
      const Effect keys = effect_of([&](ViewState& v, Commands& c) {
        view = v;
        said.clear();
        draw_panels = false;
        driver.key(glfw_key(action.shortcut), {.control = action.shortcut.ctrl,
                                               .shift = action.shortcut.shift,
                                               .alt = action.shortcut.alt});
        v = view;
        c = said;
      });
      EXPECT_EQ(keys.commands, table.commands) << action.title;
      EXPECT_TRUE(same_view(keys.view, table.view)) << action.title;
    }
    if (!action.menu.empty()) {
      draw_panels = true;
      view = ViewState{};
      driver.frame(3);  // the camera frames the figure
      driver.click(std::string(action.menu));
      driver.frame(2);
      ViewState expected = view;
      Commands wanted;
      action.run(state, expected, wanted);
      said.clear();
      driver.click(std::string(action.menu) + "/" + std::string(action.title));
      ASSERT_EQ(said.size(), wanted.size()) << action.title;
      for (std::size_t i = 0; i < said.size(); ++i) EXPECT_EQ(said[i].index(), wanted[i].index());
      EXPECT_EQ(view.dialog, expected.dialog) << action.title;
      EXPECT_EQ(view.compare, expected.compare) << action.title;
      EXPECT_EQ(view.scale, expected.scale) << action.title;
      EXPECT_EQ(view.light_theme, expected.light_theme) << action.title;
      EXPECT_EQ(view.placing_target, expected.placing_target) << action.title;
      if (view.dialog != Dialog::none) driver.key(keys::kEscape);
      if (view.rename.correction >= 0) {  // a name is being typed
        driver.frame(3);
        driver.key(keys::kEscape);
        driver.frame(2);
      }
      EXPECT_EQ(view.dialog, Dialog::none) << action.title;
      ++tried;
    }
  }
  EXPECT_GT(tried, 30);
}

TEST_F(Actions, WhatIsNotAvailableDoesNothing) {
  EditorState state;  // nothing is open
  const Document empty;
  state.document = &empty;
  for (const Action& action : actions()) {
    if (action.shortcut.key == Shortcut::none) continue;
    ViewState view;
    Commands commands;
    if (is_enabled(action, state, view)) continue;
    // Another action may have the same keys; this one must not run by them.
    bool other = false;
    for (const Action& a : actions())
      other |= a.shortcut == action.shortcut && is_enabled(a, state, view);
    EXPECT_EQ(press(action.shortcut, state, view, commands), other) << action.title;
    if (!other) {
      EXPECT_TRUE(commands.empty()) << action.title;
      EXPECT_TRUE(same_view(view, ViewState{})) << action.title;
    }
  }
  // Greyed out in the menu, a click changes nothing.
  EditorDriver driver;
  driver.ui.click("Clip");
  driver.ui.frame(2);
  driver.said.clear();
  const ProbedWidget* item = driver.ui.widget("Clip/Next problem");
  ASSERT_NE(item, nullptr);
  EXPECT_FALSE(item->enabled);
  driver.ui.click("Clip/Next problem");
  EXPECT_TRUE(driver.said.empty());
}

TEST_F(Actions, HeldKeysRepeatOnlyWhatMayRepeat) {
  const EditorState state = everything(false);
  ViewState view;
  Commands commands;
  Shortcut held{Shortcut::right, false, false, false, true};
  EXPECT_TRUE(press(held, state, view, commands));
  held.key = 'P';
  EXPECT_FALSE(press(held, state, view, commands));
  EXPECT_EQ(commands.size(), 1u);
}

// Plus is typed with shift on a US keyboard, without it elsewhere, and stands on the keypad.
TEST_F(Actions, TheInterfaceGrowsAndShrinksByEveryPlusAndMinus) {
  EditorDriver driver;
  constexpr int kEqual = 61, kMinus = 45, kZero = 48, kKeypadMinus = 333, kKeypadPlus = 334;
  const auto scale_after = [&](int key, bool shift) {
    driver.ui.key(key, {.control = true, .shift = shift});
    return driver.view().scale;
  };
  EXPECT_EQ(scale_after(kEqual, true), 1.25);
  EXPECT_EQ(scale_after(kEqual, false), 1.5);
  EXPECT_EQ(scale_after(kKeypadPlus, false), 1.75);
  EXPECT_EQ(scale_after(kMinus, false), 1.5);
  EXPECT_EQ(scale_after(kKeypadMinus, false), 1.25);
  EXPECT_EQ(scale_after(kZero, false), 1);
  for (int i = 0; i < 20; ++i) scale_after(kEqual, false);
  EXPECT_EQ(driver.view().scale, 3);
  for (int i = 0; i < 20; ++i) scale_after(kMinus, false);
  EXPECT_EQ(driver.view().scale, 0.75);
}

TEST_F(Actions, TypingIsNoShortcut) {
  EditorDriver driver;
  driver.view().dialog = Dialog::open;
  driver.ui.frame(3);
  driver.said.clear();
  driver.ui.key(keys::kSpace);
  driver.ui.key('P');
  EXPECT_TRUE(driver.said.empty());
  EXPECT_EQ(driver.view().dialog, Dialog::open);
}

}  // namespace
}  // namespace elbowroom
