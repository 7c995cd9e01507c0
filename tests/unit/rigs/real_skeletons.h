// SPDX-License-Identifier: MIT
// Skeletons that exist, with the limbs that they should be found to have.
#pragma once

#include <array>
#include <vector>

#include "core/base/math.h"

namespace elbowroom::test {

struct RealSkeleton {
  const char* name;
  std::array<const char*, 3> arm, leg;  // root, middle, end with {L|R}; of no arm: null
  const char* text;                     // skeleton_text.h
  Vec3 forward{0, 0, 1};                // where it looks; zero: its pose does not tell
  std::size_t followed = 0;             // limbs that joints follow from elsewhere in the tree
};
std::vector<RealSkeleton> real_skeletons();
std::vector<RealSkeleton> recorded_skeletons();  // some of them
RealSkeleton unreal_skeleton();                  // one of them

// What one convention calls its joints, both sides of a name with {L|R}; "" where it has none.
struct JointNames {
  const char* convention;
  const char* source;
  const char *hips, *chest, *clavicle, *upper, *fore, *hand, *thumb, *finger, *thigh, *shin, *foot,
      *toe;
};
std::vector<JointNames> real_names();

}  // namespace elbowroom::test
