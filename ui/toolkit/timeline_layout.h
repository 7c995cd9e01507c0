// SPDX-License-Identifier: MIT
// Inside the timeline: where its parts are, and its drawing. Used by timeline.cpp only.
#pragma once

#include <vector>

#include "ui/toolkit/geometry.h"
#include "ui/toolkit/timeline.h"
#include "ui/toolkit/timeline_scale.h"

namespace elbowroom {

struct TimelineLayout {
  Rect all, labels, ruler;
  Rect row_area;           // rows are cut off at it
  std::vector<Rect> rows;  // the part right of the labels; scrolled
  Rect marks, curves;      // empty height: not shown
  float most_scroll = 0;
  Rect scroll_bar;       // its track, right of the rows; empty: all of them are seen
  float row_scroll = 0;  // put right
  TimeRange clip;
  TimeScale scale;
};

TimelineLayout lay_out(const Ui& ui, const TimelineModel& model, const TimelineView& view,
                       const Rect& all, float label_width);

// The window's own strip and its handles. Requires a window whose row exists.
Rect window_band(const TimelineLayout& layout, const TimelineWindow& window);
Rect window_handle(const Ui& ui, const TimelineLayout& layout, const TimelineWindow& window,
                   bool low);
// The part of the scroll bar that stands for the rows that are seen.
Rect scroll_thumb(const Ui& ui, const TimelineLayout& layout);
// A bump's strip, at least a few pixels wide. Empty for one without sense.
Rect bump_rect(const Ui& ui, const TimelineLayout& layout, int row, const TimelineBump& bump);
// Along the foot of its row. Empty for one without sense.
Rect span_rect(const Ui& ui, const TimelineLayout& layout, int row, const TimelineSpan& span);
// The model's window, put right: finite, in order, on an existing row.
std::optional<TimelineWindow> usable_window(const TimelineModel& model);

struct TimelineHover {
  int row = -1, bump = -1, mark = -1;
  bool low = false, high = false, band = false, playhead = false, scroll_bar = false;
};
// What is under the mouse: one thing; a bump may lie under the band.
TimelineHover hover_of(const Ui& ui, const TimelineModel& model, const TimelineLayout& layout,
                       ImVec2 mouse);

void draw_timeline(Ui& ui, const TimelineModel& model, const TimelineLayout& layout,
                   const TimelineHover& hover, const std::optional<TimelineWindow>& drawn);

// The curve's value at a time, between samples; nullopt outside and where it is no number.
std::optional<double> value_at(const TimelineCurve& curve, double time);

}  // namespace elbowroom
