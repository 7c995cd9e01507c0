// SPDX-License-Identifier: MIT
// The palm of a hand (the sole of a foot) as a frame that is rigid with the wrist (ankle): what a
// hand target with `grasp` aims.
//
//   origin   the palm's middle: half way from the wrist to the mean of the finger roots (thumb
//            apart), moved out along y to the farthest skin of the palm near that line. A foot:
//            half way from the ankle to the toe roots, moved down to the sole.
//   x        along the hand to the finger roots; of a foot to the toes, across y
//   y        out of the palm, the way it faces; out of the sole, the body's down as bound
//   z        x × y, seen in the world
//
// Derivation, all in the bind pose:
//  * Finger roots: of each finger's chain (the branches below the wrist that carry skin, of which
//    one that stands off is the thumb) the first joint that is not a metacarpal, which is to say at
//    a third of the way to the chain's end or beyond. Without fingers the middle is that of the
//    skin which follows the wrist and what is below it, and x leads there.
//  * y = ± x × r, r the hand's radial side: the line of the knuckles, else from the fingers to the
//    thumb. Without fingers the direction in which the hand's skin is thinnest. What side is the
//    palm's: the thumb's side, else (guessed) the one that the joint models have, with the thumb
//    where the elbow bends to; a hand that is about as thick as it is wide faces there altogether.
//  * Where a rig has no skin at all the palm lies a stated share of the palm's length off the bones
//    (kThickness).
// `from` says which of these were used. Curled fingers are not the palm: the skin of fingers and
// thumb counts for `beyond` only.
//
// Spaces: the end joint's own axes and units, so that scale and mirrors above it do no harm.
// Pure, immutable, any thread. Cost: O(vertices of the meshes that follow the hand), once a limb.
#pragma once

#include <string>
#include <vector>

#include "core/anatomy/bound_figure.h"
#include "core/anatomy/limb.h"
#include "core/base/result.h"

namespace elbowroom {

struct GraspFrame {
  Vec3 origin{0.0};
  Vec3 x{1, 0, 0},
      y{0, 1, 0};     // directions in the joint's axes, unit, across in the world as bound
  double beyond = 0;  // how far the hand's skin stands out past the origin along y, as bound
  std::string from;   // what it rests on, for people
};

// What the fit of the joint models knows besides.
struct GraspEvidence {
  const BoundFigure& figure;
  const Limb& limb;
  double side = 1;            // +1 on the body's left
  Vec3 down{0, -1, 0};        // the body's, world, unit
  Vec3 lower{1, 0, 0};        // along the forearm (shin), world, unit
  Vec3 palm{0, -1, 0};        // where the joint models have the palm, world
  bool end_is_fixed = false;  // joints beside the end may be the hand's
};

// Error: an end without size, or with neither skin nor joints beyond it; for people.
Result<GraspFrame> fit_grasp_frame(const GraspEvidence& evidence);

// A frame's place in the world; right-handed there, also under mirrors.
struct GraspPlace {
  Vec3 position{0.0};
  Quat orientation{1, 0, 0, 0};  // world_from_grasp
  double beyond = 0;             // scene units
};
GraspPlace grasp_place(const GraspFrame& frame, const Mat4& world_from_end);

// Where the end joint has to be for its grasp frame to be at `wanted`: origin and world_from_joint
// rotation (as rotation_of has it). `world_from_end` is the joint in any pose, for its scale, which
// has to be uniform above the joint. Inverse of grasp_place.
struct EndPlacement {
  Vec3 position{0.0};
  Quat rotation{1, 0, 0, 0};
};
EndPlacement end_for_grasp(const GraspFrame& frame, const Mat4& world_from_end,
                           const Vec3& position, const Quat& orientation);

}  // namespace elbowroom
