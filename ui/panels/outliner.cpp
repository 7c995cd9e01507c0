// SPDX-License-Identifier: MIT
// What the scene holds: the character with its limbs and how they fare, the objects, the stack of
// corrections.
#include <algorithm>
#include <utility>

#include "ui/panels/panel.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/lists.h"
#include "ui/toolkit/menus.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

std::string thousands(int triangles) {
  if (triangles < 1000) return std::to_string(triangles) + " tris";
  return number_text(triangles / 1000.0, 1) + "k tris";
}

void draw_limb(const PanelContext& context, int index) {
  const EditorState& state = context.state;
  const LimbModel& limb = state.session->limbs[static_cast<std::size_t>(index)];
  RowOptions row;
  row.indent = 1;
  row.icon = Icon::dot;
  row.selected = state.limb == index;
  row.hint = "Click: work on this limb · Double-click: its first problem · Right click: its joints";
  std::string badge;
  const auto& strip = state.strip;
  if (!strip || !strip->complete() || !state.strip_is_current) {
    row.icon = Icon::ring;
    row.icon_tone = Tone::faint;
    row.right = state.source ? "looking…" : "";
  } else {
    const auto problems = strip->limbs[static_cast<std::size_t>(index)].windows.size();
    if (problems == 0) {
      row.icon_tone = Tone::good;
      row.right = "clear";
    } else {
      row.icon_tone = Tone::problem;
      badge = std::to_string(problems) + (problems == 1 ? " problem" : " problems");
      row.badge = badge;
    }
  }
  const auto scope = context.ui.scope(1000 + index);
  const RowResult result = list_row(context.ui, limb_title(limb.limb.name), row);
  if (result.context) ImGui::OpenPopup("limb");
  if (begin_popup(context.ui, "limb")) {
    if (menu_item(context.ui, "Choose joints…")) {
      context.view.joints_of = limb.limb.name;
      context.view.dialog = Dialog::limb_joints;
    }
    if (menu_item(context.ui, "Not a limb"))
      context.emit(command::SetLimbJoints{limb.limb.name, LimbJoints{}});
    end_popup(context.ui);
  }
  if (result.double_clicked)
    context.emit(command::SelectProblem{index, 0});
  else if (result.clicked)
    context.emit(command::SelectLimb{index});
}

void object_menu(const PanelContext& context, const std::filesystem::path& file, bool held) {
  if (!begin_popup(context.ui, "object")) return;
  for (const LimbModel& limb : context.state.session->limbs) {
    if (!limb.limb.is_arm()) continue;
    const auto& joints = context.state.session->scene.model().skeleton.joints;
    const std::string& joint = joints[static_cast<std::size_t>(limb.limb.end)].name;
    if (!joint.empty() && menu_item(context.ui, limb.limb.is_left() ? "Hold in the left hand"
                                                                    : "Hold in the right hand"))
      context.emit(command::AttachObject{file, joint});
  }
  if (held && menu_item(context.ui, "Put down")) context.emit(command::AttachObject{file, ""});
  menu_separator(context.ui);
  if (menu_item(context.ui, "Remove from the scene")) context.emit(command::RemoveObject{file});
  end_popup(context.ui);
}

// "right hand" for what hangs on the end of an arm, else the joint's own name.
std::string holder_of(const EditorState& state, const std::string& joint) {
  const auto& joints = state.session->scene.model().skeleton.joints;
  for (const LimbModel& limb : state.session->limbs)
    if (limb.limb.is_arm() && joints[static_cast<std::size_t>(limb.limb.end)].name == joint)
      return limb.limb.is_left() ? "left hand" : "right hand";
  return joint;
}

void draw_object(const PanelContext& context, int number, const std::filesystem::path& file,
                 const std::string& held_by) {
  const auto scope = context.ui.scope(number);
  RowOptions row;
  row.indent = 1;
  row.icon = Icon::none;
  const std::string right = held_by.empty() ? "obstacle" : holder_of(context.state, held_by);
  row.right = right;
  row.hint = "Right click to put it into a hand or to take it out of the scene";
  if (list_row(context.ui, file.stem().string(), row).context) ImGui::OpenPopup("object");
  object_menu(context, file, !held_by.empty());
}

void draw_scene(const PanelContext& context) {
  const EditorState& state = context.state;
  const Character& character = state.session->character();
  heading(context.ui, "Scene");
  RowOptions row;
  row.icon = Icon::none;
  const std::string triangles = thousands(character.triangles);
  row.right = triangles;
  row.hint = character.name;
  // The file is what people know it by; its topmost node is often called Armature.
  list_row(context.ui, state.document->scene.character.stem().string(), row);
  for (std::size_t i = 0; i < state.session->limbs.size(); ++i)
    draw_limb(context, static_cast<int>(i));
  const SceneDescription& scene = state.document->scene;
  const std::size_t objects = scene.obstacles.size() + scene.attachments.size();
  if (objects == 0) return;
  RowOptions head;
  const std::string count = std::to_string(objects);
  head.right = count;
  list_row(context.ui, "Objects", head);
  int number = 0;
  for (const auto& attached : scene.attachments)
    draw_object(context, number++, attached.file, attached.joint);
  for (const auto& obstacle : scene.obstacles) draw_object(context, number++, obstacle, "");
}

void begin_rename(const PanelContext& context, int index) {
  const auto& corrections = context.state.document->corrections;
  context.view.rename = {index, corrections[static_cast<std::size_t>(index)].name, true};
}

// The row while its name is typed: Enter and a click elsewhere keep it, Escape gives it up.
void draw_name_field(const PanelContext& context) {
  ViewState::Rename& rename = context.view.rename;
  TextOptions options;
  options.label_shown = false;
  options.focus = std::exchange(rename.begins, false);
  options.hint = "Enter keeps the name, Esc gives it up";
  const TextEdit edit = text_input(context.ui, "Correction name", rename.text, options);
  if (!edit.cancelled && (edit.entered || edit.committed) && !rename.text.empty())
    context.emit(command::RenameCorrection{rename.correction, rename.text});
  if (edit.entered || edit.committed || edit.cancelled || ImGui::IsItemDeactivated()) rename = {};
}

void correction_menu(const PanelContext& context, int index, const Correction& correction) {
  if (!begin_popup(context.ui, "correction")) return;
  if (menu_item(context.ui, "Rename", {.shortcut = "F2"})) begin_rename(context, index);
  if (menu_item(context.ui, "Go to its beginning"))
    context.emit(command::Scrub{static_cast<double>(correction.begin)});
  if (menu_item(context.ui, "Replan")) context.emit(command::ReplanCorrection{index});
  if (menu_item(context.ui, correction.muted ? "Unmute" : "Mute"))
    context.emit(command::MuteCorrection{index});
  menu_separator(context.ui);
  if (menu_item(context.ui, "Delete")) context.emit(command::DeleteCorrection{index});
  end_popup(context.ui);
}

void draw_correction(const PanelContext& context, int index) {
  const EditorState& state = context.state;
  const auto n = static_cast<std::size_t>(index);
  const Correction& correction = state.document->corrections[n];
  const auto scope = context.ui.scope(index);
  if (context.view.rename.correction == index) {
    draw_name_field(context);
    return;
  }
  RowOptions row;
  const bool fits = n >= state.corrections.size() || state.corrections[n].fits;
  row.icon = correction.muted ? Icon::ring : fits ? Icon::dot : Icon::warning;
  row.icon_tone = correction.muted ? Tone::faint : fits ? Tone::good : Tone::problem;
  row.tone = correction.muted ? Tone::faint : Tone::text;
  row.selected = state.selected_correction == index;
  row.selected_tone = Tone::good;
  row.actions = {{Icon::refresh, "Replan", false, true},
                 {correction.muted ? Icon::eye_off : Icon::eye, "Mute", correction.muted, true},
                 {Icon::trash, "Delete", false, true}};
  if (!fits)
    row.hint = state.corrections[n].problem;
  else
    row.hint = correction.muted ? "Muted: the motion goes on without it"
                                : "Lies over the clip · Double-click or F2: rename · Right click: "
                                  "more";
  const RowResult result = list_row(context.ui, correction.name, row);
  if (result.action == 0) context.emit(command::ReplanCorrection{index});
  if (result.action == 1) context.emit(command::MuteCorrection{index});
  if (result.action == 2) context.emit(command::DeleteCorrection{index});
  if (result.clicked) context.emit(command::SelectCorrection{index});
  if (result.double_clicked) begin_rename(context, index);
  if (result.context) ImGui::OpenPopup("correction");
  correction_menu(context, index, correction);
}

void draw_corrections(const PanelContext& context) {
  const EditorState& state = context.state;
  const auto& corrections = state.document->corrections;
  const auto own = [&](std::size_t n) {
    return n >= state.corrections.size() || state.corrections[n].of_this_clip;
  };
  std::size_t count = 0;
  for (std::size_t n = 0; n < corrections.size(); ++n) count += own(n) ? 1 : 0;
  const std::size_t others = corrections.size() - count;
  heading(context.ui, "Corrections", count == 0 ? "" : std::to_string(count));
  if (count == 0)
    note(context.ui, "Plans that you accept are kept here, over the clip.", Tone::faint);
  // The newest lies on top, as in any stack of layers; the clip under all.
  for (std::size_t n = corrections.size(); n-- > 0;)
    if (own(n)) draw_correction(context, static_cast<int>(n));
  if (context.view.rename.correction >= static_cast<int>(corrections.size()))
    context.view.rename = {};
  RowOptions clip;
  clip.icon = Icon::dotted_ring;
  clip.icon_tone = Tone::faint;
  clip.tone = Tone::faint;
  clip.right = "source";
  const std::string name = state.session->clip_name();
  if (state.source) list_row(context.ui, name, clip);
  if (others > 0)
    note(context.ui,
         std::to_string(others) +
             (others == 1 ? " more is kept for another clip." : " more are kept for other clips."),
         Tone::faint);
}

}  // namespace

void draw_outliner(const PanelContext& context, const Rect& rect) {
  const Panel panel(context.ui, "Outliner", rect);
  if (!context.state.open()) {
    heading(context.ui, "Scene");
    note(context.ui, "Nothing is open.", Tone::faint);
    return;
  }
  draw_scene(context);
  separator(context.ui);
  draw_corrections(context);
}

}  // namespace elbowroom
