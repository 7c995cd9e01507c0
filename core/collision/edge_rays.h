// SPDX-License-Identifier: MIT
// Edges of surviving triangles as Embree rays, both ways: does some edge of one mesh cross some
// triangle of the other? Two triangle surfaces cross if and only if one does.
//
// One packet asks 16 edges of the whole other mesh, so it can find a contact far from the pairs
// that culling has come to, which one pair's predicate cannot. It costs as much as 20 predicates,
// so it is asked only where many pairs have been left undecided. Every hit is confirmed exactly; no
// hit says nothing.
#pragma once

#include <cstdint>
#include <span>

#include "core/collision/mesh_data.h"
#include "core/collision/mesh_pair.h"

namespace elbowroom {

struct TrianglePair {
  std::uint32_t a, b;
};

// Fires up to one packet of edges of the pairs' triangles each way. True if an edge meets a
// triangle that it is not allowed to, and `found` is such a pair of triangles (which share a point,
// exactly). Builds no ray scene for a mesh that has just been deformed: says no instead.
bool edges_cross(const CollisionMesh::Data& a, const CollisionMesh::Data& b,
                 const RigidTransform& a_from_b, std::span<const TrianglePair> pairs,
                 const PatchFilter& filter, TrianglePair& found);

}  // namespace elbowroom
