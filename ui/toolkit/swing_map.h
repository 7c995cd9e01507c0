// SPDX-License-Identifier: MIT
// How far a joint may swing, as a map: the zero pose in the middle, up and down on the one axis,
// the other across. On it lie the joint's own limit, what a clip does (dots; those beyond the limit
// in the warning hue), the value now, the sampled part, and a polygon that is drawn by hand.
//
// Places are (up, across), radians; the axes' numbers are degrees. Both have the same scale.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/swing_polygon.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

struct SwingMap {
  using Place = std::array<double, 2>;
  struct Mark {
    std::string_view name;
    Place place{};
  };

  std::string_view up, across;  // what the axes are called
  std::span<const Place> own;   // the joint's own limit, closed
  std::span<const Place> clip;
  std::vector<Mark> marks;                             // known ways, "ahead"
  Place value{}, clip_value{};                         // now, in the motion and in the source clip
  std::array<double, 2> sample_up{}, sample_across{};  // sampling intervals; equal: not drawn
  SwingPolygon polygon;  // to be edited; empty: the joint's own limit holds
};

struct SwingMapOptions {
  // A place in words, for the read-out; empty: degrees by the axes' names.
  std::function<std::string(const SwingMap::Place&)> words = {};
};

// Changes map.polygon: a corner is dragged, as far as the others allow (Escape puts it back); a
// click or a drag on an edge adds a corner; a right click on one takes it away. The corner clicked
// last moves by the arrow keys a degree (Shift a tenth, Ctrl ten). Recorded as "NAME", and its
// parts as "NAME.corner.3", "NAME.edge.3" (the middle of the edge after corner 3) and "NAME.value".
Edit swing_map(Ui& ui, std::string_view name, SwingMap& map, const SwingMapOptions& options = {});

}  // namespace elbowroom
