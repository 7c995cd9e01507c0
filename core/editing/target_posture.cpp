// SPDX-License-Identifier: MIT
#include "core/editing/target_posture.h"

#include <cstdio>
#include <vector>

namespace elbowroom {

Result<LimbIk> limb_ik_at(const SceneCollision& scene, int limb, double t,
                          const std::array<Quat, 3>& residual) {
  const LimbModel& model = scene.limbs()[static_cast<std::size_t>(limb)];
  std::vector<ActorState> states;
  world_state_at(scene.world(), t, states);
  const auto index = static_cast<std::size_t>(scene.actor());
  const Actor& actor = scene.world().actors[index];
  const Skeleton& skeleton = actor.model->skeleton;
  const int parent = skeleton.joints[static_cast<std::size_t>(model.joints[0].joint)].parent;
  const Mat4 placement = parent < 0
                             ? actor.world_from_file
                             : states[index].world_from_joint[static_cast<std::size_t>(parent)];
  return LimbIk::build(model, skeleton, states[index].pose, placement, residual);
}

IkResult search_free_posture(SceneCollision& scene, int limb, const LimbIk& ik, double t,
                             const IkTarget& target, const SwivelSearch& settings, double clearance,
                             const std::stop_token& stop) {
  const auto valid = [&](const LimbState& state) {
    if (stop.stop_requested()) return false;
    scene.pose_limb(limb, &state);
    return !scene.limb_in_contact(t, limb, clearance);
  };
  const IkResult result = search_swivel(ik, target, settings, valid);
  scene.pose_limb(limb, nullptr);
  return result;
}

std::string ik_reason(const IkResult& result, const LimbModel& limb) {
  char text[160];
  switch (result.status) {
    case IkStatus::solved:
      return {};
    case IkStatus::out_of_reach:
      if (result.miss < 0.01)
        std::snprintf(text, sizeof text, "the target is out of reach by %.2g mm",
                      1000 * result.miss);
      else if (result.miss < 1)
        std::snprintf(text, sizeof text, "the target is out of reach by %.1f cm",
                      100 * result.miss);
      else
        std::snprintf(text, sizeof text, "the target is out of reach by %.2f m", result.miss);
      return text;
    case IkStatus::at_limit: {
      if (result.dof < 0) return "the target asks for more than the limb's limits allow";
      const Dof& dof = limb.space.dofs[static_cast<std::size_t>(result.dof)];
      std::snprintf(text, sizeof text, "the target asks for %.1f° beyond the limit of ",
                    result.excess * 180 / kPi);
      return text + dof.name;
    }
    case IkStatus::in_collision:
      break;
  }
  return "every posture that reaches the target touches something";
}

}  // namespace elbowroom
