// SPDX-License-Identifier: MIT
#include "core/anatomy/limb_joints.h"

#include <algorithm>
#include <cmath>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_names.h"

namespace elbowroom {
namespace {

constexpr double kAtRoot = 0.1;      // of the upper bone
constexpr double kSamePlace = 0.01;  // of the limb's length
constexpr double kNearEnd = 0.4;     // of the limb's length: what its names say is hand or foot
constexpr double kUneven = 1e-3;  // share by which scales may differ where a joint is to be keyed

bool turned_by_a_clip(const Model& model, int joint) {
  return std::any_of(model.clips.begin(), model.clips.end(), [&](const Clip& clip) {
    return clip.find_channel(joint, Path::rotation) >= 0;
  });
}

// The node at or above a joint, in its place, that clips turn in its stead.
int pivot_of(const BoundFigure& figure, int joint, int above) {
  constexpr int kMostPivots = 12;
  const double near = 1e-6 * figure.character.height;
  if (figure.model.clips.empty() || turned_by_a_clip(figure.model, joint)) return joint;
  int pivot = figure.parent(joint);
  for (int i = 0; i < kMostPivots && pivot >= 0 && pivot != above; ++i) {
    if (figure.children(pivot).size() != 1 ||
        !(glm::distance(figure.place(pivot), figure.place(joint)) <= near))
      break;
    if (turned_by_a_clip(figure.model, pivot)) return pivot;
    pivot = figure.parent(pivot);
  }
  return joint;
}

// Skin or rigid meshes, and not only by joints below it. In a file without a figure any joint of a
// skin does.
bool moves_figure_itself(const BoundFigure& figure, int joint) {
  if (!figure.shown) return true;
  double skin = figure.skin[static_cast<std::size_t>(joint)];
  double rigid = figure.rigid[static_cast<std::size_t>(joint)];
  const double all = skin;
  for (const int child : figure.children(joint)) {
    skin -= figure.skin[static_cast<std::size_t>(child)];
    if (is_skin_joint(figure.character, child))
      rigid -= figure.rigid[static_cast<std::size_t>(child)];
  }
  return skin > 1e-9 * all || rigid > 0.5;
}

// Whether a matrix keeps angles (a mirror may).
bool keeps_angles(const Mat3& m) {
  double least = glm::length(m[0]), most = least;
  for (int c = 1; c < 3; ++c) {
    least = std::min(least, glm::length(m[c]));
    most = std::max(most, glm::length(m[c]));
  }
  bool even = least > 0 && std::isfinite(most) && most - least <= kUneven * most;
  for (int c = 0; c < 3; ++c)
    even = even && std::abs(glm::dot(m[c], m[(c + 1) % 3])) <= kUneven * most * most;
  return even;
}

// What keeps a joint from being keyed as a rotation and translation that follow a limb; empty if
// nothing does. Uneven scales above both of them do not: seen from there both are even.
std::string obstacle_to_keys(const BoundFigure& figure, int joint, int root) {
  const Skeleton& skeleton = figure.model.skeleton;
  if (skeleton.joints[static_cast<std::size_t>(joint)].rest_matrix)
    return "it is placed by a matrix";
  const int own = figure.parent(joint), limbs = figure.parent(root);
  int common = own;
  while (common >= 0 && !skeleton.is_within(limbs, common)) common = figure.parent(common);
  const auto seen = [&](int node) {
    const auto global = [&](int at) {
      return at < 0 ? Mat3(1.0) : Mat3(figure.globals[static_cast<std::size_t>(at)]);
    };
    return glm::inverse(global(common)) * global(node);
  };
  if (!keeps_angles(seen(own))) return "what it hangs from is scaled unevenly";
  if (!keeps_angles(seen(limbs))) return "what the limb hangs from is scaled unevenly";
  return {};
}

std::string listed(const Model& model, const std::vector<int>& joints) {
  std::string text;
  for (const int joint : joints) text += (text.empty() ? "" : ", ") + quoted_joint(model, joint);
  return text;
}

}  // namespace

void complete_limb(const BoundFigure& figure, Limb& limb, const std::vector<int>& ends) {
  const Model& model = figure.model;
  std::vector<int> moved;
  for (const auto& [which, above] :
       {std::pair(&Limb::end, &Limb::middle), std::pair(&Limb::middle, &Limb::root),
        std::pair(&Limb::root, &Limb::root)}) {
    const int pivot = pivot_of(figure, limb.*which, which == above ? -1 : limb.*above);
    if (pivot != limb.*which) moved.push_back(pivot);
    limb.*which = pivot;
  }
  limb.joints.clear();
  limb.beside.clear();
  std::vector<int> between;
  for (int j = limb.end; j >= 0; j = figure.parent(j)) {
    limb.joints.push_back(j);
    if (j == limb.root) break;
    if (j != limb.middle && j != limb.end) between.push_back(j);
  }
  std::reverse(limb.joints.begin(), limb.joints.end());
  std::reverse(between.begin(), between.end());
  for (const auto& [from, to] :
       {std::pair(limb.root, limb.middle), std::pair(limb.middle, limb.end)}) {
    for (const int child : figure.children(from)) {
      if (std::find(limb.joints.begin(), limb.joints.end(), child) == limb.joints.end() &&
          figure.carries(child) && lies_along(figure, child, from, to)) {
        limb.beside.push_back(child);
      }
    }
  }
  if (!between.empty()) limb.why += "; driven between them: " + listed(model, between);
  if (!limb.beside.empty()) limb.why += "; driven beside them: " + listed(model, limb.beside);
  limb.following.clear();
  std::string following;
  for (const DetachedJoint& joint : detached_joints(figure, limb, ends)) {
    if (!joint.obstacle.empty()) continue;
    limb.following.push_back({joint.joint, joint.serves});
    const int parent = figure.parent(joint.joint);
    following += (following.empty() ? "" : ", ") + quoted_joint(model, joint.joint) +
                 (parent < 0 ? ", which hangs free,"
                             : ", which hangs from " + quoted_joint(model, parent) + ",") +
                 " with " + quoted_joint(model, joint.serves);
  }
  if (!following.empty()) limb.why += "; driven too: " + following;
  if (!moved.empty()) limb.why += "; turned by its clips at " + listed(model, moved);
}

std::vector<DetachedJoint> detached_joints(const BoundFigure& figure, const Limb& limb,
                                           const std::vector<int>& ends) {
  const Skeleton& skeleton = figure.model.skeleton;
  const int above = figure.parent(limb.root);
  const Vec3 root = figure.place(limb.root), middle = figure.place(limb.middle);
  const Vec3 end = figure.place(limb.end), bone = middle - root;
  const double length = glm::length(bone), whole = length + glm::length(end - middle);
  const double near = kSamePlace * whole;
  const auto is_apart = [&](int joint) {
    return is_skin_joint(figure.character, joint) && !skeleton.is_within(joint, limb.root) &&
           !skeleton.is_within(limb.root, joint);
  };
  const auto at = [&](int joint, const Vec3& place) {
    return glm::distance(figure.place(joint), place) <= near;
  };

  std::vector<DetachedJoint> detached;
  constexpr std::size_t kMost = 200;  // more is no garment
  for (const int joint : skeleton.order) {
    if (detached.size() >= kMost) break;
    if (!is_apart(joint)) continue;
    const bool named = std::find(ends.begin(), ends.end(), joint) != ends.end() &&
                       figure.carries(joint) &&
                       glm::distance(figure.place(joint), end) <= kNearEnd * whole;
    if (!named && !moves_figure_itself(figure, joint)) continue;
    int serves = -1;
    if (at(joint, middle)) serves = limb.middle;
    if (serves < 0 && (named || at(joint, end))) serves = limb.end;
    if (serves < 0 && figure.parent(joint) == above &&
        lies_along(figure, joint, limb.root, limb.middle)) {
      // At the root itself much may stand that rightly stays; a twist joint says what it is.
      const BoneName name = read_bone_name(skeleton.joints[static_cast<std::size_t>(joint)].name);
      const bool of_limb = name.part != BonePart::none && name.part != BonePart::clavicle &&
                           name.part != BonePart::shoulder && name.part != BonePart::hip;
      if (glm::dot(figure.place(joint) - root, bone) >= kAtRoot * length * length ||
          (name.helper && of_limb))
        serves = limb.root;
    }
    if (serves < 0) continue;
    // A garment's own upper arm stands at the root above its forearm.
    if (serves == limb.middle) {
      const int parent = figure.parent(joint);
      const bool listed = std::any_of(detached.begin(), detached.end(),
                                      [&](const auto& other) { return other.joint == parent; });
      if (parent >= 0 && !listed && is_apart(parent) && at(parent, root) &&
          moves_figure_itself(figure, parent))
        detached.push_back({parent, limb.root, obstacle_to_keys(figure, parent, limb.root)});
    }
    // The nearest listed one above it brings it along where it serves the same.
    const DetachedJoint* over = nullptr;
    for (const DetachedJoint& other : detached)
      if (other.joint != joint && skeleton.is_within(joint, other.joint) &&
          (over == nullptr || skeleton.is_within(other.joint, over->joint)))
        over = &other;
    if (over != nullptr && over->serves == serves) continue;
    detached.push_back({joint, serves, obstacle_to_keys(figure, joint, limb.root)});
  }
  return detached;
}

void take_along_below(const BoundFigure& figure, Limb& chain, const std::vector<const Limb*>& all) {
  const Skeleton& skeleton = figure.model.skeleton;
  std::vector<int> along;
  for (const Limb* below : all) {
    if (below->root == chain.root || !skeleton.is_within(below->root, chain.root)) continue;
    for (const FollowingJoint& own : below->following) {
      if (skeleton.is_within(own.joint, chain.root) || skeleton.is_within(chain.root, own.joint) ||
          chain.follows(own.joint) || !obstacle_to_keys(figure, own.joint, chain.root).empty())
        continue;
      chain.following.push_back(own);
      along.push_back(own.joint);
    }
  }
  if (!along.empty())
    chain.why += "; driven too, with limbs that hang from it: " + listed(figure.model, along);
}

std::string quoted_joint(const Model& model, int joint) {
  const std::string& text = model.skeleton.joints[static_cast<std::size_t>(joint)].name;
  return text.empty() ? "node " + std::to_string(joint) : "'" + text + "'";
}

}  // namespace elbowroom
