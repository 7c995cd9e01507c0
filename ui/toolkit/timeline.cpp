// SPDX-License-Identifier: MIT
#include "ui/toolkit/timeline.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "ui/toolkit/text.h"
#include "ui/toolkit/timeline_layout.h"

namespace elbowroom {
namespace {

using Kind = TimelineEvent::Kind;
using Phase = TimelineEvent::Phase;
using Grip = TimelineView::Drag::Kind;

struct Frame {
  Ui& ui;
  const TimelineModel& model;
  TimelineView& view;
  TimelineLayout layout;
  std::vector<TimelineEvent> events;

  double snapped(double time) const {
    const TimeRange& clip = layout.clip;
    if (!std::isfinite(time)) time = clip.from;
    time = std::clamp(time, clip.from, clip.to);
    if (model.snap == ImGui::GetIO().KeyShift) return time;  // Shift turns snapping round
    const double rate = usable_rate(model.frame_rate);
    return std::clamp(clip.from + std::round((time - clip.from) * rate) / rate, clip.from, clip.to);
  }
  double least() const { return 1 / usable_rate(model.frame_rate); }
};

void press(Frame& frame, const TimelineHover& hover, double time) {
  TimelineView::Drag drag;
  drag.grabbed = time;
  const auto window = usable_window(frame.model);
  if (window) {
    drag.begin = window->begin;
    drag.end = window->end;
  }
  drag.time = std::isfinite(frame.model.time) ? frame.model.time : frame.layout.clip.from;
  if (hover.scroll_bar) {
    drag.kind = Grip::rows;
    drag.scroll = frame.layout.row_scroll;
    drag.y = ImGui::GetIO().MousePos.y;
  } else if (hover.low) {
    drag.kind = Grip::window_low;
    drag.index = window->row;
  } else if (hover.high) {
    drag.kind = Grip::window_high;
    drag.index = window->row;
  } else if (hover.band) {
    drag.kind = Grip::window_band;
    drag.index = hover.row;
  } else if (hover.row >= 0) {
    drag.kind = Grip::draw;
    drag.index = hover.row;
  } else if (hover.mark >= 0) {
    drag.kind = Grip::mark;
    drag.index = hover.mark;
    drag.time = frame.model.marks[static_cast<std::size_t>(hover.mark)].time;
  } else if (hover.playhead) {
    drag.kind = Grip::playhead;
  }
  frame.view.drag = drag;
}

// What a drag says now: the values under the mouse, or those from the beginning.
TimelineEvent dragged(const Frame& frame, double mouse, bool put_back) {
  const TimelineView::Drag& drag = frame.view.drag;
  const TimeRange& clip = frame.layout.clip;
  TimelineEvent event;
  event.begin = drag.begin;
  event.end = drag.end;
  event.time = drag.time;
  const double moved = mouse - drag.grabbed;
  switch (drag.kind) {
    case Grip::playhead:
      event.kind = Kind::scrub_to;
      if (!put_back) event.time = frame.snapped(mouse);
      break;
    case Grip::window_low:
      event.kind = Kind::window_changed;
      event.row = drag.index;
      if (!put_back) {
        event.begin = std::max(
            clip.from, std::min(frame.snapped(drag.begin + moved), drag.end - frame.least()));
      }
      break;
    case Grip::window_high:
      event.kind = Kind::window_changed;
      event.row = drag.index;
      if (!put_back) {
        event.end = std::min(clip.to,
                             std::max(frame.snapped(drag.end + moved), drag.begin + frame.least()));
      }
      break;
    case Grip::window_band:
      event.kind = Kind::window_changed;
      event.row = drag.index;
      if (!put_back) {
        const double length = std::min(drag.end - drag.begin, clip.length());
        event.begin = std::clamp(frame.snapped(drag.begin + moved), clip.from, clip.to - length);
        event.end = event.begin + length;
      }
      break;
    case Grip::draw: {
      event.kind = Kind::window_drawn;
      event.row = drag.index;
      const double a = frame.snapped(drag.grabbed), b = frame.snapped(mouse);
      event.begin = std::min(a, b);
      event.end = std::min(std::max({a, b, event.begin + frame.least()}), clip.to);
      event.begin = std::max(clip.from, std::min(event.begin, event.end - frame.least()));
      break;
    }
    case Grip::mark:
      event.kind = Kind::mark_moved;
      event.mark = drag.index;
      if (!put_back) event.time = frame.snapped(drag.time + moved);
      break;
    case Grip::pan:
    case Grip::rows:
    case Grip::none:
      break;
  }
  return event;
}

void release(Frame& frame, const TimelineHover& hover, double mouse) {
  const TimelineView::Drag drag = frame.view.drag;
  if (drag.kind == Grip::none || drag.kind == Grip::pan) return;
  TimelineEvent event;
  if (drag.moved) {
    event = dragged(frame, mouse, false);
    event.phase = Phase::committed;
    frame.events.push_back(event);
    return;
  }
  // No drag: a click.
  if (drag.kind == Grip::mark) {
    event.kind = Kind::mark_clicked;
    event.mark = drag.index;
    frame.events.push_back(event);
  } else if (drag.index >= 0 && drag.kind != Grip::window_low && drag.kind != Grip::window_high) {
    event.row = drag.index;
    event.bump = hover.row == drag.index ? hover.bump : -1;
    event.kind = event.bump >= 0 ? Kind::bump_clicked : Kind::row_clicked;
    event.time = frame.snapped(mouse);
    frame.events.push_back(event);
  }
}

void step_drag(Frame& frame, const TimelineHover& hover, double mouse, bool clicked) {
  TimelineView::Drag& drag = frame.view.drag;
  const ImGuiIO& io = ImGui::GetIO();
  if (drag.kind == Grip::rows) {
    const TimelineLayout& layout = frame.layout;
    const float way = layout.scroll_bar.height() - scroll_thumb(frame.ui, layout).height();
    if (way > 0)
      frame.view.row_scroll =
          std::clamp(drag.scroll + (io.MousePos.y - drag.y) * layout.most_scroll / way, 0.0f,
                     layout.most_scroll);
    if (!io.MouseDown[0]) drag = {};
    return;
  }
  const bool fixed_mark =
      drag.kind == Grip::mark && (drag.index >= static_cast<int>(frame.model.marks.size()) ||
                                  !frame.model.marks[static_cast<std::size_t>(drag.index)].movable);
  // A row or a mark that went away meanwhile takes its drag with it.
  if (drag.index >= 0 && drag.kind != Grip::mark &&
      drag.index >= static_cast<int>(frame.model.rows.size())) {
    drag = {};
    return;
  }
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
    if (drag.moved) {
      TimelineEvent event = dragged(frame, mouse, true);
      event.phase = Phase::cancelled;
      frame.events.push_back(event);
    }
    drag = {};
    return;
  }
  if (!io.MouseDown[0]) {
    release(frame, hover, mouse);
    drag = {};
    return;
  }
  const bool at_once = drag.kind == Grip::playhead;  // the ruler follows the press itself
  if (!drag.moved) {
    if (fixed_mark || !(at_once ? clicked : ImGui::IsMouseDragging(0, frame.ui.px(3)))) return;
    drag.moved = true;
    TimelineEvent event = dragged(frame, mouse, false);
    event.phase = Phase::began;
    frame.events.push_back(event);
  } else if (io.MouseDelta.x != 0 || io.MouseDelta.y != 0) {
    TimelineEvent event = dragged(frame, mouse, false);
    event.phase = Phase::changing;
    frame.events.push_back(event);
  }
}

void zoom_and_pan(Frame& frame, bool hovered, bool middle_down, ImVec2 mouse) {
  const ImGuiIO& io = ImGui::GetIO();
  TimelineView& view = frame.view;
  TimeRange range = frame.layout.scale.range;
  const double a_pixel = frame.layout.scale.seconds_a_pixel();
  bool changed = false;
  if (hovered && io.MouseWheel != 0 && frame.layout.labels.contains(mouse)) {
    view.row_scroll = std::clamp(view.row_scroll - io.MouseWheel * frame.ui.px(30), 0.0f,
                                 frame.layout.most_scroll);
  } else if (hovered && (io.MouseWheel != 0 || io.MouseWheelH != 0)) {
    const double along = static_cast<double>(io.MouseWheelH + (io.KeyShift ? io.MouseWheel : 0));
    range.from -= 60 * a_pixel * along;
    range.to -= 60 * a_pixel * along;
    if (!io.KeyShift) {
      range = zoomed(range, frame.layout.scale.time_of(mouse.x),
                     std::pow(1.2, static_cast<double>(io.MouseWheel)));
    }
    changed = true;
  }
  if (middle_down && io.MouseDelta.x != 0) {
    range.from -= static_cast<double>(io.MouseDelta.x) * a_pixel;
    range.to -= static_cast<double>(io.MouseDelta.x) * a_pixel;
    changed = true;
  }
  if (changed) {
    range = usable_view(range.from, range.to, frame.layout.clip, frame.model.frame_rate);
    view.from = range.from;
    view.to = range.to;
  }
  if (hovered && !io.WantTextInput &&
      ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Home), false)) {
    show_all(view);
  }
}

void say(Frame& frame, const TimelineHover& hover) {
  Ui& ui = frame.ui;
  const TimelineView::Drag& drag = frame.view.drag;
  const auto shape = [](ImGuiMouseCursor cursor) { ImGui::SetMouseCursor(cursor); };
  if (drag.kind == Grip::pan) return shape(ImGuiMouseCursor_ResizeEW);
  if (hover.scroll_bar || drag.kind == Grip::rows)
    return ui.hint("Drag: more rows · Wheel over the labels does the same");
  if (drag.kind != Grip::none && drag.moved) {
    shape(ImGuiMouseCursor_ResizeEW);
    ui.hint(frame.model.snap ? "Shift: between frames · Esc: put back"
                             : "Shift: whole frames · Esc: put back");
    return;
  }
  if (hover.low || hover.high) {
    shape(ImGuiMouseCursor_ResizeEW);
    ui.hint(hover.low ? "Drag: where the plan begins" : "Drag: where the plan ends");
  } else if (hover.bump >= 0) {
    shape(ImGuiMouseCursor_Hand);
    ui.hint(hover.band ? "Click: choose this problem · Drag: move the window"
                       : "Click: choose this problem and its window");
  } else if (hover.band) {
    shape(ImGuiMouseCursor_Hand);
    ui.hint("Drag: move the window");
  } else if (hover.mark >= 0) {
    shape(ImGuiMouseCursor_Hand);
    ui.hint(frame.model.marks[static_cast<std::size_t>(hover.mark)].movable
                ? "Click: choose · Drag: another time"
                : "Click: choose");
  } else if (hover.row >= 0) {
    ui.hint("Click: choose the limb · Drag: draw a window · Wheel: zoom");
  } else if (hover.playhead) {
    shape(ImGuiMouseCursor_ResizeEW);
    ui.hint("Drag: scrub · Wheel: zoom · Middle drag: pan · Home: whole clip");
  }
}

void record(Frame& frame, std::string_view name) {
  Ui& ui = frame.ui;
  const TimelineLayout& layout = frame.layout;
  const TimelineModel& model = frame.model;
  const std::string base = "###" + std::string(name_part(name)) + '.';
  const auto part = [&](const std::string& suffix, const Rect& rect, std::string value = {},
                        bool selected = false) {
    ui.record(WidgetKind::timeline, base + suffix, rect.min, rect.max, std::move(value), true,
              selected);
  };
  const auto seconds = [](double t) { return number_text(t, 3, "s"); };
  ui.record(WidgetKind::timeline, name, layout.all.min, layout.all.max,
            seconds(layout.scale.range.from) + " – " + seconds(layout.scale.range.to));
  part("ruler", {{layout.scale.left, layout.ruler.min.y},
                 {layout.scale.left + layout.scale.width, layout.ruler.max.y}});
  if (std::isfinite(model.time)) {
    const float x = layout.scale.x_of(model.time);
    part("playhead", {{x - ui.px(6), layout.ruler.min.y}, {x + ui.px(6), layout.ruler.max.y}},
         seconds(model.time));
  }
  for (std::size_t r = 0; r < model.rows.size(); ++r) {
    const TimelineRow& row = model.rows[r];
    part("row." + row.label, layout.rows[r],
         row.computing ? number_text(100 * *row.computing, 0, "%")
                       : std::to_string(row.bumps.size()) + " bumps",
         row.selected);
    // Thousands of problems are still one row; a test looks at the first ones.
    for (std::size_t b = 0; b < std::min<std::size_t>(row.bumps.size(), 64); ++b) {
      part("row." + row.label + ".bump." + std::to_string(b),
           bump_rect(ui, layout, static_cast<int>(r), row.bumps[b]), row.bumps[b].tooltip);
    }
    for (std::size_t k = 0; k < std::min<std::size_t>(row.spans.size(), 64); ++k) {
      const TimelineSpan& span = row.spans[k];
      part("row." + row.label + ".span." + std::to_string(k),
           span_rect(ui, layout, static_cast<int>(r), span),
           seconds(span.begin) + " – " + seconds(span.end) + (span.on ? "" : ", off"));
    }
  }
  if (const auto window = usable_window(model)) {
    part("window.band", window_band(layout, *window),
         seconds(window->begin) + " – " + seconds(window->end));
    part("window.low", window_handle(ui, layout, *window, true), seconds(window->begin));
    part("window.high", window_handle(ui, layout, *window, false), seconds(window->end));
  }
  for (std::size_t i = 0; i < model.marks.size(); ++i) {
    const float x = layout.scale.x_of(model.marks[i].time);
    part("mark." + std::to_string(i),
         {{x - ui.px(9), layout.marks.min.y}, {x + ui.px(9), layout.marks.max.y}},
         model.marks[i].label, model.marks[i].selected);
  }
  if (layout.curves.height() > 1) part("curves", layout.curves);
  if (layout.most_scroll > 0) part("scroll", scroll_thumb(ui, layout));
}

}  // namespace

void show_all(TimelineView& view) { view.from = view.to = 0; }

void show_range(TimelineView& view, double begin, double end) {
  if (begin > end) std::swap(begin, end);
  const double air = 0.1 * (end - begin);
  view.from = begin - air;
  view.to = end + air;
}

std::vector<TimelineEvent> timeline(Ui& ui, std::string_view name, const TimelineModel& model,
                                    TimelineView& view, const TimelineOptions& options) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const float width = std::floor(options.width > 0 ? options.width : room.x);
  const float height = std::floor(options.height > 0 ? options.height : room.y);
  const Rect all{at, {at.x + std::max(width, ui.px(120)), at.y + std::max(height, ui.px(60))}};
  Frame frame{ui, model, view, lay_out(ui, model, view, all, options.label_width), {}};

  ImGui::PushID(name.data(), name.data() + name.size());
  ImGui::InvisibleButton("##area", {all.width(), all.height()},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemUsingMouseWheel();
  const bool hovered = ImGui::IsItemHovered();
  const bool clicked = ImGui::IsItemActivated() && ImGui::IsMouseClicked(0);
  const bool panning = ImGui::IsItemActive() && ImGui::IsMouseDown(2);
  ImGui::PopID();

  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const double time = frame.layout.scale.time_of(mouse.x);
  TimelineHover hover;
  if (hovered || view.drag.kind != Grip::none) hover = hover_of(ui, model, frame.layout, mouse);
  zoom_and_pan(frame, hovered, panning, mouse);
  if (clicked && ImGui::IsMouseDoubleClicked(0)) {
    if (frame.layout.ruler.contains(mouse)) {
      show_all(view);
    } else if (hover.bump >= 0) {
      TimelineEvent event;
      event.kind = Kind::bump_double_clicked;
      event.row = hover.row;
      event.bump = hover.bump;
      frame.events.push_back(event);
    }
  } else if (clicked) {
    press(frame, hover, time);
  }
  if (view.drag.kind != Grip::none) step_drag(frame, hover, time, clicked);
  if (hovered || view.drag.kind != Grip::none) say(frame, hover);

  std::optional<TimelineWindow> drawn;
  if (view.drag.kind == Grip::draw && view.drag.moved) {
    const TimelineEvent event = dragged(frame, time, false);
    drawn = TimelineWindow{event.begin, event.end, event.row};
  }
  // While something is dragged, it stays lit wherever the pointer goes.
  if (view.drag.kind != Grip::none && view.drag.moved) {
    hover = {};
    hover.low = view.drag.kind == Grip::window_low;
    hover.high = view.drag.kind == Grip::window_high;
    hover.band = view.drag.kind == Grip::window_band;
    hover.playhead = view.drag.kind == Grip::playhead;
    if (view.drag.kind == Grip::mark) hover.mark = view.drag.index;
  }
  draw_timeline(ui, model, frame.layout, hover, drawn);
  if (hover.bump >= 0 && hovered && view.drag.kind == Grip::none) {
    const TimelineRow& row = model.rows[static_cast<std::size_t>(hover.row)];
    explain(ui, {}, row.bumps[static_cast<std::size_t>(hover.bump)].tooltip);
  } else if (hover.mark >= 0 && hovered && view.drag.kind == Grip::none) {
    const TimelineMark& mark = model.marks[static_cast<std::size_t>(hover.mark)];
    explain(ui, {}, mark.label + " · " + number_text(mark.time, 2, "s"));
  }
  record(frame, name);
  return std::move(frame.events);
}

}  // namespace elbowroom
