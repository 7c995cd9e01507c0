// SPDX-License-Identifier: MIT
// A segment of a polyline as a quad of fixed width in pixels, with room for round ends.
#include "frame.glsl"
struct Segment {
  vec4 a;         // place, length along the line
  vec4 b;
  vec4 colour_a;  // linear, premultiplied by nothing
  vec4 colour_b;
  vec4 style;     // width in pixels, dash length (0: none)
};
layout(std430, binding = 1) readonly buffer Segments { Segment segments[]; };

out vec4 tint;
out vec2 pixel;               // along and across, in pixels from a
flat out vec3 measures;       // length in pixels, half width, dash length
out float along;

void main() {
  Segment s = segments[gl_InstanceID];
  vec4 a = frame.clip_from_world * vec4(s.a.xyz, 1.0);
  vec4 b = frame.clip_from_world * vec4(s.b.xyz, 1.0);
  // What lies behind the near plane is cut off, else its direction would turn round.
  float near_a = a.z + a.w, near_b = b.z + b.w;
  float ta = near_a < 0.0 && near_b > 0.0 ? near_a / (near_a - near_b) : 0.0;
  float tb = near_b < 0.0 && near_a > 0.0 ? near_b / (near_b - near_a) : 0.0;
  vec4 clip_a = mix(a, b, ta), clip_b = mix(b, a, tb);
  bool gone = near_a < 0.0 && near_b < 0.0;
  vec2 pa = clip_a.xy / clip_a.w * 0.5 * frame.viewport.xy;
  vec2 pb = clip_b.xy / clip_b.w * 0.5 * frame.viewport.xy;
  vec2 way = pb - pa;
  float extent = length(way);
  vec2 direction = extent > 1e-4 ? way / extent : vec2(1.0, 0.0);
  vec2 across = vec2(-direction.y, direction.x);
  float half_width = 0.5 * s.style.x;
  float reach = half_width + 1.0;
  bool at_b = (gl_VertexID & 1) != 0;
  float side = (gl_VertexID & 2) != 0 ? 1.0 : -1.0;
  pixel = vec2(at_b ? extent + reach : -reach, side * reach);
  vec4 clip = at_b ? clip_b : clip_a;
  vec2 shift = direction * (at_b ? reach : -reach) + across * pixel.y;
  clip.xy += shift * 2.0 * frame.viewport.zw * clip.w;
  tint = at_b ? s.colour_b : s.colour_a;
  along = at_b ? s.b.w : s.a.w;
  measures = vec3(extent, half_width, s.style.y);
  gl_Position = gone ? vec4(2.0, 2.0, 2.0, 1.0) : clip;
}
