// SPDX-License-Identifier: MIT
#include "core/anatomy/hand_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/anatomy/bind_geometry.h"

namespace elbowroom {
namespace {

constexpr double kRootFrom = 1.0 / 3;  // of the way to a chain's end: nearer is a metacarpal
constexpr double kNearEnd = 0.4;  // of the lower bone: joints beside the end that are the hand's
constexpr double kBehind = 0.15;  // of the lower bone, behind the end

// What a joint is to the hand. Whatever is below a thumb or a finger is of it.
enum class Role : char { none, palm, finger, thumb };

class Finder {
 public:
  Finder(const BoundFigure& figure, int end, bool foot)
      : figure_(figure),
        model_(figure.model),
        character_(figure.character),
        globals_(figure.globals),
        end_(end),
        foot_(foot) {
    roles_.assign(model_.skeleton.joints.size(), Role::none);
  }

  HandParts find(bool with_siblings) {
    mark(end_, Role::palm);
    std::vector<int> branches;
    if (with_siblings) branches = siblings();
    if (branches.empty()) branches = branches_below(figure_, end_, foot_);
    const int parent = figure_.parent(end_);
    const Vec3 wrist = origin(globals_, end_);
    const Vec3 lower = parent < 0 ? Vec3(0.0) : wrist - origin(globals_, parent);
    Digits digits{branches, -1};
    if (!foot_) digits = digits_of(figure_, branches, wrist, lower);
    for (const int finger : digits.fingers) {
      const int knuckle = knuckle_of(finger);
      parts_.finger_roots.push_back(origin(globals_, knuckle));
      if (!foot_) mark(knuckle, Role::finger);
    }
    if (digits.thumb >= 0) {
      parts_.thumb_roots.push_back(origin(globals_, digits.thumb));
      mark(digits.thumb, Role::thumb);
    }
    collect_skin();
    return std::move(parts_);
  }

 private:
  const std::vector<int>& children(int joint) const {
    return model_.skeleton.children[static_cast<std::size_t>(joint)];
  }
  void mark(int joint, Role role) {
    for (int other = 0; other < model_.skeleton.size(); ++other) {
      if (model_.skeleton.is_within(other, joint)) roles_[static_cast<std::size_t>(other)] = role;
    }
  }

  // Joints beside the end that are the hand's too, the end with them, where it branches no further
  // down than there; empty without any.
  std::vector<int> siblings() {
    const int parent = figure_.parent(end_);
    if (parent < 0) return {};
    const double reach = glm::distance(origin(globals_, end_), origin(globals_, parent));
    std::vector<int> found;
    for (const int other : figure_.children(parent)) {
      if (!is_skin_joint(character_, other) || !figure_.carries(other)) continue;
      const Vec3 off = origin(globals_, other) - origin(globals_, end_);
      const double ahead = glm::dot(off, origin(globals_, end_) - origin(globals_, parent)) / reach;
      // What stands behind the wrist is a twist joint of the forearm.
      if (other != end_ && !(glm::length(off) < kNearEnd * reach && ahead > -kBehind * reach)) {
        continue;
      }
      if (other != end_) mark(other, Role::palm);
      found.push_back(other);
    }
    return found.size() >= 2 ? found : std::vector<int>{};
  }

  int knuckle_of(int finger) const {
    const Vec3 from = origin(globals_, end_);
    const double whole = glm::distance(tip_below(figure_, finger, from), from);
    int joint = finger;
    while (!(glm::distance(origin(globals_, joint), from) >= kRootFrom * whole)) {
      const auto& below = children(joint);
      if (below.size() != 1 || !is_skin_joint(character_, below.front())) break;
      joint = below.front();
    }
    return joint;
  }

  // `own`: the hand's own skin rather than what it may hold.
  void add(const Role role, bool own, const std::array<Vec3, 3>& triangle) {
    if (!finite(triangle[0]) || !finite(triangle[1]) || !finite(triangle[2])) return;
    HandParts& parts = own ? parts_ : held_;
    parts.all.triangles.push_back(triangle);
    if (role == Role::palm) parts.palm.triangles.push_back(triangle);
  }

  // The role that a triangle's corners share; palm where they differ, none if one is not the
  // hand's.
  static Role shared(Role a, Role b, Role c) {
    if (a == Role::none || b == Role::none || c == Role::none) return Role::none;
    return a == b && b == c ? a : Role::palm;
  }

  void collect_skin() {
    const Pose pose = rest_pose(model_.skeleton);
    std::vector<Vec3> positions;
    for (const int index : character_.meshes) {
      const Mesh& mesh = model_.meshes[static_cast<std::size_t>(index)];
      if (mesh.skin < 0) {
        // A prop that hangs on a socket of its own says nothing about the hand.
        if (mesh.node < 0 || roles_[static_cast<std::size_t>(mesh.node)] == Role::none ||
            !is_skin_joint(character_, mesh.node))
          continue;
        deform(model_, mesh, pose, globals_, positions);
        for (const auto& t : mesh.triangles)
          add(roles_[static_cast<std::size_t>(mesh.node)], false,
              {positions[t.x], positions[t.y], positions[t.z]});
        continue;
      }
      const bool concerned =
          std::any_of(mesh.influences.begin(), mesh.influences.end(), [&](const Influence& i) {
            return roles_[static_cast<std::size_t>(i.joint)] != Role::none;
          });
      if (!concerned) continue;
      std::vector<Role> role(mesh.positions.size(), Role::none);
      for (std::size_t v = 0; v + 1 < mesh.influence_begin.size(); ++v) {
        const Influence* heaviest = nullptr;
        for (std::uint32_t i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i)
          if (!heaviest || mesh.influences[i].weight > heaviest->weight)
            heaviest = &mesh.influences[i];
        if (heaviest) role[v] = roles_[static_cast<std::size_t>(heaviest->joint)];
      }
      deform(model_, mesh, pose, globals_, positions);
      const std::vector<char> own = hands_own(mesh, role, positions);
      for (const auto& t : mesh.triangles) {
        const Role all = shared(role[t.x], role[t.y], role[t.z]);
        if (all != Role::none)
          add(all, own[t.x] != 0, {positions[t.x], positions[t.y], positions[t.z]});
      }
    }
    if (!parts_.all.triangles.empty()) return;
    parts_.all = std::move(held_.all);
    parts_.palm = std::move(held_.palm);
  }

  // By vertex: whether its piece of the surface, welded by position, goes on over the rest of the
  // body, or lies within a lower bone's length of the end. A weapon skinned to the hand does not.
  std::vector<char> hands_own(const Mesh& mesh, const std::vector<Role>& role,
                              const std::vector<Vec3>& positions) const {
    const Vec3 from = origin(globals_, end_);
    const int parent = model_.skeleton.joints[static_cast<std::size_t>(end_)].parent;
    const double reach = parent < 0 ? 0 : glm::distance(from, origin(globals_, parent));
    const std::size_t count = mesh.positions.size();
    std::vector<std::uint32_t> above(count);
    std::iota(above.begin(), above.end(), 0u);
    const auto top = [&](std::uint32_t v) {
      while (above[v] != v) v = above[v] = above[above[v]];
      return v;
    };
    std::vector<std::uint32_t> order = above;
    const auto key = [&](std::uint32_t v) {
      const glm::vec3& p = mesh.positions[v];
      return std::array<float, 3>{p.x, p.y, p.z};
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t i = 1; i < count; ++i)
      if (key(order[i - 1]) == key(order[i])) above[top(order[i])] = top(order[i - 1]);
    for (const auto& t : mesh.triangles) {
      above[top(t.y)] = top(t.x);
      above[top(t.z)] = top(t.x);
    }
    std::vector<char> body(count, 0), far(count, 0), result(count, 0);
    for (std::uint32_t v = 0; v < count; ++v) {
      if (role[v] == Role::none) body[top(v)] = 1;
      if (!(glm::distance(positions[v], from) <= reach)) far[top(v)] = 1;
    }
    for (std::uint32_t v = 0; v < count; ++v)
      result[v] = static_cast<char>(body[top(v)] != 0 || far[top(v)] == 0);
    return result;
  }

  const BoundFigure& figure_;
  const Model& model_;
  const Character& character_;
  const std::vector<Mat4>& globals_;
  int end_;
  bool foot_;
  std::vector<Role> roles_;  // by joint
  HandParts parts_, held_;   // held: what may be held by the hand
};

}  // namespace

HandParts hand_parts(const BoundFigure& figure, int end, bool foot, bool with_siblings) {
  return Finder(figure, end, foot).find(with_siblings);
}

std::vector<WeightedPoint> weighted_points(const HandSkin& skin) {
  std::vector<WeightedPoint> points;
  points.reserve(skin.triangles.size());
  for (const auto& t : skin.triangles)
    points.push_back(
        {(t[0] + t[1] + t[2]) / 3.0, 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]))});
  return points;
}

std::optional<Vec3> middle_of(const HandSkin& skin) {
  Vec3 sum(0.0);
  double area = 0;
  for (const WeightedPoint& point : weighted_points(skin)) {
    sum += point.weight * point.place;
    area += point.weight;
  }
  if (!(area > 0) || !std::isfinite(area)) return std::nullopt;
  return sum / area;
}

}  // namespace elbowroom
