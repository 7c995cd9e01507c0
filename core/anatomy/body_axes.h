// SPDX-License-Identifier: MIT
// How the body's axes are found, with what the finder of limbs wants to know besides. The public
// face is body_axes() in core/anatomy/limb.h.
#pragma once

#include <vector>

#include "core/anatomy/bound_figure.h"
#include "core/anatomy/limb.h"

namespace elbowroom {

struct BodyFindings {
  BodyAxes axes;
  bool paired = false;  // two limbs of a pair told what is left and right
  bool mirrored_names =
      false;  // feet and knees (or a mirror above) say that the names' left is the body's right
};

// Up from the legs or the trunk, whichever is the more upright; left from the pairs of limb roots,
// as the names have it unless at least two of feet, knees and elbows say the opposite; forward =
// left × up. Up is an axis of the space the figure was modelled in, or of the file, where one is
// near; so is left where shoulders and hips do not agree on it.
BodyFindings find_body_axes(const BoundFigure& figure, const std::vector<Limb>& limbs);

// How clearly feet, knees and elbows say that the body looks along `forward` rather than against
// it: up to ±1 for each foot, ±0.5 for each bent knee or elbow.
double looks_along(const BoundFigure& figure, const std::vector<Limb>& limbs, const Vec3& up,
                   const Vec3& forward);

}  // namespace elbowroom
