// SPDX-License-Identifier: MIT
// How far a posture is beyond (or within) its limits, and the nearest one that keeps them.
//
// Radians. Pure functions, any thread, no allocation.
#pragma once

#include "core/base/dof_space.h"

namespace elbowroom {

struct LimitExcess {
  double radians = 0;  // by how much the worst limit is exceeded; negative: distance kept from it
  int dof = -1;        // whose limit that is; of an ellipse the DOF with the larger share
};

// The worst of all ranges, ellipses and polygons (along the ray from zero). Not a number counts as
// infinite. Requires q.count == space.count().
LimitExcess limit_excess(const DofSpace& space, const Dofs& q);

// Ranges clamped, then pulled towards zero into ellipses and polygons as far as the ranges allow.
// Keeps limits that can be kept.
Dofs clamp_to_limits(const DofSpace& space, Dofs q);

}  // namespace elbowroom
