// SPDX-License-Identifier: MIT
// Things that are filled in: numbers with units, text, a choice from a list.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ui/toolkit/ui.h"

namespace elbowroom {

struct NumberOptions {
  std::string_view unit = {};              // "cm", "°", "s"
  double minimum = -1e12, maximum = 1e12;  // of the value, before `shown_per_value`
  int decimals = 2;
  double shown_per_value = 1;  // 180/π shows radians in degrees, 100 metres in centimetres
  double drag_step = 0;        // shown units a pixel; 0: one of the last decimal
  std::optional<double> reset_to = {};  // a right click resets to this
  std::string_view hint = {};
  bool enabled = true;
  float width = 0;  // pixels at 100 %; 0: the panel's rest
};
// Label left, number right: drag left and right to change (Shift slower, Ctrl faster), double-click
// or Enter to type, Escape puts it back. Typed units are understood ("12 cm" is "12"), a comma is a
// point. A value that is not a number counts as the nearest to 0 allowed; what is typed but is no
// number changes nothing.
Edit number_input(Ui& ui, std::string_view label, double& value, const NumberOptions& options = {});

struct TextOptions {
  std::string_view placeholder = {};
  std::string_view hint = {};
  bool enabled = true;
  bool focus = false;  // takes the keyboard in this frame
  float width = 0;     // pixels at 100 %; 0: the panel's rest
  bool label_shown = true;
  // Tab replaces the text by what this makes of it.
  std::function<std::string(const std::string&)> complete = {};
};
struct TextEdit : Edit {
  bool entered = false;  // Enter was pressed
};
TextEdit text_input(Ui& ui, std::string_view label, std::string& text,
                    const TextOptions& options = {});

struct ComboOptions {
  bool quiet = false;  // as text in the accent colour, at the right edge: a choice in a heading
  std::string_view hint = {};
  bool enabled = true;
  float width = 0;
};
// True when `chosen` changed. A `chosen` outside shows "–".
bool combo(Ui& ui, std::string_view label, int& chosen, const std::vector<std::string>& entries,
           const ComboOptions& options = {});

// A heading with a quiet choice at its right edge: "Sampling intervals      High arm". The choice
// is named `name`.
bool heading_combo(Ui& ui, std::string_view heading, std::string_view name, int& chosen,
                   const std::vector<std::string>& entries, std::string_view hint = {});

// The number in a text that people typed: "85", "85,5°", "−3 cm", " 1e-3 ". nullopt: none, or not
// finite.
std::optional<double> typed_number(std::string_view text);
// All the numbers in it, in order: "85° – 140°" gives 85 and 140; a dash between two numbers is no
// minus.
std::vector<double> typed_numbers(std::string_view text);

}  // namespace elbowroom
