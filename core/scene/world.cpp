// SPDX-License-Identifier: MIT
#include "core/scene/world.h"

#include <cstddef>

#include "core/animation/affine.h"

namespace elbowroom {
namespace {

// Fills with the rest pose, keeping the memory of an earlier one.
void reset_pose(const Skeleton& skeleton, Pose& pose) {
  pose.local.resize(skeleton.joints.size());
  pose.morph_weights.resize(skeleton.joints.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    pose.local[i] = skeleton.joints[i].rest;
    pose.morph_weights[i].clear();
  }
}

}  // namespace

Mat4 attached_placement(const Attachment& attachment, const std::vector<Mat4>& carrier_globals) {
  const Mat4& world_from_joint = carrier_globals[static_cast<std::size_t>(attachment.joint)];
  Transform rigid;
  rigid.translation = Vec3(world_from_joint[3]);
  rigid.rotation = rotation_of(world_from_joint);
  return multiply_affine(rigid.matrix(), attachment.joint_from_object.matrix());
}

void actor_state_at(const World& world, int actor, double t, std::vector<ActorState>& states) {
  const auto index = static_cast<std::size_t>(actor);
  if (states.size() <= index) states.resize(index + 1);
  const Actor& self = world.actors[index];
  ActorState& state = states[index];
  if (!self.model) {
    state = {};
    return;
  }
  reset_pose(self.model->skeleton, state.pose);
  if (self.clip) sample_clip(*self.clip, t, state.pose);

  Mat4 world_from_file = self.world_from_file;
  if (self.attachment && self.attachment->begin <= t && t <= self.attachment->end) {
    // A carrier that is missing or comes later can't be followed; the object stays where it stands.
    const int carrier = self.attachment->actor;
    const bool known = carrier >= 0 && carrier < actor && self.attachment->joint >= 0;
    const auto joint = static_cast<std::size_t>(self.attachment->joint);
    if (known && joint < states[static_cast<std::size_t>(carrier)].world_from_joint.size()) {
      world_from_file = attached_placement(
          *self.attachment, states[static_cast<std::size_t>(carrier)].world_from_joint);
    }
  }
  compute_globals(self.model->skeleton, state.pose, world_from_file, state.world_from_joint);
}

void world_state_at(const World& world, double t, std::vector<ActorState>& states) {
  states.resize(world.actors.size());
  for (std::size_t i = 0; i < world.actors.size(); ++i) {
    actor_state_at(world, static_cast<int>(i), t, states);
  }
}

}  // namespace elbowroom
