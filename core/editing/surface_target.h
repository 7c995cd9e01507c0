// SPDX-License-Identifier: MIT
// A hand (foot) on a surface: the targets that a click on one may mean, best first.
//
// The palm faces the surface, its x as near as can be to where the hand points at present, then
// turned about the normal by more and more to either side; it keeps `clearance`, and as much more
// as the hand's skin stands out past the palm's middle in the bind pose (curled fingers, a thumb),
// so that a flat surface is not run into. The last one is the wrist at the hand's length from the
// surface, its orientation free: the only one where there is no palm.
//
// World space, scene units, radians. Pure, any thread.
#pragma once

#include <vector>

#include "core/anatomy/limb_model.h"
#include "core/editing/document.h"

namespace elbowroom {

struct SurfacePoint {
  Vec3 place{0.0};
  Vec3 normal{0, 1, 0};  // unit, out of the surface
};

// `world_from_end` is the end joint as it stands; `hand_length` how far the hand's skin goes beyond
// it (hand_length()). Never empty; a point that is not finite gives a target that is not either.
std::vector<HandTarget> surface_targets(const LimbModel& limb, const Mat4& world_from_end,
                                        const SurfacePoint& point, double clearance,
                                        double hand_length, double time);

// How far the skin that follows the limb's end most goes from its origin in the bind pose, scene
// units; 0 without any. Cost: O(vertices).
double hand_length(const Model& model, const Character& character, const Limb& limb);

}  // namespace elbowroom
