// SPDX-License-Identifier: MIT
// Keys of the joints that follow a limb from elsewhere in the tree (core/anatomy/following.h): of
// what the limb's own keys come to when they are played, not of the curve they were made from.
//
// At each of its keys a following joint is where it belongs to the limb, to the rounding of
// float32. They stand at the limb's keys, at those of the clip that move either of the two, on both
// sides of steps, and between these wherever a straight line would leave the limb by more than
// kFollowingTolerance; at the window's ends they are the clip's own.
#pragma once

#include "core/anatomy/limb_model.h"
#include "core/editing/document.h"
#include "core/scene/model.h"

namespace elbowroom {

// How far a following joint may be from where it belongs between two keys, of the limb's length: a
// fifth of a millimetre at a leg.
inline constexpr double kFollowingTolerance = 2e-4;

// Adds keys of what follows `limb` to the correction, which has the limb's own; `source` is the
// clip that it lies over. Nothing for a limb without. Error: that of lay_over.
Status add_following_keys(const Model& model, const LimbModel& limb, const Clip& source,
                          Correction& correction);

}  // namespace elbowroom
