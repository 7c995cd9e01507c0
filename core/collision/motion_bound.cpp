// SPDX-License-Identifier: MIT
#include "core/collision/motion_bound.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/animation/channel_travel.h"

namespace elbowroom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnevenScale = 1e-4;  // share by which a scale may differ or change
constexpr int kDeepest = 64;           // nodes on a way for which that is small
constexpr double kMore = 1.01;         // what such scales, and rounding, can make of a bound

double longest_axis(const Mat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

// The uniform scale of a matrix, or 0 if it has none or mirrors.
double similarity(const Mat3& m) {
  const double x = glm::length(m[0]), y = glm::length(m[1]), z = glm::length(m[2]);
  const double tiny = kUnevenScale * x;
  if (!(x > 0) || !std::isfinite(x) || !(std::abs(x - y) <= tiny) || !(std::abs(x - z) <= tiny) ||
      !(std::abs(glm::dot(m[0], m[1])) <= tiny * x) ||
      !(std::abs(glm::dot(m[1], m[2])) <= tiny * x) ||
      !(std::abs(glm::dot(m[0], m[2])) <= tiny * x) || !(glm::determinant(m) > 0))
    return 0;
  return x;
}

bool holds(const World& world, std::size_t actor, double t) {
  const auto& attachment = world.actors[actor].attachment;
  if (!attachment || !(attachment->begin <= t && t <= attachment->end)) return false;
  if (attachment->actor < 0 || attachment->actor >= static_cast<int>(actor) ||
      attachment->joint < 0)
    return false;
  const auto& model = world.actors[static_cast<std::size_t>(attachment->actor)].model;
  return model && attachment->joint < model->skeleton.size();
}

}  // namespace

MotionBound::MotionBound(const World& world) {
  roots_.resize(world.actors.size());
  order_.resize(world.actors.size());
  for (std::size_t a = 0; a < world.actors.size(); ++a) {
    first_.push_back(nodes_.size());
    const Actor& actor = world.actors[a];
    if (!actor.model) continue;
    const Skeleton& skeleton = actor.model->skeleton;
    order_[a] = skeleton.order;
    const std::size_t base = nodes_.size();
    nodes_.resize(base + skeleton.joints.size());
    for (std::size_t n = 0; n < skeleton.joints.size(); ++n)
      nodes_[base + n].matrix = skeleton.joints[n].rest_matrix.has_value();
    if (!actor.clip) continue;
    for (const Channel& channel : actor.clip->channels) {
      if (channel.joint < 0 || channel.joint >= skeleton.size() || channel.times.empty()) continue;
      Node& node = nodes_[base + static_cast<std::size_t>(channel.joint)];
      // Of two channels for one thing the later one is what is played.
      if (channel.path == Path::weights) node.weights = &channel;
      if (node.matrix) continue;
      if (channel.path == Path::rotation) node.rotation = &channel;
      if (channel.path == Path::translation) node.translation = &channel;
      if (channel.path == Path::scale) node.scale = &channel;
    }
  }
}

void MotionBound::set_node(const World& world, std::size_t actor, std::size_t n, double begin,
                           double end, double middle, const ActorState& state) {
  const Skeleton& skeleton = world.actors[actor].model->skeleton;
  const Joint& joint = skeleton.joints[n];
  const Transform& local = state.pose.local[n];
  Node& node = nodes_[first_[actor] + n];
  const Root& root = roots_[actor];
  const bool at_root = joint.parent < 0;
  node.parent =
      at_root ? root.carrier : static_cast<int>(number(static_cast<int>(actor), joint.parent));
  const Node* parent = node.parent < 0 ? nullptr : &nodes_[static_cast<std::size_t>(node.parent)];
  node.depth = parent ? parent->depth + 1 : 0;
  node.place = Vec3(state.world_from_joint[n][3]);

  const double angle = node.rotation ? rotation_travel(*node.rotation, begin, end, middle) : 0.0;
  node.shift = node.translation ? vector_travel(*node.translation, begin, end, middle) : 0.0;
  const double rescale = node.scale ? vector_travel(*node.scale, begin, end, middle) : 0.0;
  double own = 0;  // uniform scale
  bool even = false;
  if (node.matrix) {
    const Mat3 linear(*joint.rest_matrix);
    own = similarity(linear);
    even = own > 0;
    node.reach = glm::length(Vec3((*joint.rest_matrix)[3]));
    node.largest = even ? own * (1 + 2 * kUnevenScale) : longest_axis(linear);
    node.change = 0;
  } else {
    const Vec3 s = local.scale, size = glm::abs(s);
    const double smallest = std::min({size.x, size.y, size.z});
    const double largest = std::max({size.x, size.y, size.z});
    own = s.x;
    even = s.x > 0 && s.y > 0 && s.z > 0 && largest - smallest + rescale <= kUnevenScale * smallest;
    node.reach = glm::length(local.translation) + node.shift;
    node.largest = largest + rescale;
    node.change = 2 * std::sin(0.5 * angle) * node.largest + rescale;
  }
  const bool base_similar = at_root ? root.similar : (parent && parent->similar);
  node.similar = base_similar && even && node.depth < kDeepest;
  if (node.similar) {
    node.parent_size = at_root ? root.size : parent->size;
    node.size = node.parent_size * own;
    node.turn = node.change / own;
    node.lift = node.parent_size * node.shift;
  }
  node.weight_change.clear();
  if (node.weights)
    for (int c = 0; c < node.weights->components; ++c)
      node.weight_change.push_back(component_travel(*node.weights, c, begin, end, middle));
}

void MotionBound::set(const World& world, double begin, double end, double middle,
                      const std::vector<ActorState>& states) {
  for (std::size_t a = 0; a < world.actors.size(); ++a) {
    const Actor& actor = world.actors[a];
    if (!actor.model) continue;
    Root& root = roots_[a];
    root = {};
    Mat4 base = actor.world_from_file;
    if (holds(world, a, middle)) {
      base = actor.attachment->joint_from_object.matrix();
      root.carrier = static_cast<int>(number(actor.attachment->actor, actor.attachment->joint));
    }
    root.size = similarity(Mat3(base));
    root.similar = root.size > 0;
    if (root.carrier >= 0)
      root.similar = root.similar && nodes_[static_cast<std::size_t>(root.carrier)].similar;
    root.reach = glm::length(Vec3(base[3]));
    root.largest = longest_axis(Mat3(base));
    for (const int n : order_[a])
      set_node(world, a, static_cast<std::size_t>(n), begin, end, middle, states[a]);
  }
}

// Of points that follow the similar node `to`, in the frame of the similar node `from`, or in the
// world (from = -1 as size_t).
PointTravel MotionBound::along(std::size_t from, std::size_t to) const {
  PointTravel travel;
  const Vec3 place = nodes_[to].place;
  double turns = 0;
  const auto pass = [&](int& at) {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    travel.fixed += node.lift + node.turn * glm::distance(node.place, place);
    turns += node.turn;
    at = node.parent;
  };
  int up = static_cast<int>(to), down = from == nodes_.size() ? -1 : static_cast<int>(from);
  const auto depth = [&](int at) {
    return at < 0 ? -1 : nodes_[static_cast<std::size_t>(at)].depth;
  };
  while (up != down) {
    if (depth(up) >= depth(down))
      pass(up);
    else
      pass(down);
  }
  travel.fixed *= kMore;
  travel.per_radius = kMore * turns * nodes_[to].size;
  travel.stretch = kMore * nodes_[to].size;
  return travel;
}

void MotionBound::travel(int actor, const NodeReference& reference,
                         std::vector<PointTravel>& by_node) const {
  const auto a = static_cast<std::size_t>(actor);
  const std::size_t count = order_[a].size();
  by_node.assign(count, {});
  std::size_t from = nodes_.size();
  if (reference.actor >= 0) {
    from = number(reference.actor, reference.node);
    if (!nodes_[from].similar) from = nodes_.size();
  }
  // What the roots stand on, for the plain recursion.
  PointTravel base;
  const Root& root = roots_[a];
  if (root.carrier >= 0) {
    const auto carrier = static_cast<std::size_t>(root.carrier);
    // Of points by their distance from the carrier's origin in the world: its rigid frame.
    if (nodes_[carrier].similar) {
      base = along(from, carrier);
      base.per_radius /= nodes_[carrier].size;
      base.stretch = kMore;
    } else {
      std::vector<PointTravel> carriers;
      const auto owner = static_cast<std::size_t>(
          std::upper_bound(first_.begin(), first_.end(), carrier) - first_.begin() - 1);
      travel(static_cast<int>(owner), reference, carriers);
      base = carriers[carrier - first_[owner]];
      base.stretch = kMore;
      if (base.fixed > 0 || base.per_radius > 0) base.fixed = base.per_radius = kInfinity;
    }
  } else if (from != nodes_.size() && !root.similar) {
    // The world in the reference's frame: the reference's own way up.
    int at = static_cast<int>(from);
    double turns = 0, fixed = 0;
    while (at >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      fixed += node.lift + node.turn * glm::length(node.place);
      turns += node.turn;
      at = node.parent;
    }
    base.fixed = kMore * fixed;
    base.per_radius = kMore * turns;
  }
  base.fixed += base.per_radius * root.reach;
  base.per_radius *= root.largest;
  base.stretch *= root.largest;

  for (const int n : order_[a]) {
    const std::size_t at = first_[a] + static_cast<std::size_t>(n);
    const Node& node = nodes_[at];
    PointTravel& own = by_node[static_cast<std::size_t>(n)];
    if (node.similar) {
      own = along(from, at);
      continue;
    }
    const bool below = node.parent >= 0 && static_cast<std::size_t>(node.parent) >= first_[a] &&
                       static_cast<std::size_t>(node.parent) < first_[a] + count;
    const PointTravel& up =
        below ? by_node[static_cast<std::size_t>(node.parent) - first_[a]] : base;
    own.fixed = up.fixed + up.per_radius * node.reach + kMore * up.stretch * node.shift;
    own.per_radius = up.per_radius * node.largest + kMore * up.stretch * node.change;
    own.stretch = up.stretch * node.largest;
    // 0 · infinity says nothing.
    if (!(own.fixed >= 0)) own.fixed = kInfinity;
    if (!(own.per_radius >= 0)) own.per_radius = kInfinity;
  }
}

const std::vector<double>& MotionBound::weight_travel(int actor, int node) const {
  return nodes_[number(actor, node)].weight_change;
}

}  // namespace elbowroom
