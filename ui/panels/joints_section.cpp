// SPDX-License-Identifier: MIT
// Which joints the limb has and why they were taken, in the limb panel; the dialog that chooses
// others is limb_joints.cpp.
#include "ui/panels/panel.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/text.h"

namespace elbowroom {

void draw_joints_section(const PanelContext& context) {
  Ui& ui = context.ui;
  const Limb& limb = context.state.limb_model()->limb;
  const auto& joints = context.state.session->scene.model().skeleton.joints;
  const bool by_hand = context.state.document->limbs.contains(limb.name);
  space(ui, 4);
  heading(ui, "Joints", by_hand ? "set by hand" : "found");
  const auto name = [&](int joint) {
    const std::string& own = joints[static_cast<std::size_t>(joint)].name;
    return own.empty() ? "node " + std::to_string(joint) : own;
  };
  const bool arm = limb.is_arm(), chain = limb.kind == LimbKind::chain;
  label(ui, chain ? "Root" : arm ? "Shoulder" : "Hip", name(limb.root), Tone::quiet, Tone::text);
  label(ui, chain ? "Middle" : arm ? "Elbow" : "Knee", name(limb.middle), Tone::quiet, Tone::text);
  label(ui, chain ? "End" : arm ? "Wrist" : "Ankle", name(limb.end), Tone::quiet, Tone::text);
  note(ui, "Why: " + limb.why + ".", Tone::quiet);
  for (const std::string& remark : context.state.limb_model()->notes)
    note(ui, sentence(remark) + ".", Tone::quiet);
  space(ui, 2);
  if (button(ui, "Choose joints…",
             {.hint = "Says which joints the limb has, or that it is none"})) {
    context.view.joints_of = limb.name;
    context.view.dialog = Dialog::limb_joints;
  }
}

}  // namespace elbowroom
