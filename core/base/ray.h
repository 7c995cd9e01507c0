// SPDX-License-Identifier: MIT
// A half line in world space, in double, so that it is as good far from the world's origin as near.
#pragma once

#include "core/base/math.h"

namespace elbowroom {

struct WorldRay {
  Vec3 origin{0.0};
  Vec3 direction{0, 0, -1};  // of any length but 0
};

}  // namespace elbowroom
