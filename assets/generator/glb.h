// SPDX-License-Identifier: MIT
// A small writer of binary glTF 2.0: rigid and skinned meshes, joints, clips. Only what the demo
// files need; same input, same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "assets/generator/skinning.h"

namespace elbowroom::demo {

struct GlbMaterial {
  std::string name;
  std::array<float, 3> color{};  // linear
  float roughness = 0.6f;
  float metallic = 0.0f;
  bool double_sided = false;
};

struct GlbPrimitive {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;           // one a position, unit
  std::vector<VertexWeights> weights;  // empty or one a position; indices into the skin
  std::vector<std::array<std::uint32_t, 3>> triangles;
  int material = 0;
};

struct GlbMesh {
  std::string name;
  std::vector<GlbPrimitive> primitives;
};

struct GlbNode {
  std::string name;
  int parent = -1;
  int mesh = -1;
  bool skinned = false;  // its mesh uses the one skin
  Vec3 translation{0.0};
  Quat rotation{1, 0, 0, 0};
};

struct GlbSkin {
  std::string name;
  std::vector<int> joints;  // node indices
  std::vector<Mat4> inverse_bind;
};

struct GlbChannel {
  int node = 0;
  bool rotation = true;       // else translation
  std::vector<Vec3> vectors;  // one a key
  std::vector<Quat> quats;    // one a key, unit; signs are aligned by the writer
};

struct GlbClip {
  std::string name;
  std::vector<double> times;  // shared by all channels, ascending
  std::vector<GlbChannel> channels;
};

struct GlbFile {
  std::string generator_note;
  std::vector<GlbMaterial> materials;
  std::vector<GlbMesh> meshes;
  std::vector<GlbNode> nodes;
  std::vector<GlbSkin> skins;  // at most one
  std::vector<GlbClip> clips;
};

std::string to_glb(const GlbFile& file);

}  // namespace elbowroom::demo
