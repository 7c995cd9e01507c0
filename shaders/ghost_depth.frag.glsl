// SPDX-License-Identifier: MIT
in vec3 position;
in vec3 normal;
in vec2 uv;
in float emphasis;
layout(location = 1) uniform vec4 part;

void main() {
  if (part.x > 0.5 && emphasis <= 0.3) discard;
}
