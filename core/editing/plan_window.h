// SPDX-License-Identifier: MIT
// One window of one limb, from the question to verified keys.
//
// The world is seen in several ways until something holds (planning_views.h), some of them again
// with what was learnt from motions that touch on the skin (skin_lesson.h). In each, several
// motions are planned from different seeds (Algorithm 1, smoothing, the curve), those that are the
// same way around are told apart from those that are not, and they are made keys and verified on
// the deformed skin in the order of what they cost (motion_cost.h) [SKF07 4.1, 6.1].
#pragma once

#include <optional>
#include <vector>

#include "core/editing/correct.h"
#include "core/editing/window_problem.h"

namespace elbowroom {

struct WindowPlan {
  WindowReport report;
  std::optional<Correction> correction;  // set if and only if report.status is corrected

  // Other ways around, as far as they were asked for and found: verified as well, by ascending
  // cost.
  struct Alternative {
    WindowReport report;
    Correction correction;
  };
  std::vector<Alternative> alternatives;
};

// brief: one motion in each view of the world, and the first that is verified is taken. Tells
// whether there is one at a fraction of the cost.
enum class Effort { usual, brief };

// `scene` plays `clip` when called and when it returns. The window's ends are float32 values within
// the clip.
WindowPlan plan_window(SceneCollision& scene, const std::shared_ptr<const Clip>& clip, int limb,
                       double begin, double end, const PlanningWishes& wishes,
                       const std::stop_token& stop, const ProgressSink& progress,
                       Effort effort = Effort::usual);

// The same through the problem's postures: a path and a curve from each to the next, keys at each
// of their times, one correction. Whether the postures between the ends are valid is the caller's
// to know.
WindowPlan plan_window(WindowProblem problem, const PlanningWishes& wishes,
                       const std::stop_token& stop, const ProgressSink& progress,
                       Effort effort = Effort::usual);

}  // namespace elbowroom
