// SPDX-License-Identifier: MIT
// Ready-made sampling intervals, by the look of the motion they lead to [SKF07 4.2, figure 2].
//
// Angles are those of the joint models, the same on every rig. DOFs that a preset doesn't name keep
// the limb's own interval. To add one: a value here, its rows in the .cpp.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/anatomy/limb_model.h"
#include "core/anatomy/limits.h"
#include "core/editing/document.h"

namespace elbowroom {

enum class SamplingPreset {
  paper,          // the limb's own intervals
  low,            // the upper arm hangs; the leg stays near the ground
  high,           // the upper arm at or over the shoulder's height; the knee lifted
  close_to_body,  // bent and near the trunk
};

inline constexpr SamplingPreset kSamplingPresets[] = {SamplingPreset::paper, SamplingPreset::low,
                                                      SamplingPreset::high,
                                                      SamplingPreset::close_to_body};

// "High arm", "High leg", "High" for other chains.
std::string preset_title(SamplingPreset preset, const Limb& limb);

// By DOF name, radians, inside the limits. Empty for `paper` and for chains that are no arm or leg.
std::map<std::string, Interval> preset_intervals(const LimbModel& limb, SamplingPreset preset);

// The preset whose intervals are exactly these; none if they are the animator's own.
std::optional<SamplingPreset> preset_of(const LimbModel& limb,
                                        const std::map<std::string, Interval>& sampling);

}  // namespace elbowroom
