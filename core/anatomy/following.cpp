// SPDX-License-Identifier: MIT
#include "core/anatomy/following.h"

#include <algorithm>
#include <cmath>

#include "core/animation/affine.h"

namespace elbowroom {
namespace {

bool has_volume(const Mat4& m) {
  const double size = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
  return std::isfinite(size) && std::abs(glm::determinant(Mat3(m))) > 1e-6 * size;
}

bool finite(const Transform& t) {
  const double sum = glm::dot(t.translation, t.translation) + glm::dot(t.rotation, t.rotation);
  return std::isfinite(sum);
}

}  // namespace

bool Limb::follows(int joint) const {
  return std::any_of(following.begin(), following.end(),
                     [joint](const FollowingJoint& other) { return other.joint == joint; });
}

Mat4 global_of(const Skeleton& skeleton, const Pose& pose, int joint) {
  Mat4 global(1.0);
  for (int at = joint; at >= 0; at = skeleton.joints[static_cast<std::size_t>(at)].parent) {
    const auto& matrix = skeleton.joints[static_cast<std::size_t>(at)].rest_matrix;
    global = multiply_affine(matrix ? *matrix : pose.local[static_cast<std::size_t>(at)].matrix(),
                             global);
  }
  return global;
}

Transform following_local(const Mat4& parent, const Mat4& served, const Mat4& clip_served,
                          const Mat4& clip_parent, const Transform& clip_local) {
  if (!has_volume(parent) || !has_volume(clip_served)) return clip_local;
  const Mat4 parent_from_world = glm::inverse(parent);
  const Mat4 moved = multiply_affine(served, glm::inverse(clip_served));
  const Mat4 turned = multiply_affine(parent_from_world, multiply_affine(moved, clip_parent));
  Transform local = clip_local;
  local.translation = transform_point(turned, clip_local.translation);
  local.rotation = glm::normalize(rotation_of(turned) * clip_local.rotation);
  return finite(local) ? local : clip_local;
}

void pose_following(const Limb& limb, const Skeleton& skeleton, const Pose& clip, Pose& pose) {
  for (const FollowingJoint& follower : limb.following) {
    const auto index = static_cast<std::size_t>(follower.joint);
    const int parent = skeleton.joints[index].parent;
    pose.local[index] = following_local(global_of(skeleton, pose, parent),
                                        global_of(skeleton, pose, follower.serves),
                                        global_of(skeleton, clip, follower.serves),
                                        global_of(skeleton, clip, parent), clip.local[index]);
  }
}

}  // namespace elbowroom
