// SPDX-License-Identifier: MIT
#include "render/render_geometry.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/render/scenes.h"

namespace elbowroom::test {
namespace {

Model model_of(Mesh mesh) {
  Model model;
  add_object(model, add_mesh(model, std::move(mesh), add_node(model, -1, {})));
  return model;
}

TEST(RenderGeometry, CreasesStaySharpWhereNormalsAreMade) {
  const RenderGeometry box = make_render_geometry(model_of(box_mesh({1, 2, 3})));
  EXPECT_EQ(box.vertices.size(), 24u);  // three a corner
  for (std::size_t i = 0; i < box.indices.size(); i += 3) {
    const auto &a = box.vertices[box.indices[i]], &b = box.vertices[box.indices[i + 1]],
               &c = box.vertices[box.indices[i + 2]];
    const auto face = glm::normalize(glm::cross(b.position - a.position, c.position - a.position));
    EXPECT_GT(glm::dot(face, a.normal), 0.9999f);
    EXPECT_GT(glm::dot(face, b.normal), 0.9999f);
    EXPECT_GT(glm::dot(face, c.normal), 0.9999f);
  }
}

TEST(RenderGeometry, RoundShapesAreSmooth) {
  const Mesh sphere = sphere_mesh(2.0f, 32, 64);
  const RenderGeometry geometry = make_render_geometry(model_of(sphere));
  for (const auto i : geometry.indices) {
    EXPECT_GT(glm::dot(geometry.vertices[i].normal, glm::normalize(geometry.vertices[i].position)),
              0.995f);
  }
}

TEST(RenderGeometry, TrianglesKeepTheirOrderAndNumber) {
  Mesh mesh = box_mesh(glm::vec3(1.0f));
  mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  mesh.triangles.emplace_back(1, 2, 99);
  Model model = model_of(mesh);
  add_object(model, add_mesh(model, box_mesh(glm::vec3(2.0f)), 0));
  const RenderGeometry geometry = make_render_geometry(model);
  EXPECT_EQ(geometry.triangle_count, 25u);
  EXPECT_EQ(geometry.meshes[0].index_count, 39u);
  EXPECT_EQ(geometry.meshes[1].first_triangle, 13u);
  for (std::size_t t = 0; t < 12; ++t) {
    const bool touched =
        mesh.triangles[t].x == 3 || mesh.triangles[t].y == 3 || mesh.triangles[t].z == 3;
    for (int k = 0; k < 3; ++k) {
      const auto vertex = geometry.indices[3 * t + static_cast<std::size_t>(k)];
      if (!touched) {
        EXPECT_EQ(geometry.bindings[vertex].source, mesh.triangles[t][k]);
      }
      EXPECT_TRUE(std::isfinite(geometry.vertices[vertex].position.y));
    }
  }
}

TEST(RenderGeometry, EmptyAndMalformedMeshes) {
  EXPECT_TRUE(make_render_geometry(Model{}).vertices.empty());
  EXPECT_TRUE(make_render_geometry(model_of(Mesh{})).vertices.empty());
  Mesh only_triangles;
  only_triangles.triangles.emplace_back(0, 1, 2);
  EXPECT_TRUE(make_render_geometry(model_of(only_triangles)).indices.empty());
  Mesh skinless = box_mesh(glm::vec3(1.0f));
  skinless.skin = 5;  // no such skin
  EXPECT_EQ(make_render_geometry(model_of(skinless)).palette_size, 1u);
}

TEST(RenderGeometry, PaletteTellsMirrorsAndWhatIsNotFinite) {
  Model model = model_of(box_mesh(glm::vec3(1.0f)));
  const RenderGeometry geometry = make_render_geometry(model);
  std::vector<PaletteEntry> palette;
  Mat4 m(1.0);
  EXPECT_EQ(make_palette(model, geometry, {m}, Vec3(0.0), {}, palette).at(0), 1);
  m[0][0] = -1;
  EXPECT_EQ(make_palette(model, geometry, {m}, Vec3(0.0), {}, palette).at(0), -1);
  m[3] = glm::dvec4(1e8, 0, 0, 1);
  make_palette(model, geometry, {m}, Vec3(1e8 - 0.25, 0, 0), {0.5f}, palette);
  EXPECT_EQ(palette[0].row[0].w, 0.25f);
  EXPECT_EQ(palette[0].emphasis.x, 0.5f);
  m[1][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(make_palette(model, geometry, {m}, Vec3(0.0), {}, palette).at(0), 0);
  EXPECT_EQ(make_palette(model, geometry, {}, Vec3(0.0), {}, palette).at(0), 0);
}

}  // namespace
}  // namespace elbowroom::test
