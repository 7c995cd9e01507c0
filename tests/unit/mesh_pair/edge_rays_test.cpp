// SPDX-License-Identifier: MIT
// Edges as rays find crossings far from the pairs they come from, and nothing where nothing is.
#include "core/collision/edge_rays.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "tests/support/shapes.h"

namespace elbowroom {
namespace {

TEST(EdgeRays, HitsAreContactsAndFreeMeshesHaveNone) {
  Random random(41);
  const test::Shape limb = test::limb_shape(0.05f, 0.3f, 30, 20, random);
  const test::Shape trunk = test::limb_shape(0.2f, 0.4f, 40, 30, random);
  auto a = CollisionMesh::build(trunk.positions, trunk.triangles);
  auto b = CollisionMesh::build(limb.positions, limb.triangles);
  ASSERT_TRUE(a.ok() && b.ok());
  int hits = 0, crossing = 0;
  std::vector<TriangleContact> contacts;
  for (int i = 0; i < 300; ++i) {
    const RigidTransform t{
        glm::mat3_cast(quat_from_rotation_vector(
            {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)})),
        {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.5, 0.5)}};
    find_contacts(*a, *b, t, 0, {}, contacts);
    std::erase_if(contacts, [](const TriangleContact& c) { return c.contained; });
    // Every triangle of the limb in turn, against whatever it may hit.
    std::vector<TrianglePair> pairs;
    for (std::uint32_t k = 0; k < limb.triangles.size(); k += 60) pairs.push_back({0, k});
    if (!contacts.empty()) pairs.push_back({contacts[0].triangle_a, contacts[0].triangle_b});
    TrianglePair found{0, 0};
    const bool hit = edges_cross(a->data(), b->data(), t, pairs, {}, found);
    crossing += !contacts.empty();
    hits += hit;
    if (!hit) continue;
    EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(), [&](const TriangleContact& c) {
      return c.triangle_a == found.a && c.triangle_b == found.b;
    }));
  }
  EXPECT_GT(crossing, 60);
  EXPECT_LT(crossing, 240);
  EXPECT_GT(hits, crossing / 3);
}

}  // namespace
}  // namespace elbowroom
