// SPDX-License-Identifier: MIT
// Which joints move as one over a window: a fist's fingers with the hand, a trunk that stands
// still.
#pragma once

#include <vector>

#include "core/scene/world.h"

namespace elbowroom {

// By node of the actor's skeleton, the topmost node it moves with over [begin, end]: between the
// two no local transform changes by more than 2e-3 rad, `tolerance` (scene units) or 1e-4 in scale.
// Nodes of `apart` are the top of their link whatever they do. Looked at at 60 Hz and at the ends.
std::vector<int> rigid_links(const World& world, int actor, double begin, double end,
                             const std::vector<int>& apart, double tolerance);

}  // namespace elbowroom
