// SPDX-License-Identifier: MIT
// The numeric types of the core and the few rotation helpers that every folder needs.
//
// Core computes in double; float appears only where a file, a GPU or a ray does. Quaternions are
// Hamilton, unit, (w, x, y, z) in GLM's constructor; a rotation vector is axis × angle in radians.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace elbowroom {

using Vec3 = glm::dvec3;
using Quat = glm::dquat;
using Mat3 = glm::dmat3;
using Mat4 = glm::dmat4;

inline constexpr double kPi = 3.14159265358979323846;

// Unit quaternion of a rotation vector (radians). exp(0) is the identity.
inline Quat quat_from_rotation_vector(const Vec3& v) {
  const double angle = glm::length(v);
  const double half = 0.5 * angle;
  // sin(x)/x by its series where the division would lose digits.
  const double k = angle < 1e-6 ? 0.5 - half * half / 12.0 : std::sin(half) / angle;
  return glm::normalize(Quat(std::cos(half), k * v.x, k * v.y, k * v.z));
}

// Rotation vector of a unit quaternion, length in [0, pi]: of the two signs the nearer one is
// taken.
inline Vec3 rotation_vector_from_quat(Quat q) {
  if (q.w < 0) q = Quat(-q.w, -q.x, -q.y, -q.z);
  const Vec3 axis(q.x, q.y, q.z);
  const double s = glm::length(axis);
  const double angle = 2.0 * std::atan2(s, q.w);
  return s < 1e-12 ? 2.0 * axis : axis * (angle / s);
}

// Angle in radians, [0, pi], of the rotation that takes a to b; both unit. Accurate near 0.
inline double angle_between(const Quat& a, const Quat& b) {
  return glm::length(rotation_vector_from_quat(glm::conjugate(a) * b));
}

// The shortest rotation that takes unit vector a to unit vector b. For opposite vectors the axis
// is any one across a (a fixed choice, so that results repeat).
inline Quat shortest_rotation(const Vec3& a, const Vec3& b) {
  const double d = glm::dot(a, b);
  if (d < -1.0 + 1e-12) {
    const Vec3 other = std::abs(a.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 axis = glm::normalize(glm::cross(a, other));
    return Quat(0, axis.x, axis.y, axis.z);
  }
  const Vec3 c = glm::cross(a, b);
  return glm::normalize(Quat(1.0 + d, c.x, c.y, c.z));
}

// Slerp along the shorter way, u in [0, 1]; exact at both ends (up to sign).
inline Quat slerp_shortest(const Quat& a, Quat b, double u) {
  if (glm::dot(a, b) < 0) b = Quat(-b.w, -b.x, -b.y, -b.z);
  const double d = std::fmin(1.0, glm::dot(a, b));
  const double angle = std::acos(d);
  if (angle < 1e-6) return glm::normalize(a * (1.0 - u) + b * u);
  const double s = std::sin(angle);
  return glm::normalize(a * (std::sin((1.0 - u) * angle) / s) + b * (std::sin(u * angle) / s));
}

}  // namespace elbowroom
