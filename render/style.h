// SPDX-License-Identifier: MIT
// How pictures look, all in one place: colours, light, lines. Defaults are the dark house style.
//
// Lengths are in units of the scene's size (the first character's height, Frame::size), so that a
// file in centimetres looks like one in metres; line widths are pixels of a picture at scale 1.
#pragma once

#include "render/colour.h"

namespace elbowroom {

struct Style {
  // Backdrop: a soft pool of light behind the figure, falling off to the edges.
  Rgb backdrop_centre = 0x3a4150;
  Rgb backdrop_edge = 0x191c22;

  // Ground grid. Lines are a decimal fraction of the scene's units apart, major ones five of them.
  bool ground = true;
  Rgb grid = 0x565e6e;
  float grid_opacity = 0.42f;
  float grid_radius = 4.0f;  // × size: where the lines have faded out
  Rgb ground_shadow = 0x08090b;
  float ground_shadow_opacity = 0.72f;

  // Surfaces. Base colours of files are kept in this proportion, the rest is the role's own tone.
  Rgb character = 0xd8d2c8;  // for characters without colours of their own
  Rgb obstacle = 0x8f9cb2;
  float character_materials = 1.0f;
  float obstacle_materials = 0.30f;
  bool cull_back_faces = true;  // of materials that are not double-sided, as glTF has it

  // Light. Key and fill turn with the camera if key_follows_camera, else with the world.
  bool key_follows_camera = false;
  float key_azimuth = -40.0f;   // degrees, from +z towards +x (or from the camera)
  float key_elevation = 48.0f;  // degrees above the ground
  Rgb key_colour = 0xfff1e0;
  float key = 1.45f;
  float key_size = 0.055f;  // tangent of the light's angular radius: softness of shadows
  Rgb fill_colour = 0xb9c9ea;
  float fill = 0.38f;
  Rgb sky_colour = 0xc3cfe6;
  float sky = 0.34f;
  Rgb bounce_colour = 0x8a7f78;  // ambient light from below
  float bounce = 0.15f;
  float rim = 0.5f;  // light from behind, which parts the figure from the backdrop
  float exposure = 1.0f;

  // Ambient occlusion.
  float occlusion = 1.0f;          // 0 switches it off
  float occlusion_radius = 0.16f;  // × size

  // Marks.
  Rgb problem = 0xff7a45;
  Rgb good = 0x3ecf9a;
  Rgb accent = 0x4da3ff;
  Rgb selection = 0xffd166;
  Rgb ghost = 0xa78bfa;
  float contact_radius = 0.06f;  // × size: reach of a contact's glow on the surfaces
  float trail_width = 2.5f;      // pixels

  int shadow_map_size = 2048;  // texels, a side
  int samples = 4;             // a pixel; capped by what the driver has
  bool draft = false;  // hard shadows, no occlusion, plain textures: for pictures that move where
                       // there is no GPU (render/quality.h)

  bool operator==(const Style&) const = default;
};

}  // namespace elbowroom
