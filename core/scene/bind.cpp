// SPDX-License-Identifier: MIT
// The bind pose of a character, from the inverse bind matrices of its skins.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/animation/affine.h"
#include "core/scene/model.h"

namespace elbowroom {
namespace {

constexpr double kSamePlace = 1e-3;   // of the skeleton's extent: bind and rest pose agree
constexpr double kSameScale = 0.03;   // relative, on determinants
constexpr double kMaxTilt = kPi / 3;  // between two placements of one figure

bool is_finite(const Mat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!std::isfinite(m[c][r])) return false;
    }
  }
  return true;
}

// mesh_from_joint at the time of binding, by slot; empty if the matrices tell no pose: singular
// ones, or all alike (a file without any has identities) over joints that are apart.
std::vector<Mat4> bind_matrices(const Skin& skin, const std::vector<Mat4>& rest) {
  std::vector<Mat4> bind;
  bool spread = false;
  bool alike = true;
  for (std::size_t slot = 0; slot < skin.joints.size(); ++slot) {
    const Mat4 inverse = glm::inverse(skin.inverse_bind[slot]);
    if (!is_finite(inverse)) return {};
    bind.push_back(inverse);
    alike = alike && skin.inverse_bind[slot] == skin.inverse_bind[0];
    spread = spread || rest[static_cast<std::size_t>(skin.joints[slot])][3] !=
                           rest[static_cast<std::size_t>(skin.joints[0])][3];
  }
  if (alike && spread) return {};
  return bind;
}

double extent(const Skin& skin, const std::vector<Mat4>& rest) {
  Vec3 low(INFINITY), high(-INFINITY);
  for (const int joint : skin.joints) {
    const Vec3 p(rest[static_cast<std::size_t>(joint)][3]);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return glm::length(high - low);
}

// The joint that has most of the skin's joints at or below it: the hips rather than a control bone
// beside them. The first of equals, parents first.
std::size_t root_slot(const Skeleton& skeleton, const Skin& skin) {
  std::vector<int> below(skeleton.joints.size(), 0);
  for (const int joint : skin.joints) ++below[static_cast<std::size_t>(joint)];
  std::vector<std::size_t> rank(skeleton.joints.size());
  for (std::size_t i = skeleton.order.size(); i-- > 0;) {
    const auto node = static_cast<std::size_t>(skeleton.order[i]);
    rank[node] = i;
    const int parent = skeleton.joints[node].parent;
    if (parent >= 0) below[static_cast<std::size_t>(parent)] += below[node];
  }
  std::size_t root = 0;
  for (std::size_t slot = 1; slot < skin.joints.size(); ++slot) {
    const auto joint = static_cast<std::size_t>(skin.joints[slot]);
    const auto best = static_cast<std::size_t>(skin.joints[root]);
    if (below[joint] > below[best] || (below[joint] == below[best] && rank[joint] < rank[best])) {
      root = slot;
    }
  }
  return root;
}

// world_from_bind of a character's first skin. Where the rest pose is the bind pose every joint
// gives the same one. Where it is a frame of some clip, the root joint's would lay the T-pose down
// with a figure that lies; most exporters bind in the space of the skinned mesh's node, so that
// node is preferred as long as it could be the same placement at all (players ignore it, so some
// files have nonsense there).
Mat4 place_first_skin(const Model& model, int skin_index, const std::vector<Mat4>& bind,
                      const std::vector<Mat4>& rest) {
  const Skin& skin = model.skins[static_cast<std::size_t>(skin_index)];
  const std::size_t root = root_slot(model.skeleton, skin);
  const Mat4 by_root =
      multiply_affine(rest[static_cast<std::size_t>(skin.joints[root])], skin.inverse_bind[root]);
  const double tolerance = kSamePlace * extent(skin, rest);
  bool agree = true;
  for (std::size_t slot = 0; slot < skin.joints.size(); ++slot) {
    const Vec3 bound = transform_point(by_root, Vec3(bind[slot][3]));
    const Vec3 rested(rest[static_cast<std::size_t>(skin.joints[slot])][3]);
    agree = agree && glm::distance(bound, rested) <= tolerance;
  }
  if (agree) return by_root;

  for (const Mesh& mesh : model.meshes) {
    if (mesh.skin != skin_index) continue;
    const Mat4& by_mesh = rest[static_cast<std::size_t>(mesh.node)];
    const double ratio = glm::determinant(Mat3(by_mesh)) / glm::determinant(Mat3(by_root));
    if (!(std::abs(ratio - 1.0) <= 3 * kSameScale)) break;
    const Quat turn = rotation_of(by_mesh) * glm::conjugate(rotation_of(by_root));
    const double up = (turn * Vec3(0, 1, 0)).y;
    if (up >= std::cos(kMaxTilt)) return by_mesh;
    break;
  }
  return by_root;
}

}  // namespace

std::vector<Mat4> bind_globals(const Model& model, const Character& character) {
  const Skeleton& skeleton = model.skeleton;
  std::vector<Mat4> rest;
  compute_globals(skeleton, rest_pose(skeleton), Mat4(1.0), rest);
  std::vector<Mat4> world(rest.size());
  std::vector<bool> placed(rest.size(), false);

  // A joint's place where only its ancestors are known.
  const auto follow = [&](int joint) {
    Mat4 local(1.0);
    while (joint >= 0 && !placed[static_cast<std::size_t>(joint)]) {
      const Joint& node = skeleton.joints[static_cast<std::size_t>(joint)];
      local = multiply_affine(node.rest_matrix ? *node.rest_matrix : node.rest.matrix(), local);
      joint = node.parent;
    }
    return joint < 0 ? local : multiply_affine(world[static_cast<std::size_t>(joint)], local);
  };

  // The skin of most joints knows the figure best.
  std::vector<int> skins = character.skins;
  std::stable_sort(skins.begin(), skins.end(), [&](int a, int b) {
    return model.skins[static_cast<std::size_t>(a)].joints.size() >
           model.skins[static_cast<std::size_t>(b)].joints.size();
  });
  bool first = true;
  for (const int index : skins) {
    const Skin& skin = model.skins[static_cast<std::size_t>(index)];
    const std::vector<Mat4> bind = bind_matrices(skin, rest);
    if (bind.empty()) continue;
    Mat4 world_from_bind;
    if (first) {
      world_from_bind = place_first_skin(model, index, bind, rest);
    } else {
      // Each skin was bound in its own mesh's space; a joint both share tells how the spaces lie.
      std::size_t shared = 0;
      while (shared < skin.joints.size() &&
             !placed[static_cast<std::size_t>(skin.joints[shared])]) {
        ++shared;
      }
      if (shared == skin.joints.size()) shared = root_slot(skeleton, skin);
      world_from_bind = multiply_affine(follow(skin.joints[shared]), skin.inverse_bind[shared]);
    }
    for (std::size_t slot = 0; slot < skin.joints.size(); ++slot) {
      const auto joint = static_cast<std::size_t>(skin.joints[slot]);
      if (placed[joint]) continue;
      world[joint] = multiply_affine(world_from_bind, bind[slot]);
      placed[joint] = true;
    }
    first = false;
  }
  for (const int joint : skeleton.order) {
    if (placed[static_cast<std::size_t>(joint)]) continue;
    world[static_cast<std::size_t>(joint)] = follow(joint);
    placed[static_cast<std::size_t>(joint)] = true;
  }
  return world;
}

}  // namespace elbowroom
