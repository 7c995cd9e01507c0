// SPDX-License-Identifier: MIT
#include "ui/toolkit/swing_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ui/toolkit/swing_map_view.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

using Place = SwingMap::Place;

constexpr double kDegree = std::numbers::pi / 180;
constexpr float kGrip = 9, kEdgeGrip = 6;  // how far from it the pointer takes hold, pixels

// What the map keeps between frames, in Ui::memory, before the corners at the drag's beginning.
enum Kept {
  kCorner,
  kMoved,
  kAdded,
  kPressX,
  kPressY,
  kLast,
  kHasKeys,
  kUp0,
  kUp1,
  kAcross0,
  kAcross1,
  kKeptCount
};

bool finite(const Place& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); }

// All that is on the map, with air round it; no more than a whole turn.
void bounds(const SwingMap& map, double* up, double* across) {
  up[0] = across[0] = -20 * kDegree;
  up[1] = across[1] = 20 * kDegree;
  const auto hold = [&](const Place& p) {
    if (!finite(p)) return;
    up[0] = std::min(up[0], p[0]);
    up[1] = std::max(up[1], p[0]);
    across[0] = std::min(across[0], p[1]);
    across[1] = std::max(across[1], p[1]);
  };
  for (const Place& p : map.own) hold(p);
  for (const Place& p : map.clip) hold(p);
  for (const Place& p : map.polygon) hold(p);
  hold(map.value);
  for (double* axis : {up, across}) {
    const double air = 0.1 * (axis[1] - axis[0]);
    axis[0] = std::max(axis[0] - air, -std::numbers::pi);
    axis[1] = std::min(axis[1] + air, std::numbers::pi);
  }
}

float distance(ImVec2 a, ImVec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

float distance_to_segment(ImVec2 p, ImVec2 a, ImVec2 b) {
  const ImVec2 ab(b.x - a.x, b.y - a.y);
  const float length = ab.x * ab.x + ab.y * ab.y;
  const float t = length > 0 ? ((p.x - a.x) * ab.x + (p.y - a.y) * ab.y) / length : 0;
  return distance(p,
                  {a.x + std::clamp(t, 0.0f, 1.0f) * ab.x, a.y + std::clamp(t, 0.0f, 1.0f) * ab.y});
}

struct Under {
  int corner = -1, edge = -1;
};

// The corner under the pointer, else the edge.
Under under_pointer(const Ui& ui, const SwingMapView& view, const SwingPolygon& polygon,
                    ImVec2 mouse) {
  Under under;
  float nearest = ui.px(kGrip);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const float d = distance(view.pixel(polygon[i]), mouse);
    if (d <= nearest) {
      nearest = d;
      under.corner = static_cast<int>(i);
    }
  }
  if (under.corner >= 0) return under;
  nearest = ui.px(kEdgeGrip);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const float d = distance_to_segment(mouse, view.pixel(polygon[i]),
                                        view.pixel(polygon[(i + 1) % polygon.size()]));
    if (d <= nearest) {
      nearest = d;
      under.edge = static_cast<int>(i);
    }
  }
  return under;
}

std::string words_of(const SwingMap& map, const SwingMapOptions& options, const Place& place) {
  if (options.words) return options.words(place);
  return std::string(map.up) + " " + number_text(place[0] / kDegree, 0, "°") + ", " +
         std::string(map.across) + " " + number_text(place[1] / kDegree, 0, "°");
}

}  // namespace

Edit swing_map(Ui& ui, std::string_view name, SwingMap& map, const SwingMapOptions& options) {
  Edit edit;
  map.polygon = counter_clockwise(std::move(map.polygon));
  const SwingPolygon before = map.polygon;
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [](ImGuiKey key, bool repeat) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
  };

  ImGui::PushID(name.data(), name.data() + name.size());
  const ImGuiID id = ImGui::GetID("##map");
  std::vector<double>& kept = ui.memory(id);
  if (kept.size() < kKeptCount) {
    kept.assign(kKeptCount, 0);
    kept[kCorner] = kept[kLast] = -1;
  }
  // While a corner is held, the map stays where it is under the pointer.
  SwingMapView view;
  if (kept[kCorner] >= 0 || kept[kMoved] != 0) {
    for (int i = 0; i < 2; ++i) {
      view.up[i] = kept[static_cast<std::size_t>(kUp0 + i)];
      view.across[i] = kept[static_cast<std::size_t>(kAcross0 + i)];
    }
  } else {
    bounds(map, view.up, view.across);
    for (int i = 0; i < 2; ++i) {
      kept[static_cast<std::size_t>(kUp0 + i)] = view.up[i];
      kept[static_cast<std::size_t>(kAcross0 + i)] = view.across[i];
    }
  }
  // As wide as the panel; where that would be too high, the axis across shows more.
  ImFont* font = ui.fonts().small;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ui.px(80), std::floor(ImGui::GetContentRegionAvail().x));
  const float left = std::ceil(size_of(font, "−180°").x) + ui.px(4);
  const float below = font->FontSize + ui.px(4);
  const auto ratio =
      static_cast<float>((view.up[1] - view.up[0]) / (view.across[1] - view.across[0]));
  const float plot_width = width - left;
  const float plot_height = std::floor(std::clamp(plot_width * ratio, ui.px(90), ui.px(280)));
  const double wanted = (view.up[1] - view.up[0]) * static_cast<double>(plot_width / plot_height);
  const double missing = wanted - (view.across[1] - view.across[0]);
  if (missing > 0) {
    view.across[0] -= missing / 2;
    view.across[1] += missing / 2;
  } else {
    const double high =
        (view.across[1] - view.across[0]) * static_cast<double>(plot_height / plot_width);
    const double more = high - (view.up[1] - view.up[0]);
    view.up[0] -= more / 2;
    view.up[1] += more / 2;
  }
  view.plot = {{at.x + left, at.y}, {at.x + width, at.y + plot_height}};

  ImGui::SetCursorScreenPos(view.plot.min);
  ImGui::InvisibleButton("##map", {plot_width, plot_height},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  // Dear ImGui itself lets go of the item on Escape, where the keyboard navigates.
  const bool let_go = ImGui::IsItemDeactivated();
  const ImVec2 mouse = io.MousePos;
  Under under;
  if (hovered && kept[kCorner] < 0) under = under_pointer(ui, view, map.polygon, mouse);

  const auto remember_start = [&] {
    kept.resize(kKeptCount);
    for (const Place& corner : map.polygon) kept.insert(kept.end(), corner.begin(), corner.end());
  };
  const auto start = [&] {
    SwingPolygon corners;
    for (std::size_t i = kKeptCount; i + 1 < kept.size(); i += 2)
      corners.push_back({kept[i], kept[i + 1]});
    return corners;
  };
  if (ImGui::IsItemActivated() && io.MouseClicked[0] && (under.corner >= 0 || under.edge >= 0)) {
    remember_start();
    kept[kAdded] = under.corner >= 0 ? 0 : 1;
    kept[kCorner] = under.corner >= 0 ? under.corner : under.edge;
    kept[kMoved] = 0;
    kept[kPressX] = static_cast<double>(mouse.x);
    kept[kPressY] = static_cast<double>(mouse.y);
  }
  int held = -1;
  if ((active || let_go) && kept[kCorner] >= 0) {
    const int grip = static_cast<int>(kept[kCorner]);
    const bool adds = kept[kAdded] != 0;
    held = adds ? grip + 1 : grip;
    const ImVec2 press(static_cast<float>(kept[kPressX]), static_cast<float>(kept[kPressY]));
    const auto put = [&](const Place& wanted) {
      map.polygon = adds ? with_corner_added(start(), grip, wanted)
                         : with_corner_moved(start(), grip, wanted);
    };
    if (pressed(ImGuiKey_Escape, false)) {
      if (kept[kMoved] != 0) map.polygon = start();
      edit.cancelled = kept[kMoved] != 0;
      kept[kCorner] = -1;
      kept[kMoved] = 0;
    } else if (!let_go && (kept[kMoved] != 0 || distance(mouse, press) >= ui.px(3))) {
      edit.began = kept[kMoved] == 0;
      kept[kMoved] = 1;
      // By as much as the pointer has moved since it took hold.
      const Place from = view.place(press), to = view.place(mouse);
      const Place base = adds ? from : start()[static_cast<std::size_t>(grip)];
      const double fine = io.KeyShift ? 0.1 : 1.0;
      put({base[0] + fine * (to[0] - from[0]), base[1] + fine * (to[1] - from[1])});
    } else if (let_go) {
      if (kept[kMoved] == 0 && adds) {
        // A click on an edge: a corner a little outside, so that it is one.
        const Place place = view.place(press);
        const double r = std::hypot(place[0], place[1]), out = r > 0 ? (r + 4 * kDegree) / r : 1;
        put({place[0] * out, place[1] * out});
      }
      const bool same = map.polygon == start();
      kept[kLast] = same && adds ? -1 : held;
      edit.committed = !same;
      edit.cancelled = same && kept[kMoved] != 0;
      kept[kCorner] = -1;
      kept[kMoved] = 0;
      held = -1;
    }
  }
  if (ImGui::IsItemActivated() && io.MouseClicked[1] && under.corner >= 0) {
    const SwingPolygon fewer = with_corner_removed(map.polygon, under.corner);
    edit.committed = fewer != map.polygon;
    if (!edit.committed)
      ui.toast(Tone::problem, "This corner has to stay",
               "three corners at least go round the zero pose");
    map.polygon = fewer;
    kept[kLast] = -1;
  }
  if (kept[kCorner] < 0 && kept[kLast] >= static_cast<double>(map.polygon.size())) kept[kLast] = -1;

  // Keys, for who clicked a corner here last.
  if (ImGui::IsItemActivated()) kept[kHasKeys] = 1;
  if (ImGui::IsMouseClicked(0) && !hovered) kept[kHasKeys] = 0;
  const bool keys = kept[kHasKeys] != 0 && kept[kLast] >= 0 && !active && !io.WantTextInput &&
                    ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
  if (keys) {
    ui.take_keys(false);
    const double step = kDegree * (io.KeyShift ? 0.1 : io.KeyCtrl ? 10.0 : 1.0);
    const double across = (pressed(ImGuiKey_RightArrow, true) ? step : 0) -
                          (pressed(ImGuiKey_LeftArrow, true) ? step : 0);
    const double up = (pressed(ImGuiKey_UpArrow, true) ? step : 0) -
                      (pressed(ImGuiKey_DownArrow, true) ? step : 0);
    if (across != 0 || up != 0) {
      const int last = static_cast<int>(kept[kLast]);
      const Place& from = map.polygon[static_cast<std::size_t>(last)];
      map.polygon = with_corner_moved(map.polygon, last, {from[0] + up, from[1] + across});
      edit.committed |= map.polygon != before;
    }
  }
  edit.changed = map.polygon != before;

  draw_swing_map(ui, map, view, {held, under.corner, keys ? static_cast<int>(kept[kLast]) : -1});
  if (hovered || active) {
    const int corner = held >= 0 ? held : under.corner;
    const bool on_corner = corner >= 0 && corner < static_cast<int>(map.polygon.size());
    const std::string words =
        words_of(map, options,
                 on_corner ? map.polygon[static_cast<std::size_t>(corner)] : view.place(mouse));
    if (on_corner || under.edge >= 0) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    ui.hint(words + (held >= 0           ? " · Shift: fine · Esc: put back"
                     : under.corner >= 0 ? " · Drag: move the corner · Right click: take it away"
                     : under.edge >= 0   ? " · Click or drag: one more corner"
                                         : ""));
    draw_swing_readout(ui, view, mouse, words);
  }
  ImGui::PopID();

  const std::string base(name_part(name));
  const float grip = ui.px(4);
  const auto part = [&](const std::string& which, const Place& place) {
    const ImVec2 c = view.pixel(place);
    ui.record(WidgetKind::mark, "###" + base + which, {c.x - grip, c.y - grip},
              {c.x + grip, c.y + grip}, words_of(map, options, place));
  };
  ui.record(WidgetKind::picture, name, view.plot.min, view.plot.max,
            map.polygon.empty() ? "own limit" : std::to_string(map.polygon.size()) + " corners");
  part(".value", map.value);
  for (std::size_t i = 0; i < map.polygon.size(); ++i) {
    const Place &a = map.polygon[i], &b = map.polygon[(i + 1) % map.polygon.size()];
    part(".corner." + std::to_string(i), a);
    part(".edge." + std::to_string(i), {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
  }
  ImGui::SetCursorScreenPos(at);
  ImGui::Dummy({width, plot_height + below});
  return edit;
}

}  // namespace elbowroom
