// SPDX-License-Identifier: MIT
// Checks the JSON of a glTF file before anything is read by it, and cuts it down to what the reader
// uses. tinygltf, which checks no index, size or loop itself, only ever sees the result.
//
// Used inside the reader only; refuses by throwing Refusal.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/gltf_source.h"

namespace elbowroom::gltf {

// Where an image's bytes are; at most one of the two is set.
struct ImageSource {
  std::string uri;
  int buffer_view = -1;
};

// The base-colour texture of a material, and where it lies on the surface.
struct BaseTexture {
  int image = -1;
  int texcoord = 0;                    // TEXCOORD_n
  glm::dvec2 offset{0.0}, scale{1.0};  // KHR_texture_transform
  double rotation = 0;                 // radians, counter-clockwise
};

// A node that a VRM file says to be a bone of a human body.
struct NamedBone {
  std::string bone;
  int node = -1;
};

struct Checked {
  std::string json;            // the reduced document; buffer i has the URI "buffer/i"
  std::vector<Bytes> buffers;  // by buffer, exactly as long as the reduced document says
  std::vector<ImageSource> images;
  std::vector<BaseTexture> base_textures;  // by material
  std::vector<std::string> unusable;       // by accessor: why it can't be read; empty if it can
  std::vector<bool> visible;               // by node: in the scene that is shown
  std::vector<NamedBone> human_bones;
  bool quantized = false;         // KHR_mesh_quantization is in use
  std::uint64_t total_bytes = 0;  // of all buffers: what the file can justify to allocate
  std::vector<std::string> warnings;
};

// `container` and `folder` are the file's. Everything the returned document says holds: indices are
// in range, bufferViews lie in their buffers and accessors in their bufferViews, nodes form a
// forest, and all numbers are finite and of modest size.
Checked check_document(const Container& container, Folder& folder);

// The name under which the reduced document lists a primitive's indices among its attributes.
inline constexpr const char* kIndices = "INDICES";

// How errors name a part: `node 5 "LeftArm"`.
std::string part_name(const char* kind, std::size_t index, const std::string& name);

// Bytes of one component of a glTF componentType; 0 if unknown.
int component_bytes(int component_type);

// The largest coordinate, scale or matrix entry that is taken for real. Beyond it products of a few
// transforms leave the range in which anything can be computed.
inline constexpr double kLargestNumber = 1e15;

}  // namespace elbowroom::gltf
