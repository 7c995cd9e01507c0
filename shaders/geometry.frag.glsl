// SPDX-License-Identifier: MIT
// View normal and distance, for ambient occlusion.
#include "frame.glsl"
in vec3 position;
in vec3 normal;
in vec2 uv;
in float emphasis;
layout(location = 0) out vec4 geometry;

void main() {
  vec3 flat_normal = cross(dFdx(position), dFdy(position));
  vec3 n = normalize(normal);
  float flat_length = length(flat_normal);
  if (flat_length > 0.0) {
    flat_normal /= flat_length;
    if (dot(flat_normal, to_viewer(position)) < 0.0) flat_normal = -flat_normal;
    if (dot(n, flat_normal) < 0.0) n = -n;
    // Halfway to the true face: occlusion of smooth normals darkens the facets' rims.
    n = normalize(n + flat_normal);
  }
  geometry = vec4(mat3(frame.view_from_world) * n,
                  -(frame.view_from_world * vec4(position, 1.0)).z);
}
