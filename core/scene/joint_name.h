// SPDX-License-Identifier: MIT
// Which joint a name means: files repeat names, and props and helper nodes bear those of joints.
#pragma once

#include <string>

#include "core/scene/model.h"

namespace elbowroom {

struct NamedJoint {
  int node = -1;      // -1: there is none
  int namesakes = 0;  // other joints that the name might have meant just as well
};

// A joint that the character's skins use comes before any other node of that name, and a name
// before a node's index ("17").
NamedJoint joint_of_name(const Model& model, const Character& character, const std::string& name);

}  // namespace elbowroom
