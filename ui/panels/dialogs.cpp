// SPDX-License-Identifier: MIT
#include "ui/panels/dialogs.h"

#include "ui/actions.h"
#include "ui/toolkit/feedback.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

const std::vector<std::string> kScenes = {".glb", ".gltf", ".vrm", ".elbow"};
const std::vector<std::string> kModels = {".glb", ".gltf", ".vrm"};

// "walk (corrected).glb" beside the character's file, of the same kind.
std::filesystem::path proposed_export(const std::filesystem::path& character) {
  const std::string extension = character.extension().string();
  return character.parent_path() /
         (character.stem().string() + " (corrected)" + (extension == ".gltf" ? extension : ".glb"));
}

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
    case Dialog::limb_joints:
      limb_joints_.draw(context);
      break;
    case Dialog::discard:
    case Dialog::discard_for_opening:
      unsaved(context);
      break;
    case Dialog::recover:
      recover(context);
      break;
    default:
      files(context);
  }
  shown_ = context.view.dialog == Dialog::none ? Dialog::none : shown_;
}

// Where the dialog that has just been asked for begins.
void Dialogs::open_files(const PanelContext& context) {
  const EditorState& state = context.state;
  const auto& character = state.document->scene.character;
  switch (shown_) {
    case Dialog::open:
    case Dialog::add_object:
      open_dialog(file_dialog_, character.empty() ? std::filesystem::current_path()
                                                  : character.parent_path() / "");
      break;
    case Dialog::save_project:
      open_dialog(file_dialog_, character.parent_path() / (character.stem().string() + ".elbow"));
      break;
    case Dialog::export_clip:
      open_dialog(file_dialog_, proposed_export(character));
      break;
    case Dialog::limb_joints:
      limb_joints_.open(context);
      break;
    default:
      break;
  }
}

void Dialogs::files(const PanelContext& context) {
  FileDialogOptions options;
  switch (shown_) {
    case Dialog::open:
      options.title = "Open a character, an object or a project";
      options.extensions = kScenes;
      break;
    case Dialog::add_object:
      options.title = "Add an object";
      options.action = "Add";
      options.extensions = kModels;
      break;
    case Dialog::save_project:
      options.title = "Save project";
      options.action = "Save";
      options.purpose = FilePurpose::save;
      options.extensions = {".elbow"};
      break;
    case Dialog::export_clip:
      options.title = "Export the corrected clip";
      options.action = "Export";
      options.purpose = FilePurpose::save;
      options.extensions = {".glb", ".gltf"};
      break;
    default:
      break;
  }
  const auto path = file_dialog(context.ui, file_dialog_, options);
  if (path) {
    switch (shown_) {
      case Dialog::open:
        context.emit(command::OpenFiles{{*path}});
        break;
      case Dialog::add_object:
        context.emit(command::OpenFiles{{*path}, true});
        break;
      case Dialog::save_project:
        context.emit(command::SaveProject{*path});
        if (after_saving_ == Dialog::discard) context.emit(command::Quit{});
        if (after_saving_ == Dialog::discard_for_opening)
          context.emit(command::AnswerOpening{true});
        break;
      case Dialog::export_clip:
        context.emit(command::Export{*path});
        break;
      default:
        break;
    }
  }
  if (path || !file_dialog_.open) {
    context.view.dialog = Dialog::none;
    after_saving_ = Dialog::none;
  }
}

void Dialogs::shortcuts(const PanelContext& context) {
  Ui& ui = context.ui;
  bool open = true;
  if (begin_dialog(ui, "Keyboard shortcuts", open, {640, 640})) {
    // The columns keep clear of each other.
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(28), ImGui::GetStyle().ItemSpacing.y});
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
    ImGui::PopStyleVar();
    end_dialog(ui);
  }
  if (!open) context.view.dialog = Dialog::none;
}

void Dialogs::recover(const PanelContext& context) {
  using Answer = command::AnswerRecovery::Answer;
  const auto& lost = context.state.lost;
  bool open = lost.has_value();
  Question question;
  question.title = "Recover unsaved work on " + (lost ? lost->name : "") + "?###Recover";
  question.text = "Elbowroom ended without saving what was done until " + (lost ? lost->when : "") +
                  ". Recovered work can be undone, and no file is written over.";
  question.answers = {"Recover", "Discard", "Later"};
  question.dangerous = 1;
  const auto answer = ask(context.ui, open, question);
  if (!answer && open) return;
  context.view.dialog = Dialog::none;
  context.emit(command::AnswerRecovery{answer == 0   ? Answer::recover
                                       : answer == 1 ? Answer::discard
                                                     : Answer::later});
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
  const bool quitting = shown_ == Dialog::discard;
  context.view.dialog = Dialog::none;
  if (answer == 0 && !context.state.has_project) {
    // The save dialog goes on from here.
    after_saving_ = shown_;
    context.view.dialog = Dialog::save_project;
    return;
  }
  if (answer == 0) context.emit(command::SaveProject{});
  if (quitting && answer == 0) context.emit(command::Quit{});
  if (quitting && answer == 1) context.emit(command::Quit{true});
  if (!quitting) context.emit(command::AnswerOpening{answer == 0 || answer == 1});
}

}  // namespace elbowroom
