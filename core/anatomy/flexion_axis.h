// SPDX-License-Identifier: MIT
// The axis about which an elbow or a knee bends, found from what it does.
//
// A straight joint hides its axis, so the evidence is gathered from bent poses: of the bind pose
// and of the clips. Everything is in the axes of the middle joint's parent. Any thread.
#pragma once

#include <string>
#include <vector>

#include "core/base/math.h"

namespace elbowroom {

struct FlexionEvidence {
  Vec3 upper{1, 0, 0};       // along the upper bone, unit
  Vec3 bound{1, 0, 0};       // along the lower bone in the bind pose, unit
  std::vector<Vec3> clips;   // along the lower bone, samples of all clips, unit
  Vec3 anatomical{0, 0, 1};  // the axis that the body suggests, unit, across `upper`: flexion
                             // about it is forward at an elbow in the T-pose, backward at a knee
  // What a hinge may leave of the clips' directions out of its plane, radians: median and 99th
  // percentile.
  double median_allowed = 0, high_allowed = 0;
};

struct FlexionAxis {
  Vec3 axis{0, 0, 1};  // unit, across `upper`; flexion about it is positive
  std::string from;    // for people
};

// In this order:
//  1. A bind pose with a clear bend shows the axis the rig was made for, if the clips keep to it
//     within what is allowed.
//  2. The axis z across the upper bone that leaves the lower bone's directions d in the clips
//  nearest
//     to the plane of flexion: least Σ w |z·d|, straight poses hardly counting. A slight bend of
//     the bind pose counts as a small part of them, and alone where no clip bends the joint, unless
//     it is far from the body's axis: then it is no flexion but the way the bones lie.
//  3. Where the clips do not keep to one axis the joint is no hinge in this rig: the bind pose's if
//     that has a clear bend, else the body's. The clear bend also stays where the clips' own axis
//     is but somewhat aslant to it.
// The sign is the one towards which the joint bends, if nearly all bends agree, else the body's.
FlexionAxis find_flexion_axis(const FlexionEvidence& evidence);

}  // namespace elbowroom
