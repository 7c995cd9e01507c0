// SPDX-License-Identifier: MIT
// Small sums of layout that all widgets share.
#pragma once

#include <imgui.h>

#include <cmath>

namespace elbowroom {

struct Rect {
  ImVec2 min, max;

  float width() const { return max.x - min.x; }
  float height() const { return max.y - min.y; }
  bool contains(ImVec2 p) const {
    return p.x >= min.x && p.x < max.x && p.y >= min.y && p.y < max.y;
  }
};

// Where a line of text starts so that its capitals stand in the middle of a strip.
inline float middle(float top, float height, const ImFont* font) {
  return std::floor(top + (height - font->FontSize) / 2);
}

}  // namespace elbowroom
