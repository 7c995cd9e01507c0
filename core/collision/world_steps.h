// SPDX-License-Identifier: MIT
// Instants at which a world steps: STEP keys of what any actor plays, attachments that begin or
// end. No continuous bound crosses them, and both sides are tested (DESIGN.md, "Interpolation").
#pragma once

#include <vector>

#include "core/scene/world.h"

namespace elbowroom {

// Within [begin, end], ascending, unique; seconds. At a STEP key the new value holds already; an
// attachment holds at both its ends, so the instant it ends is followed by the step.
std::vector<double> world_steps(const World& world, double begin, double end);

// The last time before t and the first after it that differ from it.
double just_before(double t);
double just_after(double t);

}  // namespace elbowroom
