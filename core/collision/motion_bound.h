// SPDX-License-Identifier: MIT
// How far anything that follows a node of the world can get during an interval of time from where
// it is at the interval's middle: the bound on motion that a certificate rests on (Schwarzer, Saha
// and Latombe 2005, with the clip's and the obstacles' motion beside the limb's).
//
// Taken from the keys that are played (channel_travel.h), so it holds for every time between
// samples. For a point that is fixed in node j's frame, at most r (node's units) from its origin:
//
//     |world place(t) − world place(middle)| ≤ fixed_j + per_radius_j · r
//
// Derivation. The place is a product of local transforms f_1 ... f_j applied to the point. Changing
// them one by one, outermost last, f_1(t)..f_{k-1}(t) [f_k(t) − f_k(m)] f_{k+1}(m)..f_j(m) p, each
// step moves the point by at most lift_k + turn_k · (distance at the middle of the point from node
// k's origin), where turn_k = 2 sin(θ_k / 2) + the share by which its scale changes, and lift_k how
// far its translation gets; and no distance from node k's origin exceeds |o_k − o_j| + r.
//
// A reference node may be given: then places are those in its frame, and only nodes on the way
// through the skeleton from it to j count. Two parts of one body are apart in any such frame as
// they are in the world, so that a walk, which carries both, does not count. Going up from the
// reference the inverses of local transforms occur, whose steps have the very same bound.
//
// What that asks of the skeleton: uniform positive scale. Nodes whose scale differs by axis by more
// than 1e-4, or changes by more within the interval, and those below them, get the plain recursion
// fixed_j = fixed_p + per_radius_p·|T_j| + stretch_p·ΔT_j, per_radius_j = per_radius_p·|S_j| +
// stretch_p·(2 sin(θ_j/2)·|S_j| + ΔS_j), which asks for nothing; they are no references (the world
// is taken). All bounds are given 1 % more, which is more than 64 scales of that freedom make.
// What hangs on a node that is sheared and moves has no bound (infinity): a rigid frame is taken
// from that node's matrix, and how it turns is not bounded here.
//
// Times must not lie on both sides of a step of the world (world_steps.h). Scene units. One thread
// at a time.
#pragma once

#include <vector>

#include "core/scene/world.h"

namespace elbowroom {

// Of points that follow one node, over the interval that is set.
struct PointTravel {
  double fixed = 0;       // scene units
  double per_radius = 0;  // scene units for each unit of the node's frame
  double stretch = 1;     // no vector of the node's frame is longer than that in the world
};

struct NodeReference {
  int actor = -1;  // -1: the world
  int node = -1;
};

class MotionBound {
 public:
  // Which channels move which node; to be made again when an actor plays another clip.
  explicit MotionBound(const World& world);

  // The interval asked about; begin ≤ middle ≤ end. `states`: the world's at `middle`; copied from.
  void set(const World& world, double begin, double end, double middle,
           const std::vector<ActorState>& states);

  // By node of `actor`. A reference that is none, or whose frame deforms, counts as the world.
  // Cost: nodes × depth.
  void travel(int actor, const NodeReference& reference, std::vector<PointTravel>& by_node) const;

  // How far the morph weights of a node get from what they are at the middle; empty if no channel
  // moves them.
  const std::vector<double>& weight_travel(int actor, int node) const;

 private:
  struct Node {
    int parent = -1;  // in nodes_; -1: the world
    int depth = 0;
    bool matrix = false;  // placed by a matrix of its own
    const Channel* rotation = nullptr;
    const Channel* translation = nullptr;
    const Channel* scale = nullptr;
    const Channel* weights = nullptr;

    // Of the interval.
    double turn = 0, lift = 0;  // as above, world units
    double size = 1;            // similar: world units for a unit of the node's frame
    double parent_size = 1;
    Vec3 place{0.0};       // of its origin at the middle, world
    bool similar = false;  // it and all above keep a uniform scale
    // For the plain recursion.
    double shift = 0, reach = 0;     // ΔT and the greatest |T|
    double change = 0, largest = 1;  // of the linear part: how far it gets, and its norm
    std::vector<double> weight_change;
  };
  struct Root {        // what the roots of an actor stand on
    int carrier = -1;  // in nodes_
    double size = 1;   // similar
    bool similar = true;
    double reach = 0, largest = 1;  // of the matrix between
  };

  std::size_t number(int actor, int node) const {
    return first_[static_cast<std::size_t>(actor)] + static_cast<std::size_t>(node);
  }
  PointTravel along(std::size_t from, std::size_t to) const;
  void set_node(const World& world, std::size_t actor, std::size_t node, double begin, double end,
                double middle, const ActorState& state);

  std::vector<std::size_t> first_;  // by actor, in nodes_
  std::vector<Node> nodes_;
  std::vector<Root> roots_;              // by actor
  std::vector<std::vector<int>> order_;  // by actor, parents first
};

}  // namespace elbowroom
