// SPDX-License-Identifier: MIT
#include "ui/toolkit/buttons.h"

#include <algorithm>

#include "ui/toolkit/geometry.h"

namespace elbowroom {
namespace {

struct Inside {
  float icon = 0, text = 0, shortcut = 0, total = 0;
};

Inside inside_of(const Ui& ui, std::string_view label, const ButtonOptions& options) {
  Inside inside;
  const std::string_view shown = shown_part(label);
  ImFont* font = options.look == ButtonLook::primary ? ui.fonts().semibold : ui.fonts().regular;
  if (options.icon != Icon::none) inside.icon = ui.px(16);
  inside.text = std::ceil(size_of(font, shown).x);
  if (!options.shortcut.empty()) inside.shortcut = std::ceil(size_of(font, options.shortcut).x);
  inside.total = inside.icon + inside.text + inside.shortcut;
  if (inside.icon > 0 && inside.text > 0) inside.total += ui.px(7);
  if (inside.shortcut > 0) inside.total += ui.px(10);
  return inside;
}

struct Face {
  ImU32 ground, line, text;
};

Face face_of(const Ui& ui, ButtonLook look, bool on, bool enabled, bool hovered, bool held) {
  const Palette& p = ui.palette();
  const float lift = !enabled ? 0.0f : held ? 0.14f : hovered ? 0.07f : 0.0f;
  Face face{};
  switch (look) {
    case ButtonLook::primary:
      face = {mixed(p.accent, p.text, held ? 0.3f : hovered ? 0.15f : 0), 0, p.on_accent};
      if (!enabled) face = {mixed(p.raised, p.accent, 0.18f), 0, p.faint};
      break;
    case ButtonLook::secondary:
      face = {mixed(p.raised, p.text, lift), mixed(p.line, p.text, lift), p.text};
      break;
    case ButtonLook::quiet:
      face = {lift > 0 ? mixed(p.panel, p.text, lift) : 0, 0, p.accent};
      break;
    case ButtonLook::danger:
      face = {mixed(p.raised, p.problem, lift > 0 ? 0.22f : 0.1f), mixed(p.line, p.problem, 0.4f),
              p.problem};
      break;
  }
  if (on && look != ButtonLook::primary) {
    face.ground = mixed(p.raised, p.accent, 0.28f + lift);
    face.line = p.accent;
    face.text = p.text;
  }
  if (!enabled && look != ButtonLook::primary) face.text = p.faint;
  return face;
}

// One item of that size: what Dear ImGui's own button does, without its drawing.
struct Pressed {
  bool clicked = false, hovered = false, held = false;
  ImVec2 min, max;
};

Pressed press(std::string_view label, ImVec2 size, bool enabled) {
  Pressed pressed;
  ImGui::PushID(label.data(), label.data() + label.size());
  ImGui::BeginDisabled(!enabled);
  pressed.min = ImGui::GetCursorScreenPos();
  pressed.clicked = ImGui::InvisibleButton("##press", {std::max(1.0f, size.x),
                                                       std::max(1.0f, size.y)});
  pressed.hovered = ImGui::IsItemHovered();
  pressed.held = ImGui::IsItemActive();
  ImGui::EndDisabled();
  ImGui::PopID();
  pressed.max = {pressed.min.x + size.x, pressed.min.y + size.y};
  if (pressed.hovered && enabled) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  return pressed;
}

void focus_ring(const Ui& ui, ImVec2 min, ImVec2 max, float rounding) {
  if (!ImGui::IsItemFocused() || !ImGui::GetIO().NavVisible) return;
  ImGui::GetWindowDrawList()->AddRect({min.x - 2, min.y - 2}, {max.x + 2, max.y + 2},
                                      ui.palette().accent, rounding + 2, 0, 2);
}

}  // namespace

float button_width(const Ui& ui, std::string_view label, const ButtonOptions& options) {
  if (options.width > 0) return ui.px(options.width);
  const float pad = options.look == ButtonLook::quiet ? ui.px(6) : ui.px(12);
  return inside_of(ui, label, options).total + 2 * pad;
}

bool button(Ui& ui, std::string_view label, const ButtonOptions& options) {
  const Inside inside = inside_of(ui, label, options);
  const std::string_view shown = shown_part(label);
  ImFont* font = options.look == ButtonLook::primary ? ui.fonts().semibold : ui.fonts().regular;
  const float rest = ImGui::GetContentRegionAvail().x;
  const ImVec2 size(options.width < 0 ? std::max(ui.px(24), std::floor(rest))
                                      : button_width(ui, label, options),
                    ui.px(ui.theme().metrics.control));
  const Pressed pressed = press(label, size, options.enabled);
  const float rounding = ui.px(ui.theme().metrics.rounding);
  const Face face = face_of(ui, options.look, options.on, options.enabled, pressed.hovered,
                            pressed.held);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (face.ground != 0) list.AddRectFilled(pressed.min, pressed.max, face.ground, rounding);
  if (face.line != 0) list.AddRect(pressed.min, pressed.max, face.line, rounding);
  const float pad = ui.px(4);
  const float room = size.x - 2 * pad;
  float x = pressed.min.x + std::max(pad, std::floor((size.x - inside.total) / 2));
  if (inside.icon > 0) {
    draw_icon(list, options.icon, {x + inside.icon / 2, pressed.min.y + size.y / 2}, inside.icon,
              face.text);
    x += inside.icon + ui.px(7);
  }
  const float text_room = std::min(inside.text + 1, room - (x - pressed.min.x - pad));
  const float text_y = middle(pressed.min.y, size.y, font);
  draw_text(list, font, {x, text_y}, face.text, shown, std::max(1.0f, text_room));
  if (inside.shortcut > 0 && inside.total <= room) {
    draw_text(list, ui.fonts().regular, {x + inside.text + ui.px(10), text_y},
              options.look == ButtonLook::primary && options.enabled
                  ? mixed(face.text, face.ground, 0.22f)
                  : ui.palette().faint,
              options.shortcut);
  }
  focus_ring(ui, pressed.min, pressed.max, rounding);
  explain(ui, options.enabled ? options.hint : options.why_not, {}, options.shortcut);
  ui.record(WidgetKind::button, label, pressed.min, pressed.max, options.on ? "on" : "",
            options.enabled, options.on);
  return pressed.clicked && options.enabled;
}

bool icon_button(Ui& ui, std::string_view name, Icon icon, const IconButtonOptions& options) {
  const float side = ui.px(options.size);
  const Pressed pressed = press(name, {side, side}, options.enabled);
  const float rounding = ui.px(ui.theme().metrics.rounding);
  Face face = face_of(ui, options.look, options.on, options.enabled, pressed.hovered, pressed.held);
  if (options.look == ButtonLook::quiet || options.look == ButtonLook::secondary) {
    face.text = !options.enabled ? with_opacity(ui.palette().faint, 0.55f)
                : options.on     ? ui.palette().accent
                : pressed.hovered ? ui.palette().text
                                  : ui.colour(options.tone);
    if (options.on) face.line = 0;
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (face.ground != 0) list.AddRectFilled(pressed.min, pressed.max, face.ground, rounding);
  if (face.line != 0) list.AddRect(pressed.min, pressed.max, face.line, rounding);
  draw_icon(list, icon, {pressed.min.x + side / 2, pressed.min.y + side / 2},
            std::min(ui.px(16), side - ui.px(4)), face.text);
  focus_ring(ui, pressed.min, pressed.max, rounding);
  explain(ui, options.hint.empty() ? name_part(name) : options.hint, {}, options.shortcut);
  ui.record(WidgetKind::icon_button, name, pressed.min, pressed.max, options.on ? "on" : "",
            options.enabled, options.on);
  return pressed.clicked && options.enabled;
}

bool toggle(Ui& ui, std::string_view label, bool& on, const ToggleOptions& options) {
  const std::string_view shown = shown_part(label);
  ImFont* font = ui.fonts().regular;
  const float height = ui.px(ui.theme().metrics.row);
  const float track_width = ui.px(28), track_height = ui.px(16), gap = ui.px(8);
  const float text_width = std::ceil(size_of(font, shown).x);
  const ImVec2 size(track_width + (shown.empty() ? 0 : gap + text_width), height);
  const Pressed pressed = press(label, size, options.enabled);
  const bool changed = pressed.clicked && options.enabled;
  if (changed) on = !on;
  const Palette& p = ui.palette();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at(pressed.min.x, std::floor(pressed.min.y + (height - track_height) / 2));
  ImU32 ground = on ? p.accent : mixed(p.line, p.text, pressed.hovered ? 0.22f : 0.1f);
  if (!options.enabled) ground = with_opacity(ground, 0.4f);
  list.AddRectFilled(at, {at.x + track_width, at.y + track_height}, ground, track_height / 2);
  const float knob = track_height / 2 - ui.px(2);
  list.AddCircleFilled({on ? at.x + track_width - track_height / 2 : at.x + track_height / 2,
                        at.y + track_height / 2},
                       knob, on ? p.on_accent : options.enabled ? p.handle : p.faint);
  draw_text(list, font, {at.x + track_width + gap, middle(pressed.min.y, height, font)},
            options.enabled ? p.text : p.faint, shown);
  focus_ring(ui, at, {at.x + track_width, at.y + track_height}, track_height / 2);
  explain(ui, options.hint, {}, options.shortcut);
  ui.record(WidgetKind::toggle, label, pressed.min, pressed.max, on ? "on" : "off",
            options.enabled, on);
  return changed;
}

bool toggle_button(Ui& ui, std::string_view label, bool& on, const ButtonOptions& options) {
  ButtonOptions with_state = options;
  with_state.on = on;
  if (!button(ui, label, with_state)) return false;
  on = !on;
  return true;
}

bool tabs(Ui& ui, std::string_view name, const std::vector<std::string>& labels, int& chosen) {
  const int count = static_cast<int>(labels.size());
  if (count == 0) return false;
  const int before = chosen;
  chosen = std::clamp(chosen, 0, count - 1);
  const auto scope = ui.scope(name);
  const float height = ui.px(ui.theme().metrics.control);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts().medium;
  const Palette& p = ui.palette();
  // All in the same narrower padding if they do not fit with the usual one.
  float total = 0;
  for (const std::string& label : labels) total += std::ceil(size_of(font, shown_part(label)).x);
  const float room = ImGui::GetContentRegionAvail().x;
  const float pad = std::clamp(std::floor((room - total) / static_cast<float>(2 * count)),
                               ui.px(3), ui.px(13));
  bool focused = false;
  for (int i = 0; i < count; ++i) {
    const std::string& label = labels[static_cast<std::size_t>(i)];
    const std::string_view shown = shown_part(label);
    const float share = std::floor(room / static_cast<float>(count)) - 2 * pad;
    float text = std::ceil(size_of(font, shown).x);
    if (total + 2 * pad * static_cast<float>(count) > room) text = std::min(text, share);
    const Pressed pressed = press(label, {std::max(text + 2 * pad, 1.0f), height}, true);
    focused |= ImGui::IsItemFocused();
    if (pressed.clicked) chosen = i;
    const bool is_chosen = i == chosen;
    if (is_chosen) {
      list.AddRectFilled(pressed.min, pressed.max, p.raised,
                         ui.px(ui.theme().metrics.rounding), ImDrawFlags_RoundCornersTop);
      list.AddRectFilled({pressed.min.x + pad, pressed.max.y - ui.px(2)},
                         {pressed.max.x - pad, pressed.max.y}, p.accent);
    }
    draw_text(list, font, {pressed.min.x + pad, middle(pressed.min.y, height, font)},
              is_chosen || pressed.hovered ? p.text : p.quiet, shown, text + 0.5f);
    focus_ring(ui, pressed.min, pressed.max, 2);
    ui.record(WidgetKind::tab, label, pressed.min, pressed.max, {}, true, is_chosen);
    if (i + 1 < count) ImGui::SameLine(0, 0);
  }
  if (focused && ImGui::GetIO().NavVisible) {
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_LeftArrow))) chosen = std::max(0, chosen - 1);
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_RightArrow))) {
      chosen = std::min(count - 1, chosen + 1);
    }
  }
  return chosen != before;
}

}  // namespace elbowroom
