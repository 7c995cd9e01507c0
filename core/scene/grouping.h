// SPDX-License-Identifier: MIT
// Which of a file's nodes make up characters and which make up objects. Every reader calls this
// once its skeleton, meshes, skins and clips stand.
#pragma once

#include "core/scene/model.h"

namespace elbowroom {

// Fills model.characters and model.objects (see there), heights included, and appends a warning
// where something had to be guessed. Requires a linked skeleton and indices in range.
//
// Two skins belong to one character if they share a joint, or if a joint of one hangs below a joint
// (or below the common root node) of the other. Skins that no mesh uses make a character only in a
// file whose skins are all unused: a clip without its figure. Order follows the file.
void group_characters_and_objects(Model& model);

// Bind-pose extent along a unit vector of the file's space: of the triangles, skinned and rigid; of
// a clip without a figure, of its joints. Lengths need a unit that isn't zero, so what is flat
// along it is measured by its diagonal, and what has no extent by 1. O(vertices).
double bind_extent(const Model& model, const Character& character, const Vec3& along);

}  // namespace elbowroom
