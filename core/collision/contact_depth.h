// SPDX-License-Identifier: MIT
// How deep two surfaces run into each other at one place: the measure that contact reports give and
// that the depth limit of allowed contacts is stated in.
//
// The depth of touching patches is the largest distance by which a vertex of one body's patches
// lies behind the other body's surface there (its touching patches and those next to them), looked
// at both ways; behind is told by the winding. It is local on purpose: parts cut out of a skin are
// open, and what is behind a whole limb is not a question about one contact. 0 where no vertex is
// behind: surfaces that touch, and needles that pass through between vertices.
#pragma once

#include <vector>

#include "core/collision/collision_body.h"

namespace elbowroom {

// Patch numbers must be in range, ascending and unique. Scene units. Cost: vertices × triangles of
// the patches, culled; some tens of microseconds for a hand on a thigh.
double contact_depth(const CollisionBody& a, const std::vector<std::uint16_t>& patches_a,
                     const CollisionBody& b, const std::vector<std::uint16_t>& patches_b);
// contact_depth() > limit, at a fraction of its cost where it is not; limit ≥ 0.
bool deeper_than(double limit, const CollisionBody& a, const std::vector<std::uint16_t>& patches_a,
                 const CollisionBody& b, const std::vector<std::uint16_t>& patches_b);

}  // namespace elbowroom
