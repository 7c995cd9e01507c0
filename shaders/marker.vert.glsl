// SPDX-License-Identifier: MIT
// A round mark of fixed size in pixels.
#include "frame.glsl"
struct Marker {
  vec4 place;   // xyz, radius in pixels
  vec4 colour;
  vec4 style;   // x: shape (0 disc, 1 ring, 2 halo)
};
layout(std430, binding = 1) readonly buffer Markers { Marker markers[]; };
out vec2 pixel;
flat out vec4 tint;
flat out vec2 shape;  // kind, radius

void main() {
  Marker m = markers[gl_InstanceID];
  float reach = m.place.w + 1.5;
  pixel = reach * (vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0);
  vec4 clip = frame.clip_from_world * vec4(m.place.xyz, 1.0);
  clip.xy += pixel * 2.0 * frame.viewport.zw * clip.w;
  tint = m.colour;
  shape = vec2(m.style.x, m.place.w);
  gl_Position = clip;
}
