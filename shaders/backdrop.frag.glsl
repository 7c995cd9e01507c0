// SPDX-License-Identifier: MIT
#include "frame.glsl"
in vec2 screen;
layout(location = 0) out vec4 colour;

void main() {
  vec2 from_centre = (screen - vec2(0.5, 0.56)) * vec2(1.05, 1.2);
  float reach = smoothstep(0.0, 0.78, length(from_centre));
  vec3 tone = mix(sqrt(frame.backdrop_centre.rgb), sqrt(frame.backdrop_edge.rgb), reach);
  colour = vec4(dithered(tone * tone, gl_FragCoord.xy), 1.0);
}
