// SPDX-License-Identifier: MIT
// Menus: the bar's and those that pop up, recorded for tests.
//   if (begin_menu(ui, "File")) {
//     if (menu_item(ui, "Open…", {.shortcut = "Ctrl+O"})) …
//     end_menu(ui);
//   }
#pragma once

#include <string_view>

#include "ui/toolkit/ui.h"

namespace elbowroom {

// A menu of the bar (inside ImGui::BeginMenuBar or BeginMainMenuBar) or of another menu. Items
// inside are named "File/Open…".
bool begin_menu(Ui& ui, std::string_view label, bool enabled = true);
void end_menu(Ui& ui);

struct MenuItemOptions {
  std::string_view shortcut = {};  // shown only; keys_pressed (layout.h) acts
  bool checked = false;
  bool enabled = true;
  std::string_view hint = {};
};
bool menu_item(Ui& ui, std::string_view label, const MenuItemOptions& options = {});
void menu_separator(Ui& ui);

// A context menu: opened by ImGui::OpenPopup(id) in the same id scope; then end_popup.
bool begin_popup(Ui& ui, const char* id);
void end_popup(Ui& ui);

}  // namespace elbowroom
