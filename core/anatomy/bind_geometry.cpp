// SPDX-License-Identifier: MIT
#include "core/anatomy/bind_geometry.h"

#include <algorithm>

#include "core/anatomy/limb_names.h"

namespace elbowroom {
namespace {

Vec3 transform(const Mat4& m, const Vec3& p) { return Vec3(m * glm::dvec4(p, 1.0)); }

// Sum and number of the vertices that follow the joint for more than half.
void add_vertices(const Model& model, const Character& character, const std::vector<Mat4>& globals,
                  int joint, Vec3& sum, int& count) {
  for (const int index : character.meshes) {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(index)];
    if (mesh.skin < 0) {
      if (mesh.node < 0 || !model.skeleton.is_within(mesh.node, joint)) continue;
      for (const glm::vec3& p : mesh.positions) {
        sum += transform(globals[static_cast<std::size_t>(mesh.node)], Vec3(p));
        ++count;
      }
      continue;
    }
    const Skin& skin = model.skins[static_cast<std::size_t>(mesh.skin)];
    const auto slot = std::find(skin.joints.begin(), skin.joints.end(), joint);
    if (slot == skin.joints.end()) continue;
    const Mat4 world_from_mesh =
        globals[static_cast<std::size_t>(joint)] *
        skin.inverse_bind[static_cast<std::size_t>(slot - skin.joints.begin())];
    for (std::size_t v = 0; v + 1 < mesh.influence_begin.size(); ++v) {
      float weight = 0;
      for (std::uint32_t i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i) {
        if (mesh.influences[i].joint == joint) weight += mesh.influences[i].weight;
      }
      if (!(weight > 0.5f)) continue;
      sum += transform(world_from_mesh, Vec3(mesh.positions[v]));
      ++count;
    }
  }
}

}  // namespace

std::optional<Vec3> direction(const Vec3& v) {
  const double length = glm::length(v);
  if (!(length > 1e-12) || !std::isfinite(length)) return std::nullopt;
  return v / length;
}

std::optional<Vec3> direction_across(const Vec3& v, const Vec3& axis) {
  const std::optional<Vec3> unit = direction(v);
  if (!unit) return std::nullopt;
  const Vec3 across = *unit - axis * glm::dot(*unit, axis);
  // Within a twentieth of a degree of the axis the rest is noise.
  if (!(glm::length(across) > 1e-3)) return std::nullopt;
  return direction(across);
}

std::optional<Quat> frame_of(const Vec3& x, const Vec3& y) {
  const auto across = direction_across(y, x);
  if (!across) return std::nullopt;
  return glm::normalize(glm::quat_cast(Mat3(x, *across, glm::cross(x, *across))));
}

bool is_skin_joint(const Character& character, int joint) {
  return std::binary_search(character.joints.begin(), character.joints.end(), joint);
}

bool moves_something(const Model& model, const Character& character, int joint) {
  for (const int other : character.joints) {
    if (model.skeleton.is_within(other, joint)) return true;
  }
  return std::any_of(character.meshes.begin(), character.meshes.end(), [&](int index) {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(index)];
    return mesh.skin < 0 && mesh.node >= 0 && model.skeleton.is_within(mesh.node, joint);
  });
}

std::optional<Vec3> extremity(const Model& model, const Character& character,
                              const std::vector<Mat4>& globals, int joint) {
  const Vec3 from = origin(globals, joint);
  Vec3 sum(0.0);
  int count = 0;
  for (const int child : model.skeleton.children[static_cast<std::size_t>(joint)]) {
    const Joint& node = model.skeleton.joints[static_cast<std::size_t>(child)];
    const BoneName name = read_bone_name(node.name);
    // A thumb stands off, a prop's socket says nothing about the hand.
    if (name.helper || name.thumb) continue;
    const bool carries_mesh = std::any_of(model.meshes.begin(), model.meshes.end(),
                                          [&](const Mesh& mesh) { return mesh.node == child; });
    if (carries_mesh && !is_skin_joint(character, child)) continue;
    const Vec3 to = origin(globals, child) - from;
    if (!direction(to)) continue;
    sum += to;
    ++count;
  }
  if (count == 0) {
    add_vertices(model, character, globals, joint, sum, count);
    sum -= from * static_cast<double>(count);
  }
  if (count == 0) return std::nullopt;
  sum /= static_cast<double>(count);
  if (!direction(sum)) return std::nullopt;
  return sum;
}

}  // namespace elbowroom
