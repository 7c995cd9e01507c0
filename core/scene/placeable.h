// SPDX-License-Identifier: MIT
// How far away a thing may be placed.
#pragma once

#include <cmath>

#include "core/base/math.h"

namespace elbowroom {

// Scene units. Collisions are looked at in float32, which can hold the square of a length up to
// here; what is farther away would be taken for free.
inline constexpr double kFarthestPlace = 1e18;

// False for places that are not finite, too.
inline bool is_placeable(const Vec3& place) {
  return std::abs(place.x) <= kFarthestPlace && std::abs(place.y) <= kFarthestPlace &&
         std::abs(place.z) <= kFarthestPlace;
}

}  // namespace elbowroom
