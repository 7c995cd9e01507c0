// SPDX-License-Identifier: MIT
// Whether keys still bring a limb's end to the target that they were planned to.
#pragma once

#include <memory>
#include <string>

#include "core/editing/window_problem.h"

namespace elbowroom {

// How far the limb's end is from the target at its time in a clip that lies over the problem's, for
// people; empty if it is there, to 1e-4 of the limb's length and 1e-3 rad. A target that keeps the
// hand's orientation keeps that of the problem's clip. The scene plays the problem's clip
// afterwards.
std::string missed_target(const WindowProblem& problem, const HandTarget& target,
                          const std::shared_ptr<const Clip>& clip);

}  // namespace elbowroom
