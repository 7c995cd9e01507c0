// SPDX-License-Identifier: MIT
// Surfaces of a draft: lit at their vertices. Without a GPU a small triangle costs as much as the
// sixteen pixels about it, so that a figure has more fragments than vertices.
#include "frame.glsl"
layout(location = 0) in vec4 position_emphasis;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in float u;
layout(location = 3) in float v;

layout(location = 2) uniform vec4 material;  // roughness, metallic

out vec3 position;
out vec4 light;   // rgb: ambient and fill, w: cosine to the key light
out vec4 gloss;   // rgb: what is mirrored of the surroundings, and the rim; w: of the key light
out vec3 uv_emphasis;

float fifth(float x) { return x * x * x * x * x; }

void main() {
  position = position_emphasis.xyz;
  uv_emphasis = vec3(u, v, position_emphasis.w);
  gl_Position = frame.clip_from_world * vec4(position, 1.0);

  vec3 viewer = to_viewer(position);
  vec3 n = vertex_normal;
  if (dot(n, viewer) < 0.0) n = -n;
  vec3 l = frame.key_direction.xyz;
  float n_l = dot(n, l);
  float n_v = max(dot(n, viewer), 1e-3);
  vec3 ambient = mix(frame.bounce_colour.rgb, frame.sky_colour.rgb, 0.5 + 0.5 * n.y);
  float wrap = max((dot(n, frame.fill_direction.xyz) + 0.4) / 1.4, 0.0);
  light = vec4(ambient + frame.fill_colour.rgb * wrap * wrap, n_l);

  // As surface.frag.glsl has it, for a base that reflects like plastic.
  float roughness = clamp(material.x, 0.25, 1.0);
  vec3 h = normalize(l + viewer);
  float a = roughness * roughness;
  float n_h = max(dot(n, h), 0.0);
  float d = n_h * n_h * (a * a - 1.0) + 1.0;
  float lobe = a * a / max(d * d, 1e-6);
  float smith = 0.25 / (mix(max(n_l, 0.0), 1.0, 0.5 * a) * mix(n_v, 1.0, 0.5 * a));
  float fresnel = 0.04 + 0.96 * fifth(1.0 - max(dot(h, viewer), 0.0));
  vec3 mirrored = reflect(-viewer, n);
  vec3 around = mix(frame.bounce_colour.rgb, frame.sky_colour.rgb,
                    smoothstep(-0.4, 0.6, mirrored.y));
  float edge = 1.0 - n_v;
  vec3 rim = frame.sky_colour.rgb *
             (edge * edge * edge * smoothstep(-0.35, 0.6, n.y + 0.3) * frame.rim.x * 0.6);
  gloss = vec4(around * (0.04 + (1.0 - roughness) * 0.96 * fifth(edge)) + rim,
               min(fresnel * lobe * smith * 0.32, 1.5));
}
