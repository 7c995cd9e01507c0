// SPDX-License-Identifier: MIT
// Driven joints of a limb that hang from elsewhere in the tree (Limb::following): a foot exported
// with its IK from the rig's root, a garment's own skeleton, a twist joint beside the clavicle.
//
// Each keeps its clip relation to the limb joint it serves:
//
//   world(f) = world(served) · clip_world(served)⁻¹ · clip_world(f)
//
// and is written as translation and rotation local to its own parent, wherever that stands; its
// scale stays the clip's. With M = world(served) · clip_world(served)⁻¹ and P its parent's world,
//
//   local = P⁻¹ · M · clip_P · clip_local
//
// Seen from a node above both, M is rigid, and P is clip_P or, below another following joint, that
// moved rigidly: so P⁻¹ M clip_P is rigid for any P that keeps angles, mirrors included. Where
// scales are uneven below that node the place is exact and the rotation the nearest.
//
// A chain takes along what follows itself, and what follows a limb that hangs from it: the hands of
// a rig that has them at its root stay on their arms when the spine is bent.
//
// Globals may be of any space, if of one. Pure functions; any thread.
#pragma once

#include "core/anatomy/limb.h"

namespace elbowroom {

// The product of a joint's locals up to the root: world_from_joint in the file's space; of -1, what
// roots stand on, the identity. O(depth).
Mat4 global_of(const Skeleton& skeleton, const Pose& pose, int joint);

// The local transform of a following joint. `parent` is its parent's global as it stands, `served`
// that of the joint it serves as it stands; the others are the clip's. Spaces without volume: the
// clip's own local.
Transform following_local(const Mat4& parent, const Mat4& served, const Mat4& clip_served,
                          const Mat4& clip_parent, const Transform& clip_local);

// Brings the following joints of a limb to where they belong in `pose`, in which its own joints
// have been turned; `clip` is the pose before that.
void pose_following(const Limb& limb, const Skeleton& skeleton, const Pose& clip, Pose& pose);

}  // namespace elbowroom
