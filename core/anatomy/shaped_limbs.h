// SPDX-License-Identifier: MIT
// Arms and legs by shape alone, for rigs whose names say nothing.
//
// A body has two pairs of chains that are alike on both sides: arms, which leave the upper trunk,
// and legs, which leave its lower end and point away from it. Every pair of joints side by side is
// the root of a possible pair of chains; a chain is followed to where it ends or forks into
// fingers. Along it, the root, the middle and the end of a limb are the three joints whose two
// bones fit a limb best: about equally long, clavicles before them and a hand or foot beyond them
// short, twist joints on the line between them, and, where there are clips, joints that bend in
// them.
//
// What is asked of a chain are lengths and angles of the bind pose, relative to each other, and how
// far joints bend in the clips. So size, placement and mirrors do not matter, and names do not.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/anatomy/bound_figure.h"

namespace elbowroom {

struct ShapedLimb {
  int root = -1, middle = -1, end = -1;
  std::string why;  // what it rests on, for people
};

// Two limbs that are each other's mirror image; which of them is the body's left is not told here.
using ShapedPair = std::array<ShapedLimb, 2>;

struct ShapedLimbs {
  std::optional<ShapedPair> arms, legs;
  std::string no_arms, no_legs;  // why there are none
};

// `members` are the nodes that may be joints of the character, parents first. Never fails; bounded
// work also on hostile trees (a few milliseconds).
ShapedLimbs find_shaped_limbs(const BoundFigure& figure, const std::vector<int>& members);

}  // namespace elbowroom
