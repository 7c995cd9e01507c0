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
};

struct FlexionAxis {
  Vec3 axis{0, 0, 1};  // unit, across `upper`; flexion about it is positive
  std::string from;    // for people
};

// The axis z across the upper bone that leaves the lower bone's directions d nearest to the plane
// of flexion: least Σ w |z·d|, where straight poses hardly count. The bind pose's bend, if it is
// more than a few degrees, weighs as much as a part of the clips; with neither, the body's axis is
// taken. The sign is the one towards which the joint bends, by the clips if nearly all of them
// agree, else the body's.
FlexionAxis find_flexion_axis(const FlexionEvidence& evidence);

}  // namespace elbowroom
