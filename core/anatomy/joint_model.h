// SPDX-License-Identifier: MIT
// One joint's model [SKF07 4.2]: between its local rotation and numbers that mean the same on every
// rig. The order of the product and its derivation stand here and nowhere else.
//
// For each of a limb's joints the local rotation (parent_from_joint) is
//
//     R = P · M(q) · E · C⁻¹          ball   M = S(q0, q1) · T(q2)    shoulder, hip
//                                     hinge  M = F(q0) · T(q1)        elbow, knee
//                                     swing  M = S(q0, q1)            wrist, ankle
//                                     fixed  M = 1                    an end that turns nothing
//
// C is the anatomical frame in the joint's own axes: x along the bone to the next joint (at the
// ankle: on along the shin), z the flexion axis, y = z × x, which is where flexion moves the bone's
// end. P is the same frame at the zero pose in the parent's axes. T(a) turns about x, F(a) about z,
// S(a, b) is the rotation of rotation vector (0, a, b), across the bone.
//
// Why in this order: M stands between two frames that are alike on every rig, so its numbers are
// free of the rig's own bone axes; the residual E stands after M, on the side of the bone, so that
// the bone's direction M·x is the model's alone for a ball and a swing, and E of a hinge is just
// the tilt of the bone out of the plane of flexion.
//
// Mirrored poses have equal numbers. A mirror maps the polar vectors x and y to the other side's x
// and y, but z = x × y to minus the other side's z. A rotation by θ about axis a becomes, mirrored,
// one by θ about minus the mirror image of a: about z the sign stays, about x and y it turns. So
// `side` = −1 negates the angle of T and the first number of S, and twist is positive inward on
// both sides. In a parent space that is itself mirrored (a negative scale above) it is negated once
// more.
//
// Angles are radians. Pure functions, any thread, no allocation. Inputs are unit quaternions.
#pragma once

#include "core/base/math.h"

namespace elbowroom {

enum class JointModelKind { ball, hinge, swing, fixed };

struct JointModel {
  JointModelKind kind = JointModelKind::ball;
  int joint = -1;                       // node index
  int first_dof = 0;                    // index in the limb's parameters
  Quat parent_from_zero{1, 0, 0, 0};    // P
  Quat joint_from_anatomy{1, 0, 0, 0};  // C
  double side = 1;                      // -1 on the right side: sign of twist and first swing

  int dof_count() const {
    if (kind == JointModelKind::fixed) return 0;
    return kind == JointModelKind::ball ? 3 : 2;
  }
};

// M(q) for the joint's own numbers, dof_count() of them.
Quat joint_rotation(const JointModel& model, const double* q);

// R = P · M(q) · E · C⁻¹.
Quat local_rotation(const JointModel& model, const double* q, const Quat& residual);

// The inverse, exact: local_rotation of what it gives is `local` up to rounding (and sign). Every
// number is in [-pi, pi], a swing's length too. What is left for E is smallest in the sense of each
// model: the identity for a ball; for a hinge the tilt of the bone out of the plane of flexion,
// with no twist about the bone; pure twist about the bone for a swing; all of it for a fixed joint.
// At the singular poses (a swing by pi, a bone along a hinge's axis) a finite choice is made.
void decompose(const JointModel& model, const Quat& local, double* q, Quat& residual);

}  // namespace elbowroom
