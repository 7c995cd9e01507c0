// SPDX-License-Identifier: MIT
// Inside or outside: which components of a mesh enclose a point.
//
// Embree's parity rays decide: two rays in different directions, all of whose hits are clear (well
// inside their triangles) and that agree. Where they graze or disagree, or where a mesh has just
// been deformed and a few points do not pay for a new ray scene, the same question is settled by
// exact crossings found through the box tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/collision/mesh_data.h"

namespace elbowroom {

struct Enclosure {
  std::uint32_t point = 0;      // index
  std::uint32_t component = 0;  // of the mesh
};

// Every component of `mesh` that encloses each point (mesh frame), by point, then component. A
// point on the surface itself counts as outside: that is contact of surfaces. Appends.
void find_enclosures(const CollisionMesh::Data& mesh, std::span<const Vec3> points,
                     std::vector<Enclosure>& out);

}  // namespace elbowroom
