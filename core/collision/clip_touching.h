// SPDX-License-Identifier: MIT
// What the clip itself has in contact of two bodies of one character, as final verdicts take it:
// triangle by triangle, not patch by patch. A patch is centimetres wide, and where a hand brushes a
// thigh not all of both may go through each other.
//
// Part by part: every triangle of one that the clip has in contact with the other, with its
// neighbours across edges and corners, may meet every such triangle of the other. So what touches
// may slide within what touches over the clip, and by a triangle beyond.
//
// Held as patches cut in two, touched and not: a numbering as PatchFilter takes it. Immutable once
// built; any thread.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "core/collision/collision_body.h"

namespace elbowroom {

class ClipTouching {
 public:
  // Of two parts (the owner's numbering), triangles of body a and of body b.
  struct Parts {
    int part_a = -1, part_b = -1;
    std::set<std::uint32_t> a, b;
  };

  ClipTouching() = default;
  // `lasting`: pairs of the bodies' patches that may touch at any time. Neighbours are added here.
  ClipTouching(const CollisionBody& a, const CollisionBody& b, const std::vector<bool>& lasting,
               const std::vector<Parts>& touched);

  bool empty() const { return parts_.empty(); }
  // Whether two triangles may meet for the clip's sake or always.
  bool allows(std::uint32_t triangle_a, std::uint32_t triangle_b) const {
    return allowed_[static_cast<std::size_t>(piece_of_a_[triangle_a]) *
                        static_cast<std::size_t>(pieces_b_) +
                    piece_of_b_[triangle_b]];
  }
  // That as a filter; keeps references.
  PatchFilter filter() const { return filter(allowed_); }
  // A filter with other pairs of pieces, as allowed_where() gives them; keeps references.
  PatchFilter filter(const std::vector<bool>& allowed) const {
    return {piece_of_a_.data(), piece_of_b_.data(), pieces_b_, &allowed};
  }
  // Pieces of each two parts that may meet for the clip's sake; a piece's patch is its remainder by
  // the body's number of patches.
  struct Pieces {
    int part_a = -1, part_b = -1;
    std::vector<std::uint16_t> a, b;  // ascending
  };
  const std::vector<Pieces>& parts() const { return parts_; }
  // What may always meet, and what may for the clip's sake of the parts that `holds`, by parts().
  std::vector<bool> allowed_where(const std::vector<bool>& holds) const;

 private:
  void allow(const Pieces& pieces, std::vector<bool>& allowed) const;

  int pieces_b_ = 0;
  std::vector<std::uint16_t> piece_of_a_, piece_of_b_;  // by triangle
  std::vector<bool> lasting_, allowed_;                 // by piece of a and of b
  std::vector<Pieces> parts_;
};

}  // namespace elbowroom
