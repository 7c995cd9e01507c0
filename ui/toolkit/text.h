// SPDX-License-Identifier: MIT
// Words: labels in three strengths, headings, name and value on one line, tooltips, key caps.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ui/toolkit/ui.h"

namespace elbowroom {

// One line across the rest of the panel: text on the left, `right` quiet at the right edge. What
// does not fit ends in "…" and is whole in the tooltip.
void label(Ui& ui, std::string_view text, std::string_view right = {}, Tone tone = Tone::text,
           Tone right_tone = Tone::quiet);
// A row's height, in quiet semibold: "Corrections". Without a line above; see separator.
void heading(Ui& ui, std::string_view text, std::string_view right = {});
// The panel's subject: semibold, full strength: "Right arm", right: "shoulder · elbow · wrist".
void title(Ui& ui, std::string_view text, std::string_view right = {});
// Wrapped quiet text in the small size, over as many lines as it takes.
void note(Ui& ui, std::string_view text, Tone tone = Tone::quiet);
// The text with line ends between words, and within one that is too wide by itself, so that no line
// is wider than `width` pixels. Dear ImGui by itself would break "1.425 s" after its point.
std::string wrapped(ImFont* font, std::string_view text, float width);
// A piece of text that takes its own width, for rows made with ImGui::SameLine; vertically centred
// in a control's height.
void inline_text(Ui& ui, std::string_view text, Tone tone = Tone::text);
// A hairline from edge to edge with air above and below.
void separator(Ui& ui);
void space(Ui& ui, float pixels = 8);

// A key as it stands on the keyboard, drawn as a cap: "Ctrl P". Returns its size.
ImVec2 key_cap(Ui& ui, std::string_view keys);
// The same at a place, without moving the cursor; the right edge at `right`.
void draw_key_cap(const Ui& ui, ImDrawList& list, ImVec2 right_centre, std::string_view keys);
ImVec2 key_cap_size(const Ui& ui, std::string_view keys);

// If the last item is hovered: `hint` goes to the status line at once, and after a moment a tooltip
// shows `tooltip` (or the hint), with keys as a cap. Nothing for empty texts.
void explain(Ui& ui, std::string_view hint, std::string_view tooltip = {},
             std::string_view keys = {});

// "1.62 s", "-0.0" never: numbers for people. What is not a number is "–". The minus is "−".
std::string number_text(double value, int decimals, std::string_view unit = {});

}  // namespace elbowroom
