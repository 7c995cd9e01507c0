// SPDX-License-Identifier: MIT
// Things that are pressed: buttons, icon buttons, toggles, tabs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ui/toolkit/icons.h"
#include "ui/toolkit/text.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

enum class ButtonLook {
  primary,    // filled accent; one in a panel
  secondary,  // raised
  quiet,      // text in the accent colour, no ground
  danger,     // raised, problem colour: cannot be undone
};

struct ButtonOptions {
  ButtonLook look = ButtonLook::secondary;
  Icon icon = Icon::none;          // left of the label
  std::string_view shortcut = {};  // drawn inside, right of the label: "P"
  std::string_view hint = {};      // status line and tooltip: what a click does
  bool enabled = true;
  std::string_view why_not = {};  // shown instead of the hint while not enabled
  float width = 0;  // pixels at 100 %; 0: as the label takes; below 0: the panel's rest
  bool on = false;  // drawn as pressed in (a mode that holds)
};
// True when clicked (or Space/Enter with the keyboard's focus).
bool button(Ui& ui, std::string_view label, const ButtonOptions& options = {});
// What it takes, to lay buttons out from the right.
float button_width(const Ui& ui, std::string_view label, const ButtonOptions& options = {});

struct IconButtonOptions {
  ButtonLook look = ButtonLook::quiet;
  std::string_view shortcut = {};  // in the tooltip
  std::string_view hint = {};      // empty: the name
  bool enabled = true;
  bool on = false;
  Tone tone = Tone::quiet;
  float size = 28;  // pixels at 100 %
};
// `name` is not drawn: it is the name for tests and the tooltip.
bool icon_button(Ui& ui, std::string_view name, Icon icon, const IconButtonOptions& options = {});

struct ToggleOptions {
  std::string_view hint = {};
  std::string_view shortcut = {};
  bool enabled = true;
};
// A switch with its label. True when it changed.
bool toggle(Ui& ui, std::string_view label, bool& on, const ToggleOptions& options = {});
// A button that stays in: "Live". True when it changed.
bool toggle_button(Ui& ui, std::string_view label, bool& on, const ButtonOptions& options = {});

// Tabs in one line, the chosen one raised. True when `chosen` changed. A `chosen` outside is put
// right. Left and Right move while the tabs have the keyboard's focus.
bool tabs(Ui& ui, std::string_view name, const std::vector<std::string>& labels, int& chosen);

}  // namespace elbowroom
