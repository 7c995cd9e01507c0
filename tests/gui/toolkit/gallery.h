// SPDX-License-Identifier: MIT
// All widgets together, laid out as the editor is: to look at, and to find what does not fit.
#pragma once

#include <string>

#include "ui/toolkit/toolkit.h"

namespace elbowroom {

struct Gallery {
  std::vector<RangeModel> ranges;
  TimelineModel timeline;
  TimelineView view;
  int tab = 0, preset = 1, language = 0;
  bool scene_open = true, objects_open = true, live = true, loop = false, more = true;
  double clearance = 0.02, seed = 7, left_ratio = 0.156, right_ratio = 0.787, timeline_ratio = 0.705;
  std::string name = "Past post A";
  bool asking = false;
  std::vector<TimelineEvent> events;  // of the last frame with some
};

Gallery make_gallery();
void draw_gallery(Ui& ui, Gallery& gallery);

}  // namespace elbowroom
