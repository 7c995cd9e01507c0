// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/toolkit/text.h"
#include "ui/toolkit/timeline_layout.h"

namespace elbowroom {
namespace {

float depth_at(const TimelineBump& bump, double t) {
  if (bump.depth.empty()) return 0.6f;
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(bump.depth.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, bump.depth.size() - 1);
  const auto fraction = static_cast<float>(place - std::floor(place));
  const float depth = bump.depth[below] + (bump.depth[above] - bump.depth[below]) * fraction;
  return std::isfinite(depth) ? std::clamp(depth, 0.0f, 1.0f) : 0;
}

void draw_bump(const Ui& ui, ImDrawList& list, const TimelineLayout& layout, int row,
               const TimelineBump& bump, bool hovered, bool enabled) {
  const Rect rect = bump_rect(ui, layout, row, bump);
  const float left = std::max(rect.min.x, layout.scale.left);
  const float right = std::min(rect.max.x, layout.scale.left + layout.scale.width);
  if (!(right - left >= 1)) return;
  const Palette& p = ui.palette();
  const float severity = std::isfinite(bump.severity) ? std::clamp(bump.severity, 0.0f, 1.0f) : 1;
  ImU32 colour = mixed(p.panel, p.problem, 0.6f + 0.4f * severity);
  if (!enabled) colour = mixed(p.panel, p.problem, 0.35f);
  if (hovered) colour = mixed(colour, p.text, 0.2f);
  const float base = rect.max.y - ui.px(1), tall = rect.height() - ui.px(4);
  const int columns = std::clamp(static_cast<int>(std::ceil((right - left) / 2)), 2, 2048);
  std::vector<ImVec2> top;
  top.reserve(static_cast<std::size_t>(columns) + 1);
  for (int i = 0; i <= columns; ++i) {
    const float x = left + (right - left) * static_cast<float>(i) / static_cast<float>(columns);
    const double t = static_cast<double>((x - rect.min.x) / (rect.max.x - rect.min.x));
    // What collides is seen, however shallow.
    const float inside = bump.depth.empty() ? 0.6f : depth_at(bump, t);
    top.push_back({x, base - std::max(inside * tall, std::min(tall, ui.px(2)))});
  }
  // Trapezoids without smoothing (seams would show); the outline's smoothing hides their steps.
  list.PrimReserve(6 * columns, 2 * (columns + 1));
  const unsigned first = list._VtxCurrentIdx;
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  for (int i = 0; i <= columns; ++i) {
    const ImVec2& point = top[static_cast<std::size_t>(i)];
    list.PrimWriteVtx(point, white, colour);
    list.PrimWriteVtx({point.x, base}, white, colour);
  }
  for (int i = 0; i < columns; ++i) {
    const unsigned corner = first + 2u * static_cast<unsigned>(i);
    for (const unsigned offset : {0u, 1u, 2u, 2u, 1u, 3u}) {
      list.PrimWriteIdx(static_cast<ImDrawIdx>(corner + offset));
    }
  }
  list.AddPolyline(top.data(), static_cast<int>(top.size()), colour, 0, std::max(1.0f, ui.px(1)));
  list.AddRectFilled({left, base}, {right, base + ui.px(1)}, mixed(colour, p.text, 0.55f));
}

struct ValueRange {
  double low = 0, high = 1;
};

ValueRange values_of(const TimelineModel& model) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&low, &high](double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const TimelineCurve& curve : model.curves) {
    for (const TimelineSample& sample : curve.samples) take(sample.value);
  }
  if (model.threshold) take(*model.threshold);
  if (!(low <= high)) return {0, 1};
  const double air = std::max(0.08 * (high - low), 1e-9 + 1e-9 * std::abs(high));
  return {low - air, high + air};
}

void stroke(ImDrawList& list, const std::vector<ImVec2>& points, ImU32 colour, float width,
            float dash) {
  if (points.size() < 2) return;
  if (dash <= 0) {
    list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, width);
    return;
  }
  float travelled = 0;  // along the line, modulo one dash and one gap
  const float gap = 0.8f * dash;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ImVec2 a = points[i - 1], b = points[i];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    float at = 0;
    while (at < length) {
      const bool drawing = travelled < dash;
      const float step =
          std::max(std::min((drawing ? dash : dash + gap) - travelled, length - at), 0.01f);
      const float to = std::min(at + step, length);
      if (drawing) {
        const auto on = [&](float s) {
          return ImVec2(a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length);
        };
        list.AddLine(on(at), on(to), colour, width);
      }
      at += step;
      travelled += step;
      if (travelled >= dash + gap - 1e-3f) travelled = 0;
    }
  }
}

// One or two points a pixel column: its least and greatest value, in their order.
void draw_curve(const Ui& ui, ImDrawList& list, const TimelineLayout& layout,
                const TimelineCurve& curve, const ValueRange& values) {
  const Rect& area = layout.curves;
  const auto y_of = [&](double value) {
    const double t = (value - values.low) / (values.high - values.low);
    return area.max.y - static_cast<float>(std::clamp(t, 0.0, 1.0)) * area.height();
  };
  const ImU32 colour = ui.colour(curve.tone);
  const float width = ui.scale() * (curve.dashed ? 1.4f : 1.8f);
  const float dash = curve.dashed ? ui.px(5) : 0;
  std::vector<ImVec2> line;
  const auto& s = curve.samples;
  const auto before = [](const TimelineSample& sample, double t) { return sample.time < t; };
  auto from = std::lower_bound(s.begin(), s.end(), layout.scale.range.from, before);
  auto to = std::lower_bound(s.begin(), s.end(), layout.scale.range.to, before);
  if (from != s.begin()) --from;
  if (to != s.end()) ++to;
  const auto flush = [&] {
    stroke(list, line, colour, width, dash);
    line.clear();
  };
  while (from < to) {
    if (!std::isfinite(from->time) || !std::isfinite(from->value)) {
      flush();
      ++from;
      continue;
    }
    const float column = std::floor(layout.scale.x_of(from->time));
    ImVec2 least(layout.scale.x_of(from->time), y_of(from->value)), greatest = least, last = least;
    for (++from; from < to && std::isfinite(from->value) &&
                 std::floor(layout.scale.x_of(from->time)) == column;
         ++from) {
      last = {layout.scale.x_of(from->time), y_of(from->value)};
      if (last.y < least.y) least = last;
      if (last.y > greatest.y) greatest = last;
    }
    if (least.x > greatest.x) std::swap(least, greatest);
    line.push_back(least);
    if (greatest.y != least.y) line.push_back(greatest);
    if (last.x > line.back().x) line.push_back(last);
  }
  flush();
}

void draw_marks(Ui& ui, ImDrawList& list, const TimelineModel& model, const TimelineLayout& layout,
                int hovered) {
  const Palette& p = ui.palette();
  ImFont* font = ui.fonts().small;
  const float y = std::round((layout.marks.min.y + layout.marks.max.y) / 2);
  for (std::size_t i = 0; i < model.marks.size(); ++i) {
    const TimelineMark& mark = model.marks[i];
    if (!std::isfinite(mark.time)) continue;
    const float x = layout.scale.x_of(mark.time);
    const bool lit = hovered == static_cast<int>(i);
    if (mark.selected || lit) {
      draw_icon(list, mark.icon, {x, y}, ui.px(21), lit ? with_opacity(p.text, 0.5f) : p.text);
    }
    draw_icon(list, mark.icon, {x, y}, ui.px(17), p.selection);
    float room = layout.marks.max.x - x - ui.px(14);
    for (const TimelineMark& other : model.marks) {
      const float distance = layout.scale.x_of(other.time) - x;
      if (distance > 0) room = std::min(room, distance - ui.px(26));
    }
    if (room > ui.px(14)) {
      draw_text(list, font, {x + ui.px(13), middle(y - ui.px(10), ui.px(20), font)},
                mark.selected ? p.text : p.quiet, mark.label, room);
    }
  }
}

}  // namespace

void draw_timeline(Ui& ui, const TimelineModel& model, const TimelineLayout& layout,
                   const TimelineHover& hover, const std::optional<TimelineWindow>& drawn) {
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const TimeScale& scale = layout.scale;
  const float left = scale.left, right = layout.all.max.x, bottom = layout.all.max.y;
  ImFont* small = ui.fonts().small;
  ImFont* regular = ui.fonts().regular;
  const float pad = ui.px(ui.theme().metrics.padding);
  const float label_room = std::max(1.0f, layout.labels.width() - pad - ui.px(8));

  // Rows and the grid.
  const ImU32 groove = mixed(p.panel, p.raised, p.dark ? 0.75f : 0.0f);
  list.PushClipRect(layout.row_area.min, {right, layout.row_area.max.y}, true);
  for (const Rect& row : layout.rows) {
    list.AddRectFilled({left, row.min.y}, row.max, p.dark ? groove : p.ground, ui.px(3));
  }
  list.PopClipRect();
  if (layout.marks.height() > 0) {
    list.AddRectFilled({left, layout.marks.min.y + ui.px(2)},
                       {layout.marks.max.x, layout.marks.max.y - ui.px(2)},
                       p.dark ? groove : p.ground, ui.px(3));
  }
  const auto ticks =
      ticks_of(scale, layout.clip.from, model.frame_rate, model.show_frames, ui.px(84));
  list.PushClipRect({left, layout.all.min.y}, {right, bottom}, true);
  const float floor = layout.ruler.max.y;
  for (const Tick& tick : ticks) {
    const float x = std::round(scale.x_of(tick.time));
    if (tick.major) {
      list.AddRectFilled({x, floor}, {x + 1, bottom}, p.line);
      draw_text(list, small, {x + ui.px(4), layout.ruler.min.y + ui.px(3)}, p.quiet, tick.label);
    }
    list.AddRectFilled({x, floor - ui.px(tick.major ? 7 : 4)}, {x + 1, floor},
                       mixed(p.line, p.text, tick.major ? 0.3f : 0.12f));
  }
  // Keys: ticks, or a line where they stand too close to be told apart.
  float last = -1e9f;
  for (const double time : model.key_times) {
    if (!std::isfinite(time)) continue;
    const float x = std::round(scale.x_of(time));
    if (x == last || x < left || x > right) continue;
    const bool close = x > last && x - last < ui.px(6);
    list.AddRectFilled({close ? last : x, floor - (close ? 1 : ui.px(3))}, {x + 1, floor},
                       with_opacity(p.ghost, close ? 0.45f : 1.0f));
    last = x;
  }
  list.AddRectFilled({left, floor}, {right, floor + 1}, p.line);

  // The window, below the bumps; while one is drawn, that one.
  const std::optional<TimelineWindow> window = drawn ? drawn : usable_window(model);
  list.PushClipRect({left, layout.row_area.min.y - ui.px(2)},
                    {right, layout.row_area.max.y + ui.px(2)}, true);
  if (window) {
    const Rect band = window_band(layout, *window);
    list.AddRectFilled(band.min, band.max,
                       with_opacity(p.accent, hover.band || drawn ? 0.3f : 0.22f));
  }
  for (std::size_t r = 0; r < model.rows.size(); ++r) {
    const TimelineRow& row = model.rows[r];
    const int index = static_cast<int>(r);
    for (const TimelineSpan& span : row.spans) {
      const Rect foot = span_rect(ui, layout, index, span);
      list.AddRectFilled(foot.min, foot.max, with_opacity(p.good, span.on ? 0.9f : 0.3f));
    }
    for (std::size_t b = 0; b < row.bumps.size(); ++b) {
      draw_bump(ui, list, layout, index, row.bumps[b],
                hover.row == index && hover.bump == static_cast<int>(b), row.enabled);
    }
    if (row.computing) {
      const double share = std::isfinite(*row.computing) ? std::clamp(*row.computing, 0.0, 1.0) : 0;
      const Rect& strip = layout.rows[r];
      const float from = scale.x_of(layout.clip.from);
      const float to = scale.x_of(layout.clip.from + share * layout.clip.length());
      const float end = scale.x_of(layout.clip.to);
      // What has not been looked at yet is veiled, so that it does not pass for clear.
      list.AddRectFilled({std::max(left, to), strip.min.y},
                         {std::min(end, strip.max.x), strip.max.y},
                         with_opacity(p.dark ? p.ground : p.line, 0.8f));
      list.AddRectFilled({std::max(left, from), strip.max.y - ui.px(2)}, {to, strip.max.y},
                         with_opacity(p.accent, 0.8f));
    }
  }
  if (window) {
    for (const bool low : {true, false}) {
      const Rect handle = window_handle(ui, layout, *window, low);
      const bool lit = low ? hover.low : hover.high;
      list.AddRectFilled(handle.min, handle.max, lit ? mixed(p.accent, p.text, 0.4f) : p.accent,
                         ui.px(3),
                         low ? ImDrawFlags_RoundCornersLeft : ImDrawFlags_RoundCornersRight);
    }
  }
  list.PopClipRect();

  if (layout.marks.height() > 0) draw_marks(ui, list, model, layout, hover.mark);
  if (layout.curves.height() > 1) {
    const ValueRange values = values_of(model);
    if (model.threshold && std::isfinite(*model.threshold)) {
      const double t = (*model.threshold - values.low) / (values.high - values.low);
      const float y =
          std::round(layout.curves.max.y - static_cast<float>(t) * layout.curves.height());
      for (float x = left; x < layout.curves.max.x; x += ui.px(6)) {
        list.AddRectFilled({x, y}, {x + ui.px(2), y + 1}, mixed(p.line, p.text, 0.35f));
      }
    }
    for (const TimelineCurve& curve : model.curves) draw_curve(ui, list, layout, curve, values);
  }

  // Before and after the clip there is nothing.
  const float begin = std::round(scale.x_of(layout.clip.from));
  const float end = std::round(scale.x_of(layout.clip.to));
  const ImU32 veil = with_opacity(p.ground, 0.55f);
  if (begin > left) list.AddRectFilled({left, floor + 1}, {begin, bottom}, veil);
  if (end < right) list.AddRectFilled({end, floor + 1}, {right, bottom}, veil);

  if (std::isfinite(model.time)) {
    const float x = std::round(scale.x_of(model.time)), half = ui.px(hover.playhead ? 7 : 6);
    const float top = layout.ruler.min.y;
    list.AddRectFilled({x, top}, {x + ui.px(2), bottom}, p.selection);
    const float centre = x + ui.px(2) / 2;
    const ImVec2 head[] = {{centre - half, top},
                           {centre + half, top},
                           {centre + half, top + half * 0.7f},
                           {centre, top + half * 1.7f},
                           {centre - half, top + half * 0.7f}};
    list.AddConvexPolyFilled(head, 5, p.selection);
  }
  list.PopClipRect();

  if (layout.most_scroll > 0) {
    const Rect thumb = scroll_thumb(ui, layout);
    list.AddRectFilled(thumb.min, thumb.max, mixed(p.line, p.text, hover.scroll_bar ? 0.4f : 0.15f),
                       ui.px(3));
  }

  // Labels, left.
  const auto name = [&](const Rect& row, std::string_view text, ImU32 colour, ImFont* font) {
    draw_text(list, font, {layout.labels.min.x + pad, middle(row.min.y, row.height(), font)},
              colour, text, label_room);
  };
  list.PushClipRect({layout.labels.min.x, layout.row_area.min.y},
                    {layout.labels.max.x, layout.row_area.max.y}, true);
  for (std::size_t r = 0; r < model.rows.size(); ++r) {
    const TimelineRow& row = model.rows[r];
    const bool lit = row.selected || hover.row == static_cast<int>(r);
    name(layout.rows[r], row.label,
         !row.enabled ? p.faint
         : lit        ? p.text
                      : p.quiet,
         row.selected ? ui.fonts().medium : regular);
  }
  list.PopClipRect();
  if (layout.marks.height() > 0) name(layout.marks, model.marks_label, p.quiet, regular);
  if (layout.curves.height() > 1) {
    const float y = layout.curves.min.y +
                    (layout.curves.height() < regular->FontSize + ui.px(12) ? 0 : ui.px(6));
    draw_text(list, regular, {layout.labels.min.x + pad, y}, p.quiet, model.curves_label,
              label_room);
    // Its value under the playhead, of the curve that holds now.
    for (const TimelineCurve& curve : model.curves) {
      const auto value = curve.dashed ? std::nullopt : value_at(curve, model.time);
      if (!value) continue;
      const std::string text =
          number_text(*value * model.curve_shown_per_value, 1, model.curve_unit);
      // Below the label, or beside it where there is no room below.
      const float beside = size_of(regular, model.curves_label).x + ui.px(8);
      ImVec2 at{layout.labels.min.x + pad, y + regular->FontSize + ui.px(2)};
      if (layout.curves.height() < ui.px(40)) {
        if (beside + size_of(small, text).x > layout.labels.width() - pad) break;
        at = {at.x + beside, y + std::floor((regular->FontSize - small->FontSize) / 2)};
      }
      draw_text(list, small, at, ui.colour(*value < model.threshold ? Tone::problem : curve.tone),
                text, label_room);
      break;
    }
  }
}

}  // namespace elbowroom
