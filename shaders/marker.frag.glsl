// SPDX-License-Identifier: MIT
in vec2 pixel;
flat in vec4 tint;
flat in vec2 shape;
layout(location = 0) out vec4 colour;
layout(location = 0) uniform float strength;

void main() {
  float r = length(pixel);
  float alpha = clamp(shape.y + 0.5 - r, 0.0, 1.0);
  vec3 rgb = tint.rgb;
  if (shape.x > 1.5) {
    float inside = max(1.0 - r / shape.y, 0.0);
    alpha = inside * inside;
  } else if (shape.x > 0.5) {
    // A ring with a thin dark seam on both sides, so that it reads on any surface.
    float width = max(0.16 * shape.y, 1.4);
    float from_middle = abs(r - (shape.y - 1.5 * width));
    float ring = clamp(0.5 * width + 0.5 - from_middle, 0.0, 1.0);
    float seam = clamp(width + 0.5 - from_middle, 0.0, 1.0) * 0.5;
    alpha = max(ring, seam);
    rgb = alpha > 0.0 ? mix(vec3(0.004), tint.rgb, ring / alpha) : tint.rgb;
  }
  alpha *= tint.a * strength;
  if (alpha <= 0.0) discard;
  colour = vec4(rgb * alpha, alpha);
}
