// SPDX-License-Identifier: MIT
// What a clip does with a limb, in the limb's own parameters: its state at a time, and how fast its
// parameters change there (the velocity that a correction has to meet at its window's ends).
//
// Only the limb joints' rotation channels are sampled; joints without one have their rest rotation.
// Times are seconds of the clip's clock, outside its keys a channel clamps. Pure, any thread.
#pragma once

#include "core/anatomy/limb_model.h"
#include "core/scene/model.h"

namespace elbowroom {

// Distance of the samples that limb_rates_at takes, seconds.
inline constexpr double kRateStep = 1e-4;

// limb_state() of the clip's pose at t.
LimbState limb_state_at(const LimbModel& limb, const Model& model, const Clip& clip, double t,
                        const LimbState* previous = nullptr);

// One-sided time derivative of the parameters at t, rad/s: from before t for side < 0, from after
// it for side > 0. At a key the two differ; where the clip steps neither sees the step.
Dofs limb_rates_at(const LimbModel& limb, const Model& model, const Clip& clip, double t, int side);

}  // namespace elbowroom
