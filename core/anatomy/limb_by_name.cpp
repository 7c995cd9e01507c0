// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/bound_figure.h"
#include "core/anatomy/limb.h"
#include "core/anatomy/limb_joints.h"
#include "core/scene/joint_name.h"

namespace elbowroom {
namespace {

constexpr std::size_t kNamesListed = 12;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Joints to offer where `wanted` is none: those that share most of its beginning or contain it,
// else the first.
std::string joints_like(const Model& model, const Character& character, const std::string& wanted) {
  const std::string low = lower(wanted);
  std::vector<std::string> names;
  for (const bool like : {true, false}) {
    for (const int joint : character.joints) {
      const std::string& name = model.skeleton.joints[static_cast<std::size_t>(joint)].name;
      if (name.empty()) continue;
      if (like && (low.empty() || lower(name).find(low) == std::string::npos)) continue;
      names.push_back(name);
    }
    if (!names.empty()) break;
  }
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < kNamesListed; ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kNamesListed) text += ", ...";
  return text;
}

int joint_named(const Model& model, const Character& character, const std::string& name) {
  return joint_of_name(model, character, name).node;
}

// The joint between the ends of a chain that serves best as its hinge: the one that leaves two
// bones of the most equal length, as an elbow does; the bind pose's bend there decides between near
// equals.
int middle_of(const std::vector<Mat4>& globals, const std::vector<int>& joints) {
  int best = -1;
  double best_score = -1;
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    const Vec3 a = origin(globals, joints[i]) - origin(globals, joints.front());
    const Vec3 b = origin(globals, joints.back()) - origin(globals, joints[i]);
    const double shorter = std::min(glm::length(a), glm::length(b));
    const double longer = std::max(glm::length(a), glm::length(b));
    if (!(shorter > 0)) continue;
    const double bend = 0.5 * (1.0 - glm::dot(a, b) / (glm::length(a) * glm::length(b)));
    const double score = shorter / longer + 0.5 * bend;
    if (score > best_score) {
      best = joints[i];
      best_score = score;
    }
  }
  return best;
}

LimbKind kind_named(const std::string& name) {
  for (const LimbKind kind :
       {LimbKind::left_arm, LimbKind::right_arm, LimbKind::left_leg, LimbKind::right_leg}) {
    if (name == limb_id(kind)) return kind;
  }
  return LimbKind::chain;
}

}  // namespace

Result<Limb> limb_between(const Model& model, const Character& character, const std::string& name,
                          const LimbJoints& joints) {
  const std::string file = model.path.filename().string();
  const auto missing = [&](const std::string& text) {
    return Error{"no joint '" + text + "'", file, "joints: " + joints_like(model, character, text)};
  };
  const int root = joint_named(model, character, joints.from);
  if (root < 0) return missing(joints.from);
  const int end = joint_named(model, character, joints.to);
  if (end < 0) return missing(joints.to);
  if (root == end || !model.skeleton.is_within(end, root)) {
    return Error{"'" + joints.to + "' is not below '" + joints.from + "'", file,
                 "a chain goes from a joint to one below it"};
  }
  Limb limb;
  limb.kind = kind_named(name);
  limb.name = name;
  limb.root = root;
  limb.end = end;
  const BoundFigure figure = bound_figure(model, character);
  std::vector<int> path;
  for (int j = end;; j = figure.parent(j)) {
    path.insert(path.begin(), j);
    if (j == root) break;
  }
  limb.why = "named; its middle is ";
  if (joints.middle.empty()) {
    limb.middle = middle_of(figure.globals, path);
    if (limb.middle < 0) {
      return Error{
          "between '" + joints.from + "' and '" + joints.to + "' is no joint that could bend", file,
          "a chain needs at least three joints in three places"};
    }
    limb.why += quoted_joint(model, limb.middle) + ", which leaves the most equal bones";
  } else {
    limb.middle = joint_named(model, character, joints.middle);
    if (limb.middle < 0) return missing(joints.middle);
    if (limb.middle == root || limb.middle == end ||
        std::find(path.begin(), path.end(), limb.middle) == path.end()) {
      return Error{
          "'" + joints.middle + "' is not between '" + joints.from + "' and '" + joints.to + "'",
          file, "name a joint of the chain"};
    }
    limb.why += quoted_joint(model, limb.middle) + ", as named";
  }
  complete_limb(figure, limb);
  return limb;
}

Result<Limb> limb_by_name(const Model& model, const Character& character, const std::string& name,
                          const LimbOverrides& overrides) {
  const std::string file = model.path.filename().string();
  const LimbFindings findings = find_limbs(model, character, overrides);
  std::string found;
  for (const Limb& limb : findings.limbs) {
    if (limb.name == name) return limb;
    found += (found.empty() ? "" : ", ") + limb.name;
  }
  const std::size_t dots = name.find("..");
  if (dots == std::string::npos) {
    std::string remedy = found.empty() ? "no limb was found; name a chain as FROM..TO"
                                       : "found: " + found + "; or name a chain as FROM..TO";
    for (const std::string& warning : findings.warnings) {
      if (warning.rfind(name + " not found", 0) == 0) remedy = warning + "; " + remedy;
    }
    return Error{"no limb '" + name + "'", file, remedy};
  }
  // A joint's name may hold dots itself ("Hand.L..Foo"): take the first split at which both exist.
  std::string from = name.substr(0, dots), to = name.substr(dots + 2);
  for (std::size_t at = dots; at != std::string::npos; at = name.find("..", at + 1)) {
    if (joint_named(model, character, name.substr(0, at)) >= 0 &&
        joint_named(model, character, name.substr(at + 2)) >= 0) {
      from = name.substr(0, at);
      to = name.substr(at + 2);
      break;
    }
  }
  const int root = joint_named(model, character, from);
  const int end = joint_named(model, character, to);
  for (const auto& [joint, text] : {std::pair(root, from), std::pair(end, to)}) {
    if (joint >= 0) continue;
    return Error{"no joint '" + text + "'", file, "joints: " + joints_like(model, character, text)};
  }
  for (const Limb& limb : findings.limbs) {
    if (limb.root == root && limb.end == end) return limb;
  }
  Result<Limb> chain = limb_between(model, character, name, {from, "", to});
  if (!chain) return chain;
  std::vector<const Limb*> all;
  for (const Limb& limb : findings.limbs) all.push_back(&limb);
  take_along_below(bound_figure(model, character), *chain, all);
  return chain;
}

}  // namespace elbowroom
