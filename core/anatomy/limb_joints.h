// SPDX-License-Identifier: MIT
// What stands between and beside a limb's own joints. For the finders of limbs.
#pragma once

#include <string>
#include <vector>

#include "core/anatomy/bound_figure.h"
#include "core/anatomy/limb.h"

namespace elbowroom {

// With root, middle and end set: fills `joints` and `beside` and adds them to `why`. Where a clip
// turns not a limb's joint but a node above it in the same place (importers split a joint into
// pivots), that node is the limb's.
void complete_limb(const BoundFigure& figure, Limb& limb);

// Joints with skin of their own that lie along the limb's upper bone but hang from what its root
// hangs from (3ds Max and Valve hang upper arms' twist joints from the clavicle): they will not
// follow the limb. Parents first.
std::vector<int> left_behind(const BoundFigure& figure, const Limb& limb);

// A joint's name in quotes, or its node index.
std::string quoted_joint(const Model& model, int joint);

}  // namespace elbowroom
