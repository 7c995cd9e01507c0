// SPDX-License-Identifier: MIT
#include "frame.glsl"
#include "shadow.glsl"
#include "occlusion.glsl"
#include "tone.glsl"
in vec3 position;
in vec3 normal;
in vec2 uv;
in float emphasis;
layout(location = 0) out vec4 colour;

layout(location = 2) uniform vec4 material;  // roughness, metallic

float fifth(float x) { return x * x * x * x * x; }

void main() {
  vec3 viewer = to_viewer(position);
  vec3 n = normalize(normal);
  vec3 face = cross(dFdx(position), dFdy(position));
  if (dot(face, viewer) < 0.0) face = -face;
  if (dot(n, face) < 0.0) n = -n;

  float hot = glow(position);
  vec3 albedo = albedo_of(uv, emphasis, hot);

  float key = key_visibility(position, n, gl_FragCoord.xy);
  float open = ambient_visibility(position);
  vec3 l = frame.key_direction.xyz;
  float n_l = max(dot(n, l), 0.0);
  float n_v = max(dot(n, viewer), 1e-3);

  vec3 ambient = mix(frame.bounce_colour.rgb, frame.sky_colour.rgb, 0.5 + 0.5 * n.y);
  // The fill wraps round, so that the unlit side keeps its shape.
  float wrap = max((dot(n, frame.fill_direction.xyz) + 0.4) / 1.4, 0.0);
  ambient += frame.fill_colour.rgb * wrap * wrap;
  vec3 light = frame.key_colour.rgb * (n_l * key) + ambient * open;

  float roughness = clamp(material.x, 0.25, 1.0);
  float metallic = material.y;
  vec3 f0 = mix(vec3(0.04), albedo, 0.7 * metallic);
  vec3 diffuse = albedo * (1.0 - 0.45 * metallic) * light;

  vec3 h = normalize(l + viewer);
  float a = roughness * roughness;
  float n_h = max(dot(n, h), 0.0);
  float d = n_h * n_h * (a * a - 1.0) + 1.0;
  float lobe = a * a / max(d * d, 1e-6);
  float smith = 0.25 / (mix(n_l, 1.0, 0.5 * a) * mix(n_v, 1.0, 0.5 * a));
  float graze = fifth(1.0 - n_v);
  vec3 fresnel = f0 + (1.0 - f0) * fifth(1.0 - max(dot(h, viewer), 0.0));
  vec3 gloss = frame.key_colour.rgb * (n_l * key) * min(fresnel * lobe * smith * 0.32, vec3(1.5));
  vec3 mirrored = reflect(-viewer, n);
  vec3 around = mix(frame.bounce_colour.rgb, frame.sky_colour.rgb,
                    smoothstep(-0.4, 0.6, mirrored.y));
  gloss += around * open * (f0 + (1.0 - roughness) * (1.0 - f0) * graze);

  // A thin light from behind and above parts the figure from the backdrop.
  float edge = (1.0 - n_v) * (1.0 - n_v) * (1.0 - n_v) * smoothstep(-0.35, 0.6, n.y + 0.3);
  vec3 back = frame.sky_colour.rgb * (edge * frame.rim.x * open) * (0.35 + 0.65 * albedo);

  vec3 result = (diffuse + gloss + back) * frame.rim.y;
  result += frame.problem.rgb * hot * 0.35;
  colour = vec4(dithered(toned(result), gl_FragCoord.xy), 1.0);
}
