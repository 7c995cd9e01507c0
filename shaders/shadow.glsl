// SPDX-License-Identifier: MIT
// Soft shadows of the key light: percentage-closer soft shadows (Fernando 2005). The mean distance
// of what blocks the light gives the width of the penumbra, which is then filtered.
layout(binding = 1) uniform sampler2DShadow shadow_map;
layout(binding = 2) uniform sampler2D shadow_depth;

vec2 disc(int i, int count, float turn) {
  float angle = float(i) * kGoldenAngle + turn;
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}

// Part of the key light that reaches a point, [0, 1]. `normal` faces the viewer.
float key_visibility(vec3 position, vec3 normal, vec2 pixel) {
  float cosine = dot(normal, frame.key_direction.xyz);
  if (cosine <= 0.0) return 0.0;
  float width = frame.shadow.x, range = frame.shadow.y, tangent = frame.shadow.z;
  float texel = width / frame.shadow.w;
  float slope = min(sqrt(1.0 - cosine * cosine) / max(cosine, 0.05), 3.0);
  vec3 at = position + normal * texel * (1.0 + slope);
  vec3 uvz = (frame.light_from_world * vec4(at, 1.0)).xyz;
  if (any(lessThan(uvz.xy, vec2(0.0))) || any(greaterThan(uvz.xy, vec2(1.0)))) return 1.0;
  float turn = 6.2831853 * pattern(pixel);

  // Dense about the middle, so that small things that nearly touch are never missed by some pixels
  // and found by others.
  const int kSearch = 16;
  float search = min(tangent * uvz.z * range, 0.06 * width) + 2.0 * texel;
  float blockers = 0.0, depth_sum = 0.0;
  for (int i = 0; i < kSearch; ++i) {
    vec2 offset = disc(i, kSearch, turn);
    offset *= search * dot(offset, offset);
    float bias = (texel + length(offset)) * slope / range;
    float depth = textureLod(shadow_depth, uvz.xy + offset / width, 0.0).r;
    if (depth < min(uvz.z - bias, 0.9999)) {
      blockers += 1.0;
      depth_sum += depth;
    }
  }
  if (blockers == 0.0) return 1.0;
  float gap = (uvz.z - depth_sum / blockers) * range;
  float radius = clamp(gap * tangent, 1.5 * texel, search);

  const int kFilter = 20;
  float lit = 0.0;
  for (int i = 0; i < kFilter; ++i) {
    vec2 offset = disc(i, kFilter, turn) * radius;
    float bias = (texel + length(offset)) * slope / range;
    lit += texture(shadow_map, vec3(uvz.xy + offset / width, min(uvz.z - bias, 0.9999)));
  }
  return lit / float(kFilter);
}
