// SPDX-License-Identifier: MIT
// Skeletons for tests, written down as text: one joint a line,
//
//   NAME = X Y Z [mark]
//
// indented by one space for each joint above it. X Y Z is where it stands at rest relative to the
// joint above, in the axes of the whole figure. Marks: "-" a joint of the skin that no vertex
// follows, "~" a plain node that no skin uses. A line with {Left|Right} in its name stands for both
// sides, with all below it: the right one has its x mirrored.
#pragma once

#include "tests/unit/rigs/rig_maker.h"

namespace elbowroom::test {

struct WrittenJoint {
  std::string name;
  int parent = -1;
  Vec3 place{0.0};  // in the axes of the whole figure
  Carries carries = Carries::skin;
};

// Aborts on a text that is none.
std::vector<WrittenJoint> read_skeleton(const std::string& text);

// The figure with every joint turned by chance, so that nothing can rest on the axes of bones.
MadeRig rig_of(const std::vector<WrittenJoint>& joints, const Placement& placement = {},
               bool nonsense_names = false);

}  // namespace elbowroom::test
