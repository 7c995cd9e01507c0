// SPDX-License-Identifier: MIT
// How closely a clip is looked at for the contacts that are listed and drawn.
#pragma once

namespace elbowroom {

inline constexpr double kContactRate = 120;  // Hz

}  // namespace elbowroom
