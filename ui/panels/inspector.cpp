// SPDX-License-Identifier: MIT
// The inspector: how the selected limb is planned, in three tabs.
#include <algorithm>

#include "ui/panels/panel.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/feedback.h"
#include "ui/toolkit/lists.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

std::string joints_of(const LimbModel& limb) {
  switch (limb.limb.kind) {
    case LimbKind::left_arm:
    case LimbKind::right_arm:
      return "shoulder · elbow · wrist";
    case LimbKind::left_leg:
    case LimbKind::right_leg:
      return "hip · knee · ankle";
    case LimbKind::chain:
      break;
  }
  return std::to_string(limb.limb.joints.size()) + " joints";
}

// The limbs as a list to choose from, while none is chosen.
void choose_limb(const PanelContext& context) {
  title(context.ui, "Choose a limb");
  note(context.ui,
       "Click an arm or a leg in the picture, a red mark in the timeline, or one of these:");
  space(context.ui);
  for (std::size_t i = 0; i < context.state.session->limbs.size(); ++i) {
    RowOptions row;
    row.icon = Icon::dot;
    if (list_row(context.ui, limb_title(context.state.session->limbs[i].limb.name), row).clicked)
      context.emit(command::SelectLimb{static_cast<int>(i)});
  }
  if (context.state.session->limbs.empty())
    inline_note(context.ui, Tone::problem, "No limb was found on this character",
                "Neither its joints' names nor its shape say which they are.");
  space(context.ui);
  if (button(context.ui, "Choose joints…",
             {.hint = "Says which joints a limb has, or adds a chain"}))
    context.view.dialog = Dialog::limb_joints;
}

}  // namespace

void draw_inspector(const PanelContext& context, const Rect& rect) {
  Ui& ui = context.ui;
  context.view.swing_in_picture = false;  // the map says so, where it is shown
  const bool planning = context.state.open() && context.state.limb >= 0;
  // The tabs' own line stays whatever the plan has to say.
  const float foot = planning ? std::min(plan_section_height(context),
                                         std::max(rect.height() - ui.px(52), 0.4f * rect.height()))
                              : 0.0f;
  if (planning) {
    const Panel panel(ui, "Plan", {{rect.min.x, rect.max.y - foot}, rect.max});
    draw_plan_section(context);
  }
  const Panel panel(ui, "Inspector", {rect.min, {rect.max.x, rect.max.y - foot}});
  if (!context.state.open()) {
    note(ui, "The selected limb's panel.", Tone::faint);
    return;
  }
  const LimbModel* limb = context.state.limb_model();
  if (!limb) {
    choose_limb(context);
    return;
  }
  int chosen = static_cast<int>(context.view.tab);
  if (tabs(ui, "Tabs", {"Limb", "Target", "Planner"}, chosen))
    context.view.tab = static_cast<InspectorTab>(chosen);
  space(ui, 4);
  title(ui, limb_title(limb->limb.name), joints_of(*limb));
  switch (context.view.tab) {
    case InspectorTab::limb:
      draw_limb_tab(context);
      break;
    case InspectorTab::target:
      draw_target_tab(context);
      break;
    case InspectorTab::planner:
      draw_planner_tab(context);
      break;
  }
}

}  // namespace elbowroom
