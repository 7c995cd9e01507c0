// SPDX-License-Identifier: MIT
// How far a limb's skin leaves the rigid parts that stand for it while planning: what the planning
// margin is measured by (DESIGN.md, "Collision: how").
#pragma once

#include <cstdint>

#include "core/collision/scene_collision.h"

namespace elbowroom {

struct SkinDeviation {
  double median = 0, percentile_95 = 0, largest = 0;  // scene units
  std::uint64_t measured = 0;                         // vertices times configurations
};

// Over `configurations` of the limb drawn from its limits (and that seed), at time t: how far
// vertices of the limb's skin stand outside the place their part alone would give them, along the
// part's normal there. The surroundings of the joints, where contact is allowed, are left out; skin
// that moves inwards counts as 0. Poses the scene and gives it back as it was. All zero where
// nothing of the limb deforms. Cost: about a millisecond a configuration.
SkinDeviation measure_skin_deviation(SceneCollision& scene, int limb, double t, int configurations,
                                     std::uint64_t seed);

}  // namespace elbowroom
