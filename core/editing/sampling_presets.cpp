// SPDX-License-Identifier: MIT
#include "core/editing/sampling_presets.h"

#include <algorithm>
#include <vector>

namespace elbowroom {
namespace {

constexpr double kDegree = kPi / 180.0;

struct Row {
  LimbJointRole joint;
  DofRole role;
  int nth;              // of the DOFs of that role in the joint
  double lower, upper;  // degrees
};

// The arm's zero is 20° below level, 45° forward of the side (limits.cpp): a first swing of −70°
// hangs, 20° is level.
const std::vector<Row> kLowArm = {{LimbJointRole::root, DofRole::swing, 0, -75, -15}};
const std::vector<Row> kHighArm = {{LimbJointRole::root, DofRole::swing, 0, 20, 110}};
const std::vector<Row> kCloseArm = {{LimbJointRole::root, DofRole::swing, 0, -85, -30},
                                    {LimbJointRole::root, DofRole::swing, 1, -55, 40},
                                    {LimbJointRole::middle, DofRole::flexion, 0, 95, 150}};
// The leg's zero is flexed by 45°, abducted by 10°: a second swing of −45° stands.
const std::vector<Row> kLowLeg = {{LimbJointRole::root, DofRole::swing, 1, -75, -15}};
const std::vector<Row> kHighLeg = {{LimbJointRole::root, DofRole::swing, 1, 15, 88}};
const std::vector<Row> kCloseLeg = {{LimbJointRole::root, DofRole::swing, 0, -30, 5},
                                    {LimbJointRole::middle, DofRole::flexion, 0, 60, 150}};

const std::vector<Row>& rows_of(bool arm, SamplingPreset preset) {
  static const std::vector<Row> none;
  switch (preset) {
    case SamplingPreset::low:
      return arm ? kLowArm : kLowLeg;
    case SamplingPreset::high:
      return arm ? kHighArm : kHighLeg;
    case SamplingPreset::close_to_body:
      return arm ? kCloseArm : kCloseLeg;
    case SamplingPreset::paper:
      break;
  }
  return none;
}

}  // namespace

std::string preset_title(SamplingPreset preset, const Limb& limb) {
  const std::string what = limb.kind == LimbKind::chain ? "" : limb.is_arm() ? " arm" : " leg";
  switch (preset) {
    case SamplingPreset::paper:
      return "Paper default";
    case SamplingPreset::low:
      return "Low" + what;
    case SamplingPreset::high:
      return "High" + what;
    case SamplingPreset::close_to_body:
      return "Close to body";
  }
  return "";
}

std::map<std::string, Interval> preset_intervals(const LimbModel& limb, SamplingPreset preset) {
  std::map<std::string, Interval> intervals;
  if (limb.limb.kind == LimbKind::chain) return intervals;
  for (const Row& row : rows_of(limb.limb.is_arm(), preset)) {
    const JointModel& joint = limb.joints[row.joint == LimbJointRole::root     ? 0u
                                          : row.joint == LimbJointRole::middle ? 1u
                                                                               : 2u];
    int nth = 0;
    for (int d = joint.first_dof; d < joint.first_dof + joint.dof_count(); ++d) {
      const Dof& dof = limb.space.dofs[static_cast<std::size_t>(d)];
      if (dof.role != row.role || nth++ != row.nth) continue;
      const double lower = std::clamp(row.lower * kDegree, dof.lower, dof.upper);
      const double upper = std::clamp(row.upper * kDegree, dof.lower, dof.upper);
      if (lower < upper) intervals[dof.name] = {lower, upper};
      break;
    }
  }
  return intervals;
}

std::optional<SamplingPreset> preset_of(const LimbModel& limb,
                                        const std::map<std::string, Interval>& sampling) {
  for (const SamplingPreset preset : kSamplingPresets)
    if (sampling == preset_intervals(limb, preset)) return preset;
  return std::nullopt;
}

}  // namespace elbowroom
