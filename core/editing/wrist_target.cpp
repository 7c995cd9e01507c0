// SPDX-License-Identifier: MIT
#include "core/editing/wrist_target.h"

namespace elbowroom {

Result<IkTarget> wrist_target(const LimbIk& ik, const Mat4& world_from_end,
                              const HandTarget& target) {
  if (!target.grasp) return IkTarget{target.position, target.orientation};
  const LimbModel& limb = ik.limb();
  if (!limb.grasp) return limb.grasp.error();
  const std::string remedy = "aim the end joint itself";
  if (!ik.serves_orientation())
    return Error{"the end of the limb can't be turned", limb.limb.name, remedy};
  if (!ik.uniform())
    return Error{"the rig is scaled unevenly: its hand changes with the posture", limb.limb.name,
                 remedy};
  const Quat orientation = target.orientation
                               ? glm::normalize(*target.orientation)
                               : grasp_place(*limb.grasp, world_from_end).orientation;
  const EndPlacement end = end_for_grasp(*limb.grasp, world_from_end, target.position, orientation);
  return IkTarget{end.position, end.rotation};
}

}  // namespace elbowroom
