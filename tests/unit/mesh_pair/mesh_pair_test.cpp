// SPDX-License-Identifier: MIT
// Contact, distance and depth of two meshes whose answers are known by construction.
#include "core/collision/mesh_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "core/base/random.h"
#include "core/collision/triangle_predicates.h"
#include "tests/support/shapes.h"

namespace elbowroom {
namespace {

using test::Shape;

CollisionMesh mesh_of(const Shape& shape, Openings openings = Openings::open) {
  auto mesh = CollisionMesh::build(shape.positions, shape.triangles, openings);
  EXPECT_TRUE(mesh.ok());
  return std::move(mesh).value();
}

RigidTransform moved(double x, double y, double z) { return {Mat3(1.0), Vec3(x, y, z)}; }

RigidTransform turned(const Vec3& rotation_vector, const Vec3& translation = Vec3(0.0)) {
  return {glm::mat3_cast(quat_from_rotation_vector(rotation_vector)), translation};
}

TEST(RigidTransform, InverseAndProduct) {
  const RigidTransform t = turned({0.3, -1.1, 0.4}, {1, 2, 3});
  const Vec3 p(0.5, -0.25, 4);
  EXPECT_LT(glm::length(inverse(t) * (t * p) - p), 1e-14);
  EXPECT_LT(glm::length((t * inverse(t)) * p - p), 1e-14);
}

TEST(CollisionMesh, RefusesBadInput) {
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_FALSE(CollisionMesh::build(positions, std::vector<glm::uvec3>{{0, 1, 3}}).ok());
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e16f}) {
    auto broken = positions;
    broken[1].y = bad;
    EXPECT_FALSE(CollisionMesh::build(broken, std::vector<glm::uvec3>{{0, 1, 2}}).ok());
    CollisionMesh mesh = mesh_of({positions, {{0, 1, 2}}});
    EXPECT_FALSE(mesh.refit(broken));
    EXPECT_EQ(mesh.positions()[1].y, 0.0f);
  }
  CollisionMesh mesh = mesh_of({positions, {{0, 1, 2}}});
  EXPECT_FALSE(mesh.refit(std::vector<glm::vec3>(2)));
}

TEST(MeshPair, EmptyMeshesTouchNothing) {
  const CollisionMesh nothing = mesh_of({});
  const CollisionMesh box = mesh_of(test::box_shape({1, 1, 1}));
  std::vector<TriangleContact> contacts;
  for (const auto* other : {&nothing, &box}) {
    EXPECT_FALSE(in_contact(nothing, *other, {}, 1.0));
    EXPECT_FALSE(in_contact(*other, nothing, {}, 1.0));
    find_contacts(nothing, *other, {}, 1.0, {}, contacts);
    EXPECT_TRUE(contacts.empty());
    EXPECT_EQ(surface_distance(nothing, *other, {}, 7.0), 7.0);
    EXPECT_EQ(penetration_depth(nothing, *other, {}), 0.0);
  }
}

TEST(MeshPair, BoxesApartTouchingAndCrossing) {
  const CollisionMesh box = mesh_of(test::box_shape({1, 1, 1}));
  EXPECT_TRUE(in_contact(box, box, moved(2, 0, 0), 0));  // faces coincide
  EXPECT_TRUE(in_contact(box, box, moved(2, 2, 2), 0));  // a corner
  EXPECT_TRUE(in_contact(box, box, moved(2, 0.5, 0.3), 0));
  EXPECT_FALSE(in_contact(box, box, moved(std::nextafter(2.0, 3.0), 0, 0), 0));
  EXPECT_TRUE(in_contact(box, box, moved(1.5, 0.1, 0.2), 0));
  EXPECT_FALSE(in_contact(box, box, moved(2.25, 0, 0), 0.25 - 1e-9));
  EXPECT_TRUE(in_contact(box, box, moved(2.25, 0, 0), 0.25));
  EXPECT_TRUE(in_contact(box, box, moved(2.25, 0, 0), std::numeric_limits<double>::infinity()));
  EXPECT_NEAR(surface_distance(box, box, moved(2.25, 0.5, 0), 10), 0.25, 1e-12);
  EXPECT_NEAR(surface_distance(box, box, moved(5, 6, 0), 10), 5.0, 1e-12);
  EXPECT_EQ(surface_distance(box, box, moved(5, 6, 0), 3.5), 3.5);
  EXPECT_EQ(surface_distance(box, box, moved(1.5, 0.1, 0.2), 10), 0.0);
}

// A needle through a sheet crosses no edge of the sheet with its body, nor its own with the
// sheet's.
TEST(MeshPair, NeedleThroughSheetAndSheetThroughNeedle) {
  const CollisionMesh needle = mesh_of(test::needle_shape(0.001f, 1, 3));
  const CollisionMesh sheet = mesh_of(test::sheet_shape(1, 2));
  const RigidTransform through = moved(0.31, 0.17, 0.4);
  EXPECT_TRUE(in_contact(sheet, needle, through, 0));
  EXPECT_TRUE(in_contact(needle, sheet, inverse(through), 0));
  EXPECT_FALSE(in_contact(sheet, needle, moved(0.31, 0.17, 1.001), 0));
}

TEST(MeshPair, ContainmentIsContact) {
  const CollisionMesh outer = mesh_of(test::sphere_shape(1, 15, 24));
  const CollisionMesh inner = mesh_of(test::box_shape({0.1f, 0.1f, 0.1f}));
  const CollisionMesh sheet = mesh_of(test::sheet_shape(0.2f, 2));
  Random random(3);
  std::vector<TriangleContact> contacts;
  for (int i = 0; i < 200; ++i) {
    const Vec3 at(random.uniform(-0.45, 0.45), random.uniform(-0.45, 0.45),
                  random.uniform(-0.45, 0.45));
    const RigidTransform t = turned({random.uniform(-2, 2), random.uniform(-2, 2), 0.3}, at);
    ASSERT_TRUE(in_contact(outer, inner, t, 0));
    ASSERT_TRUE(in_contact(inner, outer, inverse(t), 0));
    ASSERT_TRUE(in_contact(outer, sheet, t, 0));  // an open thing in a closed one
    find_contacts(outer, inner, t, 0, {}, contacts);
    ASSERT_EQ(contacts.size(), inner.triangles().size());
    EXPECT_TRUE(contacts[0].contained);
    EXPECT_GT(surface_distance(outer, inner, t, 5), 0.0);  // surfaces only
  }
  // In the box's corner beyond the sphere: its box says maybe, rays say no.
  EXPECT_FALSE(in_contact(outer, inner, moved(0.75, 0.75, 0.75), 0));
}

TEST(MeshPair, HollowMiddleIsOutside) {
  Shape shell = test::sphere_shape(1, 15, 24);
  test::append(shell, test::sphere_shape(0.5f, 15, 24));
  // Two components: each encloses; the inner sphere lies in the outer one's inside.
  const CollisionMesh spheres = mesh_of(shell);
  const CollisionMesh box = mesh_of(test::box_shape({0.1f, 0.1f, 0.1f}));
  EXPECT_TRUE(in_contact(spheres, box, moved(0, 0, 0), 0));
  // One component joined by a duct has a hollow: parity over it says outside.
  Shape torus;
  const int n = 32, m = 16;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double u = 2 * kPi * i / n, v = 2 * kPi * j / m, r = 1 + 0.3 * std::cos(v);
      torus.positions.push_back(
          glm::vec3(glm::dvec3(r * std::cos(u), r * std::sin(u), 0.3 * std::sin(v))));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i % n * m + j % m); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      torus.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      torus.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const CollisionMesh ring = mesh_of(torus);
  EXPECT_FALSE(in_contact(ring, box, moved(0, 0, 0), 0));
  EXPECT_TRUE(in_contact(ring, box, moved(1, 0, 0), 0));
}

TEST(MeshPair, OpeningsEncloseOnlyIfCapped) {
  const Shape tube = test::tube_shape(1, 2, 9, 20, false);
  const CollisionMesh box = mesh_of(test::box_shape({0.1f, 0.1f, 0.1f}));
  const CollisionMesh open = mesh_of(tube), capped = mesh_of(tube, Openings::capped);
  EXPECT_FALSE(in_contact(open, box, moved(0, 0, 1), 0));
  EXPECT_TRUE(in_contact(capped, box, moved(0, 0, 1), 0));
  EXPECT_TRUE(in_contact(capped, box, moved(0, 0, -1.85), 0));
  EXPECT_FALSE(in_contact(capped, box, moved(0, 0, 2.2), 0));
  // A cap is no surface: what reaches through it touches nothing, and is not wholly inside.
  EXPECT_FALSE(in_contact(capped, box, moved(0, 0, 2.0), 0));
  EXPECT_EQ(penetration_depth(open, box, moved(0, 0, 1)), 0.0);
  EXPECT_NEAR(penetration_depth(capped, box, moved(0, 0, 1)), 0.988 - 0.1414, 0.01);
}

TEST(MeshPair, WindingAndSeamsDoNotMatter) {
  Shape flipped = test::sphere_shape(1, 11, 16);
  Random random(5);
  for (auto& t : flipped.triangles) {
    if (random.uniform() < 0.5) std::swap(t.y, t.z);
  }
  Shape soup;  // every triangle with vertices of its own, and every third twice
  for (std::size_t i = 0; i < flipped.triangles.size(); ++i) {
    for (int copy = 0; copy < (i % 3 == 0 ? 2 : 1); ++copy) {
      const auto n = static_cast<std::uint32_t>(soup.positions.size());
      for (int k = 0; k < 3; ++k)
        soup.positions.push_back(flipped.positions[flipped.triangles[i][k]]);
      soup.triangles.push_back({n, n + 1, n + 2});
    }
  }
  soup.triangles.push_back({0, 0, 1});  // degenerate
  const CollisionMesh box = mesh_of(test::box_shape({0.1f, 0.1f, 0.1f}));
  for (const Shape& shape : {flipped, soup}) {
    const CollisionMesh sphere = mesh_of(shape);
    for (int i = 0; i < 50; ++i) {
      const Vec3 p(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
      const bool expect_far = glm::length(p) > 1.2, expect_in = glm::length(p) < 0.75;
      if (expect_far) {
        EXPECT_FALSE(in_contact(sphere, box, moved(p.x, p.y, p.z), 0));
      }
      if (expect_in) {
        EXPECT_TRUE(in_contact(sphere, box, moved(p.x, p.y, p.z), 0));
      }
    }
  }
}

TEST(MeshPair, NonManifoldAndDegenerateTriangles) {
  // Three sheets at one edge, a needle without area, and a point.
  Shape fan;
  fan.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0},
                   {5, 0, 0}, {6, 0, 0}, {7, 0, 0}, {9, 9, 9}};
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {5, 6, 7}, {8, 8, 8}};
  const CollisionMesh mesh = mesh_of(fan);
  const CollisionMesh box = mesh_of(test::box_shape({0.25f, 0.25f, 0.25f}));
  EXPECT_TRUE(in_contact(mesh, box, moved(0, 0, 0), 0));
  EXPECT_TRUE(in_contact(mesh, box, moved(-0.5, 0.5, 0.25), 0));
  EXPECT_TRUE(in_contact(mesh, box, moved(6.5, 0.1, 0.1), 0));  // through the box's sides
  EXPECT_FALSE(in_contact(mesh, box, moved(6.5, 0.26, 0.26), 0));
  EXPECT_TRUE(in_contact(mesh, box, moved(6.5, 0.25, 0.25), 0));  // along its edge
  EXPECT_TRUE(in_contact(mesh, box, moved(9.25, 9, 9), 0));       // the point on a face
  EXPECT_TRUE(in_contact(mesh, box, moved(9, 9, 9), 0));          // the point inside
  EXPECT_FALSE(in_contact(mesh, box, moved(9.26, 9, 9), 0));
  EXPECT_NEAR(surface_distance(mesh, box, moved(9.75, 9, 9), 2), 0.5, 1e-12);
}

// Allows one patch pair; patches are by triangle.
struct Patches {
  std::vector<std::uint16_t> a, b;
  std::vector<bool> allowed;
  int count_b = 1;
  PatchFilter filter() const { return {a.data(), b.data(), count_b, &allowed}; }
};

TEST(MeshPair, FilterAllowsPatchesNotPairs) {
  const CollisionMesh box = mesh_of(test::box_shape({1, 1, 1}));
  const RigidTransform t = moved(1.5, 0, 0);
  std::vector<TriangleContact> all, rest;
  find_contacts(box, box, t, 0, {}, all);
  ASSERT_FALSE(all.empty());
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const auto& x, const auto& y) {
    return std::pair(x.triangle_a, x.triangle_b) < std::pair(y.triangle_a, y.triangle_b);
  }));
  for (const auto& contact : all) EXPECT_LE(std::abs(contact.place.x - 0.75), 0.2501);
  Patches patches;
  patches.a.resize(12);
  patches.b.assign(12, 0);
  for (std::uint16_t i = 0; i < 12; ++i) patches.a[i] = i;
  patches.allowed.assign(12, false);
  patches.allowed[all[0].triangle_a] = true;
  find_contacts(box, box, t, 0, patches.filter(), rest);
  EXPECT_LT(rest.size(), all.size());
  EXPECT_TRUE(in_contact(box, box, t, 0, patches.filter()));
  patches.allowed.assign(12, true);
  find_contacts(box, box, t, 0, patches.filter(), rest);
  EXPECT_TRUE(rest.empty());
  EXPECT_FALSE(in_contact(box, box, t, 0, patches.filter()));
  EXPECT_EQ(surface_distance(box, box, t, 3, patches.filter()), 3.0);
}

TEST(MeshPair, FilterDoesNotHideContainment) {
  const CollisionMesh outer = mesh_of(test::sphere_shape(1, 15, 24));
  const CollisionMesh inner = mesh_of(test::box_shape({0.1f, 0.1f, 0.1f}));
  Patches patches;
  patches.a.assign(outer.triangles().size(), 0);
  patches.b.assign(12, 0);
  patches.b[5] = 1;
  patches.count_b = 2;
  patches.allowed = {true, false};
  EXPECT_TRUE(in_contact(outer, inner, moved(0.1, 0, 0), 0, patches.filter()));
  patches.allowed = {true, true};  // the whole of it, against everything
  EXPECT_FALSE(in_contact(outer, inner, moved(0.1, 0, 0), 0, patches.filter()));
  // Partly in, through allowed patches only: judged by its contacts.
  patches.b[5] = 0;
  EXPECT_FALSE(in_contact(outer, inner, moved(1, 0, 0), 0, patches.filter()));
}

TEST(MeshPair, CacheIsOnlyAHint) {
  const CollisionMesh box = mesh_of(test::box_shape({1, 1, 1}));
  PairCache cache;
  EXPECT_TRUE(in_contact(box, box, moved(1.9, 0, 0), 0, {}, &cache));
  EXPECT_TRUE(cache.set);
  EXPECT_TRUE(in_contact(box, box, moved(1.8, 0, 0), 0, {}, &cache));
  EXPECT_FALSE(in_contact(box, box, moved(2.8, 0, 0), 0, {}, &cache));
  cache = {1000, 2000, true};  // of another mesh
  EXPECT_TRUE(in_contact(box, box, moved(1.8, 0, 0), 0, {}, &cache));
  EXPECT_FALSE(in_contact(box, box, moved(2.8, 0, 0), 0, {}, &cache));
}

TEST(MeshPair, NonFiniteTransformsCountAsContact) {
  const CollisionMesh box = mesh_of(test::box_shape({1, 1, 1}));
  RigidTransform bad = moved(100, 0, 0);
  bad.translation.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(in_contact(box, box, bad, 0));
  EXPECT_EQ(surface_distance(box, box, bad, 1), 0.0);
  std::vector<TriangleContact> contacts(3);
  find_contacts(box, box, bad, 0, {}, contacts);
  EXPECT_TRUE(contacts.empty());
  EXPECT_EQ(penetration_depth(box, box, bad), 0.0);
}

TEST(MeshPair, FarFromTheOriginAndInAnyUnit) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double far : {0.0, 1e4}) {
      Shape shape = test::box_shape(glm::vec3(static_cast<float>(scale)));
      // Powers of two keep the shifted vertices exact.
      const auto shift = static_cast<float>(far == 0 ? 0 : scale * 16384);
      for (auto& p : shape.positions) p += glm::vec3(shift);
      const CollisionMesh a = mesh_of(shape),
                          b = mesh_of(test::box_shape(glm::vec3(static_cast<float>(scale))));
      const Vec3 base(static_cast<double>(shift));
      const double size = glm::length(Vec3(shape.positions[7] - shape.positions[0])) / 3.4641;
      const auto placed = [&](double gap) {
        return RigidTransform{Mat3(1.0), base + Vec3(2 * size + gap * size, 0.01 * size, 0)};
      };
      const double noise = far == 0 ? 1e-6 : 4e-3;
      EXPECT_TRUE(in_contact(a, b, placed(-noise), 0)) << scale << ' ' << far;
      EXPECT_FALSE(in_contact(a, b, placed(noise), 0)) << scale << ' ' << far;
      EXPECT_NEAR(surface_distance(a, b, placed(0.5), 10 * size), 0.5 * size, noise * size);
    }
  }
}

// The worst for a tree: thousands of triangles in the same place, and sizes from 1e-6 to 1e6.
TEST(MeshPair, HeapsOfTrianglesAndAllSizes) {
  Shape heap;
  for (int i = 0; i < 3000; ++i) test::append(heap, test::box_shape({0.5f, 0.5f, 0.5f}));
  Shape sizes;
  for (int i = 0; i < 400; ++i) {
    const auto size = static_cast<float>(std::pow(10.0, 6.0 - 0.03 * i));
    test::append(sizes, test::sheet_shape(size, 1), {0, 0, size});
  }
  const CollisionMesh a = mesh_of(heap), b = mesh_of(sizes);
  const CollisionMesh box = mesh_of(test::box_shape({0.25f, 0.25f, 0.25f}));
  EXPECT_TRUE(in_contact(a, box, moved(0.6, 0.1, 0), 0));
  EXPECT_FALSE(in_contact(a, box, moved(0.76, 0.1, 0), 0));
  EXPECT_NEAR(surface_distance(a, box, moved(0.85, 0.1, 0), 1), 0.1, 1e-12);
  EXPECT_TRUE(in_contact(b, box, moved(0, 0, 1), 0));
  EXPECT_FALSE(in_contact(b, box, moved(0, 0, -0.26), 0));
  EXPECT_NEAR(surface_distance(b, box, moved(0, 0, -1), 1), 0.75, 1e-4);
}

TEST(MeshPair, RefitMovesEverything) {
  const Shape sphere = test::sphere_shape(1, 15, 24);
  CollisionMesh mesh = mesh_of(sphere);
  const CollisionMesh box = mesh_of(test::box_shape({0.1f, 0.1f, 0.1f}));
  EXPECT_TRUE(in_contact(mesh, box, moved(0, 0, 0), 0));
  auto shifted = sphere.positions;
  for (auto& p : shifted) p = p * 2.0f + glm::vec3(10, 0, 0);
  ASSERT_TRUE(mesh.refit(shifted));
  EXPECT_FALSE(in_contact(mesh, box, moved(0, 0, 0), 0));
  EXPECT_TRUE(in_contact(mesh, box, moved(10, 0, 0), 0));
  EXPECT_TRUE(in_contact(mesh, box, moved(12, 0, 0), 0));
  EXPECT_NEAR(penetration_depth(mesh, box, moved(10, 0, 0)), 2 - 0.173, 0.03);
  EXPECT_NEAR(surface_distance(mesh, box, moved(13, 0, 0), 5), 0.9, 0.02);
  ASSERT_TRUE(mesh.refit(sphere.positions));
  EXPECT_TRUE(in_contact(mesh, box, moved(0, 0, 0), 0));
}

// Two pieces of skin stand in one space: what is said of them is what their triangles say, and what
// meshes say that were built there.
TEST(MeshPair, RefitPiecesInOneSpaceAreTheirTriangles) {
  Random random(12);
  const Shape limb = test::limb_shape(0.3f, 1.2f, 7, 10, random);
  const Shape trunk = test::sphere_shape(0.6f, 9, 14);
  CollisionMesh a = mesh_of(limb), b = mesh_of(trunk);
  const auto bent = [&](const Shape& shape, const Vec3& shift) {
    const Mat3 turn = glm::mat3_cast(quat_from_rotation_vector(
        {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)}));
    std::vector<glm::vec3> places;
    for (const glm::vec3& p : shape.positions) {
      Vec3 q = turn * Vec3(p) + shift;
      q.x += 0.2 * q.y * q.y;
      places.emplace_back(q);
    }
    return places;
  };
  int crossing = 0, near = 0, apart = 0;
  for (int round = 0; round < 150; ++round) {
    const double away = random.uniform(0.2, 1.6);
    const auto place_a = bent(limb, {away, 0, 0}), place_b = bent(trunk, {0, 0, 0});
    ASSERT_TRUE(a.refit(place_a));
    ASSERT_TRUE(b.refit(place_b));
    for (const double distance : {0.0, 0.05}) {
      std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
      const auto points = [](const std::vector<glm::vec3>& p, const glm::uvec3& t) {
        return TrianglePoints{Vec3(p[t.x]), Vec3(p[t.y]), Vec3(p[t.z])};
      };
      for (std::uint32_t t = 0; t < limb.triangles.size(); ++t)
        for (std::uint32_t u = 0; u < trunk.triangles.size(); ++u)
          if (triangles_touch(points(place_a, limb.triangles[t]),
                              points(place_b, trunk.triangles[u]), distance))
            expected.emplace_back(t, u);
      std::vector<TriangleContact> contacts;
      find_contacts(a, b, {}, distance, {}, contacts);
      for (const TriangleContact& c : contacts)
        if (!c.contained) found.emplace_back(c.triangle_a, c.triangle_b);
      EXPECT_EQ(found, expected) << round << ' ' << distance;
      EXPECT_EQ(in_contact(a, b, {}, distance), !contacts.empty()) << round;
      (expected.empty() ? apart : distance > 0 ? near : crossing) += 1;
    }
    const CollisionMesh built_a = mesh_of({place_a, limb.triangles});
    const CollisionMesh built_b = mesh_of({place_b, trunk.triangles});
    EXPECT_EQ(in_contact(a, b, {}, 0), in_contact(built_a, built_b, {}, 0)) << round;
    EXPECT_NEAR(surface_distance(a, b, {}, 3), surface_distance(built_a, built_b, {}, 3), 1e-12);
  }
  EXPECT_GT(std::min({crossing, near, apart}), 15);
}

TEST(MeshPair, DepthOfOverlappingSpheres) {
  const CollisionMesh a = mesh_of(test::sphere_shape(1, 31, 48));
  const CollisionMesh b = mesh_of(test::sphere_shape(0.5f, 31, 48));
  EXPECT_NEAR(penetration_depth(a, b, moved(1.2, 0, 0)), 0.3, 0.01);
  EXPECT_NEAR(penetration_depth(b, a, moved(-1.2, 0, 0)), 0.3, 0.01);
  EXPECT_EQ(penetration_depth(a, b, moved(1.6, 0, 0)), 0.0);
}

TEST(MeshPair, ManyThreadsAskTheSameMeshes) {
  Random random(9);
  const CollisionMesh outer = mesh_of(test::sphere_shape(1, 31, 48));
  const CollisionMesh inner = mesh_of(test::limb_shape(0.1f, 0.4f, 9, 12, random));
  std::vector<int> counts(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    threads.emplace_back([&, k] {
      Random own(1);
      for (int i = 0; i < 300; ++i) {
        const RigidTransform t = turned({own.uniform(-3, 3), own.uniform(-3, 3), 0},
                                        {own.uniform(-1.5, 1.5), own.uniform(-1.5, 1.5), 0});
        counts[k] += in_contact(outer, inner, t, 0.001);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  for (const int count : counts) EXPECT_EQ(count, counts[0]);
  EXPECT_GT(counts[0], 30);
  EXPECT_LT(counts[0], 270);
}

}  // namespace
}  // namespace elbowroom
