// SPDX-License-Identifier: MIT
// Which files make up a scene and how they are placed: what the command line's SCENE-ARGS and a
// project file say, before anything is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/animation/skeleton.h"

namespace elbowroom {

// A prop in a hand: the file's root stands at `joint_from_object` in the joint's rigid frame.
struct AttachedFile {
  std::filesystem::path file;
  std::string joint;  // name in the character's file
  Transform joint_from_object;
  bool operator==(const AttachedFile&) const = default;
};

struct SceneDescription {
  std::filesystem::path character;
  std::string clip;  // name or index; empty: the first one
  std::vector<std::filesystem::path> obstacles;
  std::vector<AttachedFile> attachments;
  bool operator==(const SceneDescription&) const = default;
};

}  // namespace elbowroom
