// SPDX-License-Identifier: MIT
// The hand target: where, when, which way; and whether the limb gets there.
#include <cmath>

#include "ui/euler_angles.h"
#include "ui/panels/panel.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/feedback.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

const char* end_name(const LimbModel& limb) {
  if (limb.limb.kind == LimbKind::chain) return "end";
  return limb.limb.is_arm() ? "hand" : "foot";
}

void target_numbers(const PanelContext& context, const HandTarget& target) {
  Ui& ui = context.ui;
  heading(ui, "Position", "world");
  HandTarget next = target;
  Edit edit;
  const auto note_edit = [&edit](const Edit& one) {
    if (one || one.cancelled || one.began) edit = one;
  };
  const char* names[3] = {"X", "Y", "Z"};
  for (int i = 0; i < 3; ++i) {
    NumberOptions options;
    options.unit = "m";
    options.decimals = 3;
    options.hint = "Drag, or double-click to type";
    note_edit(number_input(ui, names[i], next.position[i], options));
  }
  heading(ui, "Orientation", target.orientation ? "" : "free");
  bool fixed = target.orientation.has_value();
  ToggleOptions toggle_options;
  toggle_options.hint = "Off: the wrist may turn as it likes";
  if (toggle(ui, "Keep the hand's orientation", fixed, toggle_options)) {
    context.emit(command::KeepOrientation{fixed});
    return;
  }
  if (target.orientation) {
    Vec3& shown = context.view.turns;
    shown = euler_degrees_near(*target.orientation, shown);
    Vec3 angles = shown;
    const char* turns[3] = {"Turn X", "Turn Y", "Turn Z"};
    bool turned = false;
    for (int i = 0; i < 3; ++i) {
      NumberOptions options;
      options.unit = "°";
      options.decimals = 1;
      const Edit one = number_input(ui, turns[i], angles[i], options);
      turned |= static_cast<bool>(one);
      note_edit(one);
    }
    if (turned) {
      shown = angles;
      next.orientation = from_euler_degrees(angles);
    }
  }
  if (edit.cancelled)
    context.emit(command::SetTarget{target, Phase::cancelled});
  else if (edit)
    context.emit(command::SetTarget{next, edit.committed ? Phase::committed : Phase::changing});
}

void status(const PanelContext& context) {
  Tone tone = Tone::quiet;
  switch (context.state.target.status) {
    case TargetView::Status::none:
      return;
    case TargetView::Status::solving:
      break;
    case TargetView::Status::solved:
      tone = Tone::good;
      break;
    default:
      tone = Tone::problem;
  }
  inline_note(context.ui, tone, context.state.target.text);
}

}  // namespace

void draw_target_tab(const PanelContext& context) {
  Ui& ui = context.ui;
  const LimbModel& limb = *context.state.limb_model();
  const auto& target = context.state.document->draft.target;
  const std::string name = end_name(limb);
  if (!target) {
    context.view.turns = Vec3(0);
    heading(ui, "No target");
    note(ui, "A target is where the " + name +
                 " shall be at a time. Plan then finds a motion that goes there and comes back.");
    space(ui);
    ButtonOptions here;
    here.icon = Icon::target;
    here.shortcut = "T";
    const std::string here_hint = "Start from where the " + name + " is now, then drag it";
    here.hint = here_hint;
    if (button(ui, "Target where the " + name + " is###Target here", here))
      context.emit(command::TargetFromPosture{});
    ButtonOptions place;
    place.icon = Icon::plus;
    place.shortcut = "Shift T";
    place.on = context.view.placing_target;
    place.hint = "The next click on a body or an object puts the target on its surface";
    if (button(ui, "Place on a surface", place))
      context.view.placing_target = !context.view.placing_target;
    return;
  }
  status(context);
  const bool here = std::abs(context.state.time - target->time) < 0.5 / context.state.frame_rate;
  HandTarget moved = *target;
  NumberOptions time;
  time.unit = "s";
  time.decimals = 2;
  time.minimum = context.state.begin;
  time.maximum = context.state.end;
  time.hint = "When the hand is to be there";
  const Edit at = number_input(ui, "At", moved.time, time);
  if (at.cancelled)
    context.emit(command::SetTarget{target, Phase::cancelled});
  else if (at)
    context.emit(command::SetTarget{moved, at.committed ? Phase::committed : Phase::changing,
                                    "Time of hand target"});
  ButtonOptions go;
  go.look = ButtonLook::quiet;
  go.enabled = !here;
  go.why_not = "This is the target's time";
  if (button(ui, "Go there", go)) context.emit(command::Scrub{target->time});
  ImGui::SameLine();
  ButtonOptions now;
  now.look = ButtonLook::quiet;
  now.enabled = !here;
  now.why_not = "This is the target's time";
  if (button(ui, "Set to now", now)) {
    HandTarget next = *target;
    next.time = context.state.time;
    context.emit(command::SetTarget{next, Phase::committed, "Time of hand target"});
  }
  target_numbers(context, *target);
  space(ui, 4);
  int mode = static_cast<int>(context.view.gizmo_mode);
  if (tabs(ui, "Gizmo", {"Move  G", "Turn  R"}, mode))
    context.view.gizmo_mode = static_cast<GizmoMode>(mode);
  ImGui::SameLine();
  bool local = context.view.gizmo_space == GizmoSpace::local;
  ButtonOptions space_options;
  space_options.shortcut = "X";
  space_options.hint = "Handles along the hand's own axes instead of the world's";
  if (toggle_button(ui, "Own axes", local, space_options))
    context.view.gizmo_space = local ? GizmoSpace::local : GizmoSpace::world;
  ButtonOptions remove;
  remove.icon = Icon::trash;
  remove.hint = "Plan without a target";
  if (button(ui, "Remove target", remove)) context.emit(command::SetTarget{std::nullopt});
}

}  // namespace elbowroom
