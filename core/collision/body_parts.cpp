// SPDX-License-Identifier: MIT
#include "core/collision/body_parts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace elbowroom {

std::vector<int> joints_of_triangles(const Mesh& mesh) {
  std::vector<int> joints(mesh.triangles.size(), mesh.node);
  if (mesh.skin < 0) return joints;
  std::vector<std::pair<int, double>> sums;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    sums.clear();
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(mesh.triangles[i][k]);
      for (std::uint32_t n = mesh.influence_begin[v]; n < mesh.influence_begin[v + 1]; ++n) {
        const Influence& influence = mesh.influences[n];
        const auto known = std::find_if(sums.begin(), sums.end(), [&](const auto& sum) {
          return sum.first == influence.joint;
        });
        if (known == sums.end())
          sums.emplace_back(influence.joint, influence.weight);
        else
          known->second += influence.weight;
      }
    }
    double most = 0;
    for (const auto& [joint, sum] : sums) {
      if (sum > most || (sum == most && joint < joints[i])) {
        most = sum;
        joints[i] = joint;
      }
    }
  }
  return joints;
}

namespace {

// Of one of the limb's own joints.
int segment_of(const Limb& limb, int joint) {
  int segment = kUpperSegment;
  for (const int at : limb.joints) {
    if (at == limb.middle) segment = kLowerSegment;
    if (at == limb.end) segment = kEndSegment;
    if (at == joint) break;
  }
  return segment;
}

// Or else of a limb that hangs from it, whose side it is on.
bool is_own(const Limb& limb, int joint) {
  return std::find(limb.joints.begin(), limb.joints.end(), joint) != limb.joints.end();
}

}  // namespace

std::vector<LimbSide> limb_sides(const Skeleton& skeleton, const std::vector<Limb>& limbs) {
  std::vector<LimbSide> sides(static_cast<std::size_t>(skeleton.size()));
  for (const int joint : skeleton.order) {
    const auto at = static_cast<std::size_t>(joint);
    const int parent = skeleton.joints[at].parent;
    if (parent >= 0) sides[at] = sides[static_cast<std::size_t>(parent)];
    for (std::size_t l = 0; l < limbs.size(); ++l) {
      if (limbs[l].root == joint) sides[at] = {static_cast<int>(l), kUpperSegment};
      for (const FollowingJoint& own : limbs[l].following)
        if (own.joint == joint && is_own(limbs[l], own.serves))
          sides[at] = {static_cast<int>(l), segment_of(limbs[l], own.serves)};
    }
    if (sides[at].limb < 0) continue;
    const Limb& limb = limbs[static_cast<std::size_t>(sides[at].limb)];
    if (joint == limb.middle) sides[at].segment = kLowerSegment;
    if (joint == limb.end) sides[at].segment = kEndSegment;
  }
  return sides;
}

int enclosing_limb(const Skeleton& skeleton, const std::vector<Limb>& limbs, int limb) {
  const int root = limbs[static_cast<std::size_t>(limb)].root;
  int joint = root < 0 ? -1 : skeleton.joints[static_cast<std::size_t>(root)].parent;
  for (; joint >= 0; joint = skeleton.joints[static_cast<std::size_t>(joint)].parent)
    for (std::size_t l = 0; l < limbs.size(); ++l)
      if (static_cast<int>(l) != limb && (limbs[l].root == joint || limbs[l].follows(joint)))
        return static_cast<int>(l);
  return -1;
}

std::string joint_part_name(const std::string& owner, const Skeleton& skeleton, int joint) {
  std::string name = "unknown joint";
  if (joint >= 0 && joint < skeleton.size()) {
    name = skeleton.joints[static_cast<std::size_t>(joint)].name;
    if (name.empty()) name = "joint " + std::to_string(joint);
  }
  return (owner.empty() ? "character" : owner) + "/" + name;
}

std::string mesh_part_name(const std::string& owner, const Model& model, int mesh) {
  const Mesh& m = model.meshes[static_cast<std::size_t>(mesh)];
  std::string name = m.name;
  if (name.empty() && m.node >= 0 && m.node < model.skeleton.size())
    name = model.skeleton.joints[static_cast<std::size_t>(m.node)].name;
  if (name.empty()) name = "mesh " + std::to_string(mesh);
  return (owner.empty() ? "object" : owner) + "/" + name;
}

}  // namespace elbowroom
