// SPDX-License-Identifier: MIT
// What a surface's own colour is, what glows on it, and how light becomes a picture's tone.
layout(binding = 0) uniform sampler2D base_texture;
layout(std430, binding = 0) readonly buffer Glow { uint glow_levels[]; };

layout(location = 0) uniform vec4 base_colour;
layout(location = 1) uniform vec4 tone;         // rgb of the role, w: how much of the own colour
layout(location = 3) uniform vec4 emphasis_colour;  // w: strength
layout(location = 4) uniform int glow_base;     // first triangle in glow_levels' bytes; < 0: none

// A straight line up to the knee, then a shoulder that only reaches white at infinity.
vec3 toned(vec3 light) {
  const float knee = 0.55;
  vec3 over = max(light - knee, 0.0) / (1.0 - knee);
  return min(light, knee) + (1.0 - knee) * over / (1.0 + over);
}

float glow(vec3 position) {
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

// The surface's colour with the texture's, the role's, the emphasis' and the problem's share in it.
vec3 albedo_of(vec2 uv, float emphasis, float hot) {
  vec3 own = base_colour.rgb * texture(base_texture, uv).rgb;
  float luminance = dot(own, vec3(0.2126, 0.7152, 0.0722));
  vec3 albedo = mix(tone.rgb * mix(0.55, 1.2, sqrt(luminance)), own, tone.w);
  albedo = clamp(albedo, vec3(0.012), vec3(0.86));
  albedo = mix(albedo, emphasis_colour.rgb * mix(0.6, 1.1, sqrt(luminance)),
               emphasis_colour.w * smoothstep(0.25, 0.75, emphasis));
  return mix(albedo, frame.problem.rgb, 0.9 * hot);
}
