// SPDX-License-Identifier: MIT
in vec4 tint;
in vec2 pixel;
flat in vec3 measures;
in float along;
layout(location = 0) out vec4 colour;
layout(location = 0) uniform float strength;

void main() {
  float beyond = max(max(-pixel.x, pixel.x - measures.x), 0.0);
  float away = length(vec2(beyond, pixel.y));
  float alpha = clamp(measures.y + 0.5 - away, 0.0, 1.0);
  if (measures.z > 0.0 && fract(along / measures.z) > 0.55) alpha = 0.0;
  alpha *= tint.a * strength;
  if (alpha <= 0.0) discard;
  colour = vec4(tint.rgb * alpha, alpha);
}
