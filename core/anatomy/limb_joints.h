// SPDX-License-Identifier: MIT
// What stands between and beside a limb's own joints. For the finders of limbs.
#pragma once

#include <string>
#include <vector>

#include "core/anatomy/bound_figure.h"
#include "core/anatomy/limb.h"

namespace elbowroom {

// With root, middle and end set: fills `joints`, `beside` and `following` and adds them to `why`.
// Where a clip turns not a limb's joint but a node above it in the same place (importers split a
// joint into pivots), that node is the limb's. `ends`: joints that are hand or foot, fingers or
// toes of the limb by their names, and do not hang from it.
void complete_limb(const BoundFigure& figure, Limb& limb, const std::vector<int>& ends = {});

// A joint that belongs to a limb by its place, moves part of the figure, and hangs from elsewhere.
struct DetachedJoint {
  int joint = -1;
  int serves = -1;       // of the limb's joints
  std::string obstacle;  // why it cannot follow; empty: it can
};

// Those along the limb's upper bone that hang from what its root hangs from (3ds Max and Valve hang
// upper arms' twist joints from the clavicle); those in its middle's or its end's place (feet of an
// IK rig, the skeleton of a garment), and what stands at its root above them; and those of `ends`
// that are near its end. Parents first; below one, others that serve the same joint are not listed.
std::vector<DetachedJoint> detached_joints(const BoundFigure& figure, const Limb& limb,
                                           const std::vector<int>& ends);

// Of a chain that other limbs hang from: what follows these follows it too, where it can.
void take_along_below(const BoundFigure& figure, Limb& chain, const std::vector<const Limb*>& all);

// A joint's name in quotes, or its node index.
std::string quoted_joint(const Model& model, int joint);

}  // namespace elbowroom
