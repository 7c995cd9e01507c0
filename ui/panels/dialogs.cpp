// SPDX-License-Identifier: MIT
#include "ui/panels/dialogs.h"

#include "ui/actions.h"
#include "ui/toolkit/feedback.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {


}  // namespace

void Dialogs::draw(const PanelContext& context) {
  if (context.view.dialog != shown_) {
    shown_ = context.view.dialog;
    open_files(context);
  }
  switch (shown_) {
    case Dialog::none:
      break;
    case Dialog::shortcuts:
      shortcuts(context);
      break;
    case Dialog::discard:
      unsaved(context);
      break;
    default:
      files(context);
  }
  shown_ = context.view.dialog == Dialog::none ? Dialog::none : shown_;
}

void Dialogs::open_files(const PanelContext&) {}
void Dialogs::files(const PanelContext& context) { context.view.dialog = Dialog::none; }

void Dialogs::shortcuts(const PanelContext& context) {
  Ui& ui = context.ui;
  bool open = true;
  if (begin_dialog(ui, "Keyboard shortcuts", open, {640, 640})) {
    ImGui::Columns(2, "columns", false);
    for (const std::string_view menu : menus()) {
      bool any = false;
      for (const Action& action : actions()) {
        if (action.menu != menu || action.shortcut.key == Shortcut::none) continue;
        if (!any) heading(ui, menu);
        any = true;
        label(ui, action.title, shortcut_text(action.shortcut), Tone::text, Tone::accent);
      }
      if (menu == "View") ImGui::NextColumn();
    }
    heading(ui, "Mouse in the picture");
    const bool maya = context.view.navigation == Navigation::maya;
    label(ui, "Choose a limb", "Click");
    label(ui, "Orbit", maya ? "Alt left drag" : "Left or middle drag");
    label(ui, "Pan", maya ? "Alt middle drag" : "Right or Shift middle drag");
    label(ui, "Zoom", maya ? "Wheel, Alt right drag" : "Wheel, Ctrl middle drag");
    ImGui::Columns(1);
    end_dialog(ui);
  }
  if (!open) context.view.dialog = Dialog::none;
}

void Dialogs::unsaved(const PanelContext& context) {
  bool open = true;
  Question question;
  question.title = "Save changes to " + context.state.name + "?";
  question.text = "The window, targets and corrections made since the last save would be lost.";
  question.answers = {"Save", "Discard", "Cancel"};
  question.dangerous = 1;
  const auto answer = ask(context.ui, open, question);
  if (!answer && open) return;
  context.view.dialog = Dialog::none;
  if (answer == 0) {
    if (context.state.has_project) {
      context.emit(command::SaveProject{});
      context.emit(command::Quit{});
    } else {
      quit_after_saving_ = true;
      context.view.dialog = Dialog::save_project;
    }
  } else if (answer == 1) {
    context.emit(command::Quit{true});
  }
}

}  // namespace elbowroom
