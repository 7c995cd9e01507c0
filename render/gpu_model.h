// SPDX-License-Identifier: MIT
// A model on the GPU, and its figure: the model deformed by one state.
//
// Skinning runs once a frame in a compute shader, morph targets before it, any number of influences
// a vertex; what all passes (shadow, occlusion, picture, ghosts) draw is the deformed buffer. Rigid
// meshes go the same way with one influence. Positions are relative to an origin near the camera,
// so that floats keep their digits far from the world's origin.
#pragma once

#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/scene/world.h"
#include "render/bounds.h"
#include "render/gl_objects.h"
#include "render/render_geometry.h"

namespace elbowroom {

// What is uploaded once. Keeps the model alive.
class GpuModel {
 public:
  explicit GpuModel(std::shared_ptr<const Model> model);

  const Model& model() const { return *model_; }
  std::weak_ptr<const Model> identity() const { return model_; }
  // Nobody but this holds the model any more.
  bool unused() const { return model_.use_count() == 1; }
  const RenderGeometry& geometry() const { return geometry_; }
  // Texture of the material's base colour, a white one if it has none.
  unsigned texture(int material) const;
  bool has_texture(int material) const { return texture(material) != white_.name(); }

  unsigned vertices() const { return vertices_.name(); }
  unsigned bindings() const { return bindings_.name(); }
  unsigned influences() const { return influences_.name(); }
  unsigned morph_offsets() const { return morph_offsets_.name(); }
  unsigned indices() const { return indices_.name(); }

 private:
  std::shared_ptr<const Model> model_;
  RenderGeometry geometry_;
  GlBuffer vertices_, bindings_, influences_, morph_offsets_, indices_;
  std::vector<GlTexture> images_;
  GlTexture white_;
};

// The deformed vertices of one model in one state.
class GpuFigure {
 public:
  GpuFigure();

  // Deforms `model` into this figure's buffer, unless it is there already. `emphasis` is by node,
  // [0, 1], or empty.
  void deform(const GlProgram& skinning, const GpuModel& model, const ActorState& state,
              const Vec3& origin, const std::vector<float>& emphasis);

  // Another one after each deform() that changed something.
  std::uint64_t version() const { return version_; }

  // Binds the vertex array and draws one mesh; the program is the caller's.
  void bind() const;
  void draw(const GpuModel& model, int mesh) const;
  // +1, −1 (mirrored: winding turns round), 0: not to be drawn (not finite).
  int winding(int mesh) const { return winding_[static_cast<std::size_t>(mesh)]; }
  // Box of one mesh or of all, world space; it holds the mesh but may be larger.
  Bounds bounds(int mesh) const { return bounds_[static_cast<std::size_t>(mesh)]; }

  // The deformed positions, world space, by RenderGeometry's vertices. Waits for the GPU; for tests
  // and measuring.
  std::vector<Vec3> read_positions(const GpuModel& model) const;

 private:
  StreamBuffer deformed_, palette_, active_morphs_, mesh_morphs_;
  GlVertexArray array_;
  Vec3 origin_{0.0};
  std::weak_ptr<const Model> model_;
  std::uint64_t version_ = 0;
  std::vector<PaletteEntry> palette_entries_, last_palette_;
  std::vector<std::uint32_t> morphs_, last_morphs_;  // bits of what is uploaded, for comparison
  std::vector<int> winding_;
  std::vector<Bounds> bounds_;
};

}  // namespace elbowroom
