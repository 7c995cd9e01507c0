// SPDX-License-Identifier: MIT
// What planning through rigid parts learns from motions that touch on the deformed skin: margins
// for the pairs of parts that do, by what the skin was seen to do there. A margin for all parts
// would close ways that are open.
#pragma once

#include <stop_token>
#include <vector>

#include "core/editing/verify_window.h"
#include "core/editing/window_motion.h"

namespace elbowroom {

class SkinLesson {
 public:
  // From a motion that was planned in `world`, as keys: what touches, and the margin with which
  // the rigid parts would have refused it, the largest at any time. Poses and clips of the
  // problem's scene are as before then.
  void learn(WindowProblem& problem, PlanningWorld& world, const WindowMotion& motion,
             const KeyedMotion& keyed, const std::stop_token& stop);

  bool empty() const { return margins_.empty(); }

  // The view with what has been learnt, and a little more, since elsewhere on its way the skin may
  // do more. It is not looked at as long.
  PlanningView taught(PlanningView view) const;

 private:
  std::vector<LimbPlanningSpace::PairMargin> margins_;
};

}  // namespace elbowroom
