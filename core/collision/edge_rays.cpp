// SPDX-License-Identifier: MIT
#include "core/collision/edge_rays.h"

#include <algorithm>
#include <vector>

namespace elbowroom {
namespace {

// Edges of the triangles of `from` (a's if `from_a`), spread evenly over the pairs, as rays in the
// other mesh's frame.
bool fire(const CollisionMesh::Data& from, const CollisionMesh::Data& to,
          const RigidTransform& to_from_from, bool from_a, std::span<const TrianglePair> pairs,
          const RigidTransform& a_from_b, const CollisionMesh::Data& a,
          const CollisionMesh::Data& b, const PatchFilter& filter, TrianglePair& found) {
  if (to.was_refit && !to.rays_are_fresh()) return false;
  RayScene::Ray rays[RayScene::kPacket];
  std::uint32_t triangle_of[RayScene::kPacket];
  std::size_t count = 0;
  const std::size_t step = std::max<std::size_t>(1, pairs.size() / RayScene::kPacket);
  for (std::size_t i = 0; i < pairs.size() && count < RayScene::kPacket; i += step) {
    const std::uint32_t t = from_a ? pairs[i].a : pairs[i].b;
    // Another of its edges each time; degenerate triangles may have none.
    const std::uint32_t begin = from.topology.edge_begin[t];
    const std::uint32_t edges = from.topology.edge_begin[t + 1] - begin;
    if (edges == 0) continue;
    const Topology::Edge edge =
        from.topology.edges[from.topology.edge_of_triangle[begin + i % edges]];
    const Vec3 p = to_from_from * Vec3(from.positions[edge.a]);
    const Vec3 q = to_from_from * Vec3(from.positions[edge.b]);
    rays[count].origin = glm::vec3(p - to.tree.origin);
    rays[count].direction = glm::vec3(q - p);
    triangle_of[count++] = t;
  }
  thread_local std::vector<RayScene::Hit> hits;
  hits.clear();
  to.surface_rays().any_hits({rays, count}, hits);
  for (const RayScene::Hit& hit : hits) {
    const TrianglePair pair = from_a ? TrianglePair{triangle_of[hit.ray], hit.triangle}
                                     : TrianglePair{hit.triangle, triangle_of[hit.ray]};
    if (filter.allows(pair.a, pair.b)) continue;
    const TrianglePoints other = b.triangle(pair.b);
    if (!triangles_intersect(a.triangle(pair.a),
                             {a_from_b * other[0], a_from_b * other[1], a_from_b * other[2]})) {
      continue;
    }
    found = pair;
    return true;
  }
  return false;
}

}  // namespace

bool edges_cross(const CollisionMesh::Data& a, const CollisionMesh::Data& b,
                 const RigidTransform& a_from_b, std::span<const TrianglePair> pairs,
                 const PatchFilter& filter, TrianglePair& found) {
  return fire(b, a, a_from_b, false, pairs, a_from_b, a, b, filter, found) ||
         fire(a, b, inverse(a_from_b), true, pairs, a_from_b, a, b, filter, found);
}

}  // namespace elbowroom
