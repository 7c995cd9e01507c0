// SPDX-License-Identifier: MIT
// The joint models of one limb [SKF07 4.2]: between the local rotations of a rig's joints and
// numbers that mean the same on every rig.
//
// For each of the limb's joints the local rotation is
//
//     R = P · M(q) · E · C⁻¹          M: ball  S(q0, q1) · T(q2)      shoulder, hip
//                                        hinge  F(q0) · T(q1)          elbow, knee
//                                        swing  S(q0, q1)              wrist, ankle
//
// where C holds the anatomical frame in the joint's own axes (x along the bone to the next joint,
// z the flexion axis, y = z × x: where flexion moves the bone's end), P the same frame at the zero
// pose in the parent's axes, E is the residual (what M cannot express, identity in a perfect fit),
// T(a) turns about x, F(a) about z, and S(a, b) is the rotation vector (0, a, b) across the bone.
// On the right side T's and S's first number change sign, so that numbers are equal for mirrored
// poses ("twist is positive inward"). The residual stands in this one place, after M, always.
//
// Spaces: rotations are local (parent_from_joint). Units: radians. All functions are pure; a
// LimbModel is immutable and may be shared between threads.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/anatomy/limb.h"
#include "core/animation/clip.h"
#include "core/base/dof_space.h"

namespace elbowroom {

enum class JointModelKind { ball, hinge, swing };

struct JointModel {
  JointModelKind kind = JointModelKind::ball;
  int joint = -1;                    // node index
  int first_dof = 0;                 // index in the limb's parameters
  Quat parent_from_zero{1, 0, 0, 0};   // P
  Quat joint_from_anatomy{1, 0, 0, 0};  // C
  double side = 1;                   // -1 on the right side: sign of twist and of the first swing
  int dof_count() const { return kind == JointModelKind::ball ? 3 : 2; }
};

// M(q) for the joint's own numbers.
Quat joint_rotation(const JointModel& model, const double* q);
// R = P · M(q) · E · C⁻¹.
Quat local_rotation(const JointModel& model, const double* q, const Quat& residual);
// The inverse: q and the residual of a local rotation; exact, and E is smallest in the sense of
// each model (no twist left in a hinge's, pure twist in a swing's, identity in a ball's).
void decompose(const JointModel& model, const Quat& local, double* q, Quat& residual);

// A joint between the limb's own (a twist or helper bone): its local rotation relative to what the
// clip has is kept.
struct DrivenJoint {
  int joint = -1;
  int serves = -1;  // node index of the limb joint it follows
};

struct LimbModel {
  Limb limb;
  std::array<JointModel, 3> joints;  // root, middle, end
  std::vector<DrivenJoint> driven;
  DofSpace space;                    // names, limits, default sampling intervals, speed limits
  std::string flexion_axis_from;     // how the middle joint's axis was found, for people

  int dof_count() const { return space.count(); }
};

struct LimbState {
  Dofs q;
  std::array<Quat, 3> residual{Quat(1, 0, 0, 0), Quat(1, 0, 0, 0), Quat(1, 0, 0, 0)};
};

// Fits the limb's joint models to a rig: frames from the body's axes, bind pose, hand and foot, and
// what the joints do in the model's clips. Error: degenerate bones (zero length and the like).
Result<LimbModel> fit_limb_model(const Model& model, const Character& character, const Limb& limb,
                                 const LimbFindings& findings);

// Parameters and residuals of the limb in a pose; near `previous` where numbers could jump by a
// turn (twist), if given.
LimbState limb_state(const LimbModel& limb, const Pose& pose, const LimbState* previous = nullptr);

// Writes the limb joints' local rotations into the pose (nothing else of it changes).
void apply_limb_state(const LimbModel& limb, const LimbState& state, Pose& pose);

// For people: shoulder raise (0 hanging, 90° level, 180° overhead) and forward (0 to the side, 90°
// straight ahead) of a root joint's swing, radians.
struct Elevation {
  double raise = 0, forward = 0;
};
Elevation elevation(const LimbModel& limb, const Dofs& q);

}  // namespace elbowroom
