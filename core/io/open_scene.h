// SPDX-License-Identifier: MIT
// From a scene's description to its world: reads every file once and places it.
#pragma once

#include "core/base/result.h"
#include "core/scene/scene_description.h"
#include "core/scene/world.h"

namespace elbowroom {

struct OpenedScene {
  World world;        // actor 0 is the character's file; then obstacles, then attached props
  int character = 0;  // index in actor 0's model
  int clip = -1;      // index in actor 0's model, -1 if it has none
  std::vector<std::string> warnings;  // of all files

  const Model& model() const { return *world.actors.front().model; }
};

// Errors name the file, the joint or the clip, and what there is instead. A file that is both
// obstacle and attachment is read once.
Result<OpenedScene> open_scene(const SceneDescription& description);

}  // namespace elbowroom
