// SPDX-License-Identifier: MIT
#include "core/anatomy/hand_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_names.h"

namespace elbowroom {
namespace {

constexpr double kRootFrom = 1.0 / 3;         // of the way to a chain's end: nearer is a metacarpal
constexpr double kThumbOff = 25 * kPi / 180;  // from the mean of the other branches

// What a joint is to the hand. Whatever is below a thumb or a finger is of it.
enum class Role : char { none, palm, finger, thumb };

class Finder {
 public:
  Finder(const Model& model, const Character& character, const std::vector<Mat4>& globals, int end,
         bool foot)
      : model_(model), character_(character), globals_(globals), end_(end), foot_(foot) {
    roles_.assign(model.skeleton.joints.size(), Role::none);
  }

  HandParts find(bool with_siblings) {
    mark(end_, Role::palm);
    roots_.push_back(end_);
    if (with_siblings) add_siblings();
    for (const int root : roots_) collect_named(root);
    parts_.by_name = !fingers_.empty();
    if (fingers_.empty() && thumbs_.empty()) collect_branches();
    for (const int finger : fingers_) {
      const int knuckle = knuckle_of(finger);
      parts_.finger_roots.push_back(origin(globals_, knuckle));
      if (!foot_) mark(knuckle, Role::finger);
    }
    for (const int thumb : thumbs_) {
      parts_.thumb_roots.push_back(origin(globals_, thumb));
      mark(thumb, Role::thumb);
    }
    collect_skin();
    return std::move(parts_);
  }

 private:
  const std::vector<int>& children(int joint) const {
    return model_.skeleton.children[static_cast<std::size_t>(joint)];
  }
  BoneName name_of(int joint) const {
    return read_bone_name(model_.skeleton.joints[static_cast<std::size_t>(joint)].name);
  }

  void mark(int joint, Role role) {
    for (int other = 0; other < model_.skeleton.size(); ++other) {
      if (model_.skeleton.is_within(other, joint)) roles_[static_cast<std::size_t>(other)] = role;
    }
  }

  void add_siblings() {
    const int parent = model_.skeleton.joints[static_cast<std::size_t>(end_)].parent;
    if (parent < 0) return;
    const double reach = glm::distance(origin(globals_, end_), origin(globals_, parent));
    for (const int other : children(parent)) {
      if (other == end_ || !is_skin_joint(character_, other)) continue;
      const BoneName name = name_of(other);
      const bool beside =
          glm::distance(origin(globals_, other), origin(globals_, end_)) < 0.02 * reach;
      if (name.helper || (name.part != BonePart::finger && !beside)) continue;
      mark(other, Role::palm);
      roots_.push_back(other);
    }
  }

  void collect_named(int joint) {
    const BoneName name = name_of(joint);
    const bool skin = is_skin_joint(character_, joint);
    if (joint != end_ && name.helper) return;
    if (skin && name.part == (foot_ ? BonePart::toe : BonePart::finger) && !name.end_marker &&
        joint != end_) {
      (name.thumb ? thumbs_ : fingers_).push_back(joint);
      return;
    }
    for (const int child : children(joint)) collect_named(child);
  }

  // No name tells: the branches below the end; one that stands off from the rest is the thumb.
  void collect_branches() {
    int joint = end_;
    std::vector<int> branches;
    for (int depth = 0; depth < 3 && branches.size() < 2; ++depth) {
      branches.clear();
      for (const int child : children(joint)) {
        if (is_skin_joint(character_, child) && !name_of(child).helper &&
            direction(origin(globals_, child) - origin(globals_, end_)))
          branches.push_back(child);
      }
      if (branches.size() != 1) break;
      joint = branches.front();
    }
    if (branches.size() < 2) return;
    if (!foot_ && branches.size() >= 3) {
      double most = kThumbOff;
      std::size_t thumb = branches.size();
      for (std::size_t i = 0; i < branches.size(); ++i) {
        Vec3 others(0.0);
        for (std::size_t j = 0; j < branches.size(); ++j)
          if (j != i) others += *direction(tip_of(branches[j]) - origin(globals_, end_));
        const auto rest = direction(others);
        const auto own = direction(tip_of(branches[i]) - origin(globals_, end_));
        if (!rest || !own) continue;
        const double off = std::acos(std::clamp(glm::dot(*rest, *own), -1.0, 1.0));
        if (off > most) {
          most = off;
          thumb = i;
        }
      }
      if (thumb < branches.size()) {
        thumbs_.push_back(branches[thumb]);
        branches.erase(branches.begin() + static_cast<std::ptrdiff_t>(thumb));
      }
    }
    fingers_ = branches;
  }

  // Origin of the joint farthest from the end below (and with) `joint`.
  Vec3 tip_of(int joint) const {
    Vec3 tip = origin(globals_, joint);
    const Vec3 from = origin(globals_, end_);
    for (int other = 0; other < model_.skeleton.size(); ++other) {
      if (!model_.skeleton.is_within(other, joint) || !is_skin_joint(character_, other)) continue;
      const Vec3 place = origin(globals_, other);
      if (glm::distance(place, from) > glm::distance(tip, from)) tip = place;
    }
    return tip;
  }

  int knuckle_of(int finger) const {
    const Vec3 from = origin(globals_, end_);
    const double whole = glm::distance(tip_of(finger), from);
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

  const Model& model_;
  const Character& character_;
  const std::vector<Mat4>& globals_;
  int end_;
  bool foot_;
  std::vector<Role> roles_;  // by joint
  std::vector<int> roots_, fingers_, thumbs_;
  HandParts parts_, held_;  // held: what may be held by the hand
};

}  // namespace

HandParts hand_parts(const Model& model, const Character& character,
                     const std::vector<Mat4>& globals, int end, bool foot, bool with_siblings) {
  return Finder(model, character, globals, end, foot).find(with_siblings);
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
