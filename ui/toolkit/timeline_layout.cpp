// SPDX-License-Identifier: MIT
#include "ui/toolkit/timeline_layout.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

constexpr float kRuler = 26, kLeastRow = 18, kLeastMarks = 22, kLeastCurves = 28;

}  // namespace

float least_timeline_height(int rows) {
  return kRuler + kLeastRow * static_cast<float>(std::max(rows, 1)) + kLeastMarks + kLeastCurves;
}

TimelineLayout lay_out(const Ui& ui, const TimelineModel& model, const TimelineView& view,
                       const Rect& all, float label_width) {
  TimelineLayout layout;
  layout.all = all;
  const float labels = std::floor(std::min(ui.px(label_width), all.width() / 3));
  const float left = all.min.x + labels, right = all.max.x - ui.px(10);
  layout.labels = {all.min, {left, all.max.y}};
  layout.ruler = {{left, all.min.y}, {all.max.x, all.min.y + ui.px(kRuler)}};
  layout.clip = usable_clip(model.begin, model.end, model.frame_rate);
  layout.scale.range = usable_view(view.from, view.to, layout.clip, model.frame_rate);
  layout.scale.left = left;
  layout.scale.width = std::max(right - left, 8.0f);

  // Rows get their height first down to a readable least, then the curves what is left; rows that
  // still do not fit scroll.
  float y = layout.ruler.max.y;
  const float room = std::max(0.0f, all.max.y - y);
  const float count = static_cast<float>(std::max<std::size_t>(model.rows.size(), 1));
  const float wanted = count * ui.px(20) + ui.px(28 + 56);
  const float marks = model.marks_label.empty() ? 0 : ui.px(room < wanted ? kLeastMarks : 28);
  const float curves = model.curves_label.empty() ? 0 : ui.px(56);
  const float row =
      std::floor(std::clamp((room - marks - curves) / count, ui.px(kLeastRow), ui.px(30)));
  const float rows = model.rows.empty() ? 0 : row * count;
  const float least_curves = std::min(curves, ui.px(kLeastCurves));
  // Rows that scroll anyway leave the curves their least height.
  const float for_rows = room - marks >= rows ? room - marks : room - marks - least_curves;
  const float shown = std::min(rows, std::max(std::min(rows, 2 * row), for_rows));
  layout.row_area = {{left, y}, {all.max.x, y + shown}};
  layout.most_scroll = rows - shown;
  const float scroll = std::round(std::clamp(
      std::isfinite(view.row_scroll) ? view.row_scroll : 0.0f, 0.0f, layout.most_scroll));
  layout.row_scroll = scroll;
  if (layout.most_scroll > 0)
    layout.scroll_bar = {{all.max.x - ui.px(9), y}, {all.max.x - ui.px(2), y + shown}};
  for (std::size_t i = 0; i < model.rows.size(); ++i) {
    const float top = y - scroll + row * static_cast<float>(i);
    layout.rows.push_back({{left, top + ui.px(2)}, {right, top + row - ui.px(2)}});
  }
  y += shown;
  layout.marks = {{left, y}, {right, y + std::min(marks, std::max(0.0f, all.max.y - y))}};
  y = layout.marks.max.y;
  const float rest = all.max.y - y;
  const bool has_curves = curves > 0 && rest >= ui.px(20);
  layout.curves = {
      {left, y + ui.px(4)},
      {right, has_curves ? all.max.y - ui.px(rest < ui.px(40) ? 3 : 6) : y + ui.px(4)}};
  return layout;
}

std::optional<TimelineWindow> usable_window(const TimelineModel& model) {
  if (!model.window) return std::nullopt;
  TimelineWindow window = *model.window;
  if (window.row < 0 || window.row >= static_cast<int>(model.rows.size()) ||
      !std::isfinite(window.begin) || !std::isfinite(window.end)) {
    return std::nullopt;
  }
  if (window.begin > window.end) std::swap(window.begin, window.end);
  return window;
}

Rect scroll_thumb(const Ui& ui, const TimelineLayout& layout) {
  const Rect& bar = layout.scroll_bar;
  const float all = bar.height() + layout.most_scroll;
  const float height = std::max(ui.px(12), bar.height() * bar.height() / std::max(1.0f, all));
  const float top =
      bar.min.y + (bar.height() - height) * layout.row_scroll / std::max(1.0f, layout.most_scroll);
  return {{bar.min.x, top}, {bar.max.x, top + height}};
}

Rect window_band(const TimelineLayout& layout, const TimelineWindow& window) {
  const Rect& row = layout.rows[static_cast<std::size_t>(window.row)];
  return {{std::round(layout.scale.x_of(window.begin)), row.min.y - 1},
          {std::round(layout.scale.x_of(window.end)), row.max.y + 1}};
}

Rect window_handle(const Ui& ui, const TimelineLayout& layout, const TimelineWindow& window,
                   bool low) {
  const Rect band = window_band(layout, window);
  const float width = ui.px(7);
  // Outside the band, so that a short window still leaves room to grip its middle.
  const float left = low ? band.min.x - width : band.max.x;
  return {{left, band.min.y - ui.px(1)}, {left + width, band.max.y + ui.px(1)}};
}

Rect bump_rect(const Ui& ui, const TimelineLayout& layout, int row, const TimelineBump& bump) {
  if (!std::isfinite(bump.begin) || !std::isfinite(bump.end)) return {};
  const Rect& strip = layout.rows[static_cast<std::size_t>(row)];
  float from = layout.scale.x_of(std::min(bump.begin, bump.end));
  float to = layout.scale.x_of(std::max(bump.begin, bump.end));
  const float least = ui.px(4);
  if (to - from < least) {
    const float middle = 0.5f * (from + to);
    from = middle - least / 2;
    to = middle + least / 2;
  }
  return {{from, strip.min.y}, {to, strip.max.y}};
}

Rect span_rect(const Ui& ui, const TimelineLayout& layout, int row, const TimelineSpan& span) {
  if (!std::isfinite(span.begin) || !std::isfinite(span.end)) return {};
  const Rect& strip = layout.rows[static_cast<std::size_t>(row)];
  const float from = layout.scale.x_of(std::min(span.begin, span.end));
  const float to = layout.scale.x_of(std::max(span.begin, span.end));
  return {{from, strip.max.y - ui.px(3)}, {std::max(to, from + ui.px(2)), strip.max.y}};
}

TimelineHover hover_of(const Ui& ui, const TimelineModel& model, const TimelineLayout& layout,
                       ImVec2 mouse) {
  TimelineHover hover;
  if (layout.most_scroll > 0 && layout.scroll_bar.contains(mouse)) {
    hover.scroll_bar = true;
    return hover;
  }
  if (layout.row_area.contains(mouse) ||
      (layout.labels.contains(mouse) && mouse.y >= layout.row_area.min.y &&
       mouse.y < layout.row_area.max.y)) {
    for (std::size_t i = 0; i < layout.rows.size(); ++i) {
      const Rect& row = layout.rows[i];
      if (mouse.y >= row.min.y - ui.px(2) && mouse.y < row.max.y + ui.px(2)) {
        hover.row = static_cast<int>(i);
      }
    }
  }
  if (layout.row_area.contains(mouse)) {
    const auto window = usable_window(model);
    if (window && window->row == hover.row) {
      Rect low = window_handle(ui, layout, *window, true);
      Rect high = window_handle(ui, layout, *window, false);
      // Generous outwards, and a little inwards where there is room for it.
      const float in = std::min(ui.px(4), (high.min.x - low.max.x) / 4);
      low = {{low.min.x - ui.px(5), low.min.y}, {low.max.x + in, low.max.y}};
      high = {{high.min.x - in, high.min.y}, {high.max.x + ui.px(5), high.max.y}};
      hover.low = low.contains(mouse);
      hover.high = !hover.low && high.contains(mouse);
      hover.band = !hover.low && !hover.high && window_band(layout, *window).contains(mouse);
    }
    if (hover.row >= 0 && !hover.low && !hover.high) {
      // Of bumps that overlap, the one drawn last is on top.
      const auto& bumps = model.rows[static_cast<std::size_t>(hover.row)].bumps;
      for (std::size_t b = bumps.size(); b-- > 0 && hover.bump < 0;) {
        Rect rect = bump_rect(ui, layout, hover.row, bumps[b]);
        rect.min.x -= ui.px(2);
        rect.max.x += ui.px(2);
        if (rect.contains(mouse)) hover.bump = static_cast<int>(b);
      }
    }
    return hover;
  }
  if (layout.marks.contains(mouse)) {
    float best = ui.px(11);
    for (std::size_t i = 0; i < model.marks.size(); ++i) {
      const double time = model.marks[i].time;
      if (!std::isfinite(time)) continue;
      const float distance = std::abs(layout.scale.x_of(time) - mouse.x);
      if (distance <= best) {
        best = distance;
        hover.mark = static_cast<int>(i);
      }
    }
    return hover;
  }
  hover.playhead = mouse.x >= layout.scale.left &&
                   (layout.ruler.contains(mouse) || layout.curves.contains(mouse));
  return hover;
}

std::optional<double> value_at(const TimelineCurve& curve, double time) {
  const auto& s = curve.samples;
  if (s.empty() || !std::isfinite(time)) return std::nullopt;
  const auto after =
      std::lower_bound(s.begin(), s.end(), time,
                       [](const TimelineSample& sample, double t) { return sample.time < t; });
  if (after == s.end()) return std::nullopt;
  if (after == s.begin()) {
    return after->time == time && std::isfinite(after->value) ? std::optional(after->value)
                                                              : std::nullopt;
  }
  const auto before = after - 1;
  const double span = after->time - before->time;
  const double t = span > 0 ? (time - before->time) / span : 0;
  const double value = before->value + (after->value - before->value) * t;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace elbowroom
