// SPDX-License-Identifier: MIT
#include "frame.glsl"
out vec3 position;
out vec3 normal;
out vec2 uv;
out float emphasis;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 at = frame.ground_offset.xy + corner * frame.ground.z;
  position = vec3(at.x, frame.ground.x, at.y);
  normal = vec3(0.0, 1.0, 0.0);
  uv = corner;
  emphasis = 0.0;
  gl_Position = frame.clip_from_world * vec4(position, 1.0);
}
