// SPDX-License-Identifier: MIT
#include "core/animation/skeleton.h"

#include <algorithm>
#include <cstddef>

#include "core/animation/affine.h"

namespace elbowroom {

Mat4 Transform::matrix() const {
  const Mat3 r = glm::mat3_cast(rotation);
  return Mat4(glm::dvec4(r[0] * scale.x, 0.0), glm::dvec4(r[1] * scale.y, 0.0),
              glm::dvec4(r[2] * scale.z, 0.0), glm::dvec4(translation, 1.0));
}

int Skeleton::find(const std::string& name) const {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

bool Skeleton::is_within(int joint, int ancestor) const {
  if (ancestor < 0) return false;
  while (joint >= 0 && joint < size()) {
    if (joint == ancestor) return true;
    joint = joints[static_cast<std::size_t>(joint)].parent;
  }
  return false;
}

bool link_skeleton(Skeleton& skeleton) {
  const int count = skeleton.size();
  skeleton.children.assign(static_cast<std::size_t>(count), {});
  skeleton.order.clear();
  skeleton.order.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const int parent = skeleton.joints[static_cast<std::size_t>(i)].parent;
    if (parent < -1 || parent >= count) return false;
    if (parent < 0) {
      skeleton.order.push_back(i);
    } else {
      skeleton.children[static_cast<std::size_t>(parent)].push_back(i);
    }
  }
  // Breadth first from the roots; what is never reached hangs in a cycle.
  for (std::size_t next = 0; next < skeleton.order.size(); ++next) {
    const auto& children = skeleton.children[static_cast<std::size_t>(skeleton.order[next])];
    skeleton.order.insert(skeleton.order.end(), children.begin(), children.end());
  }
  return skeleton.order.size() == static_cast<std::size_t>(count);
}

Pose rest_pose(const Skeleton& skeleton) {
  Pose pose;
  pose.local.reserve(skeleton.joints.size());
  for (const Joint& joint : skeleton.joints) pose.local.push_back(joint.rest);
  pose.morph_weights.resize(skeleton.joints.size());
  return pose;
}

void compute_globals(const Skeleton& skeleton, const Pose& pose, const Mat4& world_from_file,
                     std::vector<Mat4>& world_from_joint) {
  world_from_joint.resize(skeleton.joints.size());
  for (const int index : skeleton.order) {
    const auto i = static_cast<std::size_t>(index);
    const Joint& joint = skeleton.joints[i];
    const Mat4& parent = joint.parent < 0
                             ? world_from_file
                             : world_from_joint[static_cast<std::size_t>(joint.parent)];
    world_from_joint[i] =
        multiply_affine(parent, joint.rest_matrix ? *joint.rest_matrix : pose.local[i].matrix());
  }
}

Quat rotation_of(const Mat4& m) {
  Mat3 r(m);
  // A mirror is taken out as the point reflection, because that one commutes with every rotation:
  // rotation_of(a·b) = rotation_of(a)·rotation_of(b) then holds under mirrored parents too.
  if (glm::determinant(r) < 0) r = -r;

  int missing = 0;
  for (int c = 0; c < 3; ++c) {
    const double length = glm::length(r[c]);
    if (length > 1e-150 && std::isfinite(length)) {
      r[c] /= length;
    } else {
      r[c] = Vec3(0.0);
      ++missing;
    }
  }
  // A joint scaled to nothing along one axis keeps the two others; with fewer left there is no
  // rotation to speak of.
  if (missing > 1) return Quat(1, 0, 0, 0);
  for (int c = 0; c < 3 && missing == 1; ++c) {
    if (r[c] != Vec3(0.0)) continue;
    const Vec3 normal = glm::cross(r[(c + 1) % 3], r[(c + 2) % 3]);
    if (glm::length(normal) < 1e-12) return Quat(1, 0, 0, 0);
    r[c] = glm::normalize(normal);
  }

  // Nearest rotation by Newton's iteration for the polar factor, X ← (X + X⁻ᵀ)/2 [Higham 1986]:
  // quadratic, and nothing to do where there is no shear.
  for (int i = 0; i < 20; ++i) {
    const double skew = std::abs(glm::dot(r[0], r[1])) + std::abs(glm::dot(r[1], r[2])) +
                        std::abs(glm::dot(r[2], r[0])) + std::abs(glm::dot(r[0], r[0]) - 1.0) +
                        std::abs(glm::dot(r[1], r[1]) - 1.0) + std::abs(glm::dot(r[2], r[2]) - 1.0);
    if (skew < 1e-15) break;
    const double determinant = glm::determinant(r);
    if (std::abs(determinant) < 1e-12) break;
    const Mat3 inverse_transpose(glm::cross(r[1], r[2]) / determinant,
                                 glm::cross(r[2], r[0]) / determinant,
                                 glm::cross(r[0], r[1]) / determinant);
    r = 0.5 * (r + inverse_transpose);
  }
  const Quat q = glm::quat_cast(r);
  const double norm = glm::length(q);
  return norm > 0.5 && std::isfinite(norm) ? q / norm : Quat(1, 0, 0, 0);
}

Transform decompose(const Mat4& m) {
  Transform t;
  t.translation = Vec3(m[3]);
  t.rotation = rotation_of(m);
  // The projection of each column on the rotated axis, so that shear falls away and a mirror shows
  // as negative scales.
  const Mat3 axes = glm::mat3_cast(t.rotation);
  for (int c = 0; c < 3; ++c) t.scale[c] = glm::dot(axes[c], Vec3(m[c]));
  return t;
}

}  // namespace elbowroom
