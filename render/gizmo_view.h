// SPDX-License-Identifier: MIT
// What drawing and dragging a gizmo share.
#pragma once

#include "render/gizmo.h"

namespace elbowroom {

bool is_finite(const Vec3& v);
bool is_finite(const glm::dvec2& v);
// Unit; the identity if it is not finite or has no length.
Quat sound_rotation(const Quat& q);
// Axis 0, 1 or 2 of a pose in the world.
Vec3 gizmo_axis(const Quat& rotation, GizmoSpace space, int axis);
// World length of an arm of `size` pixels at a place: never so long that it reaches the eye.
double arm_length(const GizmoView& view, const Vec3& place, double size);
glm::dvec2 pixel_of(const GizmoView& view, const Vec3& place);

inline constexpr int kRingPoints = 96;
inline constexpr double kRingRadius = 0.9;  // of the arm
inline constexpr double kViewRing = 1.06;   // of the arm
inline constexpr double kPi2 = 2.0 * kPi;

}  // namespace elbowroom
