// SPDX-License-Identifier: MIT
#include "frame.glsl"
layout(location = 0) in vec4 position_emphasis;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in float u;
layout(location = 3) in float v;

out vec3 position;
out vec3 normal;
out vec2 uv;
out float emphasis;
invariant gl_Position;

void main() {
  position = position_emphasis.xyz;
  normal = vertex_normal;
  uv = vec2(u, v);
  emphasis = position_emphasis.w;
  gl_Position = frame.clip_from_world * vec4(position, 1.0);
}
