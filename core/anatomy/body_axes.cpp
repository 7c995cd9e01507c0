// SPDX-License-Identifier: MIT
#include "core/anatomy/body_axes.h"

#include <array>

#include "core/anatomy/bind_geometry.h"

namespace elbowroom {
namespace {

// Rigs are bound standing straight in their file's axes; a slouch of the spine or a foot put
// forward is no lean of the body. So an axis found this near to one of the file's is taken to be
// that one.
constexpr double kSnap = 25.0 * kPi / 180.0;

Vec3 snapped(const Vec3& v, double within) {
  for (int i = 0; i < 3; ++i) {
    Vec3 axis(0.0);
    axis[i] = v[i] < 0 ? -1.0 : 1.0;
    if (glm::dot(axis, v) >= std::cos(within)) return axis;
  }
  return v;
}

const Limb* limb_of(const std::vector<Limb>& limbs, LimbKind kind) {
  for (const Limb& limb : limbs) {
    if (limb.kind == kind) return &limb;
  }
  return nullptr;
}

std::optional<Vec3> middle(const std::vector<Mat4>& globals, const Limb* left, const Limb* right,
                           int Limb::*joint) {
  if (left != nullptr && right != nullptr) {
    return 0.5 * (origin(globals, left->*joint) + origin(globals, right->*joint));
  }
  if (left != nullptr) return origin(globals, left->*joint);
  if (right != nullptr) return origin(globals, right->*joint);
  return std::nullopt;
}

Vec3 find_up(const std::vector<Mat4>& globals, const std::array<const Limb*, 4>& limbs) {
  const auto [left_arm, right_arm, left_leg, right_leg] = limbs;
  const auto hips = middle(globals, left_leg, right_leg, &Limb::root);
  const auto ankles = middle(globals, left_leg, right_leg, &Limb::end);
  const auto shoulders = middle(globals, left_arm, right_arm, &Limb::root);
  // Legs hang from the hips; the trunk rises from them. A four-footed one's trunk lies, so of the
  // two the more upright is believed.
  const Vec3 file_up(0, 1, 0);
  std::optional<Vec3> legs, trunk;
  if (hips && ankles) legs = direction(*hips - *ankles);
  if (hips && shoulders) trunk = direction(*shoulders - *hips);
  std::optional<Vec3> up = trunk ? trunk : legs;
  if (legs && trunk && glm::dot(*legs, file_up) > glm::dot(*trunk, file_up)) up = legs;
  if (!up || !finite(*up)) return file_up;
  return snapped(*up, kSnap);
}

// How clearly feet, knees and elbows say that the body looks along `forward`: about +1 for each
// foot, ±0.5 for each bent knee or elbow.
double looks_along(const Model& model, const Character& character, const std::vector<Mat4>& globals,
                   const std::vector<Limb>& limbs, const Vec3& up, const Vec3& forward) {
  double sum = 0;
  for (const Limb& limb : limbs) {
    const Vec3 root = origin(globals, limb.root);
    const Vec3 bend = origin(globals, limb.middle) - root;
    const Vec3 whole = origin(globals, limb.end) - root;
    const auto line = direction(whole);
    if (line) {
      const Vec3 out = bend - *line * glm::dot(bend, *line);
      const double share = glm::dot(out, forward) / std::max(glm::length(whole), 1e-12);
      // Knees stand out to the front, elbows to the back.
      if (std::abs(share) > 0.02) sum += (share > 0) == limb.is_arm() ? -0.5 : 0.5;
    }
    if (limb.is_arm()) continue;
    const auto foot = extremity(model, character, globals, limb.end);
    if (!foot) continue;
    const auto level = direction_across(*foot, up);
    if (level) sum += glm::dot(*level, forward);
  }
  return sum;
}

}  // namespace

BodyFindings find_body_axes(const Model& model, const Character& character,
                            const std::vector<Mat4>& globals, const std::vector<Limb>& limbs) {
  const std::array<const Limb*, 4> four = {
      limb_of(limbs, LimbKind::left_arm), limb_of(limbs, LimbKind::right_arm),
      limb_of(limbs, LimbKind::left_leg), limb_of(limbs, LimbKind::right_leg)};
  BodyFindings found;
  BodyAxes& axes = found.axes;
  axes.up = find_up(globals, four);

  Vec3 across(0.0);
  for (const std::size_t pair : {std::size_t{0}, std::size_t{2}}) {
    if (four[pair] == nullptr || four[pair + 1] == nullptr) continue;
    const auto line =
        direction(origin(globals, four[pair]->root) - origin(globals, four[pair + 1]->root));
    if (line) across += *line;
  }
  std::optional<Vec3> left = direction_across(across, axes.up);
  found.paired = left.has_value();
  if (!left) {
    // No pair to tell: glTF characters face +z.
    left = direction_across(Vec3(1, 0, 0), axes.up);
    if (!left) left = direction_across(Vec3(0, 0, -1), axes.up);
  }
  const auto level = direction_across(snapped(*left, 0.4 * kSnap), axes.up);
  axes.left = level ? *level : *left;
  axes.forward = glm::normalize(glm::cross(axes.left, axes.up));

  const double along = looks_along(model, character, globals, limbs, axes.up, axes.forward);
  if (along <= -1.0) {
    // Feet and knees contradict the names (or the assumption).
    found.mirrored_names = found.paired;
    axes.left = -axes.left;
    axes.forward = -axes.forward;
  }
  return found;
}

BodyAxes body_axes(const Model& model, const Character& character, const LimbFindings& findings) {
  return find_body_axes(model, character, bind_globals(model, character), findings.limbs).axes;
}

}  // namespace elbowroom
