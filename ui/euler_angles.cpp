// SPDX-License-Identifier: MIT
#include "ui/euler_angles.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace elbowroom {
namespace {

constexpr double kDegrees = 180 / kPi;
constexpr double kSame = 1e-6;  // rad, between rotations that are the same
// Nearer to ±90° than this, X and Z can't be told apart: the cosine they are divided by is noise.
constexpr double kLocked = 1e-7;

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The same turn, as near to `shown` as whole turns bring it.
double unwound(double degrees, double shown) {
  return degrees + 360 * std::round((shown - degrees) / 360);
}

Vec3 unwound(const Vec3& degrees, const Vec3& shown) {
  return {unwound(degrees.x, shown.x), unwound(degrees.y, shown.y), unwound(degrees.z, shown.z)};
}

double distance(const Vec3& a, const Vec3& b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
}

}  // namespace

Quat from_euler_degrees(const Vec3& degrees) { return Quat(degrees / kDegrees); }

Vec3 euler_degrees_near(const Quat& rotation, const Vec3& shown) {
  const double length = glm::length(rotation);
  if (!std::isfinite(length) || length < 1e-9) return Vec3(0);
  const Vec3 near = finite(shown) ? shown : Vec3(0);
  const Quat q = rotation / length;
  if (angle_between(q, from_euler_degrees(near)) < kSame) return near;
  const glm::dmat3 m = glm::mat3_cast(q);  // m[column][row]
  // Rz Ry Rx: the first column is (cz cy, sz cy, -sy), the last row (-sy, cy sx, cy cx).
  const double cos_y = std::hypot(m[1][2], m[2][2]);
  const double y = std::atan2(-m[0][2], cos_y);
  if (cos_y < kLocked) {
    // Only x ∓ z is known: with x as shown, m = Rz Ry Rx gives Rz = m Rx⁻¹ Ry⁻¹.
    const Quat rest = q * glm::conjugate(from_euler_degrees({near.x, y * kDegrees, 0}));
    const double z = 2 * std::atan2(rest.z, rest.w);
    return unwound(Vec3(near.x, y * kDegrees, z * kDegrees), near);
  }
  const Vec3 one = Vec3(std::atan2(m[1][2], m[2][2]), y, std::atan2(m[0][1], m[0][0])) * kDegrees;
  const Vec3 other(one.x + 180, 180 - one.y, one.z + 180);
  const Vec3 a = unwound(one, near), b = unwound(other, near);
  return distance(a, near) <= distance(b, near) ? a : b;
}

}  // namespace elbowroom
