// SPDX-License-Identifier: MIT
#include "ui/panels/panel.h"

#include <cmath>

#include "ui/toolkit/text.h"

namespace elbowroom {

std::string time_text(const EditorState& state, const ViewState& view, double t) {
  if (view.frames)
    return "frame " +
           std::to_string(std::lround((t - state.begin) * std::max(1.0, state.frame_rate)));
  return number_text(t, 2, "s");
}

std::string length_text(double metres) {
  const double size = std::abs(metres);
  if (size >= 1) return number_text(metres, 2, "m");
  if (size >= 0.01) return number_text(metres * 100, 1, "cm");
  return number_text(metres * 1000, 1, "mm");
}

std::string degrees_text(double radians, int decimals) {
  return number_text(radians * 180 / kPi, decimals, "°");
}

std::string duration_text(double milliseconds) {
  return milliseconds < 1000 ? number_text(milliseconds, 0, "ms")
                             : number_text(milliseconds / 1000, 1, "s");
}

Phase phase_of(const Edit& edit) {
  if (edit.cancelled) return Phase::cancelled;
  return edit.committed ? Phase::committed : Phase::changing;
}

std::string sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

}  // namespace elbowroom
