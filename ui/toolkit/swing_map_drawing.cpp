// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/toolkit/swing_map_view.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

using Place = SwingMap::Place;

constexpr double kDegree = std::numbers::pi / 180;

bool finite(const Place& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); }

// The outline's shape has a place inside: odd crossings.
bool inside(std::span<const Place> outline, const Place& p) {
  bool in = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Place &a = outline[i], &b = outline[j];
    if ((a[0] > p[0]) != (b[0] > p[0]) &&
        p[1] < (b[1] - a[1]) * (p[0] - a[0]) / (b[0] - a[0]) + a[1])
      in = !in;
  }
  return in;
}

std::vector<ImVec2> pixels_of(const SwingMapView& view, std::span<const Place> places) {
  std::vector<ImVec2> pixels;
  for (const Place& p : places) pixels.push_back(view.pixel(p));
  return pixels;
}

// Degrees between lines of the grid, so that there are about four.
double grid_step(const SwingMapView& view) {
  const double span = (view.across[1] - view.across[0]) / kDegree;
  for (const double step : {5.0, 10.0, 15.0, 30.0, 45.0, 90.0})
    if (span / step <= 5.5) return step;
  return 90;
}

void draw_grid(const Ui& ui, const SwingMap& map, const SwingMapView& view, float bottom,
               float left) {
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts().small;
  const double step = grid_step(view);
  const auto lines = [&](const double* axis, auto draw) {
    for (double d = std::ceil(axis[0] / kDegree / step) * step; d * kDegree <= axis[1]; d += step)
      draw(d * kDegree, number_text(d, 0, "°"), std::abs(d) < 1e-9);
  };
  const ImU32 quiet = with_opacity(p.line, 0.8f), strong = mixed(p.line, p.text, 0.25f);
  lines(view.across, [&](double value, const std::string& text, bool zero) {
    const float x = std::round(view.pixel({0, value}).x);
    list.AddRectFilled({x, view.plot.min.y}, {x + 1, view.plot.max.y}, zero ? strong : quiet);
    const float width = size_of(font, text).x;
    const float at = std::clamp(x - width / 2, view.plot.min.x, view.plot.max.x - width);
    draw_text(list, font, {at, bottom}, p.quiet, text);
  });
  lines(view.up, [&](double value, const std::string& text, bool zero) {
    const float y = std::round(view.pixel({value, 0}).y);
    list.AddRectFilled({view.plot.min.x, y}, {view.plot.max.x, y + 1}, zero ? strong : quiet);
    const float width = size_of(font, text).x;
    const float top =
        std::clamp(y - font->FontSize / 2, view.plot.min.y, view.plot.max.y - font->FontSize);
    draw_text(list, font, {left - width, top}, p.quiet, text);
  });
  // The axes' names, in the corners where they begin.
  const std::string across = std::string(map.across) + " →", up = "↑ " + std::string(map.up);
  draw_text(list, font,
            {view.plot.max.x - size_of(font, across).x - ui.px(5),
             view.plot.max.y - font->FontSize - ui.px(4)},
            p.quiet, across);
  draw_text(list, font, {view.plot.min.x + ui.px(5), view.plot.min.y + ui.px(4)}, p.quiet, up);
}

void draw_marks(const Ui& ui, const SwingMap& map, const SwingMapView& view) {
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts().small;
  for (const SwingMap::Mark& mark : map.marks) {
    if (!finite(mark.place)) continue;
    const ImVec2 at = view.pixel(mark.place);
    if (!view.plot.contains(at)) continue;
    const float r = ui.px(3);
    list.AddLine({at.x - r, at.y}, {at.x + r, at.y}, p.quiet);
    list.AddLine({at.x, at.y - r}, {at.x, at.y + r}, p.quiet);
    const float width = size_of(font, mark.name).x;
    // To the side on which there is room.
    const float x =
        at.x + ui.px(6) + width < view.plot.max.x ? at.x + ui.px(6) : at.x - ui.px(6) - width;
    draw_text(list, font, {x, at.y - font->FontSize / 2}, p.quiet, mark.name);
  }
}

void draw_clip(const Ui& ui, const SwingMap& map, const SwingMapView& view) {
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::span<const Place> limit =
      map.polygon.empty() ? map.own : std::span<const Place>(map.polygon);
  const float r = std::max(1.0f, 1.5f * ui.scale());
  for (const Place& place : map.clip) {
    if (!finite(place)) continue;
    const bool in = limit.size() < 3 || inside(limit, place);
    list.AddCircleFilled(view.pixel(place), in ? r : r + 0.5f,
                         in ? with_opacity(p.text, 0.55f) : p.problem, 8);
  }
}

void draw_shapes(const Ui& ui, const SwingMap& map, const SwingMapView& view,
                 const SwingMapFocus& focus) {
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool polygon = !map.polygon.empty();
  const auto own = pixels_of(view, map.own);
  const auto count = [](const auto& points) { return static_cast<int>(points.size()); };
  if (own.size() >= 3) {
    if (!polygon) list.AddConvexPolyFilled(own.data(), count(own), with_opacity(p.text, 0.07f));
    list.AddPolyline(own.data(), count(own), mixed(p.panel, p.text, polygon ? 0.3f : 0.5f),
                     ImDrawFlags_Closed, polygon ? 1.0f : 1.5f * ui.scale());
  }
  const auto drawn = pixels_of(view, map.polygon);
  if (polygon) {
    list.AddConvexPolyFilled(drawn.data(), count(drawn), with_opacity(p.accent, 0.12f));
  }
  if (map.sample_up[1] > map.sample_up[0] && map.sample_across[1] > map.sample_across[0]) {
    const ImVec2 a = view.pixel({map.sample_up[1], map.sample_across[0]});
    const ImVec2 b = view.pixel({map.sample_up[0], map.sample_across[1]});
    list.AddRect(a, b, with_opacity(p.accent, 0.5f), 0, 0, 1.0f);
  }
  draw_marks(ui, map, view);
  draw_clip(ui, map, view);
  if (polygon) {
    list.AddPolyline(drawn.data(), count(drawn), p.accent, ImDrawFlags_Closed, 1.5f * ui.scale());
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const int corner = static_cast<int>(i);
      const bool hot = corner == focus.held || (focus.held < 0 && corner == focus.under);
      const float r = ui.px(hot ? 5 : 4);
      const ImVec2 a(std::round(drawn[i].x) - r, std::round(drawn[i].y) - r);
      const ImVec2 b(a.x + 2 * r, a.y + 2 * r);
      list.AddRectFilled({a.x - 1, a.y - 1}, {b.x + 1, b.y + 1}, p.panel, ui.px(3));
      list.AddRectFilled(a, b, hot ? p.accent : p.handle, ui.px(2));
      if (corner == focus.last)
        list.AddRect({a.x - ui.px(3), a.y - ui.px(3)}, {b.x + ui.px(3), b.y + ui.px(3)}, p.accent,
                     ui.px(3));
    }
  }
  if (finite(map.clip_value))
    list.AddCircle(view.pixel(map.clip_value), ui.px(4), p.quiet, 16, 1.5f * ui.scale());
  if (finite(map.value)) {
    const ImVec2 at = view.pixel(map.value);
    list.AddCircleFilled(at, ui.px(5), p.panel, 16);
    list.AddCircleFilled(at, ui.px(4), p.selection, 16);
  }
}

}  // namespace

void draw_swing_map(const Ui& ui, const SwingMap& map, const SwingMapView& view,
                    const SwingMapFocus& focus) {
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(view.plot.min, view.plot.max, mixed(p.panel, p.ground, 0.7f),
                     ui.px(ui.theme().metrics.rounding));
  draw_grid(ui, map, view, view.plot.max.y + ui.px(3), view.plot.min.x - ui.px(4));
  list.PushClipRect(view.plot.min, view.plot.max, true);
  draw_shapes(ui, map, view, focus);
  list.PopClipRect();
}

void draw_swing_readout(const Ui& ui, const SwingMapView& view, ImVec2 pointer,
                        std::string_view words) {
  ImFont* font = ui.fonts().small;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float pad = ui.px(5);
  const float text = std::min(size_of(font, words).x, view.plot.width() - 2 * pad);
  const bool low = pointer.y < view.plot.min.y + view.plot.height() / 2;
  const ImVec2 from(low ? view.plot.min.x + pad : view.plot.max.x - pad - text,
                    low ? view.plot.max.y - font->FontSize - pad : view.plot.min.y + pad);
  list.AddRectFilled({from.x - ui.px(3), from.y - ui.px(2)},
                     {from.x + text + ui.px(3), from.y + font->FontSize + ui.px(3)},
                     with_opacity(ui.palette().panel, 0.9f), ui.px(3));
  draw_text(list, font, from, ui.palette().text, words, text + 1);
}

}  // namespace elbowroom
