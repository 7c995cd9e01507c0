// SPDX-License-Identifier: MIT
// Soft shadows of the key light: percentage-closer soft shadows (Fernando 2005). The mean distance
// of what blocks the light gives the width of the penumbra, which is then filtered.
layout(binding = 1) uniform sampler2DShadow shadow_map;
layout(binding = 2) uniform sampler2D shadow_depth;

#ifdef DRAFT
// Hard shadows: part of the key light that reaches a point whose surface has that cosine to it.
float key_visibility(vec3 position, float cosine) {
  float texel = frame.shadow.x / frame.shadow.w;
  float slope = min(sqrt(max(1.0 - cosine * cosine, 0.0)) / max(cosine, 0.05), 3.0);
  vec3 uvz = (frame.light_from_world * vec4(position, 1.0)).xyz;
  if (any(lessThan(uvz.xy, vec2(0.0))) || any(greaterThan(uvz.xy, vec2(1.0)))) return 1.0;
  float bias = 2.5 * texel * (1.0 + slope) / frame.shadow.y;
  return texture(shadow_map, vec3(uvz.xy, min(uvz.z - bias, 0.9999)));
}
#else
// Points of a disc, the i-th of n at sqrt((i + 0.5) / n) and i golden angles. The search's are drawn
// to the middle by their squared distance, so that small things that nearly touch are never missed
// by some pixels and found by others.
const int kSearch = 16;
const vec2 kSearchDisc[16] = vec2[](
    vec2(0.00552427, 0.00000000), vec2(-0.02116614, 0.01938992),
    vec2(0.00539970, -0.06152675), vec2(0.06224995, 0.08119404),
    vec2(-0.14687527, -0.02598017), vec2(0.17005154, -0.10817287),
    vec2(-0.06722053, 0.25005703), vec2(-0.14791944, -0.28480988),
    vec2(0.36371615, 0.13282855), vec2(-0.42290205, 0.17456782),
    vec2(0.22532639, -0.48150941), vec2(0.18236861, 0.58141987),
    vec2(-0.59745773, -0.34623897), vec2(0.75695680, -0.16641483),
    vec2(-0.49617814, 0.70576233), vec2(-0.12253406, -0.94558689));
const int kFilter = 20;
const vec2 kFilterDisc[20] = vec2[](
    vec2(0.15811388, 0.00000000), vec2(-0.20193678, 0.18499064),
    vec2(0.03090966, -0.35219965), vec2(0.25452824, 0.33198701),
    vec2(-0.46709062, -0.08262175), vec2(0.44246901, -0.28146256),
    vec2(-0.14799723, 0.55054230), vec2(-0.28224676, -0.54344896),
    vec2(0.61236256, 0.22363383), vec2(-0.63706121, 0.26296961),
    vec2(0.30710560, -0.65626683), vec2(0.22694322, 0.72353077),
    vec2(-0.68400952, -0.39639750), vec2(0.80242103, -0.17641001),
    vec2(-0.48970507, 0.69655506), vec2(-0.11313321, -0.87304117),
    vec2(0.69452694, 0.58534804), vec2(-0.93461555, 0.03864928),
    vec2(0.68173030, -0.67841270), vec2(-0.04561040, 0.98636692));


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
  mat2 turned = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));

  float search = min(tangent * uvz.z * range, 0.06 * width) + 2.0 * texel;
  float blockers = 0.0, depth_sum = 0.0;
  for (int i = 0; i < kSearch; ++i) {
    vec2 offset = turned * kSearchDisc[i] * search;
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

  float lit = 0.0;
  for (int i = 0; i < kFilter; ++i) {
    vec2 offset = turned * kFilterDisc[i] * radius;
    float bias = (texel + length(offset)) * slope / range;
    lit += texture(shadow_map, vec3(uvz.xy + offset / width, min(uvz.z - bias, 0.9999)));
  }
  return lit / float(kFilter);
}
#endif
