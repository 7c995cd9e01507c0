// SPDX-License-Identifier: MIT
// Arms and legs by what joints are called, and where names are numbers, by hierarchy and bone
// lengths. core/anatomy/limb_names.h reads one name; this puts them together.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/anatomy/bound_figure.h"
#include "core/anatomy/limb.h"

namespace elbowroom {

struct NamedLimb {
  int root = -1, middle = -1, end = -1;  // -1: not found
  std::string why;                       // what it rests on; of one not found, why not
  std::vector<int> detached;             // hand or foot, fingers or toes that do not hang from it
  bool side_by_place = false;            // the names tell no sides
};

// By kind: left arm, right arm, left leg, right leg. `members` are the nodes that may be joints of
// the character, parents first.
std::array<NamedLimb, 4> find_named_limbs(const BoundFigure& figure,
                                          const std::vector<int>& members);

}  // namespace elbowroom
