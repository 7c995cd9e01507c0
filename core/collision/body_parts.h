// SPDX-License-Identifier: MIT
// Which joint every triangle of a character follows, which of its triangles are a limb's side, and
// what people call the parts.
//
// A body part is the triangles of a character that follow one joint: the joint with the greatest
// sum of weights over the triangle's three vertices (of equal ones the lowest index), or, for a
// rigid mesh that hangs below a joint, that joint. A limb's side is everything that follows its
// root joint or anything below it: hand, fingers, driven joints, a sword in the hand; and what the
// limb takes along from elsewhere in the tree (Limb::following), with the segment of the joint that
// it serves.
#pragma once

#include <string>
#include <vector>

#include "core/anatomy/limb.h"
#include "core/scene/model.h"

namespace elbowroom {

// Node index of the joint each triangle of the mesh follows; for a rigid mesh its own node.
std::vector<int> joints_of_triangles(const Mesh& mesh);

// The three rigid links of a limb, by what they hang from.
inline constexpr int kUpperSegment = 0;  // upper arm, thigh
inline constexpr int kLowerSegment = 1;  // forearm, shank
inline constexpr int kEndSegment = 2;    // hand, foot, and what hangs below
inline constexpr int kSegments = 3;

struct LimbSide {
  int limb = -1;     // index in the limbs given, -1: no limb's
  int segment = -1;  // kUpperSegment, ...; -1 where limb is
};

// By node: whose side it is. Where limbs nest (an arm below a spine chain) the innermost counts.
std::vector<LimbSide> limb_sides(const Skeleton& skeleton, const std::vector<Limb>& limbs);

// Index of the limb that the root of `limb` hangs below, -1 if none: what moves along with it.
int enclosing_limb(const Skeleton& skeleton, const std::vector<Limb>& limbs, int limb);

// "Ada/RightForeArm": never empty on either side of the stroke; "joint 12" for a nameless one.
std::string joint_part_name(const std::string& owner, const Skeleton& skeleton, int joint);
// "umbrella.glb/Canopy"; a nameless mesh goes by its node, else by "mesh 3".
std::string mesh_part_name(const std::string& owner, const Model& model, int mesh);

}  // namespace elbowroom
