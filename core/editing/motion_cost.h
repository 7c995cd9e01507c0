// SPDX-License-Identifier: MIT
// What a motion costs: how motions that all are free are ranked. Lower is better.
//
//   deviation     ∫ Σ (q - r)² / T      rad², from what the animator wants: the clip, moved
//                                       into the sampling intervals set
//                                       (WindowProblem::reference_at)
//   effort        ∫ Σ (q' - r')² / T    times kEffortTime², likewise rad²
//   acceleration  ∫ Σ q''² / T          times kAccelerationTime⁴: gentle turns cost little
//   hurry         how much the peak acceleration is above what is natural for the DOF
//                 (natural_acceleration), squared
//   nearness      how much of the clearance asked for is missing, squared; on the skin
//
// T is the window's length; sums are over DOFs.
#pragma once

#include "core/editing/window_motion.h"

namespace elbowroom {

struct MotionCost {
  double deviation = 0, effort = 0, acceleration = 0, hurry = 0, nearness = 0;

  double total() const { return deviation + effort + acceleration + hurry + nearness; }
};

// All but nearness, which only the skin tells.
MotionCost motion_cost(const WindowProblem& problem, const WindowMotion& motion);

// Of a path, before there is a curve along it: its deviation and effort.
double path_cost(const WindowProblem& problem, const WindowPaths& paths);

double nearness_cost(double clearance, double wanted);

// The acceleration of a quick but ordinary movement, rad/s². In a minimum-jerk movement of duration
// D the peak acceleration is 3.08 / D times the peak speed (Flash and Hogan 1985); the DOF's speed
// limit is taken as the peak of one that lasts 0.4 s.
double natural_acceleration(const Dof& dof);

}  // namespace elbowroom
