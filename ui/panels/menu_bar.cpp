// SPDX-License-Identifier: MIT
// The bar at the top: the program's name, the menus, what is open, undo and redo at hand.
#include <algorithm>
#include <cmath>

#include "ui/actions.h"
#include "ui/panels/panel.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/menus.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

// "Undo Set window" says what would be undone.
std::string title_of(const Action& action, const EditorState& state) {
  std::string title(action.title);
  if (title == "Undo" && !state.undo_name.empty()) title += " “" + state.undo_name + "”";
  if (title == "Redo" && !state.redo_name.empty()) title += " “" + state.redo_name + "”";
  return title;
}

void draw_menu(const PanelContext& context, std::string_view menu) {
  for (const Action& action : actions()) {
    if (action.menu != menu) continue;
    if (action.separated) menu_separator(context.ui);
    MenuItemOptions options;
    const std::string keys = shortcut_text(action.shortcut);
    options.shortcut = keys;
    options.enabled = is_enabled(action, context.state, context.view);
    options.checked = action.checked && action.checked(context.state, context.view);
    const std::string label = title_of(action, context.state) + "###" + std::string(action.title);
    if (menu_item(context.ui, label, options))
      action.run(context.state, context.view, context.commands);
  }
  if (menu != "File" || context.state.recent_files.empty()) return;
  menu_separator(context.ui);
  if (begin_menu(context.ui, "Open recent")) {
    for (const std::string& file : context.state.recent_files)
      if (menu_item(context.ui, file)) context.emit(command::OpenFiles{{file}});
    end_menu(context.ui);
  }
}

// The menus in a window of their own: Dear ImGui has a menu bar only at a window's top.
void draw_menus(const PanelContext& context, const Rect& rect) {
  Ui& ui = context.ui;
  ImGui::SetNextWindowPos(rect.min);
  ImGui::SetNextWindowSize({rect.width(), rect.height()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  const float air = std::floor(0.5f * (rect.height() - ui.fonts().regular->FontSize));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(8), std::max(1.0f, air)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(16), ui.px(6)});
  ImGui::PushStyleColor(ImGuiCol_MenuBarBg, 0);
  ImGui::Begin("Menus", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_MenuBar);
  if (ImGui::BeginMenuBar()) {
    for (const std::string_view menu : menus())
      if (begin_menu(ui, menu)) {
        draw_menu(context, menu);
        end_menu(ui);
      }
    ImGui::EndMenuBar();
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(5);
}

// Where the menus begin, and about where they end.
float menus_begin(const Ui& ui) {
  return size_of(ui.fonts().semibold, "Elbowroom").x + 2 * ui.px(ui.theme().metrics.padding);
}
float menus_end(const Ui& ui) {
  float x = menus_begin(ui);
  for (const std::string_view menu : menus()) x += size_of(ui.fonts().regular, menu).x + ui.px(28);
  return x;
}

void draw_bar(const PanelContext& context, const Rect& rect) {
  Ui& ui = context.ui;
  const float pad = ui.px(ui.theme().metrics.padding);
  const Panel panel(ui, "Menu", rect, {PanelGround::panel, false, false});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* bold = ui.fonts().semibold;
  draw_text(list, bold, {rect.min.x + pad, middle(rect.min.y, rect.height(), bold)},
            ui.colour(Tone::text), "Elbowroom");
  // What is open, in the middle, or beside the menus where they reach so far.
  if (context.state.open()) {
    ImFont* font = ui.fonts().regular;
    const std::string& text = context.state.name;
    ImVec2 size = size_of(font, text);
    const float x = std::max(std::floor(0.5f * (rect.min.x + rect.max.x) - 0.5f * size.x),
                             std::floor(rect.min.x + menus_end(ui) + ui.px(20)));
    const float y = middle(rect.min.y, rect.height(), font);
    size.x = std::clamp(rect.max.x - ui.px(110) - x, 1.0f, size.x);
    draw_text(list, font, {x, y}, ui.colour(Tone::text), text, size.x);
    if (context.state.dirty)
      draw_icon(list, Icon::dot, {x + size.x + ui.px(13), rect.min.y + 0.5f * rect.height()},
                ui.px(14), ui.colour(Tone::selection));
    ui.record(WidgetKind::label, "Document", {x, y}, {x + size.x, y + size.y},
              context.state.dirty ? text + ", not saved" : text);
  }
  // Undo and redo.
  const float button = ui.px(28);
  const float top = rect.min.y + std::floor(0.5f * (rect.height() - button));
  ImGui::SetCursorScreenPos({rect.max.x - pad - 2 * button - ui.px(4), top});
  IconButtonOptions undo;
  undo.shortcut = "Ctrl Z";
  undo.enabled = !context.state.undo_name.empty();
  const std::string undo_hint = "Undo " + context.state.undo_name;
  undo.hint = undo_hint;
  if (icon_button(ui, "Undo", Icon::undo, undo)) context.emit(command::Undo{});
  ImGui::SetCursorScreenPos({rect.max.x - pad - button, top});
  IconButtonOptions redo;
  redo.shortcut = "Ctrl Shift Z";
  redo.enabled = !context.state.redo_name.empty();
  const std::string redo_hint = "Redo " + context.state.redo_name;
  redo.hint = redo_hint;
  if (icon_button(ui, "Redo", Icon::redo, redo)) context.emit(command::Redo{});
}

}  // namespace

void draw_menu_bar(const PanelContext& context, const Rect& rect) {
  const Ui& ui = context.ui;
  const float name = menus_begin(ui);
  draw_bar(context, rect);
  draw_menus(context, {{rect.min.x + name, rect.min.y}, {rect.max.x - ui.px(90), rect.max.y}});
}

}  // namespace elbowroom
