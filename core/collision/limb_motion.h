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
// How far the DOFs move a part: turning_travel.h. Two frames are compared in: the world, and the
// base that the limb's root stands on, in which a walk moves neither the limb nor the trunk near
// it. Between two rows the base does not turn evenly either; `flex`, half the square of its turn in
// a row times the limb's reach, is far more than that can do.
//
// A scale that is not uniform, or changes by more than 1e-4, has no bound: supported is false.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/collision/limb_planning_data.h"
#include "core/collision/turning_travel.h"

namespace elbowroom {

class LimbMotion {
 public:
  // Fills all rows of the tracks. Cost: the world's state at each of them.
  explicit LimbMotion(LimbPlanningSpace::Data& data);

  bool supported() const { return supported_; }
  double flex() const { return flex_; }  // scene units

  // The interval of an edge; `q` are its DOFs at the middle, `rate` their change a second. The
  // chain must be placed at the middle (Data::place_chain), parts as Data::place has them there.
  void set(const Dofs& q, const Dofs& rate, double begin, double middle, double end,
           const FrameTracks::Cell& at_begin, const FrameTracks::Cell& at_middle,
           const FrameTracks::Cell& at_end, const LimbPlanningSpace::Data::Segment& segment,
           const std::array<Quat, 3>& residual);

  // How far a part may get in each of the two frames, at most. For `still_travel` and
  // `moving_travel` a part that the world and that the limb moves; what is asked for once is kept.
  struct Travel {
    double in_world = 0, in_base = 0;
  };
  const Travel& still_travel(int part);
  const Travel& moving_travel(int part);

  // How far apart the two parts of a pair may come or go together, at most, in whatever frame says
  // least. `a` moves with the limb; `b` with the limb or with the world.
  double travel(int a, int b);

 private:
  struct Sums {  // over rows, from the first
    std::vector<double> lift, turn;
  };
  struct TrackSums {  // of a tracked node up to a row, in the world and in the base
    double world_lift = 0, world_turn = 0, base_lift = 0, base_turn = 0;
  };
  double between(const std::vector<double>& sums) const;  // the farther side of the middle
  // In the frame of the chain node that `part`'s way reaches after `shared` nodes; 0: in the base.
  double travel_beyond(int part, std::size_t shared);

  LimbPlanningSpace::Data& data_;
  bool supported_ = true;
  double flex_ = 0;
  Sums base_;                          // the base in the world
  std::vector<TrackSums> tracked_;     // by row and tracked node
  std::vector<Sums> local_;            // by chain node: its own translation and (no DOF) rotation
  std::vector<double> above_;          // by chain node: scale of what it hangs from, at most
  std::vector<std::vector<int>> way_;  // by chain node: from the root to it
  std::vector<double> node_radius_;    // by part: of the world, about its tracked node
  std::vector<double> twist_radius_;   // by part: about the axis of its own chain node; -1: unknown

  // Of the interval.
  const LimbPlanningSpace::Data::Segment* segment_ = nullptr;
  FrameTracks::Cell begin_, middle_, end_;
  std::vector<TurningJoint> turns_;                             // by chain node
  std::vector<std::vector<const TurningJoint*>> turns_on_way_;  // by chain node, as way_
  double base_lift_ = 0, base_turn_ = 0;
  Vec3 base_place_{0.0};
  // By part.
  std::vector<std::uint8_t> known_;
  std::vector<Travel> travel_;
  std::vector<TurningPart> placed_;  // of those that move with the limb
};

}  // namespace elbowroom
