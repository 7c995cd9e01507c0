// SPDX-License-Identifier: MIT
#include "core/anatomy/limb_candidates.h"

#include <algorithm>
#include <cmath>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_joints.h"

namespace elbowroom {
namespace {

// Joints that move skin push out those that move none, then what is no copy (Rigify's ORG bones)
// copies, then names of known words names with others in them, then joints of a skin plain nodes.
int rank_of(const NamedFigure& figure, int joint) {
  const BoneName& name = figure.names[static_cast<std::size_t>(joint)];
  return (figure.figure.carries(joint) ? 8 : 0) + (name.copy ? 0 : 4) +
         (name.unknown.empty() ? 2 : 0) + (is_skin_joint(figure.figure.character, joint) ? 1 : 0);
}

bool is_of_limb(BonePart part) {
  return part == BonePart::clavicle || of_family(kLimbFamilies[0], part) ||
         of_family(kLimbFamilies[1], part);
}

// The two bones that a joint between them would make of a limb, or not.
constexpr double kLeastShare = 0.6;      // of the longer bone
constexpr double kBelowAClavicle = 0.4;  // the same, where the "shoulder" can be no clavicle

// A bare "arm" that has neither an upper arm nor a forearm beside it. Below a "shoulder" it is the
// forearm if it is the one joint between that and the hand, and lies like an elbow ("Shoulder",
// "Arm", "Hand" below a "Clavicle"; "Hip", "Leg", "Foot").
bool is_lower_one(const NamedFigure& figure, const LimbFamily& family,
                  const std::vector<LimbCandidate>& all, const LimbCandidate& plain) {
  int root = -1;
  for (const LimbCandidate& other : all) {
    if (other.part == family.weak && figure.below(plain.joint, other.joint)) root = other.joint;
    if (other.joint != plain.joint && other.part == family.plain &&
        (figure.below(plain.joint, other.joint) || figure.below(other.joint, plain.joint)))
      return false;
  }
  bool several = false;
  const int end = nearest_below(figure, all, family.end, plain.joint, several);
  if (root < 0 || end < 0) return false;
  for (int j = figure.figure.parent(end); j != plain.joint; j = figure.figure.parent(j)) {
    if (!figure.name(j).helper &&
        !lies_along(figure.figure.place(j), figure.figure.place(plain.joint),
                    figure.figure.place(end)))
      return false;
  }
  const double upper = figure.distance(root, plain.joint),
               lower = figure.distance(plain.joint, end);
  bool clavicle = false;
  for (int j = figure.figure.parent(root); j >= 0 && !clavicle; j = figure.figure.parent(j))
    clavicle = figure.name(j).part == BonePart::clavicle;
  const double share = clavicle ? kBelowAClavicle : kLeastShare;
  return std::min(upper, lower) >= share * std::max(upper, lower);
}

}  // namespace

bool of_family(const LimbFamily& family, BonePart part) {
  return part == family.upper || part == family.plain || part == family.fore ||
         part == family.end || part == family.weak;
}

NamedFigure::NamedFigure(const BoundFigure& bound, const std::vector<int>& nodes)
    : figure(bound), model(bound.model), members(nodes) {
  const auto& joints = model.skeleton.joints;
  std::vector<std::string> all;
  for (const int joint : members) all.push_back(joints[static_cast<std::size_t>(joint)].name);
  const std::set<std::string> habit = common_words(all);
  names.resize(joints.size());
  member.assign(joints.size(), 0);
  for (const int joint : members) {
    const auto j = static_cast<std::size_t>(joint);
    names[j] = read_bone_name(joints[j].name, habit);
    member[j] = 1;
  }
}

std::string NamedFigure::quoted(int joint) const { return quoted_joint(model, joint); }

int NamedFigure::descendants(int joint) const {
  return static_cast<int>(
      std::count_if(members.begin(), members.end(), [&](int m) { return below(m, joint); }));
}

std::vector<BoneSide> sides_of(const NamedFigure& figure, std::array<bool, 2>& by_place) {
  std::vector<BoneSide> sides(figure.names.size(), BoneSide::none), of_limb = sides;
  for (const int joint : figure.members) {
    const auto j = static_cast<std::size_t>(joint);
    const int parent = figure.figure.parent(joint);
    if (parent >= 0) of_limb[j] = of_limb[static_cast<std::size_t>(parent)];
    sides[j] = figure.names[j].side;
    if (!is_of_limb(figure.names[j].part)) continue;
    // "LeftArm", "Elbow", "Wrist": the side is said once.
    if (sides[j] == BoneSide::none) sides[j] = of_limb[j];
    of_limb[j] = sides[j];
  }
  for (std::size_t f = 0; f < kLimbFamilies.size(); ++f) {
    const LimbFamily& family = kLimbFamilies[f];
    by_place[f] = std::none_of(figure.members.begin(), figure.members.end(), [&](int joint) {
      const BoneName& name = figure.names[static_cast<std::size_t>(joint)];
      return name.side != BoneSide::none && of_family(family, name.part);
    });
    if (!by_place[f]) continue;
    // For the time being towards +x, since glTF figures face +z.
    std::vector<Vec3> places;
    for (const int joint : figure.members) {
      if (of_family(family, figure.names[static_cast<std::size_t>(joint)].part))
        places.push_back(figure.figure.place(joint));
    }
    const Vec3 left = widest_way(places);
    double middle = 0, low = INFINITY, high = -INFINITY;
    for (const int joint : figure.figure.character.joints) {
      const double along = glm::dot(figure.figure.place(joint), left);
      low = std::min(low, along);
      high = std::max(high, along);
      middle += along;
    }
    middle /= std::max<double>(1.0, static_cast<double>(figure.figure.character.joints.size()));
    for (const int joint : figure.members) {
      const auto j = static_cast<std::size_t>(joint);
      if (!of_family(family, figure.names[j].part)) continue;
      const double along = glm::dot(figure.figure.place(joint), left) - middle;
      if (std::abs(along) < 0.01 * (high - low)) continue;
      sides[j] = along > 0 ? BoneSide::left : BoneSide::right;
    }
  }
  return sides;
}

std::vector<LimbCandidate> candidates_of(const NamedFigure& figure, const LimbFamily& family,
                                         BoneSide side, const std::vector<BoneSide>& sides) {
  std::vector<LimbCandidate> all;
  for (const int joint : figure.members) {
    const auto j = static_cast<std::size_t>(joint);
    const BoneName& name = figure.names[j];
    if (sides[j] != side || name.helper || !of_family(family, name.part)) continue;
    BonePart part = name.part;
    if (name.end_marker) {
      // "arm_end": where the limb ends, if something follows; else it only closes a bone.
      const bool leaf =
          std::none_of(figure.figure.children(joint).begin(), figure.figure.children(joint).end(),
                       [&](int child) { return figure.is_member(child); });
      if (leaf) continue;
      if (part == family.plain) part = family.end;
    }
    all.push_back({joint, part, rank_of(figure, joint)});
  }
  // What a bare "arm" or "leg" means: the lower one below an upper one, the upper one above a lower
  // one ("Leg" is the shin where there is an "UpLeg").
  std::vector<LimbCandidate> resolved = all;
  for (LimbCandidate& candidate : resolved) {
    if (candidate.part != family.plain) continue;
    bool has_upper = false, has_fore = false;
    for (const LimbCandidate& other : all) {
      if (other.part == family.upper && figure.below(candidate.joint, other.joint)) {
        has_upper = true;
      }
      if (other.part == family.fore && figure.below(other.joint, candidate.joint)) has_fore = true;
    }
    if (has_upper && !has_fore) candidate.part = family.fore;
    if (has_fore && !has_upper) candidate.part = family.upper;
    if (!has_fore && !has_upper && is_lower_one(figure, family, all, candidate))
      candidate.part = family.fore;
  }
  std::vector<LimbCandidate> kept;
  for (const LimbCandidate& candidate : resolved) {
    const bool outdone =
        std::any_of(resolved.begin(), resolved.end(), [&](const LimbCandidate& other) {
          return other.part == candidate.part && other.rank > candidate.rank;
        });
    if (!outdone) kept.push_back(candidate);
  }
  return kept;
}

// Nearest below `from` with the wanted part; of equally near ones that with most below it, then the
// first. `several` tells of the others.
int nearest_below(const NamedFigure& figure, const std::vector<LimbCandidate>& candidates,
                  BonePart part, int from, bool& several) {
  const Skeleton& skeleton = figure.model.skeleton;
  int best = -1, best_depth = 0, best_weight = 0;
  several = false;
  for (const LimbCandidate& candidate : candidates) {
    if (candidate.part != part || !figure.below(candidate.joint, from)) continue;
    int depth = 0;
    for (int j = candidate.joint; j != from;
         j = skeleton.joints[static_cast<std::size_t>(j)].parent) {
      ++depth;
    }
    const int weight = figure.descendants(candidate.joint);
    if (best >= 0 && depth == best_depth) several = true;
    if (best < 0 || depth < best_depth || (depth == best_depth && weight > best_weight)) {
      if (best < 0 || depth < best_depth) several = false;
      best = candidate.joint;
      best_depth = depth;
      best_weight = weight;
    }
  }
  return best;
}

}  // namespace elbowroom
