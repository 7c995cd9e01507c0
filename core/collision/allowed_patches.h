// SPDX-License-Identifier: MIT
// Where touching is natural between two bodies of one character (DESIGN.md, "Allowed contacts"):
// pairs of patches with a reason, never whole pairs of parts.
//
//  * shared_joint: both patches lie within a radius of the joint that the two share. The radius is
//    taken along the surface from the seam where the two are cut apart; for pieces that are not
//    joined to it (armour, a robot's links), straight from the joint, in the bind pose. It is the
//    setting's or 1.25 × the limb's own radius at that joint, whichever is larger, and at most half
//    the limb's length.
//  * bind_pose: the patches touch in the bind pose.
//  * clip: the two parts are in contact in the source clip, and these patches are then within
//    CollisionSettings::touch_reach; allowed about the times at which the clip has the parts in
//    contact, to the depth it has then. `touching` is what the clip itself has in contact: what
//    final verdicts and proofs go by, while planning has room to slide.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/collision/clip_touching.h"
#include "core/collision/collision_body.h"
#include "core/collision/patch_regions.h"
#include "core/collision/surface_patches.h"

namespace elbowroom {

struct AllowedPatches {
  static constexpr std::uint8_t kShared = 1, kBind = 2, kClip = 4;
  // kShared and kBind; or kClip too where the clip itself touches; or all of kClip.
  enum class Reasons { lasting, touched, all };

  int patches_a = 0, patches_b = 0;
  std::vector<std::uint8_t> reasons;                 // a bit set for each pair: p · patches_b + q
  std::vector<bool> always;                          // kShared or kBind
  std::vector<bool> any;                             // or kClip
  std::map<std::pair<int, int>, double> clip_depth;  // by part of a and part of b, over the clip
  // The same over time: how deep the clip has the two parts about the times it was looked at.
  struct DepthAt {
    double time = 0, depth = 0;
  };
  std::map<std::pair<int, int>, std::vector<DepthAt>> clip_depths;  // times ascend
  std::vector<std::uint32_t> clip_pairs;  // of patches, for the clip's sake; places in `reasons`
  ClipTouching touching;                  // what of these the clip has in contact itself

  // The deepest the clip has two parts within `memory` seconds of t; negative if it does not.
  double depth_about(int part_a, int part_b, double t, double memory) const;
  // Whether the clip has two parts in contact about every time of [from, to]: at one time within
  // `memory` seconds of all of it.
  bool clip_touches(int part_a, int part_b, double from, double to, double memory) const;

  AllowedPatches() = default;
  AllowedPatches(int count_a, int count_b);
  void allow(int patch_a, int patch_b, std::uint8_t reason);
  // For the clip's sake: these triangles' patches, and `touching`. After all that lasts.
  void allow_touched(const CollisionBody& a, const CollisionBody& b,
                     const std::vector<ClipTouching::Parts>& touched);
  std::uint8_t reasons_of(int patch_a, int patch_b) const {
    return reasons[static_cast<std::size_t>(patch_a) * static_cast<std::size_t>(patches_b) +
                   static_cast<std::size_t>(patch_b)];
  }
  bool empty() const;

  // A filter over the triangles of the two bodies these are for: `always`, `touching`'s or `any`.
  // Keeps references to this and to the bodies, until allow() or allow_touched() is called.
  PatchFilter filter(const CollisionBody& a, const CollisionBody& b, Reasons which) const;

 private:
  // By Reasons, when first asked for.
  struct Regions {
    std::shared_ptr<const PatchRegions> of[3];
    bool known[3] = {false, false, false};
  };
  mutable Regions regions_;
};

// A filter over the triangles of two bodies. Keeps references.
PatchFilter patch_filter(const CollisionBody& a, const CollisionBody& b,
                         const std::vector<bool>& allowed);

// The joint that the limb-side body `child` shares with the body nearer the trunk.
struct SharedJoint {
  int joint = -1;             // its node
  Vec3 place{0.0};            // in the query space, bind pose
  Vec3 bone{0.0};             // from it to the limb's next joint; 0 if there is none
  double limb_length = 0;     // root to end; 0 if unknown
  std::vector<int> carriers;  // joints whose parts are the other side, where the surface is not
                              // joined: the nearest that have any
};

// All bodies of a character as one welded surface, in the pose they stand in.
struct JoinedSurface {
  WeldedSurface surface;
  std::vector<int> component;                 // by point
  std::vector<std::uint32_t> first_triangle;  // by body, in the order given
};
JoinedSurface join_bodies(const std::vector<const CollisionBody*>& bodies, double weld_tolerance);

// Adds the shared_joint patches of two bodies of the joined surface (`child` and `parent` are their
// places in its order), which stands in the bind pose. With joint.joint < 0 the two share a seam at
// most (two thighs), and only what is joined to it counts. `swapped`: `allowed` has the parent's
// patches first.
void allow_shared_joint(const JoinedSurface& whole, const std::vector<const CollisionBody*>& bodies,
                        int child, int parent, const SharedJoint& joint, double radius,
                        bool swapped, AllowedPatches& allowed);

}  // namespace elbowroom
