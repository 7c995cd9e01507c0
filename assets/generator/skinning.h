// SPDX-License-Identifier: MIT
// Skin weights by heat that flows from the bones over the skin, after Baran and Popović, Automatic
// rigging and animation of 3D characters, 2007: (L + M H) w = M H p, with the surface's cotangent
// Laplacian L and vertex areas M, so weights blend along the skin and never jump a gap.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "assets/generator/figure.h"
#include "assets/generator/surface.h"

namespace elbowroom::demo {

struct VertexWeights {
  std::array<std::uint8_t, 4> joint{};  // unused ones are 0
  std::array<float, 4> weight{};        // multiples of 2^-16 that sum to 1 exactly
};

std::vector<VertexWeights> skin_weights(const Surface& surface, const BodyShape& shape,
                                        const Figure& figure);

}  // namespace elbowroom::demo
