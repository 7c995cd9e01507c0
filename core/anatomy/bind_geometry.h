// SPDX-License-Identifier: MIT
// Small questions about a character in its bind pose, shared by the finding of limbs, the body's
// axes and the fit of joint models. World space is the file's. Any thread.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/model.h"

namespace elbowroom {

// Origin of a joint.
inline Vec3 origin(const std::vector<Mat4>& globals, int joint) {
  return Vec3(globals[static_cast<std::size_t>(joint)][3]);
}

inline bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// v at length 1; nothing if it has none (or isn't finite).
std::optional<Vec3> direction(const Vec3& v);

// The part of v across the unit vector `axis`, at length 1; nothing if v is along it.
std::optional<Vec3> direction_across(const Vec3& v, const Vec3& axis);

// Right-handed frame with the unit vector `x` as its x and y as near to `y` as it can be; nothing
// if they are along each other.
std::optional<Quat> frame_of(const Vec3& x, const Vec3& y);

// The level direction (across the file's up) in which places spread most, unit, not towards -x.
Vec3 widest_way(const std::vector<Vec3>& places);

// Whether a skin of the character uses the joint.
bool is_skin_joint(const Character& character, int joint);

// Whether turning the joint would move anything: a skin uses it or a joint below it, or a mesh
// hangs below it.
bool moves_something(const Model& model, const Character& character, int joint);

}  // namespace elbowroom
