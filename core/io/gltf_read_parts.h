// SPDX-License-Identifier: MIT
// From tinygltf's structures to a Model, one function a kind of thing. Private to the gltf_*.cpp
// files; each refuses by throwing Refusal and appends to model.warnings.
#pragma once

#include <string>

#include "core/io/gltf_parse.h"
#include "core/scene/model.h"

namespace elbowroom::gltf {

struct Conversion {
  const tinygltf::Model& source;
  const Checked& checked;
  const std::string file;  // for errors
  Model& model;

  std::string in_file(const std::string& part) const { return file + ", " + part; }
};

void convert_nodes(Conversion& to);  // skeleton; first of all
void convert_skins(Conversion& to);
void convert_meshes(Conversion& to);     // after nodes and skins
void convert_materials(Conversion& to);  // without images
void convert_clips(Conversion& to);      // after meshes
// Decodes the images that materials use. `read` fetches the encoded bytes of one and may refuse;
// that costs the image and gives a warning.
void convert_images(Conversion& to, Folder& folder, bool decode);

}  // namespace elbowroom::gltf
