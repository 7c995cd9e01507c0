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

// Joints that move skin and will not follow the limb, though they belong to it by their place:
// those along its upper bone that hang from what its root hangs from (3ds Max and Valve hang upper
// arms' twist joints from the clavicle), and those in its middle's or its end's place that hang
// from elsewhere (the skeleton of a garment). Parents first; below one, others are not listed.
std::vector<int> left_behind(const BoundFigure& figure, const Limb& limb);

// A joint's name in quotes, or its node index.
std::string quoted_joint(const Model& model, int joint);

}  // namespace elbowroom
