// SPDX-License-Identifier: MIT
// A hand target as the limb's inverse kinematics wants it: for the end joint's own origin.
//
// A target with `grasp` is the palm's (core/anatomy/grasp_frame.h); one without an orientation
// keeps that which the hand has in the clip. Pure, any thread.
#pragma once

#include "core/editing/document.h"
#include "core/ik/limb_ik.h"

namespace elbowroom {

// `world_from_end` is the end joint in the clip at the target's time, by the world.
// Errors, for grasp targets only: a limb whose palm can't be told; an end that can't be turned; a
// rig with uneven scales, in which the hand's size would change with its posture.
Result<IkTarget> wrist_target(const LimbIk& ik, const Mat4& world_from_end,
                              const HandTarget& target);

}  // namespace elbowroom
