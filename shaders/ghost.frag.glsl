// SPDX-License-Identifier: MIT
// A translucent figure: its nearest surface only (the depth pass before sees to that), brighter
// towards the silhouette. Premultiplied alpha.
#include "frame.glsl"
in vec3 position;
in vec3 normal;
in vec2 uv;
in float emphasis;
layout(location = 0) out vec4 colour;
layout(location = 0) uniform vec4 ghost;   // rgb, opacity
layout(location = 1) uniform vec4 part;    // x: 1 draws only what is emphasized

void main() {
  float shown = part.x > 0.5 ? smoothstep(0.3, 0.6, emphasis) : 1.0;
  if (shown <= 0.0) discard;
  vec3 viewer = to_viewer(position);
  vec3 n = normalize(normal);
  float n_v = abs(dot(n, viewer));
  float edge = pow(1.0 - n_v, 2.0);
  float alpha = clamp(ghost.a * mix(0.62, 1.5, edge), 0.0, 1.0) * shown;
  vec3 rgb = ghost.rgb * (0.55 + 0.3 * max(dot(n, frame.key_direction.xyz), 0.0) + 0.5 * edge);
  colour = vec4(min(rgb, vec3(1.0)) * alpha, alpha);
}
