// SPDX-License-Identifier: MIT
// A model's triangles as a GPU takes them: one vertex list for all meshes, one palette of matrices
// for all skins and rigid nodes. No GL here.
//
// Triangles keep the file's order (triangle i of a mesh is primitive i of its draw), so that
// highlights and picking speak of the same indices as collision. Where a mesh has no normals,
// smooth ones are made, with creases kept sharp; a vertex on a crease is split.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/model.h"
#include "core/scene/world.h"

namespace elbowroom {

struct RenderVertex {
  glm::vec3 position;
  float u;
  glm::vec3 normal;
  float v;
};

struct RenderInfluence {
  std::uint32_t palette;
  float weight;
};

// What the skinning shader needs to know of a vertex besides its RenderVertex.
struct RenderBinding {
  std::uint32_t influence_begin, influence_end;
  std::uint32_t mesh;
  std::uint32_t source;  // vertex index in the Mesh: morph offsets are by that
};

struct RenderMesh {
  std::uint32_t first_vertex = 0, vertex_count = 0;
  std::uint32_t first_index = 0, index_count = 0;
  std::uint32_t first_triangle = 0;  // in the model's count over all meshes
  std::uint32_t palette_begin = 0, palette_end = 0;
  std::vector<std::int32_t> morph_block;  // by target: its block of offsets, -1 if it has none
};

struct RenderGeometry {
  std::vector<RenderVertex> vertices;
  std::vector<RenderBinding> bindings;  // one a vertex
  std::vector<RenderInfluence> influences;
  std::vector<std::uint32_t> indices;  // into vertices
  std::vector<glm::vec3> morph_offsets;
  std::vector<RenderMesh> meshes;           // by mesh index
  std::vector<std::uint32_t> skin_palette;  // first palette entry of each skin
  std::uint32_t palette_size = 0;
  std::uint32_t triangle_count = 0;

  // Bind-space box of the vertices each palette entry moves; lower > upper if it moves none.
  struct Box {
    glm::vec3 lower, upper;
  };
  std::vector<Box> palette_boxes;
  bool has_morphs = false;
};

// Faces that meet at more than this angle are a crease, where normals have to be made.
inline constexpr double kCreaseAngle = 0.7;

// Vertices that are not finite and indices out of range make their triangles degenerate; nothing is
// dropped. O(triangles log triangles).
RenderGeometry make_render_geometry(const Model& model);

// One matrix of the palette, relative to `origin`: world − origin in float.
struct PaletteEntry {
  glm::vec4 row[3];          // of the affine matrix origin_from_bind
  glm::vec4 emphasis{0.0f};  // x: how much the joint is part of what is emphasized, [0, 1]
};

// The palette of one state. `emphasis` is by node and may be empty. Entries that are not finite get
// the zero matrix; returns by mesh whether all it uses is finite and the sign of its determinant
// (+1, −1 for a mirrored placement, 0: not drawable).
std::vector<int> make_palette(const Model& model, const RenderGeometry& geometry,
                              const std::vector<Mat4>& world_from_joint, const Vec3& origin,
                              const std::vector<float>& emphasis,
                              std::vector<PaletteEntry>& palette);

}  // namespace elbowroom
