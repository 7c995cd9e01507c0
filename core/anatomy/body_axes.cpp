// SPDX-License-Identifier: MIT
#include "core/anatomy/body_axes.h"

#include <algorithm>
#include <array>

#include "core/anatomy/bind_geometry.h"
#include "core/scene/grouping.h"

namespace elbowroom {
namespace {

constexpr double kUpright = 0.7;  // cosine: of 45°

// Rigs are bound standing straight in the axes they were modelled in; a slouch of the spine or a
// foot put forward is no lean of the body. So an axis found this near to one of those is taken to
// be that one. They turn with the figure, whatever turns it; the file's own count too, since some
// figures were modelled in axes of no meaning.
constexpr double kSnap = 25.0 * kPi / 180.0;
constexpr double kSame = 1e-5;  // radians: the file's axis, but for rounding
// How clearly knees, elbows and feet tell where the body looks: shares of a limb's length by which
// the joint stands out, and of the shin's by which the foot does.
constexpr double kLeastBend = 0.01, kClearBend = 0.08, kClearFoot = 0.06, kFootReach = 0.4;
constexpr double kAgree = 1.0 * kPi / 180.0;  // shoulders and hips, on what is left

Vec3 snapped(const BoundFigure& figure, const Vec3& v, double within) {
  Vec3 best = v;
  double most = std::cos(within);
  for (const Vec3& own : figure.axes) {
    Vec3 axis = own;
    for (int i = 0; i < 3; ++i) {
      Vec3 of_file(0.0);
      of_file[i] = own[i] < 0 ? -1.0 : 1.0;
      if (glm::distance(of_file, own) < kSame) axis = of_file;
    }
    const double along = glm::dot(axis, v);
    if (std::abs(along) < most) continue;
    most = std::abs(along);
    best = along < 0 ? -axis : axis;
  }
  for (int i = 0; i < 3; ++i) {
    Vec3 axis(0.0);
    axis[i] = v[i] < 0 ? -1.0 : 1.0;
    if (glm::dot(axis, v) < most) continue;
    most = glm::dot(axis, v);
    best = axis;
  }
  return best;
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

Vec3 find_up(const BoundFigure& figure, const std::array<const Limb*, 4>& limbs) {
  const std::vector<Mat4>& globals = figure.globals;
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
  return snapped(figure, *up, kSnap);
}

// Middle of the skin about a place, relative to it: a foot that hangs from elsewhere.
std::optional<Vec3> skin_about(const BoundFigure& figure, const Vec3& place, double reach) {
  const Pose pose = rest_pose(figure.model.skeleton);
  std::vector<Vec3> positions;
  Vec3 sum(0.0);
  int count = 0;
  for (const int index : figure.character.meshes) {
    deform(figure.model, figure.model.meshes[static_cast<std::size_t>(index)], pose, figure.globals,
           positions);
    for (const Vec3& position : positions) {
      if (!(glm::distance(position, place) < reach)) continue;
      sum += position - place;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace

double looks_along(const BoundFigure& figure, const std::vector<Limb>& limbs, const Vec3& up,
                   const Vec3& forward) {
  const std::vector<Mat4>& globals = figure.globals;
  double sum = 0;
  for (const Limb& limb : limbs) {
    const Vec3 root = origin(globals, limb.root);
    const Vec3 bend = origin(globals, limb.middle) - root;
    const Vec3 whole = origin(globals, limb.end) - root;
    const auto line = direction(whole);
    if (line) {
      const Vec3 out = bend - *line * glm::dot(bend, *line);
      const double share = glm::dot(out, forward) / std::max(glm::length(whole), 1e-12);
      const double weight = 0.5 * std::min(1.0, std::abs(share) / kClearBend);
      // Knees stand out to the front, elbows to the back.
      if (std::abs(share) > kLeastBend) sum += (share > 0) == limb.is_arm() ? -weight : weight;
    }
    if (limb.is_arm()) continue;
    const double shin = glm::length(whole - bend);
    auto foot = extremity(figure, limb.end, false);
    if (!foot) foot = skin_about(figure, origin(globals, limb.end), kFootReach * shin);
    if (!foot) continue;
    const Vec3 level = *foot - up * glm::dot(*foot, up);
    const double length = glm::length(level);
    if (!(length > 0)) continue;
    sum += glm::dot(level, forward) / length * std::min(1.0, length / (kClearFoot * shin));
  }
  return sum;
}

BodyFindings find_body_axes(const BoundFigure& figure, const std::vector<Limb>& limbs) {
  const std::vector<Mat4>& globals = figure.globals;
  const std::array<const Limb*, 4> four = {
      limb_of(limbs, LimbKind::left_arm), limb_of(limbs, LimbKind::right_arm),
      limb_of(limbs, LimbKind::left_leg), limb_of(limbs, LimbKind::right_leg)};
  BodyFindings found;
  BodyAxes& axes = found.axes;
  axes.up = find_up(figure, four);

  Vec3 across(0.0);
  std::vector<Vec3> lines;
  for (const std::size_t pair : {std::size_t{0}, std::size_t{2}}) {
    if (four[pair] == nullptr || four[pair + 1] == nullptr) continue;
    const auto line =
        direction(origin(globals, four[pair]->root) - origin(globals, four[pair + 1]->root));
    if (!line) continue;
    across += *line;
    lines.push_back(*line);
  }
  std::optional<Vec3> left = direction_across(across, axes.up);
  found.paired = left.has_value();
  if (!left) {
    // No pair to tell: glTF characters face +z.
    left = direction_across(Vec3(1, 0, 0), axes.up);
    if (!left) left = direction_across(Vec3(0, 0, -1), axes.up);
  }
  axes.left = *left;
  // A pair that stands aslant is a figure bound in a stride.
  const bool agree = lines.size() == 2 && glm::dot(lines[0], lines[1]) > std::cos(kAgree);
  if (!agree) {
    const auto level = direction_across(snapped(figure, *left, 0.4 * kSnap), axes.up);
    if (level) axes.left = *level;
  }
  axes.forward = glm::normalize(glm::cross(axes.left, axes.up));

  // Under a mirror what was named the left is the body's right.
  const bool mirrored =
      found.paired && glm::dot(glm::cross(figure.axes[0], figure.axes[1]), figure.axes[2]) < 0 &&
      std::any_of(limbs.begin(), limbs.end(), [](const Limb& limb) { return limb.named_side; });
  if (mirrored) {
    found.mirrored_names = true;
    axes.left = -axes.left;
    axes.forward = -axes.forward;
  }
  const double along = looks_along(figure, limbs, axes.up, axes.forward);
  if (along <= -1.0) {
    // Feet and knees contradict the names (or the assumption).
    found.mirrored_names = found.paired && !mirrored;
    axes.left = -axes.left;
    axes.forward = -axes.forward;
  }
  return found;
}

BodyAxes body_axes(const Model& model, const Character& character, const LimbFindings& findings) {
  return find_body_axes(bound_figure(model, character), findings.limbs).axes;
}

double body_height(const Model& model, const Character& character, const LimbFindings& findings) {
  if (findings.limbs.empty()) return character.height;
  const Vec3 up = body_axes(model, character, findings).up;
  return up.y > kUpright ? character.height : bind_extent(model, character, up);
}

}  // namespace elbowroom
