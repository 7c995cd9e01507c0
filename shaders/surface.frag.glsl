// SPDX-License-Identifier: MIT
#include "frame.glsl"
#include "shadow.glsl"
#include "occlusion.glsl"
in vec3 position;
in vec3 normal;
in vec2 uv;
in float emphasis;
layout(location = 0) out vec4 colour;

layout(binding = 0) uniform sampler2D base_texture;
layout(std430, binding = 0) readonly buffer Glow { uint glow_levels[]; };

layout(location = 0) uniform vec4 base_colour;
layout(location = 1) uniform vec4 tone;         // rgb of the role, w: how much of the own colour
layout(location = 2) uniform vec4 material;     // roughness, metallic
layout(location = 3) uniform vec4 emphasis_colour;  // w: strength
layout(location = 4) uniform int glow_base;     // first triangle in glow_levels' bytes; < 0: none

// A straight line up to the knee, then a shoulder that only reaches white at infinity.
vec3 toned(vec3 light) {
  const float knee = 0.55;
  vec3 over = max(light - knee, 0.0) / (1.0 - knee);
  return min(light, knee) + (1.0 - knee) * over / (1.0 + over);
}

float glow() {
  float level = 0.0;
  if (glow_base >= 0) {
    uint triangle = uint(glow_base + gl_PrimitiveID);
    level = float((glow_levels[triangle >> 2] >> (8u * (triangle & 3u))) & 255u) / 255.0;
  }
  for (int i = 0; i < int(frame.contact_count.x); ++i) {
    vec4 contact = frame.contacts[i];
    float d = length(position - contact.xyz) / contact.w;
    level = max(level, 1.0 - smoothstep(0.35, 1.0, d));
  }
  return level;
}

float fifth(float x) { return x * x * x * x * x; }

void main() {
  vec3 viewer = to_viewer(position);
  vec3 n = normalize(normal);
  vec3 face = cross(dFdx(position), dFdy(position));
  if (dot(face, viewer) < 0.0) face = -face;
  if (dot(n, face) < 0.0) n = -n;

  vec3 own = base_colour.rgb * texture(base_texture, uv).rgb;
  float luminance = dot(own, vec3(0.2126, 0.7152, 0.0722));
  vec3 albedo = mix(tone.rgb * mix(0.55, 1.2, sqrt(luminance)), own, tone.w);
  albedo = clamp(albedo, vec3(0.012), vec3(0.86));
  albedo = mix(albedo, emphasis_colour.rgb * mix(0.6, 1.1, sqrt(luminance)),
               emphasis_colour.w * smoothstep(0.25, 0.75, emphasis));
  float hot = glow();
  albedo = mix(albedo, frame.problem.rgb, 0.9 * hot);

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
