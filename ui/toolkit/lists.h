// SPDX-License-Identifier: MIT
// Lists: rows of an outliner or a stack, sections that fold, cards with numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ui/toolkit/icons.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

// A small button at a row's right end, seen while the row is hovered or has the keyboard, while
// `on`, and while the row is selected if its name has room beside.
struct RowAction {
  Icon icon = Icon::none;
  std::string name;  // for the tooltip and for tests: "Mute"
  bool on = false;
  bool enabled = true;
};

struct RowOptions {
  Icon icon = Icon::none;  // left of the label; Icon::dot for a state
  Tone icon_tone = Tone::quiet;
  std::string_view right = {};  // quiet, at the right edge
  Tone right_tone = Tone::faint;
  std::string_view badge = {};  // instead of `right`: a pill, "2 problems"
  Tone badge_tone = Tone::problem;
  std::vector<RowAction> actions = {};
  Tone tone = Tone::text;
  Tone selected_tone = Tone::accent;  // the ground's colour when selected
  bool selected = false;
  bool enabled = true;
  int indent = 0;                     // levels
  std::optional<bool> expanded = {};  // set: a chevron that folds
  std::string_view hint = {};
};

struct RowResult {
  bool clicked = false;  // with the left button, neither on the chevron nor on an action
  bool double_clicked = false;
  bool context = false;  // right button: open a menu
  bool toggled = false;  // the chevron (or Left/Right with the keyboard's focus)
  bool hovered = false;
  int action = -1;  // index of the action clicked
};

// One row from edge to edge of the panel.
RowResult list_row(Ui& ui, std::string_view label, const RowOptions& options = {});

// A heading that folds what follows: `if (section(ui, "Limits", open)) { … }`. Returns `open`.
bool section(Ui& ui, std::string_view label, bool& open, std::string_view right = {});

struct CardRow {
  std::string name, value;
  Tone tone = Tone::quiet;
  bool check = false;  // a check mark in place of the value
};
struct CardOptions {
  bool selected = false;
  Tone selected_tone = Tone::good;
  bool enabled = true;
  std::string_view hint = {};
  float width = 0;  // pixels on the screen; 0: the panel's rest
};
struct CardResult {
  bool clicked = false, double_clicked = false, hovered = false;
};
// Title and rows of name and value in a frame: an alternative.
CardResult card(Ui& ui, std::string_view title, const std::vector<CardRow>& rows,
                const CardOptions& options = {});
// The width for `columns` cards side by side with the usual gap; put SameLine between them.
float card_width(const Ui& ui, int columns);

}  // namespace elbowroom
