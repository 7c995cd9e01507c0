// SPDX-License-Identifier: MIT
// Ambient occlusion at a pixel of the picture, from the half-size buffers: of the four nearest
// texels those of the same surface count.
layout(binding = 3) uniform sampler2D occlusion_map;
layout(binding = 4) uniform sampler2D geometry_map;  // view normal, distance along the view

float ambient_visibility(vec3 position) {
  if (frame.occlusion.w < 0.5) return 1.0;
  float depth = -(frame.view_from_world * vec4(position, 1.0)).z;
  vec2 size = vec2(textureSize(occlusion_map, 0));
  vec2 at = gl_FragCoord.xy * frame.viewport.zw * size - 0.5;
  ivec2 base = ivec2(floor(at));
  vec2 f = at - vec2(base);
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1);
    ivec2 texel = clamp(base + step, ivec2(0), ivec2(size) - 1);
    float other = texelFetch(geometry_map, texel, 0).w;
    vec2 near = mix(1.0 - f, f, vec2(step));
    float apart = abs(other - depth) / frame.occlusion.y;
    float weight = (near.x * near.y + 0.02) / (1.0 + 400.0 * apart * apart);
    sum += weight * texelFetch(occlusion_map, texel, 0).r;
    weights += weight;
  }
  return mix(1.0, sum / max(weights, 1e-6), frame.occlusion.x);
}
