// SPDX-License-Identifier: MIT
// Triangle against triangle, and mesh distances, against CGAL with exact numbers. On a small
// integer grid nearly everything is degenerate: coplanar, collinear, touching at a vertex, without
// area.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/base/random.h"
#include "core/collision/mesh_pair.h"
#include "core/collision/triangle_predicates.h"
#include "tests/support/shapes.h"

namespace elbowroom::test {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

Exact::Point_3 exact(const Vec3& p) { return Exact::Point_3(p.x, p.y, p.z); }

// What a triangle is as a set of points: a triangle, a segment or a point.
struct Set {
  int dimension;
  std::array<Exact::Point_3, 3> p;
  Exact::Triangle_3 triangle() const { return {p[0], p[1], p[2]}; }
  Exact::Segment_3 segment() const { return {p[0], p[1]}; }
};

Set set_of(const TrianglePoints& t) {
  Set set{2, {exact(t[0]), exact(t[1]), exact(t[2])}};
  if (!CGAL::collinear(set.p[0], set.p[1], set.p[2])) return set;
  std::sort(set.p.begin(), set.p.end(),
            [](const auto& x, const auto& y) { return CGAL::lexicographically_xyz_smaller(x, y); });
  set.p[1] = set.p[2];
  set.dimension = set.p[0] == set.p[1] ? 0 : 1;
  return set;
}

bool meet(const Set& a, const Set& b) {
  if (a.dimension < b.dimension) return meet(b, a);
  if (a.dimension == 2) {
    if (b.dimension == 2) return CGAL::do_intersect(a.triangle(), b.triangle());
    if (b.dimension == 1) return CGAL::do_intersect(a.triangle(), b.segment());
    return a.triangle().has_on(b.p[0]);
  }
  if (a.dimension == 1) {
    if (b.dimension == 1) return CGAL::do_intersect(a.segment(), b.segment());
    return a.segment().has_on(b.p[0]);
  }
  return a.p[0] == b.p[0];
}

TrianglePoints grid_triangle(Random& random, std::uint64_t n, double step) {
  TrianglePoints t;
  for (auto& p : t) {
    for (int k = 0; k < 3; ++k) p[k] = step * static_cast<double>(random.below(n));
  }
  return t;
}

TEST(Triangles, OnAGridIntersectAsExactNumbersSay) {
  Random random(21);
  int met = 0, flat = 0;
  const int count = ELBOWROOM_PLACEMENTS * 4;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t n = 2 + random.below(4);
    const double step = i % 2 ? 1.0 : 0.1;  // tenths are no exact doubles: nearly degenerate
    const TrianglePoints a = grid_triangle(random, n, step), b = grid_triangle(random, n, step);
    const Set sa = set_of(a), sb = set_of(b);
    const bool truth = meet(sa, sb);
    met += truth;
    flat += sa.dimension < 2 || sb.dimension < 2;
    ASSERT_EQ(triangles_intersect(a, b), truth) << i;
    ASSERT_EQ(triangles_intersect(b, a), truth) << i;
  }
  std::printf("%d pairs, %.1f %% meet, %.1f %% degenerate\n", count, 100.0 * met / count,
              100.0 * flat / count);
}

// One triangle's vertex within a few units in the last place of the other's plane, edge or vertex.
TEST(Triangles, WithinRoundingOfTouchingIntersectAsExactNumbersSay) {
  Random random(22);
  int met = 0;
  const int count = ELBOWROOM_PLACEMENTS * 2;
  const auto anywhere = [&] {
    return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  for (int i = 0; i < count; ++i) {
    const TrianglePoints a = {anywhere(), anywhere(), anywhere()};
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    if (i % 3 == 1) v = 0;
    if (i % 3 == 2) u = v = 0;
    Vec3 touch = a[0] + u * (a[1] - a[0]) + v * (a[2] - a[0]);
    for (int k = 0; k < 3; ++k) touch[k] += static_cast<double>(random.below(5)) * 1e-16 - 2e-16;
    const Vec3 n = glm::cross(a[1] - a[0], a[2] - a[0]);
    const auto above = [&] {
      Vec3 p = anywhere();
      return glm::dot(p - a[0], n) < 0 ? p - 2.0 * (glm::dot(p - a[0], n) / glm::dot(n, n)) * n : p;
    };
    const TrianglePoints b = {touch, above(), above()};
    const bool truth = meet(set_of(a), set_of(b));
    met += truth;
    ASSERT_EQ(triangles_intersect(a, b), truth) << i;
  }
  std::printf("%d pairs, %.1f %% meet\n", count, 100.0 * met / count);
}

double exact_distance(const TrianglePoints& a, const TrianglePoints& b) {
  const auto d2 = CGAL::squared_distance(set_of(a).triangle(), set_of(b).triangle());
  return std::sqrt(CGAL::to_double(d2));
}

TEST(Triangles, DistancesAreExact) {
  Random random(23);
  const int count = ELBOWROOM_PLACEMENTS / 5;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    TrianglePoints a, b;
    const bool nearly_flat = i % 4 == 0, skinny = i % 4 == 1, nearly_parallel = i % 4 == 2;
    for (auto* t : {&a, &b}) {
      for (auto& p : *t) {
        p = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        if (nearly_flat) p.z *= 1e-7;
      }
      if (skinny) (*t)[2] = 0.5 * ((*t)[0] + (*t)[1]) + 1e-6 * (*t)[2];
    }
    const Vec3 apart(0, 0, std::pow(10.0, random.uniform(-6.0, 0.5)));
    if (nearly_parallel) {
      for (std::size_t k = 0; k < 3; ++k) b[k] = a[(k + 1) % 3] + 1e-8 * b[k];
    }
    for (auto& p : b) p += apart;
    if (CGAL::collinear(exact(a[0]), exact(a[1]), exact(a[2])) ||
        CGAL::collinear(exact(b[0]), exact(b[1]), exact(b[2]))) {
      continue;
    }
    const double truth = exact_distance(a, b);
    const double ours = triangles_intersect(a, b) ? 0 : std::sqrt(closest_points(a, b).distance2);
    worst = std::max(worst, std::abs(ours - truth));
    ASSERT_NEAR(ours, truth, 1e-9) << i;
    if (truth > 0) {
      EXPECT_FALSE(triangles_touch(a, b, truth - 1e-9)) << i;
      EXPECT_TRUE(triangles_touch(a, b, truth + 1e-9)) << i;
    }
  }
  std::printf("%d pairs, worst error %.2g of size 1\n", count, worst);
}

TEST(Distances, OfMeshesAreThoseOfTheirClosestTriangles) {
  Random random(24);
  const Shape shapes[] = {limb_shape(0.1f, 0.3f, 6, 8, random), box_shape({0.2f, 0.1f, 0.3f}),
                          sheet_shape(0.2f, 4), needle_shape(1e-3f, 0.3f, 3)};
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    const Shape &sa = shapes[random.below(4)], &sb = shapes[random.below(4)];
    auto a = CollisionMesh::build(sa.positions, sa.triangles);
    auto b = CollisionMesh::build(sb.positions, sb.triangles);
    ASSERT_TRUE(a.ok() && b.ok());
    const RigidTransform t{
        glm::mat3_cast(quat_from_rotation_vector(
            {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)})),
        {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)}};
    double truth = std::numeric_limits<double>::infinity();
    for (const auto& x : sa.triangles) {
      const TrianglePoints pa = {Vec3(sa.positions[x.x]), Vec3(sa.positions[x.y]),
                                 Vec3(sa.positions[x.z])};
      for (const auto& y : sb.triangles) {
        const TrianglePoints pb = {t * Vec3(sb.positions[y.x]), t * Vec3(sb.positions[y.y]),
                                   t * Vec3(sb.positions[y.z])};
        // Bounding spheres spare exact numbers what cannot matter.
        const Vec3 ca = (pa[0] + pa[1] + pa[2]) / 3.0, cb = (pb[0] + pb[1] + pb[2]) / 3.0;
        double ra = 0, rb = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          ra = std::max(ra, glm::length(pa[k] - ca));
          rb = std::max(rb, glm::length(pb[k] - cb));
        }
        if (glm::length(ca - cb) - ra - rb > truth) continue;
        truth = std::min(truth, exact_distance(pa, pb));
      }
    }
    const double ours = surface_distance(*a, *b, t, 100);
    worst = std::max(worst, std::abs(ours - truth));
    ASSERT_NEAR(ours, truth, 1e-9) << i;
    EXPECT_NEAR(surface_distance(*b, *a, inverse(t), 100), truth, 1e-9);
    if (truth > 1e-6) {
      EXPECT_TRUE(in_contact(*a, *b, t, truth * (1 + 1e-9) + 1e-12));
      EXPECT_EQ(surface_distance(*a, *b, t, 0.5 * truth), 0.5 * truth);
    }
  }
  std::printf("worst error %.2g\n", worst);
}

}  // namespace
}  // namespace elbowroom::test
