// SPDX-License-Identifier: MIT
#include "core/editing/limb_track.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

constexpr double kSampleRate = 240;  // Hz, dense enough that no DOF turns by pi between two
constexpr double kAccelerationStep = 1.0 / 30;  // s
constexpr double kDifferenceStep = 1.0e-4;  // s, well inside a key interval, well above rounding

}  // namespace

LimbTrack::LimbTrack(const Model& model, const Clip& clip, const LimbModel& limb, double begin,
                     double end)
    : model_(&model), clip_(&clip), limb_(&limb), begin_(begin), end_(end) {
  rest_ = rest_pose(model.skeleton);
  const auto steps =
      static_cast<std::size_t>(std::ceil(std::max(1.0, (end - begin) * kSampleRate)));
  step_ = (end - begin) / static_cast<double>(steps);
  samples_.reserve(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i)
    samples_.push_back(
        sample(begin + step_ * static_cast<double>(i), i ? &samples_.back() : nullptr));
  peak_speed_.count = limb.dof_count();
  if (step_ <= 0) return;
  for (std::size_t i = 1; i < samples_.size(); ++i)
    for (int d = 0; d < peak_speed_.count; ++d)
      peak_speed_[d] =
          std::max(peak_speed_[d], std::abs(samples_[i].q[d] - samples_[i - 1].q[d]) / step_);
}

LimbState LimbTrack::sample(double t, const LimbState* previous) const {
  Pose pose = rest_;
  sample_clip(*clip_, t, pose);
  return limb_state(*limb_, pose, previous);
}

LimbState LimbTrack::at(double t) const {
  t = std::clamp(t, begin_, end_);
  const double position = step_ > 0 ? (t - begin_) / step_ : 0;
  const auto nearest =
      std::min(static_cast<std::size_t>(std::lround(position)), samples_.size() - 1);
  return sample(t, &samples_[nearest]);
}

Dofs LimbTrack::rate(double t, int side) const {
  const LimbState here = at(t);
  const double h = side < 0 ? -kDifferenceStep : kDifferenceStep;
  const LimbState there = sample(t + h, &here);
  Dofs rate = here.q;
  for (int d = 0; d < rate.count; ++d) rate[d] = (there.q[d] - here.q[d]) / h;
  return rate;
}

Dofs LimbTrack::acceleration(double t) const {
  const LimbState here = at(t);
  const double h = std::min({kAccelerationStep, std::max(kDifferenceStep, t - clip_->begin),
                             std::max(kDifferenceStep, clip_->end - t)});
  const LimbState before = sample(t - h, &here), after = sample(t + h, &here);
  Dofs acceleration = here.q;
  for (int d = 0; d < acceleration.count; ++d)
    acceleration[d] = (before.q[d] - 2 * here.q[d] + after.q[d]) / (h * h);
  return acceleration;
}

}  // namespace elbowroom
