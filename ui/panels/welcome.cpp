// SPDX-License-Identifier: MIT
// What the viewport says while nothing is open.
#include "ui/panels/panel.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/lists.h"
#include "ui/toolkit/text.h"

namespace elbowroom {

void draw_welcome(const PanelContext& context, const Rect& rect) {
  Ui& ui = context.ui;
  if (context.state.opening.active) return;  // the status line tells
  const float width = ui.px(420);
  const float left = std::floor(0.5f * (rect.min.x + rect.max.x) - 0.5f * width);
  const Panel panel(
      ui, "Welcome",
      {{left, std::floor(rect.min.y + 0.28f * rect.height())}, {left + width, rect.max.y}},
      {PanelGround::none, true, false});
  title(ui, "Open a character");
  note(ui,
       "Drop a glTF file with a skinned, animated figure here, and objects to go with it; or a "
       "project.");
  space(ui);
  ButtonOptions open;
  open.look = ButtonLook::primary;
  open.icon = Icon::folder;
  open.shortcut = "Ctrl O";
  if (button(ui, "Open…", open)) context.view.dialog = Dialog::open;
  ImGui::SameLine(0, ui.px(ui.theme().metrics.gap));
  if (button(ui, "Open the demo")) context.emit(command::OpenDemo{});
  if (context.state.recent_files.empty()) return;
  space(ui);
  heading(ui, "Recent");
  int number = 0;
  for (const std::string& file : context.state.recent_files) {
    if (number >= 6) break;
    const auto scope = ui.scope(number++);
    const std::filesystem::path path(file);
    const std::string folder = path.parent_path().filename().string();
    RowOptions row;
    row.icon = Icon::file;
    row.right = folder;
    row.hint = file;
    if (list_row(ui, path.filename().string(), row).clicked)
      context.emit(command::OpenFiles{{path}});
  }
}

}  // namespace elbowroom
