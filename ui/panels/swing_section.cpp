// SPDX-License-Identifier: MIT
// How far a joint of the limb may swing: a map of it, and a polygon drawn by hand [SKF07 4.2].
#include <algorithm>

#include "ui/panels/panel.h"
#include "ui/toolkit/buttons.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/swing_map.h"
#include "ui/toolkit/text.h"

namespace elbowroom {

void draw_swing_section(const PanelContext& context) {
  Ui& ui = context.ui;
  const auto& swings = context.state.swings;
  if (swings.empty()) return;
  int& chosen = context.view.swing_joint;
  chosen = std::clamp(chosen, 0, static_cast<int>(swings.size()) - 1);
  std::vector<std::string> joints;
  for (const SwingView& view : swings) joints.push_back(view.joint);
  space(ui, 4);
  heading_combo(ui, "Swing limit", "Swing joint", chosen, joints,
                "Which joint the map below shows");
  const SwingView& view = swings[static_cast<std::size_t>(chosen)];
  const LimbModel& limb = *context.state.limb_model();

  SwingMap map;
  map.up = view.first;
  map.across = view.second;
  map.own = view.own;
  map.clip = view.clip;
  for (const auto& mark : view.landmarks) map.marks.push_back({mark.name, mark.place});
  map.value = view.value;
  map.clip_value = view.clip_value;
  map.sample_up = view.sample_first;
  map.sample_across = view.sample_second;
  map.polygon = view.polygon;
  const auto scope = ui.scope(chosen);
  SwingMapOptions options;
  options.words = [&](const SwingMap::Place& place) { return swing_text(limb, view, place); };
  const Edit edit = swing_map(ui, "Swing map", map, options);
  context.view.swing_in_picture =
      edit || ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  if (edit.cancelled || edit)
    context.emit(command::SetSwingLimit{view.role, map.polygon, phase_of(edit)});

  note(ui, "Dots: the clip; the large one: now. Frame: sampled.", Tone::faint);
  if (view.polygon.empty()) {
    ButtonOptions draw;
    draw.enabled = !view.start.empty();
    draw.why_not = "The joint's own range leaves no room for a polygon";
    draw.hint = "Bounds the joint by a polygon of your own, to begin with like its limit now";
    if (button(ui, "Draw as polygon", draw))
      context.emit(command::SetSwingLimit{view.role, view.start});
    return;
  }
  if (button(ui, "Back to own limit", {.hint = "Takes the polygon away"}))
    context.emit(command::SetSwingLimit{view.role, {}});
  note(ui, "Drag a corner; click an edge for one more; right click takes one away.", Tone::faint);
}

}  // namespace elbowroom
