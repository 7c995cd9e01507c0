// SPDX-License-Identifier: MIT
// Everything that a menu, a key or the palette can do, in one table: title, place in the menus,
// shortcut, when it is available, what it does. Menus, the sheet of shortcuts and the keyboard are
// all made from it, so none of them can say what the others don't.
//
// To add one: a row in actions.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "ui/commands.h"
#include "ui/editor_state.h"

namespace elbowroom {

// A key with its modifiers. `key` is a letter or digit (upper case), or one of the named ones.
struct Shortcut {
  enum Named : int {
    none = 0,
    space = ' ',
    escape = 256,
    enter,
    tab,
    home,
    end,
    left,
    right,
    page_up,
    page_down,
    del,
    f1,
    f2
  };
  int key = none;
  bool ctrl = false, shift = false, alt = false;
  bool repeats = false;  // while the key is held
  bool operator==(const Shortcut&) const = default;
};

// "Ctrl Shift Z"; empty for none.
std::string shortcut_text(const Shortcut& shortcut);

struct Action {
  std::string_view menu;   // "File"; empty: in no menu
  std::string_view title;  // "Save project"
  Shortcut shortcut;
  std::function<bool(const EditorState&, const ViewState&)> enabled;  // empty: always
  std::function<void(const EditorState&, ViewState&, Commands&)> run;
  std::function<bool(const EditorState&, const ViewState&)> checked;  // empty: no mark
  bool separated = false;                                             // a line above it in the menu
};

std::span<const Action> actions();
std::span<const std::string_view> menus();  // in their order

bool is_enabled(const Action& action, const EditorState& state, const ViewState& view);

// Carries out the action that a key press means, if there is one and it is available.
bool press(const Shortcut& key, const EditorState& state, ViewState& view, Commands& commands);

}  // namespace elbowroom
