// SPDX-License-Identifier: MIT
// Morphing and linear blend skinning (glTF 2.0, 3.7.2.2 and 3.7.3.3).
#include <algorithm>
#include <cstddef>

#include "core/animation/affine.h"
#include "core/scene/model.h"

namespace elbowroom {
namespace {

// Positions with the morph targets added, in the mesh's space.
void morph(const Mesh& mesh, const Pose& pose, std::vector<Vec3>& out) {
  out.assign(mesh.positions.begin(), mesh.positions.end());
  if (mesh.morphs.empty()) return;
  const auto node = static_cast<std::size_t>(mesh.node);
  const bool posed = node < pose.morph_weights.size() && !pose.morph_weights[node].empty();
  const std::vector<double>& weights = posed ? pose.morph_weights[node] : mesh.morph_weights;
  const std::size_t targets = std::min(weights.size(), mesh.morphs.size());
  for (std::size_t target = 0; target < targets; ++target) {
    const double weight = weights[target];
    const std::vector<glm::vec3>& offsets = mesh.morphs[target].offsets;
    if (weight == 0 || offsets.size() != out.size()) continue;
    for (std::size_t v = 0; v < out.size(); ++v) out[v] += weight * Vec3(offsets[v]);
  }
}

}  // namespace

void deform(const Model& model, const Mesh& mesh, const Pose& pose,
            const std::vector<Mat4>& world_from_joint, std::vector<Vec3>& out) {
  morph(mesh, pose, out);
  if (mesh.skin < 0) {
    const Mat4& world_from_mesh = world_from_joint[static_cast<std::size_t>(mesh.node)];
    for (Vec3& p : out) p = transform_point(world_from_mesh, p);
    return;
  }

  const Skin& skin = model.skins[static_cast<std::size_t>(mesh.skin)];
  std::vector<Mat4> world_from_bind(skin.joints.size());
  for (std::size_t slot = 0; slot < skin.joints.size(); ++slot) {
    world_from_bind[slot] = multiply_affine(
        world_from_joint[static_cast<std::size_t>(skin.joints[slot])], skin.inverse_bind[slot]);
  }
  for (std::size_t v = 0; v < out.size(); ++v) {
    const Vec3 p = out[v];
    Vec3 sum(0.0);
    double total = 0;
    for (std::uint32_t i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i) {
      const Influence& influence = mesh.influences[i];
      const double weight = influence.weight;
      total += weight;
      sum += weight * transform_point(world_from_bind[static_cast<std::size_t>(influence.slot)], p);
    }
    // float32 weights sum to 1 only to 1e-7, which far from the origin would move a vertex by more
    // than the contact tolerance.
    out[v] = sum / total;
  }
}

}  // namespace elbowroom
