// SPDX-License-Identifier: MIT
// Signs drawn as lines, so that no icon font is needed and every scale is sharp.
#pragma once

#include <imgui.h>

namespace elbowroom {

enum class Icon {
  none,
  play,
  pause,
  first,
  last,
  step_back,
  step_forward,
  loop,
  eye,
  eye_off,
  mute,
  solo,
  trash,
  undo,
  redo,
  refresh,
  camera,
  chevron_left,
  chevron_right,
  chevron_up,
  chevron_down,
  dot,
  ring,
  dotted_ring,
  diamond,
  warning,
  check,
  plus,
  close,
  file,
  folder,
  home,
  search,
  more,
  move,
  rotate,
  target,
  lock,
};

// Drawn into a square of `size` pixels about `centre`, which is rounded to whole pixels.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 centre, float size, ImU32 colour);

}  // namespace elbowroom
