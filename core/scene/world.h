// SPDX-License-Identifier: MIT
// The world w(t) of [SKF07 3]: every file that is placed in the scene, what it plays, and what it
// is attached to; a pure function of t. All actors share one clock, in seconds; outside its keys a
// clip clamps.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/model.h"

namespace elbowroom {

// An object that follows a joint over a time interval (the umbrella in the hand).
struct Attachment {
  int actor = -1;  // whom it follows; index in World::actors, lower than the follower's own
  int joint = -1;  // node index there
  Transform joint_from_object;  // placed in the joint's frame without the joint's scale: a rigid
                                // frame, so that a prop keeps its size under an armature scale
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
};

// One file in the scene.
struct Actor {
  std::string name;
  std::shared_ptr<const Model> model;
  std::shared_ptr<const Clip> clip;  // what it plays; null: its rest pose. Need not be one of the
                                     // model's own: a corrected clip goes here
  std::optional<Attachment> attachment;
  Mat4 world_from_file{1.0};  // where it stands when it is not attached
};

struct World {
  std::vector<Actor>
      actors;  // the edited character's file first; attached ones after their carriers
};

struct ActorState {
  Pose pose;
  std::vector<Mat4> world_from_joint;  // by node
};

// The state of one actor at time t. `states` holds those of lower index (for attachments).
void actor_state_at(const World& world, int actor, double t, std::vector<ActorState>& states);
// The state of all at time t. Reuses the memory of `states`. Pure; safe on any thread.
void world_state_at(const World& world, double t, std::vector<ActorState>& states);

// The world placement of an attached actor, from its carrier's globals.
Mat4 attached_placement(const Attachment& attachment, const std::vector<Mat4>& carrier_globals);

}  // namespace elbowroom
