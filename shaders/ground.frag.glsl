// SPDX-License-Identifier: MIT
// The ground is no surface of its own but what falls on the backdrop: grid lines, the shadow of the
// key light, and contact shadows. All fade towards the horizon. Premultiplied alpha.
#include "frame.glsl"
#include "shadow.glsl"
#include "occlusion.glsl"
in vec3 position;
in vec3 normal;
in vec2 uv;
in float emphasis;
layout(location = 0) out vec4 colour;

// Coverage of lines `spacing` apart and about a pixel wide; gone before they blur together.
float lines(vec2 at, float spacing, vec2 width) {
  vec2 away = abs(fract(at / spacing - 0.5) - 0.5) * spacing;
  vec2 cover = 1.0 - smoothstep(0.35 * width, 1.15 * width, away);
  cover *= 1.0 - smoothstep(0.08, 0.3, width / spacing);
  return max(cover.x, cover.y);
}

void main() {
  float fade = 1.0 - smoothstep(0.15, 1.0, length(uv));
  vec3 viewer = to_viewer(position);
  float above = smoothstep(0.0, 0.05, viewer.y);  // seen from below it is not there
  vec2 at = position.xz - frame.ground_offset.zw;
  vec2 width = max(fwidth(at), 1e-9);
  float minor = lines(at, frame.ground.y, width);
  float major = lines(at, 5.0 * frame.ground.y, width);
  float line = frame.grid_colour.w * fade * max(0.42 * minor, major);

  float shade = 0.0;
  if (frame.ground.w > 0.5 && fade * above > 0.0) {
#ifdef DRAFT
    float key = 1.0 - key_visibility(position, frame.key_direction.y);
    float contact = 0.0;
#else
    float key = 1.0 - key_visibility(position, normal, gl_FragCoord.xy);
    float contact = 1.0 - ambient_visibility(position);
#endif
    shade = 1.0 - (1.0 - 0.62 * key) * (1.0 - 0.85 * contact);
  }
  float dark = shade * frame.ground_shadow.w * fade * above;
  float bright = line * above;
  // The line lies in the shadow: it is dimmed by it and drawn over it.
  bright *= 1.0 - 0.6 * dark;
  vec3 rgb = frame.ground_shadow.rgb * dark * (1.0 - bright) + frame.grid_colour.rgb * bright;
  colour = vec4(rgb, bright + dark * (1.0 - bright));
}
