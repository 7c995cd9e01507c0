// SPDX-License-Identifier: MIT
// Chains of joints as a finder of limbs by shape sees them (shaped_limbs.h), and how well three
// joints of one fit the root, middle and end of an arm or a leg. Not for other uses. One thread.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/anatomy/bound_figure.h"

namespace elbowroom {

// From a joint down, always along the branch that goes farthest, to its last joint.
struct ShapedChain {
  std::vector<int> joints;
  std::vector<char> forks;     // by index: branches of like size part here
  std::vector<double> beyond;  // by index: length along the bones from there to the last joint
  std::vector<double> bends;   // by index: how far the bone to the next joint swings in the clips,
                               // radians; empty if no clip turns any of them
};

struct ChainFit {
  std::size_t root = 0, middle = 0, end = 0;  // indices into the chain
  double upper = 0, lower = 0;                // lengths of the two bones
  double cost = INFINITY;                     // 0 or less: as a limb should be; 1: hardly
  std::string remark;                         // twist joints between, for people; may be empty
};

class ChainShapes {
 public:
  // `figure` and `members` (parents first) must outlive it.
  ChainShapes(const BoundFigure& figure, const std::vector<int>& members);

  // Members directly below a joint which carry skin; where none do, whatever closes the bone.
  const std::vector<int>& below(int joint) const { return below_[static_cast<std::size_t>(joint)]; }
  // Length along the bones from the joint's parent to the farthest joint below it.
  double extent(int joint) const { return extent_[static_cast<std::size_t>(joint)]; }

  const ShapedChain& chain(int joint);

  // Every three joints that are not out of the question. `other` is the chain on the body's other
  // side.
  std::vector<ChainFit> fits(const ShapedChain& chain, const ShapedChain* other, bool arm) const;

 private:
  ShapedChain follow(int joint) const;
  void add(ShapedChain& chain, int joint) const;
  std::vector<double> bends_in_clips(const std::vector<int>& joints) const;

  const BoundFigure& figure_;
  std::vector<std::vector<int>> below_;
  std::vector<double> extent_;
  std::vector<int> weight_;  // joints below
  std::map<int, ShapedChain> chains_;
};

}  // namespace elbowroom
