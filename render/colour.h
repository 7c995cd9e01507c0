// SPDX-License-Identifier: MIT
// Colours as people write them (sRGB, 0xrrggbb) and as light adds up (linear).
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace elbowroom {

using Rgb = std::uint32_t;  // 0xrrggbb, sRGB

inline float linear_from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

inline float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

inline glm::vec3 linear_from_rgb(Rgb rgb) {
  const auto channel = [rgb](int shift) {
    return linear_from_srgb(static_cast<float>((rgb >> shift) & 0xffu) / 255.0f);
  };
  return {channel(16), channel(8), channel(0)};
}

}  // namespace elbowroom
