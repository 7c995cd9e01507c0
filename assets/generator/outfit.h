// SPDX-License-Identifier: MIT
// What the mannequin wears: colours only, divided by clean lines across its one skin.
#pragma once

#include <vector>

#include "assets/generator/glb.h"
#include "assets/generator/surface.h"

namespace elbowroom::demo {

// Cuts the surface along all hems.
Surface cut_outfit(const Surface& surface, const BodyShape& shape);

std::vector<GlbMaterial> outfit_materials();
// Index of the material at a place of the body in the bind pose.
int outfit_material(const Vec3& p);

}  // namespace elbowroom::demo
