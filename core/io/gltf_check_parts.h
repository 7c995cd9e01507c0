// SPDX-License-Identifier: MIT
// The parts of check_document (gltf_check.h), which fill one reduced document. Private to the
// gltf_check*.cpp files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/io/gltf_check.h"
#include "core/io/gltf_json.h"

namespace elbowroom::gltf {

struct CheckState {
  const Container& container;
  Folder& folder;
  const Json& document;
  JsonAccess access;
  Json reduced;
  Checked out;
};

// buffers, bufferViews and accessors: bytes are fetched and every range is checked.
void check_data(CheckState& state);
// materials and textures (which only ever warn), meshes, skins, nodes, scenes and animations.
// Requires check_data.
void check_looks(CheckState& state);
void check_scene(CheckState& state);
void check_animations(CheckState& state);
// The humanoid bones of a VRM file; only ever warns. Requires check_scene.
void check_human_bones(CheckState& state);

}  // namespace elbowroom::gltf
