// SPDX-License-Identifier: MIT
// The constants of a picture as shaders/frame.glsl has them (std140), and what they are made from.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/camera.h"
#include "render/frame.h"
#include "render/style.h"

namespace elbowroom {

inline constexpr int kMaxContacts = 64;

struct FrameUniforms {
  glm::mat4 clip_from_world, view_from_world, light_from_world;
  glm::vec4 eye, backward, viewport, key_direction, key_colour, fill_direction, fill_colour;
  glm::vec4 sky_colour, bounce_colour, rim, shadow, occlusion, unproject, backdrop_centre;
  glm::vec4 backdrop_edge, ground, ground_offset, grid_colour, ground_shadow, problem;
  glm::vec4 contact_count;
  glm::vec4 contacts[kMaxContacts];
};

// What the picture's geometry comes to, before it is packed.
struct ViewSetup {
  Camera camera;
  double aspect = 1;
  double near = 0.1, far = 100;  // distances from the eye
  double size = 1;               // scene_size
  double ground = 0;             // height of the grid, world
  double shadow_width = 1, shadow_range = 1;
  Mat4 clip_from_world{1.0};  // "world" is relative to the camera's focus from here on
  Mat4 light_clip_from_world{1.0};
  Vec3 key_direction{0, 1, 0};
};

// `bodies` are the boxes of the meshes drawn, world space.
ViewSetup make_view(const Camera& camera, const Style& style, const Frame& frame,
                    const std::vector<Bounds>& bodies, double size, double aspect);

FrameUniforms make_uniforms(const ViewSetup& view, const Style& style, const Frame& frame,
                            int width, int height);

}  // namespace elbowroom
