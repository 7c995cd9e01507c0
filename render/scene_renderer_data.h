// SPDX-License-Identifier: MIT
// What a SceneRenderer holds, and the passes that make a picture of it. Private to the render
// folder.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/frame_uniforms.h"
#include "render/gpu_model.h"
#include "render/overlay.h"
#include "render/picture_buffers.h"
#include "render/scene_renderer.h"
#include "render/shader.h"

namespace elbowroom {

// Texture units and storage bindings of the shaders.
enum Unit : GLuint {
  kBase = 0,
  kShadowCompare = 1,
  kShadowDepth = 2,
  kOcclusion = 3,
  kGeometry = 4
};
inline constexpr GLuint kFrameBinding = 0, kGlowBinding = 0;

// One mesh of one actor to be drawn.
struct DrawnMesh {
  std::size_t actor = 0;
  int mesh = 0;
  Role role = Role::obstacle;
};

struct SceneRenderer::Data {
  GlProgram skinning, surface, shadow, geometry, ground_geometry, occlusion, blur, backdrop, ground,
      ghost, ghost_depth, pick, draft_surface, draft_ground;
  std::optional<Overlay> overlay;
  PictureBuffers buffers;
  GlSampler base_sampler, plain_sampler, compare_sampler, depth_sampler;
  GlVertexArray empty;
  StreamBuffer uniforms, glow;
  std::vector<std::unique_ptr<GpuModel>> models;
  std::vector<GpuFigure> figures;        // by actor
  std::vector<GpuFigure> ghost_figures;  // by ghost

  // Of the last frame.
  std::vector<GpuModel*> actor_models;
  std::vector<DrawnMesh> items;
  std::vector<int> glow_begin;  // by actor: its first byte in the glow buffer, −1: none
  ViewSetup view;
  bool drawn = false;

  // What the shadow map shows; empty: nothing.
  struct Cast {
    std::size_t actor;
    int mesh;
    std::uint64_t version;
    bool operator==(const Cast&) const = default;
  };
  std::vector<Cast> casts;
  // What a kept picture shows.
  struct Scene {
    std::vector<Cast> items;
    std::vector<std::uint8_t> uniforms, glow;
    std::vector<glm::vec4> emphasis;  // by actor
    Style style;
    bool operator==(const Scene&) const = default;
  };
  std::optional<Scene> kept_scene;
  std::vector<std::uint8_t> glow_levels;  // as uploaded
  Scene scene_of(const Frame& frame, const Style& style, const FrameUniforms& uniforms) const;
  void draw_scene(const Frame& frame, const Style& style);
  void copy_picture(const GlFramebuffer& from, const GlFramebuffer& to) const;

  Mat4 cast_matrix{0.0};
  unsigned cast_map = 0;

  GpuModel* model(const std::shared_ptr<const Model>& wanted);
  void drop_unused_models();
  void collect(const Frame& frame);
  // Deforms all figures and sets the view; `items` are then what is to be drawn.
  void set_frame(const Frame& frame, const Camera& camera, const Style& style, double aspect);
  void deform_figures(const Frame& frame, const Vec3& origin);
  void upload_glow(const Frame& frame);
  void draw_shadow();
  void draw_occlusion(const Style& style);
  void draw_surfaces(const Frame& frame, const Style& style);
  void draw_ghosts(const Frame& frame);
  void bind_maps() const;
  std::vector<Pick> draw_ids(const Mat4& clip_from_world, int width, int height);
};

}  // namespace elbowroom
