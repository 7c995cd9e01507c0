// SPDX-License-Identifier: MIT
#include "core/collision/topology.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace elbowroom {
namespace {

TEST(Topology, ClosedMeshesHaveUniqueEdgesAndNoBorder) {
  const test::Shape sphere = test::sphere_shape(1, 7, 12);
  const Topology t = build_topology(sphere.positions, sphere.triangles, false);
  ASSERT_EQ(t.components.size(), 1u);
  EXPECT_TRUE(t.components[0].encloses);
  EXPECT_EQ(t.complex_faces, 0u);
  // Euler: V − E + F = 2.
  EXPECT_EQ(sphere.positions.size() + sphere.triangles.size(), t.edges.size() + 2);
}

TEST(Topology, SeamsAreWelded) {
  const test::Shape sphere = test::sphere_shape(1, 7, 12);
  test::Shape soup;
  for (const auto& t : sphere.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    for (int k = 0; k < 3; ++k) soup.positions.push_back(sphere.positions[t[k]]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const Topology t = build_topology(soup.positions, soup.triangles, false);
  EXPECT_EQ(t.components.size(), 1u);
  EXPECT_TRUE(t.components[0].encloses);
  EXPECT_EQ(t.edges.size() * 2, soup.triangles.size() * 3);
}

TEST(Topology, OpeningsAreLoopsWithCaps) {
  const test::Shape tube = test::tube_shape(1, 2, 5, 12, false);
  const Topology open = build_topology(tube.positions, tube.triangles, false);
  EXPECT_FALSE(open.components[0].encloses);
  EXPECT_EQ(open.components[0].border_edges, 24u);
  EXPECT_TRUE(open.caps.empty());
  const Topology capped = build_topology(tube.positions, tube.triangles, true);
  EXPECT_TRUE(capped.components[0].encloses);
  ASSERT_EQ(capped.loops.size(), 2u);
  EXPECT_EQ(capped.loops[0].vertices.size(), 12u);
  EXPECT_EQ(capped.caps.size(), 24u);
  EXPECT_LT(glm::length(loop_middle(capped.loops[0], tube.positions) - Vec3(0, 0, -2)), 1e-6);
}

TEST(Topology, ComplexFacesRepeatsAndFlipsKeepTheirPlace) {
  test::Shape box = test::box_shape({1, 1, 1});
  std::swap(box.triangles[3].y, box.triangles[3].z);  // OpenMesh refuses the flipped one
  box.triangles.push_back(box.triangles[0]);          // given twice
  box.triangles.push_back({0, 0, 1});                 // without area
  const Topology t = build_topology(box.positions, box.triangles, false);
  EXPECT_GT(t.complex_faces, 0u);
  EXPECT_EQ(t.components.size(), 1u);
  EXPECT_TRUE(t.components[0].encloses);
  EXPECT_EQ(t.edges.size(), 18u);
  EXPECT_FALSE(t.counts[12]);
  EXPECT_FALSE(t.counts[13]);
  // A fin at one edge opens it: three faces there.
  box.positions.push_back({3, 3, 3});
  box.triangles.push_back({0, 1, 8});
  EXPECT_FALSE(build_topology(box.positions, box.triangles, false).components[0].encloses);
}

TEST(Topology, ComponentsAreCountedApart) {
  test::Shape two = test::box_shape({1, 1, 1});
  test::append(two, test::sheet_shape(1, 2), {5, 0, 0});
  const Topology t = build_topology(two.positions, two.triangles, false);
  ASSERT_EQ(t.components.size(), 2u);
  EXPECT_TRUE(t.components[0].encloses);
  EXPECT_FALSE(t.components[1].encloses);
  EXPECT_EQ(t.components[1].first_triangle, 12u);
  EXPECT_EQ(t.components[1].triangles, 8u);
}

}  // namespace
}  // namespace elbowroom
