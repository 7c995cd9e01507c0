// SPDX-License-Identifier: MIT
// What all shaders of a picture share. "World" is relative to an origin near the camera.
layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_world;
  mat4 view_from_world;
  mat4 light_from_world;   // to [0, 1]³ of the shadow map
  vec4 eye;                // xyz; w = 1: orthographic
  vec4 backward;           // unit, from the picture to the viewer
  vec4 viewport;           // width, height, 1 / width, 1 / height
  vec4 key_direction;      // towards the light
  vec4 key_colour;
  vec4 fill_direction;
  vec4 fill_colour;
  vec4 sky_colour;
  vec4 bounce_colour;
  vec4 rim;                // x: strength, y: exposure
  vec4 shadow;             // world width of the map, depth range, tan of the light's radius, texels
  vec4 occlusion;          // strength, radius (world), pixels a unit at distance 1, 1: on
  vec4 unproject;          // view xy of a point at distance 1: half width, half height
  vec4 backdrop_centre;
  vec4 backdrop_edge;
  vec4 ground;             // height, line spacing, radius, 1: lit
  vec4 ground_offset;      // xz: centre, zw: phase of the lines
  vec4 grid_colour;        // w: opacity
  vec4 ground_shadow;      // w: opacity
  vec4 problem;
  vec4 contact_count;      // x
  vec4 contacts[64];       // place, radius
} frame;

// A fixed pattern that differs between neighbours and averages out over a few pixels
// (interleaved gradient noise, Jimenez 2014).
float pattern(vec2 pixel) {
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// Breaks the bands of slow gradients: half a step of the 8-bit sRGB target, in linear light.
vec3 dithered(vec3 colour, vec2 pixel) {
  return max(colour + (pattern(pixel + 17.0) - 0.5) * (2.2 / 255.0) * sqrt(max(colour, 0.0)), 0.0);
}

vec3 to_viewer(vec3 position) {
  return frame.eye.w > 0.5 ? frame.backward.xyz : normalize(frame.eye.xyz - position);
}
