// SPDX-License-Identifier: MIT
#include "frame.glsl"
#include "shadow.glsl"
#include "tone.glsl"
in vec3 position;
in vec4 light;
in vec4 gloss;
in vec3 uv_emphasis;
layout(location = 0) out vec4 colour;

layout(location = 2) uniform vec4 material;  // roughness, metallic

void main() {
  float hot = glow(position);
  vec3 albedo = albedo_of(uv_emphasis.xy, uv_emphasis.z, hot);
  float n_l = max(light.w, 0.0);
  float key = n_l > 0.0 ? key_visibility(position, light.w) : 0.0;
  vec3 lit = frame.key_colour.rgb * (n_l * key);
  vec3 result = albedo * (1.0 - 0.45 * material.y) * (lit + light.rgb) + gloss.rgb +
                lit * gloss.w;
  result = result * frame.rim.y + frame.problem.rgb * hot * 0.35;
  colour = vec4(toned(result), 1.0);
}
