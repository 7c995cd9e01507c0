// SPDX-License-Identifier: MIT
// One planned motion of a window, not yet keys: Algorithm 1, smoothing and the curve, from each
// posture of the problem to the next [SKF07 4.1].
//
// Seconds, radians. A PlanningWorld poses the scene's limb while it lives if it looks at the skin;
// one at a time then.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/collision/limb_planning_space.h"
#include "core/editing/planning_views.h"
#include "core/editing/window_problem.h"
#include "core/planning/curve.h"
#include "core/planning/interpolation.h"
#include "core/planning/state_space.h"

namespace elbowroom {

// The curves between a window's postures; one where there are none between.
struct WindowMotion {
  std::vector<Curve> curves;
  std::vector<double> until;  // end of each, seconds

  bool empty() const { return curves.empty(); }
  const Curve& at(double t) const;
};

// The world of each part of a problem, from one posture to the next, seen in one way.
class PlanningWorld {
 public:
  PlanningWorld(WindowProblem& problem, const PlanningView& view);
  ~PlanningWorld();
  PlanningWorld(const PlanningWorld&) = delete;
  PlanningWorld& operator=(const PlanningWorld&) = delete;

  const PlanningView& view() const { return view_; }
  StateSpace& part(std::size_t index);
  // The part's rigid parts; null on the skin, or where nobody has asked for the part yet.
  LimbPlanningSpace* rigid(std::size_t index) { return rigid_[index]; }
  // What said no most often so far, "A with B"; empty if it is not known.
  std::string blocked_by() const;

 private:
  WindowProblem& problem_;
  PlanningView view_;
  std::vector<std::unique_ptr<StateSpace>> parts_;
  std::vector<LimbPlanningSpace*> rigid_;
};

// Landmarks between a window's postures, smoothed: one list for each two of them.
struct WindowPaths {
  std::vector<std::vector<Configuration>> parts;  // empty if there is none
  std::uint64_t seed = 0;
  std::string reason;  // one sentence, where there is none
};

// What a motion came to and what it cost.
struct MotionResult {
  WindowMotion motion;  // empty if there is none
  std::string reason;   // one sentence, where there is none
  int landmarks = 0;
  // Names of DOFs whose limit, or speed limit, the state at a posture forced the curve beyond; and
  // whose acceleration limit it exceeds.
  std::vector<std::string> limits_widened;
  bool keeps_accelerations = true;  // but where the clip exceeds them
};
struct PlanningCosts {
  double plan_ms = 0, smooth_ms = 0;
  long validity_checks = 0, edge_checks = 0, iterations = 0;

  void add(const CheckCounters& checks);
};

// A way around, and the curve along it: most of the time goes into the second. Costs are added to.
// Same bytes for the same problem, view, wishes and seed.
WindowPaths plan_paths(const WindowProblem& problem, PlanningWorld& world,
                       const PlanningWishes& wishes, std::uint64_t seed,
                       const std::stop_token& stop, const ProgressSink& progress,
                       PlanningCosts& costs);
MotionResult fit_motion(const WindowProblem& problem, PlanningWorld& world,
                        const WindowPaths& paths, const std::stop_token& stop,
                        const ProgressSink& progress, PlanningCosts& costs);

// Whether one motion can be turned into the other without meeting anything: every blend of the two
// is free, at each of some moments of the window. If so they are one way around with two looks; if
// not, two ways.
bool same_way_around(PlanningWorld& world, const WindowProblem& problem, const WindowMotion& a,
                     const WindowMotion& b);
bool same_way_around(PlanningWorld& world, const WindowProblem& problem, const WindowMotion& a,
                     const WindowPaths& b);

}  // namespace elbowroom
