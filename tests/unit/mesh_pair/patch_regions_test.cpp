// SPDX-License-Identifier: MIT
// Regions of allowed patches save time and decide nothing.
#include "core/collision/patch_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/collision/mesh_data.h"
#include "tests/support/shapes.h"

namespace elbowroom {
namespace {

CollisionMesh mesh_of(const test::Shape& shape) {
  auto mesh = CollisionMesh::build(shape.positions, shape.triangles, Openings::open);
  EXPECT_TRUE(mesh.ok());
  return std::move(mesh).value();
}

bool same(const std::vector<TriangleContact>& x, const std::vector<TriangleContact>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const auto& p, const auto& q) {
    return p.triangle_a == q.triangle_a && p.triangle_b == q.triangle_b;
  });
}

// Few patches and more than 64 kinds of them; all, some and none allowed; crossing, near and apart.
TEST(PatchRegions, DecideNothing) {
  Random random(5);
  const CollisionMesh a = mesh_of(test::limb_shape(0.5f, 2, 12, 16, random));
  const CollisionMesh b = mesh_of(test::sphere_shape(1, 15, 24));
  const auto below = [&](std::size_t n) { return random.below(static_cast<std::uint64_t>(n)); };
  int touching = 0, hidden = 0;
  for (int round = 0; round < 200; ++round) {
    const std::size_t patches_a = round % 2 ? 7 : 150, patches_b = round % 4 < 2 ? 5 : 130;
    std::vector<std::uint16_t> of_a, of_b;
    // Patches of neighbours, as real ones are, so that whole boxes are allowed.
    for (std::size_t t = 0; t < a.triangles().size(); ++t)
      of_a.push_back(static_cast<std::uint16_t>(t * patches_a / a.triangles().size()));
    for (std::size_t t = 0; t < b.triangles().size(); ++t)
      of_b.push_back(static_cast<std::uint16_t>(t * patches_b / b.triangles().size()));
    std::vector<bool> allowed(patches_a * patches_b);
    const double share = round % 5 * 0.25;
    for (std::size_t i = 0; i < allowed.size(); ++i) allowed[i] = random.uniform() < share;
    if (round % 3 == 0)  // whole rows and columns
      for (std::size_t p = below(patches_a); p < patches_a; ++p)
        for (std::size_t q = 0; q < patches_b; ++q) allowed[p * patches_b + q] = true;
    const PatchFilter plain{of_a.data(), of_b.data(), static_cast<int>(patches_b), &allowed};
    const auto regions = patch_regions(a, b, plain);
    PatchFilter quick = plain;
    quick.regions = regions.get();
    RigidTransform t;
    t.rotation = glm::mat3_cast(quat_from_rotation_vector(
        Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2))));
    t.translation = Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-3, 3));
    const double distance = round % 7 == 0 ? 0.0 : 0.1;
    std::vector<TriangleContact> all, x, y;
    find_contacts(a, b, t, distance, {}, all);
    find_contacts(a, b, t, distance, plain, x);
    find_contacts(a, b, t, distance, quick, y);
    EXPECT_TRUE(same(x, y)) << round;
    touching += !x.empty();
    hidden += x.size() < all.size();
    EXPECT_EQ(in_contact(a, b, t, distance, plain), in_contact(a, b, t, distance, quick)) << round;
    EXPECT_EQ(surface_distance(a, b, t, 5, plain), surface_distance(a, b, t, 5, quick)) << round;
  }
  EXPECT_GT(touching, 40);
  EXPECT_GT(hidden, 40);
}

// Whoever asks for patches only is told the same ones, at a fraction of the contacts.
TEST(PatchContacts, AreThoseOfAllContacts) {
  Random random(8);
  const CollisionMesh a = mesh_of(test::limb_shape(0.5f, 2, 12, 16, random));
  const CollisionMesh b = mesh_of(test::sphere_shape(1, 15, 24));
  std::size_t contacts = 0, told = 0;
  std::vector<TriangleContact> known;  // of the round before, which are of somewhere else
  for (int round = 0; round < 100; ++round) {
    constexpr std::size_t kPatches = 20;
    std::vector<std::uint16_t> of_a, of_b;
    for (std::size_t t = 0; t < a.triangles().size(); ++t)
      of_a.push_back(static_cast<std::uint16_t>(t * kPatches / a.triangles().size()));
    for (std::size_t t = 0; t < b.triangles().size(); ++t)
      of_b.push_back(static_cast<std::uint16_t>(t * kPatches / b.triangles().size()));
    std::vector<bool> allowed(kPatches * kPatches);
    for (std::size_t i = 0; i < allowed.size(); ++i) allowed[i] = random.uniform() < 0.3;
    const PatchFilter filter{of_a.data(), of_b.data(), static_cast<int>(kPatches), &allowed};
    RigidTransform t;
    t.rotation = glm::mat3_cast(quat_from_rotation_vector(
        Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2))));
    t.translation = Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-3, 3));
    const double distance = round % 3 == 0 ? 0.0 : 0.1;
    const auto patches = [&](const std::vector<TriangleContact>& found) {
      std::vector<std::pair<std::uint16_t, std::uint16_t>> pairs;
      for (const TriangleContact& c : found)
        pairs.emplace_back(of_a[c.triangle_a], of_b[c.triangle_b]);
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
      return pairs;
    };
    std::vector<TriangleContact> all, few;
    find_contacts(a, b, t, distance, filter, all);
    find_patch_contacts(a, b, t, distance, filter, few);
    EXPECT_EQ(patches(few), patches(all)) << round;
    known.push_back({1u << 30, 1u << 30});
    find_patch_contacts(a, b, t, distance, filter, known);
    EXPECT_EQ(patches(known), patches(all)) << round << ": whatever is tried first";
    contacts += all.size();
    told += few.size();
  }
  EXPECT_GT(contacts, 1000u);
  EXPECT_LT(3 * told, contacts);
}

TEST(PatchRegions, LeaveOutWhatIsAllowed) {
  const CollisionMesh a = mesh_of(test::sphere_shape(1, 15, 24));
  const std::vector<std::uint16_t> one(a.triangles().size(), 0);
  std::vector<bool> allowed{true};
  const PatchFilter filter{one.data(), one.data(), 1, &allowed};
  const auto regions = patch_regions(a, a, filter);
  ASSERT_TRUE(regions);
  EXPECT_EQ(regions->all_a & regions->all_b, 0u);
  allowed[0] = false;
  EXPECT_FALSE(patch_regions(a, a, filter)) << "nothing is allowed";
  EXPECT_FALSE(patch_regions(a, a, PatchFilter{}));
}

// Those of other meshes are not listened to.
TEST(PatchRegions, OfOtherMeshesAreIgnored) {
  const CollisionMesh a = mesh_of(test::sphere_shape(1, 15, 24));
  const CollisionMesh small = mesh_of(test::box_shape({1, 1, 1}));
  const std::vector<std::uint16_t> one(a.triangles().size(), 0);
  std::vector<bool> yes{true}, no{false};
  const auto regions = patch_regions(a, a, {one.data(), one.data(), 1, &yes});
  PatchFilter filter{one.data(), one.data(), 1, &no};
  filter.regions = regions.get();
  EXPECT_TRUE(in_contact(a, small, {}, 0, filter));
}

}  // namespace
}  // namespace elbowroom
