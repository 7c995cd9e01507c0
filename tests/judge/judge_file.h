// SPDX-License-Identifier: MIT
// The judge's own reader of glTF and GLB: plain, trusting, and sharing nothing with the product's.
// Wrong files throw std::runtime_error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace judge {

struct Node {
  std::string name;
  int parent = -1;
  glm::dvec3 translation{0.0}, scale{1.0};
  glm::dquat rotation{1, 0, 0, 0};
  std::optional<glm::dmat4> matrix;
  int mesh = -1, skin = -1;
  std::vector<double> weights;  // of its morph targets
  bool in_scene = false;        // below a root of the default scene
};

// One primitive with triangles.
struct Primitive {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<std::vector<std::pair<int, double>>>
      influences;  // by vertex: slot in the skin, weight
  std::vector<std::vector<glm::dvec3>> morphs;
};

struct MeshData {
  std::vector<Primitive> primitives;
  std::vector<double> weights;
};

struct SkinData {
  std::vector<int> joints;
  std::vector<glm::dmat4> inverse_bind;
};

struct KeyChannel {
  int node = -1;
  std::string path, interpolation;
  int components = 0;  // 0: its counts do not fit, it cannot be played
  std::vector<float> times;
  std::vector<double> values;                       // as a player computes with them
  std::vector<std::uint8_t> raw_times, raw_values;  // as they stand in the file, without gaps
};

struct KeyAnimation {
  std::string name;
  std::vector<KeyChannel> channels;  // those with a node
  double begin = 0, end = 0;
};

struct File {
  std::filesystem::path path;
  std::vector<Node> nodes;
  std::vector<int> order;  // parents first
  std::vector<MeshData> meshes;
  std::vector<SkinData> skins;
  std::vector<KeyAnimation> animations;
  std::string json;                  // the text
  std::string bin;                   // the BIN chunk, with its padding
  std::vector<std::string> buffers;  // all bytes each buffer's file, chunk or data URI has
  bool binary = false;

  // By exact name, else by index; throws if there is none.
  const KeyAnimation& animation(const std::string& name_or_index) const;
  int node(const std::string& name) const;  // throws if there is none
  bool is_within(int node, int ancestor) const;
};

File load(const std::filesystem::path& path);

}  // namespace judge
