// SPDX-License-Identifier: MIT
// Culling lets the same pairs through, in the same order, in every instruction set of this machine,
// and drops none that is close.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <set>
#include <vector>

#include "core/base/random.h"
#include "core/collision/box_traversal.h"
#include "core/collision/mesh_pair.h"
#include "core/collision/triangle_predicates.h"
#include "tests/support/shapes.h"

namespace elbowroom {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

bool collect(void* context, std::uint32_t one, const std::uint32_t* many, int count,
             bool one_is_a) {
  auto& pairs = *static_cast<Pairs*>(context);
  for (int i = 0; i < count; ++i) {
    pairs.emplace_back(one_is_a ? one : many[i], one_is_a ? many[i] : one);
  }
  return false;
}

TEST(Culling, SameInEveryInstructionSetAndDropsNothingClose) {
  Random random(31);
  const test::Shape sa = test::limb_shape(0.1f, 0.3f, 20, 14, random);
  const test::Shape sb = test::limb_shape(0.05f, 0.2f, 12, 10, random);
  const BoxTree a = build_box_tree(sa.positions, sa.triangles);
  const BoxTree b = build_box_tree(sb.positions, sb.triangles);
  auto mesh_a = CollisionMesh::build(sa.positions, sa.triangles);
  auto mesh_b = CollisionMesh::build(sb.positions, sb.triangles);
  ASSERT_TRUE(mesh_a.ok() && mesh_b.ok());
  const auto triangle = [](const test::Shape& s, std::size_t t, const RigidTransform& place) {
    const auto& i = s.triangles[t];
    return TrianglePoints{place * Vec3(s.positions[i.x]), place * Vec3(s.positions[i.y]),
                          place * Vec3(s.positions[i.z])};
  };
  const auto targets = hwy::SupportedTargets();
  int sets = 0;
  for (int i = 0; i < 12; ++i) {
    const RigidTransform t{
        glm::mat3_cast(quat_from_rotation_vector(
            {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)})),
        {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(-0.4, 0.4)}};
    const double distance = i % 2 ? 0.01 : 0.0;
    std::vector<Pairs> found;
    std::vector<double> distances;
    sets = 0;
    for (auto rest = targets; rest != 0; rest &= rest - 1) {
      hwy::SetSupportedTargetsForTest(rest & -rest);
      hwy::GetChosenTarget().DeInit();
      found.emplace_back();
      visit_close_pairs(a, b, t, distance, nullptr, collect, &found.back());
      distances.push_back(surface_distance(*mesh_a, *mesh_b, t, 1.0));
      ++sets;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
    for (std::size_t k = 1; k < found.size(); ++k) {
      EXPECT_EQ(found[k], found[0]);
      EXPECT_EQ(distances[k], distances[0]);
    }
    const std::set<std::pair<std::uint32_t, std::uint32_t>> let_through(found[0].begin(),
                                                                        found[0].end());
    EXPECT_EQ(let_through.size(), found[0].size());  // each once
    for (std::uint32_t x = 0; x < sa.triangles.size(); ++x) {
      const TrianglePoints ta = triangle(sa, x, {});
      for (std::uint32_t y = 0; y < sb.triangles.size(); ++y) {
        if (let_through.contains({x, y})) continue;
        const TrianglePoints tb = triangle(sb, y, t);
        if (surely_apart(ta, tb, distance)) continue;
        ASSERT_FALSE(triangles_touch(ta, tb, distance)) << x << ' ' << y;
      }
    }
  }
  EXPECT_GE(sets, 1);
  RecordProperty("instruction_sets", sets);
}

}  // namespace
}  // namespace elbowroom
