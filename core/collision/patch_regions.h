// SPDX-License-Identifier: MIT
// Allowed contacts, as a traversal of two box trees can use them: below which pairs of boxes is
// there anything but allowed pairs of triangles? Joined parts of a body always lie close about
// their joint, and all of that is allowed; without this every question about them would visit it
// triangle by triangle.
//
// Patches of mesh b against which the same patches of a are allowed are one class, of 64 at most
// (what is left over shares the last one). Each box of b has the classes below it, each box of a
// those that something below it is not allowed to touch: where the two have none in common, all
// pairs below are allowed. Conservative: a pair that is left out is allowed.
//
// A value; refitting either mesh leaves it as it is. Any number of threads may read it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/collision/box_tree.h"
#include "core/collision/mesh_pair.h"

namespace elbowroom {

struct PatchRegions {
  // By node · BoxTree::kWidth + child, and for each tree as a whole.
  std::vector<std::uint64_t> of_a, of_b;
  std::uint64_t all_a = 0, all_b = 0;

  // These are regions of trees of this size.
  bool fit(const BoxTree& a, const BoxTree& b) const {
    return of_a.size() == a.nodes.size() * BoxTree::kWidth &&
           of_b.size() == b.nodes.size() * BoxTree::kWidth;
  }
};

// Of what the filter allows now; null if it allows nothing. O(triangles + pairs of patches).
std::shared_ptr<const PatchRegions> patch_regions(const CollisionMesh& a, const CollisionMesh& b,
                                                  const PatchFilter& filter);

}  // namespace elbowroom
