// SPDX-License-Identifier: MIT
// Scalable ambient obscurance (McGuire, Mara and Luebke 2012), without its mip levels.
#include "frame.glsl"
layout(binding = 4) uniform sampler2D geometry_map;
in vec2 screen;
layout(location = 0) out float visibility;

// A spiral of five turns.
const int kTaps = 16;
const vec2 kSpiral[16] = vec2[](
    vec2(0.01736157, 0.02598343), vec2(-0.09194862, 0.01828972),
    vec2(0.03048286, -0.15324770), vec2(0.18188398, 0.12153099),
    vec2(-0.23385083, 0.15625413), vec2(-0.06706230, -0.33714494),
    vec2(0.39844402, 0.07925544), vec2(-0.26042355, 0.38975138),
    vec2(-0.29514669, -0.44171823), vec2(0.58234126, -0.11583488),
    vec2(-0.12802802, 0.64364034), vec2(-0.59761878, -0.39931610),
    vec2(0.64958563, -0.43403924), vec2(0.16460746, 0.82753758),
    vec2(-0.88883666, -0.17680060), vec2(0.53820866, -0.80548619));

vec3 view_position(vec2 at, float depth) {
  vec2 xy = (at * 2.0 - 1.0) * frame.unproject.xy;
  return vec3(frame.eye.w > 0.5 ? xy : xy * depth, -depth);
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec4 here = texelFetch(geometry_map, texel, 0);
  visibility = 1.0;
  if (here.w == 0.0) return;
  vec2 size = vec2(textureSize(geometry_map, 0));
  vec3 p = view_position(screen, here.w);
  float radius = frame.occlusion.y;
  float pixels = frame.occlusion.z * radius / (frame.eye.w > 0.5 ? 1.0 : max(here.w, 1e-20));
  pixels = min(pixels * size.y, 0.3 * size.y);
  if (pixels < 1.0) return;

  // Sixteen turns that the 4 × 4 blur averages.
  float turn = 6.2831853 * (float((texel.x & 3) * 4 + (((texel.x ^ texel.y) & 3))) / 16.0);
  mat2 turned = mat2(cos(turn), sin(turn), -sin(turn), cos(turn)) * pixels;
  float sum = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    ivec2 tap = texel + ivec2(round(turned * kSpiral[i]));
    if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(size)))) continue;
    float depth = texelFetch(geometry_map, tap, 0).w;
    if (depth == 0.0) continue;
    vec3 v = (view_position((vec2(tap) + 0.5) / size, depth) - p) / radius;
    float vv = dot(v, v);
    float vn = dot(v, here.xyz);
    float f = max(1.0 - vv, 0.0);
    sum += f * f * f * max((vn - 0.012) / (vv + 0.01), 0.0);
  }
  visibility = clamp(1.0 - 2.4 * sum / float(kTaps), 0.0, 1.0);
}
