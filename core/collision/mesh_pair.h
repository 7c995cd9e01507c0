// SPDX-License-Identifier: MIT
// Questions about two collision meshes in a relative placement: do they touch, where, how far
// apart.
//
// Truth is the triangles themselves: those of a as they are, those of b with every vertex placed as
// `a_from_b * p` in double. At distance 0 two triangles are in contact if they share a point,
// exactly; else if they are at a distance ≤ `distance`, within 1e-9 of their size. Surfaces at a
// distance ≤ `distance` are in contact, and so is what lies wholly inside:
//
// Containment. A component of one mesh (its triangles hang together) that crosses nothing of an
// enclosing component of the other mesh and has a vertex inside it, is in contact. Which components
// enclose is the mesh's to say (Openings). A filter hides it only if it allows every triangle of
// the contained component against the first triangle of the enclosing one; what find_contacts()
// lists for a containment are exactly these pairs. What is partly inside through allowed contacts
// is judged by its contacts alone.
//
// What decides. Culling by boxes and slabs (box_traversal.h) leaves few pairs of triangles. Each is
// settled by an exact predicate: measured, that costs less than the edges' rays about a contact,
// and rays decide nothing where surfaces are near but do not cross. Embree's rays decide where they
// look farther than a pair: inside or outside by parity (containment.h), and edge packets where
// hundreds of near pairs have decided nothing (edge_rays.h). An edge's hit is confirmed exactly; a
// parity counts if two rays clear of all edges agree, else exact crossings are counted.
//
// All functions: a transform that is not finite says nothing about the pair, so it counts as
// contact (in_contact true, distance 0, no places). A negative or NaN distance counts as 0. Any
// number of threads may ask about the same meshes, each with its own cache.
#pragma once

#include <cstdint>
#include <vector>

#include "core/collision/collision_mesh.h"

namespace elbowroom {

struct PatchRegions;

// Allowed contacts as pairs of patches: every triangle has a patch number in its mesh; the pair
// (p, q) is allowed if bit p · patches_b + q is set.
struct PatchFilter {
  const std::uint16_t* patch_of_a = nullptr;  // one a triangle of mesh a
  const std::uint16_t* patch_of_b = nullptr;
  int patches_b = 0;
  const std::vector<bool>* allowed = nullptr;
  // Of just these meshes and allowed pairs (patch_regions.h), or null: saves time, decides nothing.
  const PatchRegions* regions = nullptr;

  bool allows(std::uint32_t triangle_a, std::uint32_t triangle_b) const {
    return allowed && (*allowed)[static_cast<std::size_t>(patch_of_a[triangle_a]) *
                                     static_cast<std::size_t>(patches_b) +
                                 patch_of_b[triangle_b]];
  }
};

// What a query remembers for the next one: the pair that hit last is tried first.
struct PairCache {
  std::uint32_t triangle_a = 0, triangle_b = 0;
  bool set = false;
};

struct TriangleContact {
  std::uint32_t triangle_a = 0, triangle_b = 0;
  Vec3 place{0.0};         // in a's frame, on or between the two triangles
  bool contained = false;  // found by parity, not by crossing
};

// True if anything not allowed is in contact (distance ≤ `distance` ≥ 0, in a's units).
bool in_contact(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
                double distance, const PatchFilter& filter = {}, PairCache* cache = nullptr);

// Distances by triangle: how far each of a mesh may still get.
struct TriangleReach {
  const float* of_a = nullptr;  // one a triangle of mesh a, ≥ 0
  const float* of_b = nullptr;
  double most = 0;   // no less than any sum of one of each
  double apart = 0;  // what is to be kept beside
};

// True if two triangles that are not allowed are at a distance ≤ apart + of_a + of_b: what has to
// be false for two surfaces never to touch while each gets no farther than its reach. Containment
// is not looked at: surfaces that never touch leave inside and outside as they are.
bool reach_each_other(const CollisionMesh& a, const CollisionMesh& b,
                      const RigidTransform& a_from_b, const TriangleReach& reach,
                      const PatchFilter& filter = {}, PairCache* cache = nullptr);

// All pairs in contact, in a fixed order; allowed ones too, unless the filter says so.
void find_contacts(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
                   double distance, const PatchFilter& filter, std::vector<TriangleContact>& out);

// The same for who asks which patches are in contact: of each two one pair of triangles at least,
// none with a place (but for what is contained). `filter` has to be one that allows something.
// What `out` holds before, of an earlier time, is tried first, which saves time and changes
// nothing.
void find_patch_contacts(const CollisionMesh& a, const CollisionMesh& b,
                         const RigidTransform& a_from_b, double distance, const PatchFilter& filter,
                         std::vector<TriangleContact>& out);

// The distance of the two surfaces, 0 where they cross, or `at_most` if it is larger. Containment
// is not looked at. Exact within 1e-9 of the meshes' size.
double surface_distance(const CollisionMesh& a, const CollisionMesh& b,
                        const RigidTransform& a_from_b, double at_most,
                        const PatchFilter& filter = {});

// How deep points of a lie inside b and the other way round: the largest distance from a vertex of
// one that is inside a closed component of the other to the other's surface; 0 if none is inside.
double penetration_depth(const CollisionMesh& a, const CollisionMesh& b,
                         const RigidTransform& a_from_b);

}  // namespace elbowroom
