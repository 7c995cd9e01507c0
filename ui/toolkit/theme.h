// SPDX-License-Identifier: MIT
// The one style of the window: colours by role, fonts, sizes. A panel never names a colour; it
// names a role, so that the dark and the light theme both suit it.
//
// Sizes are in pixels at 100 %; Ui::px multiplies by the scale and rounds, so that edges stay on
// whole pixels. Colours are Dear ImGui's packed sRGB.
#pragma once

#include <imgui.h>

#include <cstdint>

namespace elbowroom {

// What a colour says. Never the only signal: a word, a shape or a place says it too.
enum class Tone {
  text,       // names and numbers being worked on
  quiet,      // units, labels, second lines
  faint,      // read-only, off, not available
  accent,     // what can be done next; the window of planning
  problem,    // collisions, failures
  good,       // clear, planned, certified
  selection,  // what is selected; the playhead
  ghost,      // a motion not yet accepted
};

struct Palette {
  ImU32 ground = 0;  // behind the panels
  ImU32 panel = 0;
  ImU32 raised = 0;  // buttons, fields, cards, popups
  ImU32 line = 0;    // hairlines, tracks
  ImU32 text = 0, quiet = 0, faint = 0;
  ImU32 accent = 0, problem = 0, good = 0, selection = 0, ghost = 0;
  ImU32 on_accent = 0;  // text on a filled accent
  ImU32 handle = 0;     // what is gripped with the mouse
  bool dark = true;

  ImU32 of(Tone tone) const;
};

struct Metrics {
  float text = 16;   // a line of text; Inter's em is 1/1.21 of it
  float small = 14;  // second lines, axis labels
  float row = 27;    // list rows, headings
  float control = 32;
  float padding = 12;  // of a panel, left and right
  float gap = 8;       // between controls
  float rounding = 5;
};

struct Theme {
  Palette palette;
  Metrics metrics;
};

Theme dark_theme();
Theme light_theme();

// 0xRRGGBB as in UX documents, opaque.
constexpr ImU32 colour_of(std::uint32_t rgb) {
  return IM_COL32((rgb >> 16) & 0xffu, (rgb >> 8) & 0xffu, rgb & 0xffu, 255);
}
// The colour with another opacity [0, 1].
ImU32 with_opacity(ImU32 colour, float opacity);
// From a (t = 0) to b (t = 1).
ImU32 mixed(ImU32 a, ImU32 b, float t);
// WCAG 2.1 contrast of two opaque colours, 1 to 21; text needs 4.5.
double contrast(ImU32 a, ImU32 b);

// 75 % to 300 %; what is not a number becomes 1.
float usable_scale(double scale);

// Sets Dear ImGui's style of the current context. Fonts are apart: see fonts.h.
void apply(const Theme& theme, double scale);

}  // namespace elbowroom
