// SPDX-License-Identifier: MIT
#include "tests/gui/toolkit/gallery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elbowroom {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

RangeModel range(double low, double high, double from, double to, double now) {
  RangeModel m;
  m.limit_low = low * kDegree;
  m.limit_high = high * kDegree;
  m.low = m.default_low = from * kDegree;
  m.high = m.default_high = to * kDegree;
  m.current = now * kDegree;
  m.clip = (now - 12) * kDegree;
  return m;
}

TimelineBump bump(double begin, double end, float most) {
  TimelineBump b{begin, end, 0.5 * (begin + end), {}, most, "forearm – post A, 3.1 cm deep"};
  for (int i = 0; i <= 24; ++i) {
    b.depth.push_back(most * std::sin(std::numbers::pi_v<float> * static_cast<float>(i) / 24));
  }
  return b;
}

void outliner(Ui& ui, Gallery& g) {
  heading(ui, "Scene");
  if (list_row(ui, "Ada", {.right = "14.2k tris", .expanded = g.scene_open}).toggled) {
    g.scene_open = !g.scene_open;
  }
  if (g.scene_open) {
    list_row(ui, "Right arm", {.icon = Icon::dot, .icon_tone = Tone::problem, .badge = "2 problems",
                               .selected = true, .indent = 1, .hint = "Click: choose this limb"});
    for (const char* limb : {"Left arm", "Right leg", "Left leg"}) {
      list_row(ui, limb, {.icon = Icon::dot, .icon_tone = Tone::good, .right = "clear",
                          .indent = 1});
    }
  }
  if (list_row(ui, "Objects", {.right = "3", .expanded = g.objects_open}).toggled) {
    g.objects_open = !g.objects_open;
  }
  if (g.objects_open) {
    list_row(ui, "Umbrella", {.right = "held, right hand", .indent = 1});
    list_row(ui, "Post A", {.right = "static",
                            .actions = {{Icon::eye, "Hide"}}, .indent = 1});
    list_row(ui, "Post B with a name that is too long for the panel", {.right = "static", .indent = 1});
  }
  separator(ui);
  heading(ui, "Corrections");
  list_row(ui, "Past post A", {.icon = Icon::ring, .icon_tone = Tone::good, .right = "1.20–2.05 s",
                               .actions = {{Icon::mute, "Mute"}, {Icon::solo, "Solo"},
                                           {Icon::trash, "Delete"}},
                               .selected_tone = Tone::good, .selected = true});
  list_row(ui, "Past post B", {.icon = Icon::ring, .right = "not planned",
                               .actions = {{Icon::mute, "Mute", true}}});
  list_row(ui, "Walk (clip, read-only)", {.icon = Icon::dotted_ring, .tone = Tone::faint});
  separator(ui);
  heading(ui, "Tasks");
  list_row(ui, "Grab hat", {.icon = Icon::diamond, .icon_tone = Tone::selection, .right = "4.10 s"});
  list_row(ui, "Drop on table", {.icon = Icon::diamond, .icon_tone = Tone::selection,
                                 .right = "5.60 s"});
}

void inspector(Ui& ui, Gallery& g) {
  tabs(ui, "Pages", {"Limb", "Target", "Planner", "Object"}, g.tab);
  space(ui, 2);
  title(ui, "Right arm", "shoulder · elbow · wrist");
  heading_combo(ui, "Sampling intervals", "Preset", g.preset,
                {"Paper", "High arm", "Low arm", "Close to body"});
  const char* names[] = {"Shoulder, raise", "Shoulder, forward", "Shoulder, twist",
                         "Elbow, flexion", "Forearm, twist", "Wrist, bend", "Wrist, sideways"};
  for (std::size_t i = 0; i < g.ranges.size(); ++i) {
    range_slider(ui, names[i], g.ranges[i],
                 {.right = i == 3 ? "90 – 100 % first, then all" : ""});
  }
  space(ui, 4);
  button(ui, "Plan 1.20–2.05 s###plan", {.look = ButtonLook::primary, .shortcut = "P",
                                          .hint = "Search for a way around"});
  ImGui::SameLine();
  toggle_button(ui, "Live", g.live, {.icon = Icon::target});
  ImGui::SameLine();
  button(ui, "Seed 7###seed", {.icon = Icon::refresh});
  progress(ui, "Planning", 0.34, {.right = "4 s left"});
  heading(ui, "Alternatives", "4 found · 11 ms");
  const float width = card_width(ui, 2);
  card(ui, "Over the post", {{"clearance", "3.1 cm"}, {"from clip", "21°"},
                             {"peak speed", "3.4 rad/s"}, {"certified", "", Tone::good, true}},
       {.selected = true, .width = width});
  ImGui::SameLine();
  card(ui, "Close to body", {{"clearance", "1.2 cm"}, {"from clip", "34°"},
                             {"peak speed", "4.0 rad/s"}, {"certified", "", Tone::good, true}},
       {.width = width});
  if (section(ui, "More", g.more, "6")) {
    text_input(ui, "Name", g.name);
    number_input(ui, "Clearance", g.clearance, {.unit = "cm", .minimum = 0, .maximum = 1,
                                                .decimals = 1, .shown_per_value = 100});
    number_input(ui, "Seed", g.seed, {.decimals = 0, .enabled = false});
    combo(ui, "Interpolation", g.language, {"Spherical", "Linear", "Curve"});
    toggle(ui, "Keep the elbow out", g.loop);
    inline_error(ui, {"No way past Post A with these intervals", "right arm, 1.62 s",
                      "Widen “Shoulder, raise” or move the window"});
    if (button(ui, "Delete…", {.look = ButtonLook::danger})) g.asking = true;
    ImGui::SameLine();
    button(ui, "Export", {.enabled = false, .why_not = "Nothing is accepted yet"});
    ImGui::SameLine();
    button(ui, "Reset all", {.look = ButtonLook::quiet});
  }
}

void transport(Ui& ui, Gallery& g) {
  const IconButtonOptions plain{.look = ButtonLook::secondary};
  icon_button(ui, "First frame", Icon::first, plain);
  ImGui::SameLine();
  icon_button(ui, "Step back", Icon::step_back, plain);
  ImGui::SameLine();
  icon_button(ui, "Play", Icon::play, {.look = ButtonLook::primary, .shortcut = "Space"});
  ImGui::SameLine();
  icon_button(ui, "Step forward", Icon::step_forward, plain);
  ImGui::SameLine();
  icon_button(ui, "Last frame", Icon::last, plain);
  ImGui::SameLine();
  IconButtonOptions on = plain;
  on.on = true;
  icon_button(ui, "Loop", Icon::loop, on);
  ImGui::SameLine(0, ui.px(14));
  inline_text(ui, "00:01.62");
  ImGui::SameLine();
  inline_text(ui, "frame 49 / 182 · 30 fps", Tone::quiet);
  const float right = button_width(ui, "problem", {.icon = Icon::chevron_left}) * 2 + ui.px(8);
  ImGui::SameLine(ImGui::GetWindowWidth() - right - ui.px(12));
  button(ui, "problem###previous", {.icon = Icon::chevron_left});
  ImGui::SameLine();
  button(ui, "problem###next", {.icon = Icon::chevron_right});
  (void)g;
}

void icons(Ui& ui) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImVec2 at = ImGui::GetCursorScreenPos();
  const float left = at.x, step = ui.px(30);
  for (int i = 1; i <= static_cast<int>(Icon::lock); ++i) {
    draw_icon(list, static_cast<Icon>(i), {at.x + step / 2, at.y + step / 2}, ui.px(16),
              ui.palette().text);
    at.x += step;
    if (i % 14 == 0) at = {left, at.y + step};
  }
  ImGui::Dummy({14 * step, at.y + step - ImGui::GetCursorScreenPos().y});
}

}  // namespace

Gallery make_gallery() {
  Gallery g;
  g.ranges = {range(-20, 170, 85, 140, 100),  range(-60, 120, 20, 95, 45),
              range(-90, 90, -40, 40, -5),    range(0, 150, 126, 149, 96),
              range(-80, 80, -60, 60, -28),   range(-60, 60, -20, 20, 0),
              range(-25, 30, -10, 10, -3)};
  TimelineModel& t = g.timeline;
  t.end = 6.1;
  t.time = 1.62;
  t.rows = {{"Right arm", true, true, {bump(1.38, 1.76, 0.9f), bump(3.69, 4.08, 0.6f)}, {}},
            {"Left arm", true, false, {}, 0.4},
            {"Legs", false, false, {bump(2.5, 2.6, 0.3f)}, {}}};
  t.window = TimelineWindow{1.2, 2.05, 0};
  t.marks = {{4.1, "grab hat"}, {5.6, "drop", Icon::diamond, true}};
  TimelineCurve before{"before", {}, true, Tone::problem}, after{"after", {}, false, Tone::good};
  for (int i = 0; i <= 183; ++i) {
    const double s = i / 30.0;
    const double dip = 0.09 * std::exp(-std::pow((s - 1.6) / 0.35, 2)),
                 second = 0.07 * std::exp(-std::pow((s - 3.95) / 0.5, 2));
    before.samples.push_back({s, 0.09 - 1.15 * dip - second});
    after.samples.push_back({s, 0.09 - 0.65 * dip - second});
    t.key_times.push_back(s);
  }
  t.curves = {before, after};
  t.threshold = 0;
  return g;
}

void draw_gallery(Ui& ui, Gallery& g) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float menu = ui.px(34), status = ui.px(26), seam = ui.px(4);
  const float body = size.y - menu - status;
  const float x0 = std::max(ui.px(200), std::floor(size.x * static_cast<float>(g.left_ratio)));
  const float x1 = std::min(size.x - ui.px(300), std::floor(size.x * static_cast<float>(g.right_ratio)));
  const float y1 = std::floor(menu + body * static_cast<float>(g.timeline_ratio));
  {
    Panel panel(ui, "Menu", {{0, 0}, {size.x, menu}}, {.scrolls = false});
    inline_text(ui, "Elbowroom");
    ImGui::SameLine();
    icon_button(ui, "Undo", Icon::undo, {.shortcut = "Ctrl Z"});
    ImGui::SameLine();
    icon_button(ui, "Redo", Icon::redo, {.enabled = false});
    ImGui::SameLine(size.x - key_cap_size(ui, "Ctrl P").x - ui.px(12));
    key_cap(ui, "Ctrl P");
  }
  {
    Panel panel(ui, "Outliner", {{0, menu + 1}, {x0 - seam / 2, y1}});
    outliner(ui, g);
  }
  {
    Panel panel(ui, "Viewport", {{x0 + seam / 2, menu + 1}, {x1 - seam / 2, y1}},
                {.ground = PanelGround::ground});
    icons(ui);
    note(ui, "Text in three strengths: 0123456789 1.11 8.88 ° × · – ‹ › ✓ µ … → ≤ − Äß Ωπ Жд");
    label(ui, "Full strength 111.11 cm", "right 3.1 cm");
    label(ui, "Full strength 888.88 cm", "right 4.0 cm", Tone::quiet);
    label(ui, "Faint: read-only, off", "", Tone::faint);
    for (const Tone tone : {Tone::accent, Tone::problem, Tone::good, Tone::selection, Tone::ghost}) {
      inline_text(ui, "Tone", tone);
      ImGui::SameLine();
    }
    ImGui::NewLine();
  }
  {
    Panel panel(ui, "Inspector", {{x1 + seam / 2, menu + 1}, {size.x, y1}});
    inspector(ui, g);
  }
  {
    Panel panel(ui, "Transport", {{0, y1 + seam}, {size.x, y1 + seam + ui.px(44)}},
                {.scrolls = false});
    transport(ui, g);
  }
  {
    Panel panel(ui, "Time", {{0, y1 + seam + ui.px(44)}, {size.x, size.y - status - 1}},
                {.padded = false, .scrolls = false});
    auto events = timeline(ui, "timeline", g.timeline, g.view);
    if (!events.empty()) g.events = std::move(events);
  }
  {
    Panel panel(ui, "Status", {{0, size.y - status}, {size.x, size.y}},
                {.padded = false, .scrolls = false});
    ImGui::SetCursorPos({ui.px(12), ui.px(3)});
    note(ui, ui.hint_text().empty() ? "✓ Past post A: certified, 11 ms" : ui.hint_text(),
         ui.hint_text().empty() ? Tone::good : Tone::quiet);
  }
  splitter_between_columns(ui, "left split", x0, menu, y1, g.left_ratio, size.x);
  splitter_between_columns(ui, "right split", x1, menu, y1, g.right_ratio, size.x);
  splitter_between_rows(ui, "time split", y1 + seam / 2, 0, size.x, g.timeline_ratio, body);
  ask(ui, g.asking, {"Save changes to two-posts.elbow?",
                     "Two corrections and a task are not saved yet.",
                     {"Save", "Discard", "Cancel"}, -1, 1});
}

}  // namespace elbowroom
