// SPDX-License-Identifier: MIT
#include "core/anatomy/bound_figure.h"

#include <algorithm>
#include <cmath>

#include "core/anatomy/bind_geometry.h"

namespace elbowroom {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kThumbOff = 25 * kDegree;   // from the mean of the others
constexpr double kThumbClear = 8 * kDegree;  // more than the next one
constexpr double kOnLine = 0.06;             // of a bone, off its line: a twist joint
constexpr double kTwoApart = 15 * kDegree;   // of two digits, from the forearm

Vec3 transform(const Mat4& m, const Vec3& p) { return Vec3(m * glm::dvec4(p, 1.0)); }

// Sum and number of the vertices that follow the joint for more than half.
void add_vertices(const BoundFigure& figure, int joint, Vec3& sum, int& count) {
  const Model& model = figure.model;
  for (const int index : figure.character.meshes) {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(index)];
    if (mesh.skin < 0) {
      if (mesh.node < 0 || !model.skeleton.is_within(mesh.node, joint)) continue;
      for (const glm::vec3& p : mesh.positions) {
        sum += transform(figure.globals[static_cast<std::size_t>(mesh.node)], Vec3(p));
        ++count;
      }
      continue;
    }
    const Skin& skin = model.skins[static_cast<std::size_t>(mesh.skin)];
    const auto slot = std::find(skin.joints.begin(), skin.joints.end(), joint);
    if (slot == skin.joints.end()) continue;
    const Mat4 world_from_mesh =
        figure.globals[static_cast<std::size_t>(joint)] *
        skin.inverse_bind[static_cast<std::size_t>(slot - skin.joints.begin())];
    for (std::size_t v = 0; v + 1 < mesh.influence_begin.size(); ++v) {
      float weight = 0;
      for (std::uint32_t i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i) {
        if (mesh.influences[i].joint == joint) weight += mesh.influences[i].weight;
      }
      if (!(weight > 0.5f)) continue;
      sum += transform(world_from_mesh, Vec3(mesh.positions[v]));
      ++count;
    }
  }
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// bind_globals places each joint as world_from_bind · inverse(inverse bind matrix).
void find_axes(BoundFigure& figure) {
  const Skin* largest = nullptr;
  for (const int index : figure.character.skins) {
    const Skin& skin = figure.model.skins[static_cast<std::size_t>(index)];
    if (largest == nullptr || skin.joints.size() > largest->joints.size()) largest = &skin;
  }
  if (largest == nullptr || largest->joints.empty()) return;
  const Mat3 world_from_bind(figure.globals[static_cast<std::size_t>(largest->joints.front())] *
                             largest->inverse_bind.front());
  std::array<Vec3, 3> axes;
  for (int i = 0; i < 3; ++i) {
    const auto axis = direction(world_from_bind[i]);
    if (!axis) return;
    axes[static_cast<std::size_t>(i)] = *axis;
  }
  figure.axes = axes;
}

}  // namespace

BoundFigure bound_figure(const Model& model, const Character& character) {
  const std::size_t count = model.skeleton.joints.size();
  BoundFigure figure{model, character, bind_globals(model, character), {}, {}, {}};
  find_axes(figure);
  figure.skin.assign(count, 0.0);
  figure.rigid.assign(count, 0.0);
  figure.jointed.assign(count, 0);
  for (const int joint : character.joints) figure.jointed[static_cast<std::size_t>(joint)] = 1;
  for (const int index : character.meshes) {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(index)];
    if (mesh.skin < 0 && mesh.node >= 0 && !mesh.positions.empty()) {
      figure.rigid[static_cast<std::size_t>(mesh.node)] +=
          static_cast<double>(mesh.positions.size());
      figure.shown = true;
    }
    for (const Influence& influence : mesh.influences) {
      if (!(influence.weight > 0)) continue;
      figure.skin[static_cast<std::size_t>(influence.joint)] +=
          static_cast<double>(influence.weight);
      figure.shown = true;
    }
  }
  for (std::size_t i = model.skeleton.order.size(); i-- > 0;) {
    const auto j = static_cast<std::size_t>(model.skeleton.order[i]);
    const int parent = model.skeleton.joints[j].parent;
    if (parent < 0) continue;
    const auto p = static_cast<std::size_t>(parent);
    figure.skin[p] += figure.skin[j];
    figure.rigid[p] += figure.rigid[j];
    figure.jointed[p] = static_cast<char>(figure.jointed[p] != 0 || figure.jointed[j] != 0);
  }
  return figure;
}

std::vector<int> BoundFigure::own_parts(const std::vector<int>& joints) const {
  std::vector<int> skinned, moved, used;
  for (const int joint : joints) {
    const auto j = static_cast<std::size_t>(joint);
    if (!is_skin_joint(character, joint)) continue;
    used.push_back(joint);
    if (carries(joint)) moved.push_back(joint);
    if (skin[j] > 0) skinned.push_back(joint);
  }
  return !skinned.empty() ? skinned : !moved.empty() ? moved : used;
}

Vec3 tip_below(const BoundFigure& figure, int joint, const Vec3& from) {
  Vec3 tip = figure.place(joint);
  std::vector<int> stack = {joint};
  while (!stack.empty()) {
    const int other = stack.back();
    stack.pop_back();
    for (const int child : figure.children(other)) stack.push_back(child);
    if (!is_skin_joint(figure.character, other)) continue;
    if (glm::distance(figure.place(other), from) > glm::distance(tip, from)) {
      tip = figure.place(other);
    }
  }
  return tip;
}

bool lies_along(const Vec3& place, const Vec3& from, const Vec3& to) {
  const Vec3 bone = to - from, way = place - from;
  const double length = glm::length(bone);
  if (!(length > 0)) return false;
  const double along = glm::dot(way, bone) / (length * length);
  return along >= -kOnLine && along <= 1 + kOnLine &&
         glm::length(way - bone * along) <= kOnLine * length;
}

bool lies_along(const BoundFigure& figure, int joint, int from, int to) {
  std::vector<int> stack = {joint};
  while (!stack.empty()) {
    const int next = stack.back();
    stack.pop_back();
    if (!lies_along(figure.place(next), figure.place(from), figure.place(to))) return false;
    for (const int child : figure.children(next)) stack.push_back(child);
  }
  return true;
}

std::vector<int> branches_below(const BoundFigure& figure, int end, bool foot) {
  constexpr int kDeepest = 3;
  int joint = end;
  for (int depth = 0; depth < kDeepest; ++depth) {
    std::vector<int> apart;
    for (const int child : figure.children(joint)) {
      if (direction(figure.place(child) - figure.place(end))) apart.push_back(child);
    }
    const std::vector<int> branches = figure.own_parts(apart);
    if (foot || branches.size() != 1) return branches;
    joint = branches.front();
  }
  return {};
}

Digits digits_of(const BoundFigure& figure, const std::vector<int>& branches, const Vec3& wrist,
                 const Vec3& lower) {
  Digits digits;
  std::vector<Vec3> ways;
  for (const int branch : branches) {
    const auto way = direction(tip_below(figure, branch, wrist) - wrist);
    if (!way) continue;
    digits.fingers.push_back(branch);
    ways.push_back(*way);
  }
  std::size_t thumb = ways.size();
  if (ways.size() == 2 && direction(lower)) {
    const double a = angle_between(ways[0], lower), b = angle_between(ways[1], lower);
    if (std::abs(a - b) > kTwoApart && std::max(a, b) > kThumbOff) thumb = a > b ? 0 : 1;
  } else if (ways.size() >= 3) {
    std::vector<double> off(ways.size(), 0);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      Vec3 others(0.0);
      for (std::size_t j = 0; j < ways.size(); ++j) {
        if (j != i) others += ways[j];
      }
      off[i] = angle_between(ways[i], others);
    }
    const auto most = std::max_element(off.begin(), off.end());
    const bool clear = std::all_of(off.begin(), off.end(), [&](const double& other) {
      return &other == &*most || *most - other > kThumbClear;
    });
    if (*most > kThumbOff && clear) thumb = static_cast<std::size_t>(most - off.begin());
  }
  if (thumb < ways.size()) {
    digits.thumb = digits.fingers[thumb];
    digits.fingers.erase(digits.fingers.begin() + static_cast<std::ptrdiff_t>(thumb));
  }
  return digits;
}

std::optional<Vec3> extremity(const BoundFigure& figure, int joint, bool hand) {
  const Vec3 from = figure.place(joint);
  const auto mean_of = [&](const std::vector<int>& joints) -> std::optional<Vec3> {
    Vec3 sum(0.0);
    int count = 0;
    for (const int other : joints) {
      const Vec3 to = figure.place(other) - from;
      if (!direction(to)) continue;
      sum += to;
      ++count;
    }
    if (count == 0 || !direction(sum)) return std::nullopt;
    return sum / static_cast<double>(count);
  };

  std::vector<int> all;
  for (const int child : figure.children(joint)) {
    const bool bears_mesh = std::any_of(figure.model.meshes.begin(), figure.model.meshes.end(),
                                        [&](const Mesh& mesh) { return mesh.node == child; });
    if (bears_mesh && !is_skin_joint(figure.character, child)) continue;
    all.push_back(child);
  }
  std::vector<int> own;
  for (const int part : figure.own_parts(all)) {
    if (figure.carries(part)) own.push_back(part);
  }
  if (hand) {
    const int above = figure.parent(joint);
    const Vec3 lower = above < 0 ? Vec3(0.0) : from - figure.place(above);
    const Digits digits = digits_of(figure, own, from, lower);
    if (digits.thumb >= 0) std::erase(own, digits.thumb);
  }
  if (const auto beyond = mean_of(own)) return beyond;
  Vec3 sum(0.0);
  int count = 0;
  add_vertices(figure, joint, sum, count);
  if (count > 0) {
    const Vec3 beyond = sum / static_cast<double>(count) - from;
    if (direction(beyond)) return beyond;
  }
  return mean_of(all);
}

}  // namespace elbowroom
