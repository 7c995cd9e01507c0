// SPDX-License-Identifier: MIT
#include "ui/toolkit/menus.h"

#include <string>

#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

void push_menu_style(Ui& ui) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(10), ui.px(8)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(14), ui.px(9)});
}

// Escape closes the innermost one; Dear ImGui itself does so only when menus are walked by
// keyboard.
void close_on_escape() {
  if (ImGui::IsWindowFocused() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
    ImGui::CloseCurrentPopup();
}

}  // namespace

bool begin_menu(Ui& ui, std::string_view label, bool enabled) {
  const std::string text(label);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size = size_of(ImGui::GetFont(), shown_part(label));
  ui.record(WidgetKind::menu, label, at, {at.x + size.x, at.y + size.y}, {}, enabled);
  push_menu_style(ui);
  const bool open = ImGui::BeginMenu(text.c_str(), enabled);
  if (open) {
    ui.enter(label);
    close_on_escape();
  } else {
    ImGui::PopStyleVar(2);
  }
  return open;
}

void end_menu(Ui& ui) {
  ui.leave();
  ImGui::EndMenu();
  ImGui::PopStyleVar(2);
}

bool menu_item(Ui& ui, std::string_view label, const MenuItemOptions& options) {
  const std::string text(label), keys(options.shortcut);
  const bool clicked = ImGui::MenuItem(text.c_str(), keys.empty() ? nullptr : keys.c_str(),
                                       options.checked, options.enabled);
  if (ImGui::IsItemHovered() && !options.hint.empty()) ui.hint(options.hint);
  ui.record(WidgetKind::menu_item, label, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), keys,
            options.enabled, options.checked);
  return clicked;
}

void menu_separator(Ui&) { ImGui::Separator(); }

bool begin_popup(Ui& ui, const char* id) {
  push_menu_style(ui);
  const bool open = ImGui::BeginPopup(id);
  if (open) {
    ui.enter(id);
    close_on_escape();
  } else {
    ImGui::PopStyleVar(2);
  }
  return open;
}

void end_popup(Ui& ui) {
  ui.leave();
  ImGui::EndPopup();
  ImGui::PopStyleVar(2);
}

}  // namespace elbowroom
