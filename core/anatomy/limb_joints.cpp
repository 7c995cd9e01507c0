// SPDX-License-Identifier: MIT
#include "core/anatomy/limb_joints.h"

#include <algorithm>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_names.h"

namespace elbowroom {
namespace {

constexpr double kAtRoot = 0.1;  // of the upper bone

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
  std::vector<int> behind;
  const int above = figure.parent(limb.root);
  if (above < 0) return behind;
  const Vec3 root = figure.place(limb.root), bone = figure.place(limb.middle) - root;
  const double length = glm::length(bone);
  for (const int other : figure.children(above)) {
    if (other == limb.root || !is_skin_joint(figure.character, other) || !figure.carries(other) ||
        !lies_along(figure, other, limb.root, limb.middle))
      continue;
    // At the root itself much may stand that rightly stays; a twist joint says what it is.
    const bool at_root = glm::dot(figure.place(other) - root, bone) < kAtRoot * length * length;
    const BoneName name =
        read_bone_name(figure.model.skeleton.joints[static_cast<std::size_t>(other)].name);
    const bool of_limb = name.part != BonePart::none && name.part != BonePart::clavicle &&
                         name.part != BonePart::shoulder && name.part != BonePart::hip;
    if (!at_root || (name.helper && of_limb)) behind.push_back(other);
  }
  return behind;
}

std::string quoted_joint(const Model& model, int joint) {
  const std::string& text = model.skeleton.joints[static_cast<std::size_t>(joint)].name;
  return text.empty() ? "node " + std::to_string(joint) : "'" + text + "'";
}

}  // namespace elbowroom
