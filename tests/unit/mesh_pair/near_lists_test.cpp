// SPDX-License-Identifier: MIT
// What is learnt about placements near by changes no answer.
#include "core/collision/near_lists.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/collision/pair_clearance.h"
#include "core/collision/patch_regions.h"
#include "tests/support/shapes.h"

namespace elbowroom {
namespace {

CollisionMesh mesh_of(const test::Shape& shape, Openings openings = Openings::open) {
  auto mesh = CollisionMesh::build(shape.positions, shape.triangles, openings);
  EXPECT_TRUE(mesh.ok());
  return std::move(mesh).value();
}

Vec3 any_vector(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

RigidTransform any_placement(Random& random, double reach) {
  return {glm::mat3_cast(quat_from_rotation_vector(any_vector(random, 2))),
          any_vector(random, reach)};
}

RigidTransform moved(const RigidTransform& t, Random& random, double angle, double way) {
  const Mat3 turn = glm::mat3_cast(quat_from_rotation_vector(any_vector(random, angle)));
  return {turn * t.rotation, t.translation + any_vector(random, way)};
}

struct Tally {
  long asked = 0, known = 0, contact = 0, contact_known = 0, surely = 0;
};

// Walks about from placement to placement in small steps, as a planner does, with jumps, and asks
// both ways.
Tally walk(const CollisionMesh& a, const CollisionMesh& b, double reach, double distance,
           const PatchFilter& filter, Random& random, int steps, double scale = 1) {
  NearLists lists(0.06 * scale);
  PairCache cache;
  Tally tally;
  RigidTransform t;
  for (int i = 0; i < steps; ++i) {
    // Begins where the two are near each other.
    if (i % 60 == 0) {
      do {
        t = any_placement(random, reach * scale);
      } while (in_contact(a, b, t, distance, filter) ||
               !in_contact(a, b, t, distance + 0.04 * scale, filter));
    }
    const RigidTransform now = moved(t, random, 0.01, 0.012 * scale);
    if (i % 4 == 0) t = now;
    const double more = i % 3 == 0 ? 0.02 * scale * random.uniform() : 0.0;
    const bool truth = in_contact(a, b, now, distance + more, filter);
    const auto said = lists.in_contact(a, b, now, distance + more, filter, &cache);
    const auto surely = lists.surely_farther(a, b, now, distance + more);
    ++tally.asked;
    tally.contact += truth;
    EXPECT_EQ(said.has_value(), surely.has_value());
    if (said) {
      ++tally.known;
      tally.contact_known += truth;
      EXPECT_EQ(*said, truth) << i;
    } else if (!truth) {
      lists.learn(a, b, now, distance, filter);
    }
    if (surely && *surely) {
      ++tally.surely;
      std::vector<TriangleContact> contacts;
      find_contacts(a, b, now, distance + more, filter, contacts);
      for (const TriangleContact& contact : contacts) EXPECT_TRUE(contact.contained) << i;
    }
  }
  return tally;
}

TEST(NearLists, AnswerAsAllOfBothMeshesWould) {
  Random random(11);
  const CollisionMesh limb = mesh_of(test::limb_shape(0.12f, 0.5f, 10, 12, random));
  const CollisionMesh trunk = mesh_of(test::limb_shape(0.3f, 0.7f, 8, 10, random));
  const CollisionMesh ball = mesh_of(test::sphere_shape(0.4f, 12, 18));
  Tally all;
  for (const double distance : {0.0, 0.02})
    for (const CollisionMesh* other : {&trunk, &ball}) {
      const Tally tally = walk(limb, *other, 0.7, distance, {}, random, 3000);
      all.asked += tally.asked;
      all.known += tally.known;
      all.contact += tally.contact;
      all.contact_known += tally.contact_known;
      all.surely += tally.surely;
    }
  EXPECT_GT(all.known, all.asked / 4);
  EXPECT_GT(all.contact_known, 200);
  EXPECT_GT(all.surely, all.asked / 10);
}

// A small thing that gets into a bigger one through a hole touches nothing on its way.
TEST(NearLists, SeeWhatGoesInside) {
  Random random(3);
  const CollisionMesh tube = mesh_of(test::tube_shape(0.5f, 0.5f, 8, 16, false), Openings::capped);
  const CollisionMesh pea = mesh_of(test::sphere_shape(0.05f, 5, 8));
  for (const bool pea_first : {true, false}) {
    NearLists lists(0.3);
    long known = 0, inside = 0;
    for (int i = 0; i < 4000; ++i) {
      RigidTransform t;
      t.translation = Vec3(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2),
                           0.5 + 0.25 * std::sin(0.05 * i));
      const CollisionMesh &a = pea_first ? pea : tube, &b = pea_first ? tube : pea;
      if (pea_first) t = inverse(t);
      const bool truth = in_contact(a, b, t, 0);
      const auto said = lists.in_contact(a, b, t, 0, {}, nullptr);
      if (said) {
        ++known;
        inside += truth;
        EXPECT_EQ(*said, truth) << i;
      } else if (!truth) {
        lists.learn(a, b, t, 0, {});
      }
    }
    EXPECT_GT(known, 500);
    EXPECT_GT(inside, 100);
  }
}

TEST(NearLists, HeedWhatIsAllowed) {
  Random random(17);
  const CollisionMesh a = mesh_of(test::limb_shape(0.2f, 0.6f, 10, 12, random));
  const CollisionMesh b = mesh_of(test::sphere_shape(0.4f, 12, 18));
  long known = 0, contact = 0;
  for (int round = 0; round < 8; ++round) {
    const int patches = 6;
    std::vector<std::uint16_t> of_a, of_b;
    for (std::size_t t = 0; t < a.triangles().size(); ++t)
      of_a.push_back(static_cast<std::uint16_t>(t * patches / a.triangles().size()));
    for (std::size_t t = 0; t < b.triangles().size(); ++t)
      of_b.push_back(static_cast<std::uint16_t>(t * patches / b.triangles().size()));
    std::vector<bool> allowed(patches * patches);
    for (std::size_t i = 0; i < allowed.size(); ++i) allowed[i] = random.uniform() < 0.12 * round;
    PatchFilter filter{of_a.data(), of_b.data(), patches, &allowed};
    const auto regions = patch_regions(a, b, filter);
    filter.regions = regions.get();
    const Tally tally = walk(a, b, 0.6, 0.01, filter, random, 1500);
    known += tally.known;
    contact += tally.contact_known;
  }
  EXPECT_GT(known, 3000);
  EXPECT_GT(contact, 100);
}

TEST(NearLists, InAnyUnit) {
  for (const float size : {1e-3f, 1e3f}) {
    Random random(5);
    const CollisionMesh a = mesh_of(test::limb_shape(0.12f * size, 0.5f * size, 10, 12, random));
    const CollisionMesh b = mesh_of(test::sphere_shape(0.4f * size, 12, 18));
    const Tally tally = walk(a, b, 0.7, 0.02 * static_cast<double>(size), {}, random, 1500,
                             static_cast<double>(size));
    EXPECT_GT(tally.known, 300);
  }
}

TEST(NearLists, KnowNothingOfWhatIsNoNumber) {
  Random random(7);
  const CollisionMesh a = mesh_of(test::box_shape({0.1f, 0.1f, 0.1f}));
  NearLists lists(0.1), none;
  RigidTransform t;
  t.translation = Vec3(0.25, 0, 0);
  for (int i = 0; i < 3; ++i) {
    lists.learn(a, a, t, 0.01, {});
    none.learn(a, a, t, 0.01, {});
  }
  EXPECT_EQ(lists.in_contact(a, a, t, 0.01, {}, nullptr), std::optional<bool>(false));
  EXPECT_FALSE(none.in_contact(a, a, t, 0.01, {}, nullptr).has_value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lists.in_contact(a, a, t, nan, {}, nullptr).has_value());
  EXPECT_FALSE(lists.in_contact(a, a, t, 1e9, {}, nullptr).has_value());
  for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
    RigidTransform lost = t;
    lost.translation.y = bad;
    EXPECT_FALSE(lists.in_contact(a, a, lost, 0.01, {}, nullptr).has_value());
    EXPECT_FALSE(lists.surely_farther(a, a, lost, 0.01).has_value());
    lists.learn(a, a, lost, 0.01, {});
    lost = t;
    lost.rotation[1][1] = bad;
    EXPECT_FALSE(lists.in_contact(a, a, lost, 0.01, {}, nullptr).has_value());
  }
  // Nothing at all is near nothing.
  const CollisionMesh empty = mesh_of({});
  lists = NearLists(0.1);
  for (int i = 0; i < 3; ++i) lists.learn(empty, a, t, 0.01, {});
  const auto said = lists.in_contact(empty, a, t, 0.01, {}, nullptr);
  EXPECT_TRUE(!said || !*said);
}

}  // namespace
}  // namespace elbowroom
