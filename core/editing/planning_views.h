// SPDX-License-Identifier: MIT
// The ways in which the world is looked at while a window is planned, and what each may cost.
//
// Rigid parts are fast and approximate, the skin is exact and a hundred times slower; much
// clearance is what is wanted, little may be all there is. Scene units.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/collision/limb_planning_space.h"

namespace elbowroom {

struct PlanningView {
  bool on_skin = false;       // the deformed skin; else the limb's rigid parts
  bool as_verified = false;   // on the skin: no room to slide beside contacts of the clip
  double clearance = 0;       // from everything else
  double body_clearance = 0;  // from the character itself
  double margin = 0;          // for what the skin does beyond rigid parts
  double near_share = 0;      // of samples near the clip's own motion
  std::vector<LimbPlanningSpace::PairMargin> pair_margins{};  // of rigid parts, beside `margin`
  std::vector<double> moments{};  // s, at which the skin is looked at whatever the resolution

  // What is planned: so many motions, of each a share of the iterations and so many checks; and
  // after so many seeds without a path no more.
  int ways = 4;
  int seeds_in_vain = 1;
  double effort = 1;
  std::int64_t most_checks = std::numeric_limits<std::int64_t>::max();
  // So often it may be looked at again, taught by motions that touch on the skin (skin_lesson.h).
  int lessons = 0;

  std::string text() const;  // for people
};

// In the order in which they are tried (view_order.h): the rigid parts with the clearance asked
// for; the same with less room from its own body; the skin; rigid parts with a margin for what the
// skin does beyond them; the skin by the rule of final verdicts, with little clearance; at last
// both with hardly any. `intervals_set`: the animator's sampling intervals say where to search
// first.
std::vector<PlanningView> planning_views(double clearance, double touching, double height,
                                         bool intervals_set);

}  // namespace elbowroom
