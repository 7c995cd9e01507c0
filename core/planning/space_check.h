// SPDX-License-Identifier: MIT
// Whether what a planning query rests on makes sense: the guard against hostile input shared by
// search, smoothing and curve.
#pragma once

#include <string>
#include <vector>

#include "core/planning/state_space.h"

namespace elbowroom {

// What is wrong with a DOF space, one sentence; empty if nothing is. Asked for: 1 to kMaxDofs DOFs,
// finite limits in order, sampling intervals inside them, positive finite speed limits, positive
// acceleration limits (infinite: none), ellipses of existing DOFs with positive half-axes.
std::string dof_space_fault(const DofSpace& space);

// What is wrong with values of that space (count, NaN, infinity); empty if nothing is.
std::string dofs_fault(const DofSpace& space, const Dofs& q);

// The same for a configuration, its time included.
std::string configuration_fault(const DofSpace& space, const Configuration& c);

// What limit q breaks, one sentence that names the DOF; empty if none, within 1e-9.
std::string limit_fault(const DofSpace& space, const Dofs& q);

// What is wrong with a path: no or one landmark, times that do not ascend, DOF counts that differ,
// values that are not finite; empty if nothing is.
std::string path_fault(const std::vector<Configuration>& path);

}  // namespace elbowroom
