// SPDX-License-Identifier: MIT
// How the body's axes are found, with what the finder of limbs wants to know besides. The public
// face is body_axes() in core/anatomy/limb.h.
#pragma once

#include <vector>

#include "core/anatomy/limb.h"

namespace elbowroom {

struct BodyFindings {
  BodyAxes axes;
  bool paired = false;          // two limbs of a pair told what is left and right
  bool mirrored_names = false;  // feet and knees say that the names' left is the body's right
};

// Up from the legs or the trunk, whichever is the more upright; left from the pairs of limb roots,
// as the names have it unless at least two of feet, knees and elbows say the opposite; forward =
// left × up. `globals` is the bind pose.
BodyFindings find_body_axes(const Model& model, const Character& character,
                            const std::vector<Mat4>& globals, const std::vector<Limb>& limbs);

}  // namespace elbowroom
