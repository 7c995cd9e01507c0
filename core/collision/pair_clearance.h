// SPDX-License-Identifier: MIT
// A one-sided question about two meshes, for proofs that ask it thousands of times: are they surely
// farther apart than a distance? By boxes, slabs and the planes of triangles; no distance between
// triangles is computed, so a no means little and costs little.
#pragma once

#include "core/collision/mesh_pair.h"

namespace elbowroom {

// True only if all pairs of triangles that are not allowed are farther apart than `distance` ≥ 0.
// Containment is not looked at. False where the transform or the distance is not finite.
bool surely_farther(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
                    double distance, const PatchFilter& filter = {});

}  // namespace elbowroom
