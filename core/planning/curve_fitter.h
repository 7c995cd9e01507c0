// SPDX-License-Identifier: MIT
// The work of fit_curve(): a curve along a path (curve_follow.cpp), and its fairing
// (curve_fair.cpp). Private to the planning folder.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/random.h"
#include "core/planning/curve_energy.h"
#include "core/planning/curve_fit.h"
#include "core/planning/curve_limits.h"

namespace elbowroom {

class CurveFitter {
 public:
  CurveFitter(StateSpace& world, const CurveQuery& query, const CurveSettings& settings,
              std::stop_token stop, const ProgressSink& progress, CurveResult& result)
      : world_(world),
        query_(query),
        settings_(settings),
        stop_(std::move(stop)),
        progress_(progress),
        result_(result),
        limits_(*query.space),
        trial_resolution_(settings.trial_resolution),
        start_(std::chrono::steady_clock::now()) {
    const double window = query.path.back().t - query.path.front().t;
    const int spans = std::max(4, static_cast<int>(std::lround(window / settings.knot_spacing)));
    for (int i = 0; i <= spans; ++i) {
      breakpoints_.push_back(i == spans ? query.path.back().t
                                        : query.path.front().t + window * i / spans);
    }
  }

  // A valid curve: the smoothest one that is held to the path at as few control points as
  // collisions and limits ask for. Where holding all of them is not enough, knots are added.
  enum class Followed { yes, no, stopped };
  Followed follow_path();

  // Lowers the energy by valid steps, and then, where acceleration limits are exceeded, by how
  // much; false on a stop. What is left stands confirmed.
  bool fair();

  void report();

 private:
  // What is wrong with the curve: control points first ... last act on the place at fault, in spans
  // first_span ... last_span.
  struct Fault {
    int first = 0, last = -1;
    int first_span = 0, last_span = -1;
    double time = 0;         // of the place
    bool collision = false;  // or else a limit is broken
    bool none() const { return last < first; }
  };

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  int count() const { return static_cast<int>(curve_.control.size()); }
  int dofs() const { return query_.space->count(); }
  int fixed_at_begin() const { return query_.acceleration_init ? 3 : 2; }
  int fixed_at_end() const { return query_.acceleration_goal ? 3 : 2; }
  double knot(int i) const { return curve_.knots[static_cast<std::size_t>(i)]; }
  Dofs& control(int i) { return curve_.control[static_cast<std::size_t>(i)]; }

  // Control points on the path at their Greville abscissae, which makes the differences of control
  // points slopes of the path; those at the ends as values, velocities and accelerations ask.
  void place_on_path();

  // Next to the ends the path may be too fast to be caught up with: the first free control points
  // are drawn into the cone of speeds of their neighbours, from both ends.
  void slow_down();

  // Minimizes the energy with some control points held to the path: none at first, then one more
  // wherever the minimum collides or breaks a limit. False, with the spans at fault marked, when
  // all that act on such a place are held already; or on a stop.
  bool hold_to_path(std::vector<bool>& bad);

  // Where even the path itself collides (its tests missed something thin, or its corner is cut
  // there), a small common shift of the control points that act on the place often helps. True,
  // with d shifted, if one was found.
  bool nudge(const Fault& fault, std::vector<Dofs>& d, Random& random);

  // A curve tested at the resolution that is promised.
  struct Kept {
    std::vector<Dofs> control, offsets;
    double energy = 0;
    CurveLimits::Strain strain;
    std::int64_t accepted = 0;
  };
  void keep() { kept_ = {curve_.control, offsets_, result_.energy, strain_, result_.accepted}; }

  // Tests what has changed since the last curve kept; keeps it, or goes back to that one.
  void confirm();

  // The first thing wrong with control points first ... last and the curve they act on.
  Fault find_fault(int first, int last, const EdgeResolution& resolution);

  // Of the control points that act on the fault and are not held, the one nearest to it; or -1.
  int nearest_free(const std::vector<bool>& held, const Fault& fault) const;

  void set_offsets(const std::vector<Dofs>& d, int first, int last);

  // Halves the spans marked and their neighbours; false if none can be halved.
  bool refine(const std::vector<bool>& bad);

  void prepare_energy();

  bool goes_on(std::int64_t trial, std::int64_t most);

  // One trial: a stretch of control points, all DOFs or one, towards the minimum of the energy, or
  // `everything` there is. Where that collides, a control point is first held half-way, then where
  // it was, and the others go on. A step that is to be gentler is about the place where an
  // acceleration limit is exceeded most, towards where accelerations weigh more.
  enum class Step { smoother, gentler, smoother_as_gentle };
  bool try_step(Random& random, Step step, bool everything);

  // Acceleration limits are exceeded no more than before, or less.
  bool is_gentler(bool by_much) const;

  StateSpace& world_;
  const CurveQuery& query_;
  const CurveSettings& settings_;
  std::stop_token stop_;
  const ProgressSink& progress_;
  CurveResult& result_;
  CurveLimits limits_;
  EdgeResolution trial_resolution_;
  std::chrono::steady_clock::time_point start_;
  std::vector<double> breakpoints_;
  Curve curve_;
  BandMatrix energy_matrix_, relief_matrix_;
  std::vector<Dofs> reference_;  // the clip's control points, smoothed; 0 without a clip
  std::vector<Dofs> offsets_;    // control points less those of the reference
  Kept kept_;
  CurveLimits::Strain strain_;
  std::chrono::steady_clock::time_point told_ = start_;  // of progress
  int taken_back_ = 0;
  std::vector<double> suspects_;  // times of recent collisions, latest first
};

}  // namespace elbowroom
