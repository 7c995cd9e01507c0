// SPDX-License-Identifier: MIT
// How far the parts of a LimbPlanningSpace can get within an interval of an edge from where they
// are at its middle: the bound that certified edges rest on (Schwarzer, Saha and Latombe 2005), for
// the limb's DOFs, the clip's motion and the obstacles'. Private to the collision folder.
//
// What is bounded is the planner's own world: placements interpolated between the rows of its
// tracks (frame_tracks.h), DOFs linear in time. Between two rows a place moves evenly; a rotation
// by normalized linear interpolation through θ turns at 2 sin(θ/2) to 4 tan(θ/4) rad a row. Sums
// over rows are kept, so an interval costs two look-ups a node.
//
// A point fixed to a node of the limb's chain moves at most, for each chain node k up to it, by how
// far k's translation gets, plus k's angle times the point's distance from k's origin; a twist
// counts with the distance from the bone's axis. Two frames are compared in: the world, and the
// base that the limb's root stands on, in which a walk moves neither the limb nor the trunk near
// it. The base's matrix is interpolated entry by entry, which leaves it short of a rotation by the
// square of its turn in a row; `flex` bounds what that can do.
//
// A scale that is not uniform, or changes by more than 1e-4, has no bound: supported is false.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/collision/limb_planning_data.h"

namespace elbowroom {

class LimbMotion {
 public:
  // Fills all rows of the tracks. Cost: the world's state at each of them.
  explicit LimbMotion(LimbPlanningSpace::Data& data);

  bool supported() const { return supported_; }
  double flex() const { return flex_; }  // scene units

  // The interval of an edge; `rate` is its change of DOFs a second. The chain must be placed at the
  // middle (Data::place_chain), parts as Data::place has them there.
  void set(const Dofs& rate, double begin, double middle, double end,
           const FrameTracks::Cell& at_begin, const FrameTracks::Cell& at_middle,
           const FrameTracks::Cell& at_end, const LimbPlanningSpace::Data::Segment& segment,
           const std::array<Quat, 3>& residual);

  // How far apart the two parts of a pair may come or go together, at most, in whatever frame says
  // least. `a` moves with the limb; `b` with the limb or with the world.
  double travel(int a, int b);

 private:
  struct Sums {  // over rows, from the first
    std::vector<double> lift, turn;
  };
  struct Part {
    double in_world = 0, in_base = 0;
    std::array<double, 16> by_node{};  // along its chain, root first; below 16 nodes
    bool known = false;
  };
  double between(const std::vector<double>& sums) const;  // the farther side of the middle
  const Part& moving_part(int part);
  const Part& still_part(int part);

  LimbPlanningSpace::Data& data_;
  bool supported_ = true;
  double flex_ = 0;
  Sums base_;                          // the base in the world
  std::vector<Sums> world_, near_;     // by tracked node: in the world, and in the base
  std::vector<Sums> local_;            // by chain node: its own translation and (no DOF) rotation
  std::vector<double> above_;          // by chain node: scale of what it hangs from, at most
  std::vector<std::vector<int>> way_;  // by chain node: from the root to it
  std::vector<double> node_radius_;    // by part: of the world, about its tracked node
  std::vector<double> twist_radius_;   // by part: about the axis of its own chain node; -1: unknown

  // Of the interval.
  const LimbPlanningSpace::Data::Segment* segment_ = nullptr;
  FrameTracks::Cell begin_, middle_, end_;
  struct Turn {
    double lift = 0, swing = 0, twist = 0;
    Vec3 axis{1, 0, 0};  // of the twist, world
  };
  std::vector<Turn> turns_;  // by chain node
  double base_lift_ = 0, base_turn_ = 0;
  Vec3 base_place_{0.0};
  std::vector<Part> parts_;
};

}  // namespace elbowroom
