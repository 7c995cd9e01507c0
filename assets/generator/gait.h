// SPDX-License-Identifier: MIT
// Level walking at natural cadence from published measurements, as smooth periodic curves over the
// gait cycle: phase 0 is the heel contact of the leg in question, 1 the next one.
//
// Sources (figures rounded to key points; degrees):
//  - knee and ankle: D. A. Winter, The Biomechanics and Motor Control of Human Gait, 2nd ed., 1991,
//    natural cadence, ensemble averages;
//  - thigh against the vertical, foot against the ground, pelvis: J. Perry and J. M. Burnfield,
//  Gait
//    Analysis, 2nd ed., 2010; M. P. Murray, A. B. Drought, R. C. Kory, Walking patterns of normal
//    men, J. Bone Joint Surg. 46-A, 1964;
//  - shoulder and elbow: M. P. Murray, S. B. Sepic, E. J. Barnard, Patterns of sagittal rotation of
//    the upper limbs in walking, Phys. Ther. 47, 1967.
#pragma once

#include <vector>

#include "core/base/math.h"

namespace elbowroom::demo {

// A periodic cubic spline (C2) of period 1 through key points.
class PeriodicCurve {
 public:
  struct Key {
    double phase, value;
  };
  // At least three keys, phases ascending in [0, 1).
  explicit PeriodicCurve(const std::vector<Key>& keys, double scale = 1.0);
  double operator()(double phase) const;

 private:
  std::vector<Key> keys_;
  std::vector<double> curvature_;  // second derivative at each key
};

struct Gait {
  // Radians. Hip: the thigh against the vertical, forward positive; knee: flexion; ankle:
  // dorsiflexion positive; foot: pitch of the sole, toes up positive.
  PeriodicCurve hip, knee, ankle, foot;
  PeriodicCurve shoulder, elbow;  // flexion; phase of the leg on the same side
  double toe_off = 0.61;          // end of stance
  double period = 1.10;           // seconds a stride: 109 steps a minute
  // Of the pelvis, peak values: rotation about the vertical, drop towards the swinging leg, sway to
  // the stance leg.
  double pelvis_rotation = 4.5 * kPi / 180, pelvis_drop = 3.5 * kPi / 180;
  double pelvis_sway = 0.020;               // metres
  double trunk_rotation = 3.5 * kPi / 180;  // of the shoulders, against the pelvis's
};

Gait natural_gait();

}  // namespace elbowroom::demo
