// SPDX-License-Identifier: MIT
// The search for a swivel angle whose posture is valid [SKF07 5].
//
// From the current posture's swivel outward, both ways, with a growing step; limits and collisions
// are one validity test. When that finds nothing, all round: every step of a fixed grid (absolute
// multiples of 2π / resolution), the ends and middles of the intervals in which limits are kept,
// and the narrow ones between two steps of the grid, found by minimizing how far limits are
// exceeded; nearest to the initial swivel first. So it is solved wherever a scan of that grid finds
// a valid posture. What the target leaves open besides the swivel (LimbIk::solve_at_swivel) is kept
// as it is at first, and only when the circle holds no valid posture varied over its limits.
//
// Radians, scene units. Deterministic. Runs on the calling thread, no state. Cost: about a
// microsecond for each posture tried, besides the callback; allocates only when the greedy search
// fails.
#pragma once

#include <functional>
#include <optional>

#include "core/ik/limb_ik.h"

namespace elbowroom {

struct SwivelSearch {
  std::optional<Dofs> near;       // posture to start from and to keep near to; none: ik.current()
  std::optional<double> initial;  // swivel to start from; none: that of `near`
  double step = 2 * kPi / 180;    // δ, the first one
  double growth = 1.3;            // of the step, ≥ 1
  double lower = -kPi, upper = kPi;  // range of the swivel; 2π wide or more: all round
  const DofSpace* limits = nullptr;  // null: the limb's own
  int resolution = 360;              // of the exhaustive search, steps all round; 0: none
  int max_checks = 0;                // of the callback; 0: as many as it takes. For dragging: ~50
};

enum class IkStatus { solved, out_of_reach, at_limit, in_collision };
const char* ik_status_id(IkStatus status);

struct IkResult {
  IkStatus status = IkStatus::out_of_reach;
  // Solved: the posture. Else the best one to show, within limits: stretched towards a target out
  // of reach; that which exceeds limits least, clamped to them; that which collides, nearest to the
  // initial swivel.
  LimbState state;
  double swivel = 0;
  // Out of reach: by how much, scene units; infinite for a target that is not finite.
  double miss = 0;
  // At a limit: which DOF's is in the way at the best swivel, and by how much it is exceeded.
  int dof = -1;
  double excess = 0;
  int tried = 0;    // postures looked at
  int checked = 0;  // of these, how often the callback was asked
  // False if an orientation was asked for of an end that can't turn; the position alone counts.
  bool orientation_served = true;

  bool solved() const { return status == IkStatus::solved; }
};

// Whether a posture within limits is free of collisions.
using PostureCheck = std::function<bool(const LimbState&)>;

// `valid` may be empty: every posture within limits is valid then. A target that isn't finite is
// out of reach. Settings that make no sense (NaN, growth below 1, an empty range) are put right:
// defaults, 1, the initial swivel alone.
IkResult search_swivel(const LimbIk& ik, const IkTarget& target, const SwivelSearch& settings = {},
                       const PostureCheck& valid = {});

}  // namespace elbowroom
