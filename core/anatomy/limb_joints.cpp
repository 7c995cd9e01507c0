// SPDX-License-Identifier: MIT
#include "core/anatomy/limb_joints.h"

#include <algorithm>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_names.h"

namespace elbowroom {
namespace {

constexpr double kAtRoot = 0.1;      // of the upper bone
constexpr double kSamePlace = 0.01;  // of the limb's length

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

// Not only by joints below it. In a file without a figure any joint of a skin does.
bool moves_skin_itself(const BoundFigure& figure, int joint) {
  if (!figure.shown) return true;
  double own = figure.skin[static_cast<std::size_t>(joint)];
  const double all = own;
  for (const int child : figure.children(joint))
    own -= figure.skin[static_cast<std::size_t>(child)];
  return own > 1e-9 * all;
}

std::string listed(const Model& model, const std::vector<int>& joints) {
  std::string text;
  for (const int joint : joints) text += (text.empty() ? "" : ", ") + quoted_joint(model, joint);
  return text;
}

}  // namespace

void complete_limb(const BoundFigure& figure, Limb& limb) {
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
  if (!moved.empty()) limb.why += "; turned by its clips at " + listed(model, moved);
}

std::vector<int> left_behind(const BoundFigure& figure, const Limb& limb) {
  const Skeleton& skeleton = figure.model.skeleton;
  const int above = figure.parent(limb.root);
  const Vec3 root = figure.place(limb.root), middle = figure.place(limb.middle);
  const Vec3 end = figure.place(limb.end), bone = middle - root;
  const double length = glm::length(bone), near = kSamePlace * (length + glm::length(end - middle));
  std::vector<int> behind;
  constexpr std::size_t kMost = 200;  // more is no garment
  for (const int joint : skeleton.order) {
    if (behind.size() >= kMost) break;
    if (!is_skin_joint(figure.character, joint) || !moves_skin_itself(figure, joint) ||
        skeleton.is_within(joint, limb.root) || skeleton.is_within(limb.root, joint))
      continue;
    const Vec3 place = figure.place(joint);
    bool belongs = glm::distance(place, middle) <= near || glm::distance(place, end) <= near;
    if (!belongs && figure.parent(joint) == above &&
        lies_along(figure, joint, limb.root, limb.middle)) {
      // At the root itself much may stand that rightly stays; a twist joint says what it is.
      const BoneName name = read_bone_name(skeleton.joints[static_cast<std::size_t>(joint)].name);
      const bool of_limb = name.part != BonePart::none && name.part != BonePart::clavicle &&
                           name.part != BonePart::shoulder && name.part != BonePart::hip;
      belongs =
          glm::dot(place - root, bone) >= kAtRoot * length * length || (name.helper && of_limb);
    }
    const bool covered = std::any_of(behind.begin(), behind.end(),
                                     [&](int other) { return skeleton.is_within(joint, other); });
    if (belongs && !covered) behind.push_back(joint);
  }
  return behind;
}

std::string quoted_joint(const Model& model, int joint) {
  const std::string& text = model.skeleton.joints[static_cast<std::size_t>(joint)].name;
  return text.empty() ? "node " + std::to_string(joint) : "'" + text + "'";
}

}  // namespace elbowroom
