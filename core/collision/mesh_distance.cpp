// SPDX-License-Identifier: MIT
// Distances of two meshes: surface_distance() and penetration_depth() of mesh_pair.h.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/collision/box_traversal.h"
#include "core/collision/containment.h"
#include "core/collision/mesh_data.h"
#include "core/collision/mesh_pair.h"

namespace elbowroom {
namespace {

using Data = CollisionMesh::Data;

TrianglePoints placed(const RigidTransform& a_from_b, const TrianglePoints& t) {
  return {a_from_b * t[0], a_from_b * t[1], a_from_b * t[2]};
}

// The projections onto a unit axis are farther apart than `distance`.
bool apart_along(const Vec3& axis, const TrianglePoints& a, const TrianglePoints& b,
                 double distance) {
  const Vec3 base = a[0];
  double low_a = 0, high_a = 0, low_b = glm::dot(axis, b[0] - base), high_b = low_b;
  for (std::size_t i = 1; i < 3; ++i) {
    const double ha = glm::dot(axis, a[i] - base), hb = glm::dot(axis, b[i] - base);
    low_a = std::min(low_a, ha);
    high_a = std::max(high_a, ha);
    low_b = std::min(low_b, hb);
    high_b = std::max(high_b, hb);
  }
  // Rounding of the axis and of the projections is far below this.
  const double limit = distance * (1 + 1e-12) + 1e-14 * (std::abs(low_b) + std::abs(high_b));
  return low_b - high_a > limit || low_a - high_b > limit;
}

struct Closest {
  const Data& a;
  const Data& b;
  const RigidTransform& a_from_b;
  const PatchFilter& filter;
  ClosestSoFar best;
};

bool visit_closest(void* context, std::uint32_t one, const std::uint32_t* many, int count,
                   bool one_is_a) {
  Closest& c = *static_cast<Closest*>(context);
  for (int i = 0; i < count; ++i) {
    const std::uint32_t ta = one_is_a ? one : many[i], tb = one_is_a ? many[i] : one;
    if (c.filter.allows(ta, tb)) continue;
    const TrianglePoints pa = c.a.triangle(ta), pb = placed(c.a_from_b, c.b.triangle(tb));
    const double best = c.best.distance;
    const bool first = c.best.axis == Vec3(0.0);
    if (!first && (apart_along(c.best.axis, pa, pb, best) || surely_apart(pa, pb, best))) continue;
    if (triangles_intersect(pa, pb)) {
      c.best.distance = 0;
      return true;
    }
    const ClosestPoints closest =
        closest_points(pa, pb, 0, first ? std::numeric_limits<double>::infinity() : best * best);
    const double distance = std::sqrt(closest.distance2);
    // The first pair gives an axis even if it is farther apart than what is asked about.
    if (!first && !(distance < best)) continue;
    c.best.distance = std::min(best, distance);
    c.best.axis = distance > 0 ? (closest.on_b - closest.on_a) / distance : Vec3(0.0);
  }
  return false;
}

// Distance of p to the surface, at most `at_most`; `hint` is a triangle to try first and becomes
// the closest one.
double distance_to_surface(const Data& mesh, const Vec3& p, double at_most, std::uint32_t& hint) {
  const auto to_triangle = [&](std::uint32_t t) {
    return glm::length(closest_point(p, mesh.triangle(t)) - p);
  };
  double best = std::min(at_most, to_triangle(hint));
  struct Entry {
    BoxTree::Ref node;
    double bound;
  };
  const Vec3 local = p - mesh.tree.origin;
  Entry stack[BoxTree::kMaxDepth * BoxTree::kWidth + 1];
  int count = 1;
  stack[0] = {0, 0.0};
  while (count > 0) {
    const Entry entry = stack[--count];
    if (entry.bound >= best) continue;
    const BoxTree::Node& node = mesh.tree.nodes[static_cast<std::size_t>(entry.node)];
    const int first = count;
    for (int i = 0; i < node.count; ++i) {
      double square = 0;
      for (int k = 0; k < 3; ++k) {
        const double gap = std::abs(local[k] - static_cast<double>(node.center[k][i])) -
                           static_cast<double>(node.half[k][i]);
        if (gap > 0) square += gap * gap;
      }
      const double bound = std::sqrt(square) * (1 - 1e-12);
      if (bound >= best) continue;
      if (BoxTree::is_triangle(node.child[i])) {
        const std::uint32_t t = BoxTree::triangle_of(node.child[i]);
        const double d = to_triangle(t);
        if (d < best) {
          best = d;
          hint = t;
        }
      } else {
        stack[count++] = {node.child[i], bound};
      }
    }
    // The nearest goes on top.
    std::sort(stack + first, stack + count,
              [](const Entry& x, const Entry& y) { return x.bound > y.bound; });
  }
  return best;
}

// Deepest vertex of `inner` inside `outer`, if deeper than `deepest`.
double deepest_vertex(const Data& inner, const Data& outer, const RigidTransform& outer_from_inner,
                      double deepest) {
  if (!outer.can_enclose || inner.tree.empty()) return deepest;
  std::vector<bool> used(inner.positions.size(), false);
  for (const glm::uvec3& t : inner.triangles) {
    for (int i = 0; i < 3; ++i) used[inner.topology.welded[t[i]]] = true;
  }
  std::vector<Vec3> points;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    const Vec3 p = outer_from_inner * Vec3(inner.positions[v]);
    bool in = true;
    for (int k = 0; k < 3; ++k) {
      in = in && p[k] >= static_cast<double>(outer.low[k]) &&
           p[k] <= static_cast<double>(outer.high[k]);
    }
    if (in) points.push_back(p);
  }
  std::vector<Enclosure> enclosures;
  find_enclosures(outer, points, enclosures);
  std::uint32_t hint = 0;
  std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  for (const Enclosure& e : enclosures) {
    if (e.point == last) continue;
    last = e.point;
    const Vec3& p = points[e.point];
    // The last vertex's closest triangle bounds this one's depth: most need no search.
    if (glm::length(closest_point(p, outer.triangle(hint)) - p) <= deepest) continue;
    deepest = std::max(
        deepest, distance_to_surface(outer, p, std::numeric_limits<double>::infinity(), hint));
  }
  return deepest;
}

}  // namespace

double surface_distance(const CollisionMesh& a, const CollisionMesh& b,
                        const RigidTransform& a_from_b, double at_most, const PatchFilter& filter) {
  const Data &da = a.data(), &db = b.data();
  if (da.tree.empty() || db.tree.empty() || !(at_most > 0)) return std::fmax(at_most, 0.0);
  if (!is_finite(a_from_b)) return 0;
  Closest closest{da, db, a_from_b, filter, {at_most, Vec3(0.0)}};
  visit_closest_pairs(da.tree, db.tree, a_from_b, closest.best, filter.regions, visit_closest,
                      &closest);
  return closest.best.distance;
}

double penetration_depth(const CollisionMesh& a, const CollisionMesh& b,
                         const RigidTransform& a_from_b) {
  const Data &da = a.data(), &db = b.data();
  if (da.tree.empty() || db.tree.empty() || !is_finite(a_from_b)) return 0;
  double deepest = deepest_vertex(da, db, inverse(a_from_b), 0.0);
  deepest = deepest_vertex(db, da, a_from_b, deepest);
  return deepest;
}

}  // namespace elbowroom
