// SPDX-License-Identifier: MIT
#include "ui/toolkit/layout.h"

#include <imgui_internal.h>

#include <algorithm>
#include <optional>

#include "ui/toolkit/icons.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

Edit splitter(Ui& ui, std::string_view name, const Rect& line, bool columns, double& ratio,
              float extent, double least, double most, double reset_to) {
  Edit edit;
  if (least > most) std::swap(least, most);
  const auto put_right = [least, most](double value) {
    return std::clamp(std::isfinite(value) ? value : 0.5, least, most);
  };
  ratio = put_right(ratio);
  const float grip = ui.px(4);
  Rect area = line;
  if (columns) {
    area.min.x -= grip;
    area.max.x += grip;
  } else {
    area.min.y -= grip;
    area.max.y += grip;
  }
  ImGui::SetNextWindowPos(area.min);
  ImGui::SetNextWindowSize({std::max(1.0f, area.width()), std::max(1.0f, area.height())});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(std::string(name).c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::InvisibleButton("grip", {std::max(1.0f, area.width()), std::max(1.0f, area.height())});
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  if (hovered || active) {
    ImGui::SetMouseCursor(columns ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ui.hint("Drag: resize · Double-click: usual size");
  }
  std::vector<double>& memory = ui.memory(ImGui::GetID("grip"));  // ratio at the beginning, moved
  if (memory.size() != 2) memory.assign(2, 0);
  if (ImGui::IsItemActivated()) {
    memory = {ratio, 0};
    edit.began = true;
  }
  if (hovered && ImGui::IsMouseDoubleClicked(0)) {
    const double before = ratio;
    ratio = put_right(reset_to);
    edit.changed = ratio != before;
  } else if (active && extent > 0 && ImGui::IsMouseDragging(0, 0)) {
    const ImVec2 dragged = ImGui::GetMouseDragDelta(0, 0);
    const double wanted =
        put_right(memory[0] + static_cast<double>((columns ? dragged.x : dragged.y) / extent));
    edit.changed = wanted != ratio;
    ratio = wanted;
  }
  if (ImGui::IsItemDeactivated()) edit.committed = ratio != memory[0];
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = hovered || active ? ui.palette().accent : ui.palette().ground;
  list.AddRectFilled(line.min, line.max, ink);
  ui.record(WidgetKind::splitter, name, area.min, area.max, number_text(100 * ratio, 0, "%"));
  ImGui::End();
  ImGui::PopStyleVar(2);
  return edit;
}

struct Keys {
  bool control = false, shift = false, alt = false;
  int code = -1;
};

std::optional<Keys> parse_keys(std::string_view text) {
  Keys keys;
  while (true) {
    const auto take = [&text](std::string_view prefix) {
      if (text.size() <= prefix.size() || !text.starts_with(prefix)) return false;
      text.remove_prefix(prefix.size());
      return true;
    };
    if (take("Ctrl+") || take("Ctrl ")) {
      keys.control = true;
    } else if (take("Shift+") || take("Shift ")) {
      keys.shift = true;
    } else if (take("Alt+") || take("Alt ")) {
      keys.alt = true;
    } else {
      break;
    }
  }
  // GLFW's codes: printable keys are the US layout's ASCII capitals.
  struct Named {
    std::string_view name;
    int code;
  };
  static constexpr Named kNamed[] = {
      {"Space", 32},   {"Esc", 256},    {"Enter", 257},    {"Tab", 258},  {"Backspace", 259},
      {"Insert", 260}, {"Delete", 261}, {"Right", 262},    {"Left", 263}, {"Down", 264},
      {"Up", 265},     {"PageUp", 266}, {"PageDown", 267}, {"Home", 268}, {"End", 269}};
  for (const Named& named : kNamed) {
    if (text == named.name) keys.code = named.code;
  }
  if (text == "?") {
    keys.shift = true;
    keys.code = '/';
  } else if (text.size() == 1 && text[0] > ' ' && text[0] < 127) {
    keys.code = text[0] >= 'a' && text[0] <= 'z' ? text[0] - 'a' + 'A' : text[0];
  } else if (keys.code < 0 && text.size() >= 2 && text[0] == 'F') {
    int number = 0;
    for (const char c : text.substr(1)) {
      if (c < '0' || c > '9' || number > 25) return std::nullopt;
      number = 10 * number + (c - '0');
    }
    if (number >= 1 && number <= 25) keys.code = 289 + number;
  }
  if (keys.code < 0) return std::nullopt;
  return keys;
}

}  // namespace

Panel::Window::Window(Ui& ui, std::string_view name, const Rect& place,
                      const PanelOptions& options) {
  const Palette& p = ui.palette();
  ImGui::SetNextWindowPos(place.min);
  ImGui::SetNextWindowSize({std::max(1.0f, place.width()), std::max(1.0f, place.height())});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  if (!options.padded) ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, options.ground == PanelGround::panel    ? p.panel
                                           : options.ground == PanelGround::raised ? p.raised
                                           : options.ground == PanelGround::none
                                               ? with_opacity(p.ground, 0)
                                               : p.ground);
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                           ImGuiWindowFlags_NoSavedSettings |
                           ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (!options.scrolls) {
    flags |= ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  }
  ImGui::Begin(std::string(name).c_str(), nullptr, flags);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(options.padded ? 1 : 2);
  ui.record(WidgetKind::panel, name, place.min, place.max);
}

Panel::Window::~Window() { ImGui::End(); }

Panel::Panel(Ui& ui, std::string_view name, const Rect& place, const PanelOptions& options)
    : window_(ui, name, place, options), scope_(ui, name) {}

Panel::~Panel() = default;

float panel_content_height(std::string_view name) {
  const ImGuiWindow* window = ImGui::FindWindowByName(std::string(name).c_str());
  if (!window) return 0;
  // Its ContentSize is what the last frame but one held, until the next Begin.
  return window->DC.CursorMaxPos.y - window->DC.CursorStartPos.y + 2 * window->WindowPadding.y;
}

Edit splitter_between_columns(Ui& ui, std::string_view name, float x, float top, float bottom,
                              double& ratio, float extent, double least, double most,
                              double reset_to) {
  const float left = std::floor(x - ui.px(2));
  return splitter(ui, name, {{left, top}, {left + ui.px(4), bottom}}, true, ratio, extent, least,
                  most, reset_to);
}

Edit splitter_between_rows(Ui& ui, std::string_view name, float y, float left, float right,
                           double& ratio, float extent, double least, double most,
                           double reset_to) {
  const float top = std::floor(y - ui.px(2));
  return splitter(ui, name, {{left, top}, {right, top + ui.px(4)}}, false, ratio, extent, least,
                  most, reset_to);
}

bool keys_pressed(std::string_view text, bool repeat) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return false;
  const std::optional<Keys> keys = parse_keys(text);
  if (!keys || keys->control != io.KeyCtrl || keys->shift != io.KeyShift ||
      keys->alt != io.KeyAlt || io.KeySuper) {
    return false;
  }
  return ImGui::IsKeyPressed(keys->code, repeat);
}

}  // namespace elbowroom
