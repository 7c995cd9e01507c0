// SPDX-License-Identifier: MIT
// The joints that names say to be parts of an arm or a leg, before they are put together
// (core/anatomy/named_limbs.h).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/anatomy/bound_figure.h"
#include "core/anatomy/limb_names.h"

namespace elbowroom {

// The names of one family of limbs, from the root to the end.
struct LimbFamily {
  bool arm;
  BonePart upper, plain, fore, end, weak;
  const char* upper_word;
  const char* fore_word;
  const char* end_word;
};
inline constexpr std::array<LimbFamily, 2> kLimbFamilies = {
    LimbFamily{true, BonePart::upper_arm, BonePart::arm, BonePart::forearm, BonePart::hand,
               BonePart::shoulder, "upper arm", "forearm", "hand"},
    LimbFamily{false, BonePart::thigh, BonePart::leg, BonePart::shin, BonePart::foot, BonePart::hip,
               "thigh", "shin", "foot"}};

bool of_family(const LimbFamily& family, BonePart part);

struct LimbCandidate {
  int joint = -1;
  BonePart part = BonePart::none;
  int rank = 0;  // of the same part those with the highest are taken
};

// A figure with the names of its joints read.
struct NamedFigure {
  const BoundFigure& figure;
  const Model& model;
  const std::vector<int>& members;  // nodes that could be joints of the character, parents first
  std::vector<BoneName> names;      // by node
  std::vector<char> member;         // by node

  NamedFigure(const BoundFigure& bound, const std::vector<int>& nodes);

  std::string quoted(int joint) const;
  double distance(int a, int b) const { return glm::distance(figure.place(a), figure.place(b)); }
  bool below(int joint, int ancestor) const {
    return joint != ancestor && model.skeleton.is_within(joint, ancestor);
  }
  const BoneName& name(int joint) const { return names[static_cast<std::size_t>(joint)]; }
  bool is_member(int joint) const { return member[static_cast<std::size_t>(joint)] != 0; }
  int descendants(int joint) const;  // members below it
};

// Sides of the joints, by node: as named, or by place for families whose names tell none
// (`by_place`, arms and legs).
std::vector<BoneSide> sides_of(const NamedFigure& figure, std::array<bool, 2>& by_place);

// The joints of one family on one side, parents first; of each part those of the highest rank. What
// a bare "arm" or "shoulder" means is settled by what else is named above and below it.
std::vector<LimbCandidate> candidates_of(const NamedFigure& figure, const LimbFamily& family,
                                         BoneSide side, const std::vector<BoneSide>& sides);

// Nearest below `from` with the wanted part; of equally near ones that with most below it, then the
// first. `several` tells of the others. -1: none.
int nearest_below(const NamedFigure& figure, const std::vector<LimbCandidate>& candidates,
                  BonePart part, int from, bool& several);

}  // namespace elbowroom
