// SPDX-License-Identifier: MIT
// The limb panel: per DOF its anatomical name, limits, value and sampling interval [SKF07 4.2]; how
// far its joints swing; which joints they are, and why.
#include "ui/panels/panel.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/range_slider.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

// "Shoulder, forward" for "Shoulder, swing forward": the whole name does not fit into a narrow
// window, and the widget keeps it.
std::string shown_name(const std::string& dof) {
  const std::string swing = ", swing ";
  const std::size_t at = dof.find(swing);
  const std::size_t rest = at + swing.size();
  if (at == std::string::npos || (rest < dof.size() && dof[rest] >= '0' && dof[rest] <= '9'))
    return dof;
  return dof.substr(0, at) + ", " + dof.substr(rest) + "###" + dof;
}

void presets(const PanelContext& context, const LimbModel& limb) {
  std::map<std::string, Interval> sampling;
  const Draft& draft = context.state.document->draft;
  if (const auto found = draft.wishes.find(draft.limb); found != draft.wishes.end())
    sampling = found->second.sampling;
  std::vector<std::string> names;
  int chosen = -1;
  const auto own = preset_of(limb, sampling);
  for (const SamplingPreset preset : kSamplingPresets) {
    if (own && *own == preset) chosen = static_cast<int>(names.size());
    names.push_back(preset_title(preset, limb.limb));
  }
  if (chosen < 0) {
    chosen = static_cast<int>(names.size());
    names.emplace_back("Own");
  }
  if (heading_combo(context.ui, "Sampling intervals", "Preset", chosen, names,
                    "Ready-made intervals: where the planner looks for postures") &&
      chosen < static_cast<int>(std::size(kSamplingPresets)))
    context.emit(command::ChoosePreset{kSamplingPresets[chosen]});
}

}  // namespace

void draw_limb_tab(const PanelContext& context) {
  Ui& ui = context.ui;
  const LimbModel& limb = *context.state.limb_model();
  presets(context, limb);
  for (std::size_t d = 0; d < context.state.dofs.size(); ++d) {
    const DofView& dof = context.state.dofs[d];
    RangeModel range;
    range.limit_low = dof.lower;
    range.limit_high = dof.upper;
    range.low = dof.sample_lower;
    range.high = dof.sample_upper;
    range.default_low = dof.default_lower;
    range.default_high = dof.default_upper;
    range.current = dof.value;
    range.clip = dof.clip_value;
    RangeOptions options;
    options.hint = "Where the planner looks for postures; double-click resets";
    const Edit edit = range_slider(ui, shown_name(dof.name), range, options);
    if (edit.cancelled)
      context.emit(
          command::SetSampling{dof.name, Interval{range.low, range.high}, Phase::cancelled});
    else if (edit) {
      // Back at the limb's own interval: that is no wish.
      std::optional<Interval> wanted = Interval{range.low, range.high};
      if (range.low == dof.default_lower && range.high == dof.default_upper) wanted.reset();
      context.emit(command::SetSampling{dof.name, wanted, phase_of(edit)});
    }
  }
  draw_swing_section(context);
  draw_joints_section(context);
}

}  // namespace elbowroom
