// SPDX-License-Identifier: MIT
// A rotation as three numbers that people can edit: turns about X, then Y, then Z, each about the
// fixed axes, in degrees. A rotation has many such triples; shown is the one that an editor's
// fields hold, as long as it means the rotation, so that no field jumps while another one is
// edited.
//
// Pure functions of their arguments. [SKF07] has nothing on this: it is for the eye only.
#pragma once

#include "core/base/math.h"

namespace elbowroom {

Quat from_euler_degrees(const Vec3& degrees);

// The triple that means `rotation` and is nearest to `shown`: `shown` itself if it means it already
// (to 1e-6 rad). Angles go on beyond 180° where that is nearer. Where Y is at ±90° and X and Z turn
// about the same axis, X stays as shown. A rotation or triple that is no number gives zeros.
Vec3 euler_degrees_near(const Quat& rotation, const Vec3& shown);

}  // namespace elbowroom
