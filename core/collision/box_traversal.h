// SPDX-License-Identifier: MIT
// Dual traversal of two box trees, each in its own frame: which pairs of triangles may be at a
// distance ≤ `distance`, or closest. One box of one tree meets the 16 boxes of a node of the other
// at once (separating axes of Gottschalk, Lin and Manocha 1996), in float, with Highway's run-time
// dispatch.
//
// Conservative: a pair that is left out is farther apart than `distance`. Boxes are rounded
// outwards and every bound is widened by more than the rounding of its evaluation, so the culling
// may differ in what it lets through but never in what it may drop. No fused operations: the same
// pairs in the same order in every instruction set.
#pragma once

#include <cstdint>

#include "core/collision/box_tree.h"
#include "core/collision/collision_mesh.h"

namespace elbowroom {

// Pairs of one triangle of one tree with some of the other. Returns true to stop the traversal.
// `one_is_a`: `one` belongs to tree a and `many` to b; else the other way round.
using PairVisitor = bool (*)(void* context, std::uint32_t one, const std::uint32_t* many, int count,
                             bool one_is_a);

// Visits all pairs of triangles whose boxes are not surely farther apart than `distance`, deepest
// first. True if the visitor stopped it.
bool visit_close_pairs(const BoxTree& a, const BoxTree& b, const RigidTransform& a_from_b,
                       double distance, PairVisitor visitor, void* context);

// Visits pairs nearest boxes first while their boxes may be closer than *distance, which the
// visitor lowers as it finds closer triangles.
bool visit_closest_pairs(const BoxTree& a, const BoxTree& b, const RigidTransform& a_from_b,
                         const double* distance, PairVisitor visitor, void* context);

// The transform is finite, so that anything can be said about the pair.
bool is_finite(const RigidTransform& t);

}  // namespace elbowroom
