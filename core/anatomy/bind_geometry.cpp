// SPDX-License-Identifier: MIT
#include "core/anatomy/bind_geometry.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
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

Vec3 widest_way(const std::vector<Vec3>& places) {
  Vec3 mean(0.0);
  for (const Vec3& p : places) mean += p / static_cast<double>(places.size());
  double xx = 0, xz = 0, zz = 0;
  for (const Vec3& p : places) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xz += (p.x - mean.x) * (p.z - mean.z);
    zz += (p.z - mean.z) * (p.z - mean.z);
  }
  const double angle = 0.5 * std::atan2(2 * xz, xx - zz);
  const Vec3 way(std::cos(angle), 0, std::sin(angle));
  return way.x < 0 ? -way : way;
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

}  // namespace elbowroom
