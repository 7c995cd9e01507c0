// SPDX-License-Identifier: MIT
// Default limits, sampling intervals, speed limits and names of a limb's DOFs.
//
// Limits are the ranges of joint motion of healthy adults, carried over into the parameters of the
// joint models (whose zero poses are in limits.cpp beside the figures); a clip that exceeds them
// widens them for its query (DofSpace::widen_to). Sources, figures in degrees at their place in
// limits.cpp:
//   Boone, Azen: Normal range of motion of joints in male subjects. J Bone Joint Surg Am 61 (1979).
//   American Academy of Orthopaedic Surgeons: Joint Motion, Method of Measuring and Recording
//   (1965). Kapandji: The Physiology of the Joints (rotation of the bent knee).
// Speed limits are those of brisk everyday motion up to running and ball games, well below the
// fastest that people were measured at:
//   Jessop, Pain: Maximum velocities in flexion and extension actions for sport. J Human Kinetics
//   50 (2016): up to 50 rad/s at the wrist, 28 rad/s at the knee. Novacheck: The biomechanics of
//   running. Gait and Posture 7 (1998).
// Acceleration limits are what such a speed asks for in the briefest movement: in a minimum-jerk
// movement of duration D the peak acceleration is 3.08 / D times the peak speed (Flash, Hogan: The
// coordination of arm movements. J Neuroscience 5 (1985)); D is 0.15 s.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/anatomy/joint_model.h"
#include "core/anatomy/limb.h"
#include "core/anatomy/limb_model.h"
#include "core/base/dof_space.h"
#include "core/base/swing_polygon.h"

namespace elbowroom {

// Peak acceleration times duration over peak speed, of a minimum-jerk movement.
inline constexpr double kMinimumJerkRatio = 3.08;

enum class LimbJointRole { root, middle, end };

// Zero direction of a root's bone, in the body's axes (outward: away from the middle of the body on
// the limb's side), unit; in the middle of the swing range, so that the opposite direction, where a
// swing is singular, points into the trunk. For arms and legs only.
struct ZeroDirection {
  double outward = 0, up = 0, forward = 0;
};
ZeroDirection zero_direction(bool arm);

// Appends the DOFs (and the ellipse, if it has one) of one joint. `first_dof` of the model must be
// the number of DOFs there are. `joint_name` names those of a chain that is no arm or leg.
void append_dofs(LimbKind kind, LimbJointRole role, const JointModel& model,
                 const std::string& joint_name, DofSpace& space);

// Bounds the swing of a joint of a limb by a polygon (core/base/swing_polygon.h) in place of the
// one it has; its ellipse is dropped unless `keep_ellipse`, and its ranges become the polygon's,
// sampling intervals no wider. Corners are (first swing, second swing): of a shoulder up and
// forward of the zero pose. Error: a joint without a swing, a corner at half a turn or beyond, or
// no such polygon; the limb is unchanged then.
Status set_swing_polygon(LimbModel& limb, LimbJointRole role, const SwingPolygon& corners,
                         bool keep_ellipse = false);

// Corners on the ellipse that a joint's swing has, within its ranges, a start for editing; empty
// without one.
SwingPolygon polygon_of_ellipse(const LimbModel& limb, LimbJointRole role, int corners = 12);

// The same for any joint that swings: where it has no ellipse, the corners of its ranges. A polygon
// that can be edited (core/base/swing_polygon.h), or empty where the ranges leave no room for one.
SwingPolygon swing_polygon_of(const LimbModel& limb, LimbJointRole role, int corners = 12);

}  // namespace elbowroom
