// SPDX-License-Identifier: MIT
// Sixteen axis-aligned boxes side by side, as centres and half extents in float, and whether a
// sphere may touch one of them: with Highway's run-time dispatch, the same answer in every
// instruction set. Any frame and unit; boxes are rounded outwards.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/base/math.h"

namespace elbowroom {

struct alignas(64) BoxPack {
  static constexpr int kWidth = 16;
  float center[3][kWidth];
  float half[3][kWidth];  // −1e30 in unused slots: apart from everything
};

// Boxes given by their corners, relative to `origin`.
std::vector<BoxPack> pack_boxes(std::span<const std::pair<glm::vec3, glm::vec3>> corners,
                                const Vec3& origin);

// False if no box is nearer to `centre` than `radius`. Conservative: what is no number is near.
bool sphere_near_boxes(const BoxPack* packs, std::size_t count, const Vec3& centre, double radius);

}  // namespace elbowroom
