// SPDX-License-Identifier: MIT
// The timeline: a ruler with the playhead, a row of collision bumps per limb, the window of
// planning over its row, marks (tasks), and curves (clearance) below. It draws a model, keeps only
// its view (what part of the time is seen) and the drag in progress, and reports what the user did
// as events; the caller changes the document.
//
// Times are in seconds of the clip. Model and view may hold anything (times that are no numbers,
// ends before begins): what makes no sense is not drawn or is put right.
// Cost: a few draw calls a pixel column at most, however many samples there are.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ui/toolkit/icons.h"
#include "ui/toolkit/ui.h"

namespace elbowroom {

struct TimelineBump {
  double begin = 0, end = 0, peak = 0;
  std::vector<float> depth;  // 0..1 of the row's height, evenly from begin to end; empty: flat
  float severity = 1;        // 0..1: how strong the colour is
  std::string tooltip = {};  // "forearm – post A, 3.1 cm at 1.62 s"
};

// A stretch of a row that something was done to.
struct TimelineSpan {
  double begin = 0, end = 0;
  bool on = true;  // false: faint
};

struct TimelineRow {
  std::string label;
  bool enabled = true, selected = false;
  std::vector<TimelineBump> bumps = {};
  std::optional<double> computing = {};  // 0..1: how much of the clip has been looked at
  std::vector<TimelineSpan> spans = {};
};

struct TimelineWindow {
  double begin = 0, end = 0;
  int row = 0;
};

struct TimelineMark {
  double time = 0;
  std::string label;
  Icon icon = Icon::diamond;
  bool selected = false;
  bool movable = true;
};

struct TimelineSample {
  double time = 0, value = 0;
};

struct TimelineCurve {
  std::string name;
  std::vector<TimelineSample> samples;  // by time
  bool dashed = false;                  // before; solid: after
  Tone tone = Tone::good;
};

struct TimelineModel {
  double begin = 0, end = 1;  // of the clip
  double frame_rate = 30;
  bool show_frames = false;  // the ruler's labels
  bool snap = false;         // times go to whole frames
  double time = 0;           // the playhead
  std::vector<TimelineRow> rows = {};
  std::optional<TimelineWindow> window = {};
  std::string marks_label = "Tasks";
  std::vector<TimelineMark> marks = {};
  std::string curves_label = "Clearance";
  std::vector<TimelineCurve> curves = {};
  std::string curve_unit = "cm";
  double curve_shown_per_value = 100;    // metres in centimetres
  std::optional<double> threshold = {};  // a dotted line, in the curves' values
  std::vector<double> key_times = {};    // short ticks under the ruler
};

// The part of the time that is seen, and what is being dragged. Keep one per timeline; a new one
// shows the whole clip.
struct TimelineView {
  double from = 0, to = 0;  // from == to: the whole clip
  float row_scroll = 0;     // pixels

  struct Drag {
    enum class Kind { none, playhead, window_low, window_high, window_band, draw, mark, pan, rows };
    Kind kind = Kind::none;
    int index = -1;                       // row or mark
    double grabbed = 0;                   // time under the mouse at the beginning
    double begin = 0, end = 0, time = 0;  // values at the beginning
    float scroll = 0, y = 0;              // of the rows, and where the mouse took their bar
    bool moved = false;
  } drag;
};

struct TimelineEvent {
  enum class Kind {
    scrub_to,             // time
    window_changed,       // begin, end, row
    window_drawn,         // begin, end, row: on an empty part of that row
    mark_moved,           // mark, time
    mark_clicked,         // mark
    bump_clicked,         // row, bump
    bump_double_clicked,  // row, bump
    row_clicked,          // row: its label, or an empty part
  };
  // Of a drag: began, changing, then committed or cancelled (with the values from the beginning).
  enum class Phase { began, changing, committed, cancelled };

  Kind kind = Kind::scrub_to;
  Phase phase = Phase::committed;
  int row = -1, bump = -1, mark = -1;
  double time = 0, begin = 0, end = 0;
};

struct TimelineOptions {
  float width = 0, height = 0;  // pixels on the screen; 0: the panel's rest
  float label_width = 132;      // pixels at 100 %; at most a third of the width
};

// Rows that don't fit scroll: by the bar at their right, or the wheel over their labels. Wheel
// elsewhere: zoom about the pointer; Shift and wheel, or middle drag: pan; Home, or a double-click
// on the ruler: the whole clip; left drag on the ruler or the playhead: scrub; Escape: puts a drag
// back. Recorded as NAME with parts: "NAME.ruler", "NAME.playhead", "NAME.window.low", ".high",
// ".band", "NAME.row.LABEL", "NAME.row.LABEL.bump.N", "NAME.row.LABEL.span.N", "NAME.mark.N",
// "NAME.curves", "NAME.scroll".
std::vector<TimelineEvent> timeline(Ui& ui, std::string_view name, const TimelineModel& model,
                                    TimelineView& view, const TimelineOptions& options = {});

// Pixels at 100 % in which so many rows, the marks and a curve can be read without scrolling.
float least_timeline_height(int rows);

// Shows the whole clip, or [begin, end] with a tenth of air at both sides.
void show_all(TimelineView& view);
void show_range(TimelineView& view, double begin, double end);

}  // namespace elbowroom
