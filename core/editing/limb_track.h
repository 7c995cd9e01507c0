// SPDX-License-Identifier: MIT
// What a clip does with one limb over a window, in the limb's own parameters: continuous in time
// (no jumps by a turn), exact at any t.
//
// Immutable once built; safe to share between threads. Keeps references to model, clip and limb.
#pragma once

#include <vector>

#include "core/anatomy/limb_model.h"
#include "core/scene/model.h"

namespace elbowroom {

class LimbTrack {
 public:
  // [begin, end] in seconds of the clip's clock.
  LimbTrack(const Model& model, const Clip& clip, const LimbModel& limb, double begin, double end);

  // Parameters and residuals at t, unwrapped along the window. t outside is clamped to it.
  LimbState at(double t) const;

  // One-sided time derivative of the parameters, rad/s: side < 0 from before t, > 0 from after it.
  Dofs rate(double t, int side) const;

  // Second time derivative, rad/s², as far as an eye sees it: over two thirtieths of a second, for
  // the keys of a clip are corners of a curve that has none. t well inside the clip.
  Dofs acceleration(double t) const;

  // Largest |dq/dt| of each DOF over the window, rad/s.
  const Dofs& peak_speed() const { return peak_speed_; }

  double begin() const { return begin_; }
  double end() const { return end_; }

 private:
  LimbState sample(double t, const LimbState* previous) const;

  const Model* model_;
  const Clip* clip_;
  const LimbModel* limb_;
  double begin_, end_, step_;
  Pose rest_;
  std::vector<LimbState> samples_;  // every step_ from begin_
  Dofs peak_speed_;
};

}  // namespace elbowroom
