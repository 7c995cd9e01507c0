// SPDX-License-Identifier: MIT
// From a curve in joint-model parameters to the keys of the limb's joints, as a file holds them.
#pragma once

#include <functional>
#include <vector>

#include "core/anatomy/limb_model.h"
#include "core/editing/document.h"

namespace elbowroom {

// Residuals of a window: from their value at its begin to that at its end by slerp (DESIGN.md,
// "Residual").
std::array<Quat, 3> residual_between(const LimbState& at_init, const LimbState& at_goal, double u);

// Keys at each of `stops` (ascending, the window's ends first and last), and evenly between them at
// `rate` Hz or a little denser; times are strictly increasing float32. `q` gives the parameters at
// a time. Derivatives (for cubic channels) are central differences of the same function.
std::vector<JointKeys> make_limb_keys(const Skeleton& skeleton, const LimbModel& limb,
                                      const std::function<Dofs(double)>& q,
                                      const LimbState& at_init, const LimbState& at_goal,
                                      const std::vector<double>& stops, double rate);

}  // namespace elbowroom
