// SPDX-License-Identifier: MIT
// What planning learns from motions that touch on the deformed skin. Through rigid parts: margins
// for the pairs of parts that do, by what the skin was seen to do there; a margin for all parts
// would close ways that are open. On the skin itself: when; what moves fast passes between two
// looks of one resolution, and a finer one is not needed all over the window.
#pragma once

#include <cstddef>
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

  // What is known of one pair: the margin that would have refused a motion that touches.
  void learn(const LimbPlanningSpace::PairMargin& pair);

  // From a motion that was planned on the skin: when it touches, seconds.
  void learn(double time);

  // How much has been learnt; grows with each lesson that is new.
  std::size_t size() const { return margins_.size() + moments_.size(); }
  const std::vector<double>& moments() const { return moments_; }

  // The view with what has been learnt. Of margins a little more, since elsewhere on its way the
  // skin may do more, and it is not looked at as long; the skin is looked at as in final verdicts.
  PlanningView taught(PlanningView view) const;

 private:
  std::vector<LimbPlanningSpace::PairMargin> margins_;
  std::vector<double> moments_;
};

}  // namespace elbowroom
