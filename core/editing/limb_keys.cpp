// SPDX-License-Identifier: MIT
#include "core/editing/limb_keys.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

constexpr double kSlopeStep = 1.0e-4;  // s

}  // namespace

std::array<Quat, 3> residual_between(const LimbState& at_init, const LimbState& at_goal, double u) {
  std::array<Quat, 3> residual;
  for (std::size_t j = 0; j < 3; ++j)
    residual[j] = slerp_shortest(at_init.residual[j], at_goal.residual[j], u);
  return residual;
}

std::vector<JointKeys> make_limb_keys(const Skeleton& skeleton, const LimbModel& limb,
                                      const std::function<Dofs(double)>& q,
                                      const LimbState& at_init, const LimbState& at_goal,
                                      const std::vector<double>& stops, double rate) {
  std::vector<float> times;
  for (std::size_t part = 0; part + 1 < stops.size(); ++part) {
    const double begin = stops[part], end = stops[part + 1];
    const auto intervals = static_cast<int>(std::ceil(std::max(1.0, (end - begin) * rate - 1e-9)));
    for (int i = 0; i <= intervals; ++i) {
      const double t = i == intervals ? end : begin + (end - begin) * i / intervals;
      const auto time = static_cast<float>(t);
      if (times.empty() || time > times.back()) times.push_back(time);
    }
  }
  const double begin = stops.front(), end = stops.back();
  auto rotation_at = [&](const JointModel& joint, std::size_t index, double t) {
    const double u = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
    const Dofs values = q(t);
    return local_rotation(joint, &values.value[static_cast<std::size_t>(joint.first_dof)],
                          residual_between(at_init, at_goal, u)[index]);
  };

  std::vector<JointKeys> result;
  for (std::size_t j = 0; j < limb.joints.size(); ++j) {
    const JointModel& joint = limb.joints[j];
    if (joint.kind == JointModelKind::fixed) continue;  // no DOFs: it follows the clip
    JointKeys keys;
    keys.node = joint.joint;
    keys.joint = skeleton.joints[static_cast<std::size_t>(joint.joint)].name;
    keys.keys.times = times;
    for (const float time : times) {
      const double t = static_cast<double>(time);
      const Quat value = rotation_at(joint, j, t);
      const double before = std::max(begin, t - kSlopeStep);
      const double after = std::min(end, t + kSlopeStep);
      Quat low = rotation_at(joint, j, before), high = rotation_at(joint, j, after);
      if (glm::dot(low, value) < 0) low = -low;
      if (glm::dot(high, value) < 0) high = -high;
      keys.keys.values.push_back(value);
      keys.keys.derivatives.push_back((high - low) * (1.0 / (after - before)));
    }
    result.push_back(std::move(keys));
  }
  return result;
}

}  // namespace elbowroom
