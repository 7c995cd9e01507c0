// SPDX-License-Identifier: MIT
// 4 × 4 mean of the occlusion over texels of the same surface.
#include "frame.glsl"
layout(binding = 3) uniform sampler2D occlusion_map;
layout(binding = 4) uniform sampler2D geometry_map;
in vec2 screen;
layout(location = 0) out float visibility;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(occlusion_map, 0);
  float depth = texelFetch(geometry_map, texel, 0).w;
  float sum = 0.0, weights = 0.0;
  for (int y = -2; y < 2; ++y) {
    for (int x = -2; x < 2; ++x) {
      ivec2 tap = clamp(texel + ivec2(x, y), ivec2(0), size - 1);
      float apart = (texelFetch(geometry_map, tap, 0).w - depth) / frame.occlusion.y;
      float weight = 1.0 / (1.0 + 100.0 * apart * apart);
      sum += weight * texelFetch(occlusion_map, tap, 0).r;
      weights += weight;
    }
  }
  visibility = sum / weights;
}
