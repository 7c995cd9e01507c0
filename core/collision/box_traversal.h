// SPDX-License-Identifier: MIT
// Dual traversal of two box trees, each in its own frame: which pairs of triangles may be at a
// distance ≤ `distance`, or closest. One box of one tree meets the 16 boxes of a node of the other
// at once (separating axes: six face normals and the slabs' own; Gottschalk, Lin and Manocha 1996),
// in float, with Highway's run-time dispatch.
//
// Conservative: a pair that is left out is farther apart than `distance`. Boxes are rounded
// outwards and every bound is widened by more than the rounding of its evaluation, so the culling
// may differ in what it lets through but never in what it may drop. No fused operations: the same
// pairs in the same order in every instruction set.
#pragma once

#include <cstdint>

#include "core/collision/box_tree.h"
#include "core/collision/collision_mesh.h"
#include "core/collision/patch_regions.h"

namespace elbowroom {

// Pairs of one triangle of one tree with some of the other. Returns true to stop the traversal.
// `one_is_a`: `one` belongs to tree a and `many` to b; else the other way round.
using PairVisitor = bool (*)(void* context, std::uint32_t one, const std::uint32_t* many, int count,
                             bool one_is_a);

// What a traversal has seen of whole trees: nothing of a lies in b's box, nothing of b in a's.
struct Apart {
  bool a_outside_b = false, b_outside_a = false;
};

// Visits all pairs of triangles whose boxes are not surely farther apart than `distance`, deepest
// first. True if the visitor stopped it. What is allowed by `regions` (null: nothing is) is left
// out where whole boxes are; the visitor still sees some.
bool visit_close_pairs(const BoxTree& a, const BoxTree& b, const RigidTransform& a_from_b,
                       double distance, const PatchRegions* regions, PairVisitor visitor,
                       void* context, Apart* apart = nullptr);

// The closest pair of triangles so far, kept by the visitor below.
struct ClosestSoFar {
  double distance = 0;  // pairs of boxes farther apart than this are left out
  Vec3 axis{0.0};  // unit vector in a's frame from one of the closest points to the other, or 0
};

// Visits pairs nearest boxes first while their boxes may be closer than so_far.distance, which the
// visitor lowers as it finds closer triangles. Boxes are compared along so_far.axis too: about the
// closest points of smooth surfaces that axis separates nearly everything else.
bool visit_closest_pairs(const BoxTree& a, const BoxTree& b, const RigidTransform& a_from_b,
                         const ClosestSoFar& so_far, const PatchRegions* regions,
                         PairVisitor visitor, void* context);

// The transform is finite, so that anything can be said about the pair.
bool is_finite(const RigidTransform& t);

}  // namespace elbowroom
