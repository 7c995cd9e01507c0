// SPDX-License-Identifier: MIT
// What a swing's map looks like, for swing_map.cpp: where its places are in pixels, and the drawing
// of them into the current window. Pixels of the screen; places in radians.
#pragma once

#include <array>

#include "ui/toolkit/geometry.h"
#include "ui/toolkit/swing_map.h"

namespace elbowroom {

struct SwingMapView {
  double up[2] = {-1, 1}, across[2] = {-1, 1};  // radians at the plot's edges
  Rect plot;

  float scale() const { return plot.width() / static_cast<float>(across[1] - across[0]); }
  ImVec2 pixel(const SwingMap::Place& p) const {
    return {plot.min.x + static_cast<float>(p[1] - across[0]) * scale(),
            plot.max.y - static_cast<float>(p[0] - up[0]) * scale()};
  }
  SwingMap::Place place(ImVec2 p) const {
    return {up[0] + static_cast<double>((plot.max.y - p.y) / scale()),
            across[0] + static_cast<double>((p.x - plot.min.x) / scale())};
  }
};

// What of the polygon the pointer has to do with; -1: nothing.
struct SwingMapFocus {
  int held = -1;   // the corner that is dragged
  int under = -1;  // the one under the pointer
  int last = -1;   // the one that the arrow keys move
};

void draw_swing_map(const Ui& ui, const SwingMap& map, const SwingMapView& view,
                    const SwingMapFocus& focus);
// Words on the map, on the side where the pointer is not and no axis has its name.
void draw_swing_readout(const Ui& ui, const SwingMapView& view, ImVec2 pointer,
                        std::string_view words);

}  // namespace elbowroom
