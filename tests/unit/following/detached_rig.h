// SPDX-License-Identifier: MIT
// A body whose feet hang from its root, as rigs exported with their IK have them, and more that
// hangs elsewhere if it is asked for; and a clip in which all of it moves.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/anatomy/limb_model.h"
#include "core/scene/model.h"

namespace elbowroom::test {

struct RigOptions {
  double scale = 1;            // of a node above everything
  bool mirrored = false;       // that node turns x over
  bool uneven = false;         // and is twice as wide as high
  bool detached_hand = false;  // hands hang from the root too
  bool garment = false;        // trousers with a skeleton of their own
  bool twist = false;          // twist joints of the upper arms hang from the clavicles
  bool matrix_foot = false;    // the left foot is placed by a matrix
  Vec3 foot_parent_scale{1.0};
  bool plain = false;  // feet hang from the shins
};

struct DetachedRig {
  std::shared_ptr<Model> model;
  int joint(const std::string& name) const { return model->skeleton.find(name); }
  const Character& character() const { return model->characters.front(); }
};
DetachedRig make_detached_rig(const RigOptions& options = {});

// Root and hips go along and turn, thighs and shins swing, and the feet are keyed where their shins
// have them, from 0 to 2 s at `rate` Hz. None: no keys of the feet (they stand in their parent).
enum class FootKeys { linear, cubic, step, none };
std::shared_ptr<Clip> walk_of(const DetachedRig& rig, FootKeys keys, int rate = 30);

}  // namespace elbowroom::test
