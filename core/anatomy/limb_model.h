// SPDX-License-Identifier: MIT
// The joint models of one limb [SKF07 4.2], fitted to a rig: between the local rotations of its
// joints and numbers that mean the same on every rig. core/anatomy/joint_model.h has the product
// and its derivation.
//
// A limb has three joint models: its root is a ball, its middle a hinge with twist, its end a
// swing. Where the clips of the file show that a rig's middle or end turns about three axes, that
// joint is a ball too, and where turning the end would move nothing (or but a part of the hand), it
// is fixed. So numbers of DOFs differ between rigs: ask dof_count(), not for seven.
//
// Zero poses: the arm 45° forward of the side and 20° below level, the leg flexed by 45° and
// abducted by 10° (core/anatomy/limits.cpp); elbow and knee straight; hand along the forearm; foot
// as bound. Twist is zero as the shortest swing brings it from the T-pose with elbows that bend
// forward (standing, with knees that bend back); forearm and shin as bound, unless fingers show
// that the palm was bound to face another way than down (T-pose) or in (A-pose). A wrist without
// twist of its own is centred where it twists least in the clips.
//
// Spaces: rotations are local (parent_from_joint). Units: radians. All functions are pure; a
// LimbModel is immutable and may be shared between threads.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/anatomy/grasp_frame.h"
#include "core/anatomy/joint_model.h"
#include "core/anatomy/limb.h"
#include "core/animation/clip.h"
#include "core/base/dof_space.h"

namespace elbowroom {

// A joint between or beside the limb's own (a twist or helper bone): its local rotation relative to
// what the clip has is kept. Those that hang elsewhere are Limb::following.
struct DrivenJoint {
  int joint = -1;
  int serves = -1;  // node index of the limb joint it follows
};

struct LimbModel {
  Limb limb;
  std::array<JointModel, 3> joints;  // root, middle, end
  std::vector<DrivenJoint> driven;
  DofSpace space;                 // names, limits, default sampling intervals, speed limits
  std::string flexion_axis_from;  // how the middle joint's axis was found, for people
  // The palm (the sole) in the end joint's axes; the error says why it can't be told.
  Result<GraspFrame> grasp = Error{"the limb is not fitted", "", ""};
  std::vector<std::string> notes;  // where a joint's model is another than usual, and why
  // The body's axes in the axes of the root joint's parent, unit: for elevation().
  Vec3 up{0, 1, 0}, outward{1, 0, 0}, forward{0, 0, 1};

  int dof_count() const { return space.count(); }
};

struct LimbState {
  Dofs q;
  std::array<Quat, 3> residual{Quat(1, 0, 0, 0), Quat(1, 0, 0, 0), Quat(1, 0, 0, 0)};
};

// Fits the limb's joint models to a rig: frames from the body's axes, bind pose, hand and foot, and
// what the joints do in the model's clips. Error: degenerate bones (zero length and the like), or a
// joint that cannot be animated. Cost: O(keys of the limb's joints).
Result<LimbModel> fit_limb_model(const Model& model, const Character& character, const Limb& limb,
                                 const LimbFindings& findings);

// Parameters and residuals of the limb in a pose. Of the numbers that stand for one rotation those
// near `previous` are taken, if given (twist and flexion go on past a half turn, a swing past pi),
// else those nearest to the middle of the limits.
LimbState limb_state(const LimbModel& limb, const Pose& pose, const LimbState* previous = nullptr);

// Writes the limb joints' local rotations into the pose (nothing else of it changes).
void apply_limb_state(const LimbModel& limb, const LimbState& state, Pose& pose);
// The same, and what follows the limb from elsewhere in the tree comes along, in the relation that
// it has to the limb in the pose given.
void apply_limb_state(const LimbModel& limb, const LimbState& state, const Skeleton& skeleton,
                      Pose& pose);

// For people: shoulder raise (0 hanging, 90° level, 180° overhead) and forward (0 to the side, 90°
// straight ahead) of a root joint's swing, radians.
struct Elevation {
  double raise = 0, forward = 0;
};
Elevation elevation(const LimbModel& limb, const Dofs& q);

}  // namespace elbowroom
