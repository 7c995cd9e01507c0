// SPDX-License-Identifier: MIT
// What one file holds, checked and in plain form: joints, skins, triangles, clips, and which of it
// are characters and which objects. Immutable once read; shared between threads by const pointer.
//
// Positions are float32 as in the file, in the mesh's own space. Triangles are the file's own
// (strips and fans are unrolled), never welded, reordered or dropped: they are the truth of every
// collision verdict. A quad that a file gives twice is there twice.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/animation/clip.h"
#include "core/animation/skeleton.h"

namespace elbowroom {

struct Influence {
  std::int32_t joint;  // node index (not the index in the skin)
  std::int32_t slot;   // index in Skin::joints
  float weight;        // the weights of one vertex sum to 1 (normalized by the reader)
};

struct MorphTarget {
  std::vector<glm::vec3> offsets;  // one a vertex; empty if the target moves no position
};

// One glTF primitive as it stands at one node. A glTF mesh used by two nodes gives two of these.
struct Mesh {
  std::string name;
  int node = -1;
  int skin = -1;  // index in Model::skins; -1: rigid, placed by its node
  int material = -1;
  int source_mesh = -1, source_primitive = -1;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;    // empty or one a vertex
  std::vector<glm::vec2> texcoords;  // empty or one a vertex, for the material's base-colour
                                     // image, v down; a texture transform is applied
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> influence_begin;  // skinned: positions + 1 entries into influences
  std::vector<Influence> influences;
  std::vector<MorphTarget> morphs;
  std::vector<double> morph_weights;  // rest value, one a target
};

struct Skin {
  std::string name;
  std::vector<int> joints;         // node indices
  std::vector<Mat4> inverse_bind;  // one a joint; identity where the file has none. May carry scale
};

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // decoded; empty if no material has it as its base colour, or
                                   // if it can't be decoded (a warning says so)
};

struct Material {
  std::string name;
  glm::vec4 base_color{1.0f};
  int base_color_image = -1;
  float metallic = 1, roughness = 1;
  bool double_sided = false;
  bool unlit = false;
};

// A skinned figure: all skins whose joints hang together, their meshes, and rigid meshes that hang
// below one of their joints (a sword in a hand).
struct Character {
  std::string name;  // of the topmost node that is not shared with another character
  std::vector<int> skins;
  std::vector<int> meshes;  // indices in Model::meshes, skinned and rigid
  std::vector<int> joints;  // union of the skins' joints, node indices, ascending
  double height = 0;        // in the bind pose, extent along the file's up (+y), scene units. The
                            // unit of every tolerance (DESIGN.md, "Contact")
  int triangles = 0;
};

// Anything with triangles that is no part of a character: one for each topmost mesh-bearing node.
struct Object {
  std::string name;
  int node = -1;
  std::vector<int> meshes;
  int triangles = 0;
  bool animated = false;  // some clip moves it
};

// A joint that the file itself says to be a certain bone of a human body, by the names of VRM
// ("leftUpperArm"). Not checked to make sense.
struct HumanBone {
  std::string bone;
  int node = -1;  // in range
};

struct Model {
  std::filesystem::path path;
  Skeleton skeleton;
  std::vector<Mesh> meshes;
  std::vector<Skin> skins;
  std::vector<Clip> clips;
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<HumanBone> human_bones;  // of a VRM file, in the file's order
  std::vector<Character> characters;
  std::vector<Object> objects;
  std::vector<std::string> warnings;

  // By exact name, else by decimal index; -1 if there is none.
  int find_clip(const std::string& name_or_index) const;
};

// world_from_joint of the pose the skins were bound in: the inverse of each inverse bind matrix,
// placed as the rest pose places the character; joints of no skin follow their parent by their rest
// transform. This is the T- or A-pose even where the nodes' own TRS is a frame of some clip.
std::vector<Mat4> bind_globals(const Model& model, const Character& character);

// Vertices of a mesh in the world, morphed and skinned as a glTF player does, in double. For a
// rigid mesh its node's matrix is applied. `out` is resized to the mesh's positions.
void deform(const Model& model, const Mesh& mesh, const Pose& pose,
            const std::vector<Mat4>& world_from_joint, std::vector<Vec3>& out);

}  // namespace elbowroom
