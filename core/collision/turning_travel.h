// SPDX-License-Identifier: MIT
// How far what hangs on a chain of joints can get while the joints' numbers change evenly, from
// where it is at the middle of an interval.
//
// Adding up what each joint may do alone takes no notice of the way: an elbow that bends while the
// shoulder gives way counts twice. To the first order what the joints do is one turn, whose vectors
// add up; what is beyond the first order is bounded. For h, half the interval, joint k at o_k, a
// point p there at the middle, r_k = |p − o_k|:
//
//     |p(t) − p| ≤ |Σ_k h ω_k × (p − o_k)| + Σ_k r_k (¾ θ_k² + ½ τ_k² + Θ_k (θ_k + τ_k))
//                  + Σ_k (lift_k + loose_k r_k)
//
// ω_k are angular velocities at the middle; θ_k and τ_k how far the swing's numbers and the twist
// get; Θ_k the sum of all angles outside the factor in question.
//
// Derivation. The place is a product of motions, outermost first; changing them one by one, each
// adds A (F − 1) r, where F is how the factor turns and A, of an angle of at most Θ, how those
// outside it do: |A v − v| ≤ Θ |v|. A twist turns evenly about an axis that keeps:
// |(F − 1) r − φ × r| ≤ ½ φ² r. A swing is exp(u) with u even, so it turns at J(u) u', where
// J(u) = ∫ exp(αu) dα over [0, 1]: never faster than |u'|, and in any direction J changes by no
// more than ½ |du|. From v' = ω × F r then |v − h ω × r| ≤ (½ · ½ + ½) |u'|² h² r. The first sum is
// the length of an affine function of p, so it is largest at a corner of a box.
//
// Scene units, radians. Pure functions, any thread.
#pragma once

#include <span>

#include "core/anatomy/joint_model.h"
#include "core/base/math.h"

namespace elbowroom {

// What one joint does within half an interval.
struct TurningJoint {
  Vec3 origin{0.0};             // o_k, world
  Vec3 swing{0.0}, twist{0.0};  // h ω_k, world: of a swing or flexion, and of a twist
  double swing_angle = 0;       // θ_k ≥ |swing|; τ_k is |twist|
  double loose = 0;             // of any other rotation of the joint, about whatever axis
  double lift = 0;              // that its origin gets towards what it hangs from
};

// Swing and twist of a joint whose numbers are `q` at the middle and change by `rate` a second for
// `half` seconds to both sides. `world_from_bone`: the rotation of the frame after M
// (joint_model.h) at the middle.
void set_turn(TurningJoint& turn, const JointModel& model, const double* q, const double* rate,
              double half, const Mat3& world_from_bone);

// A part lies within both, at the middle.
struct TurningPart {
  Vec3 centre{0.0};          // world
  double radius = 0;         // of a sphere about it
  Mat3 half{0.0};            // of a box about it: half its edges, world
  double twist_radius = -1;  // about the last joint's twist axis, if it is known
};

// The least of that bound and of what each joint may do alone. `joints`: those that move the part
// in the frame that is asked about, outermost first.
double turning_travel(std::span<const TurningJoint* const> joints, const TurningPart& part);

}  // namespace elbowroom
