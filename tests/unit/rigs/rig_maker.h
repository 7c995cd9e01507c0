// SPDX-License-Identifier: MIT
// Skeletons for tests, made from tables: one row a joint, where it stands said by a place of the
// body. Rows with {l|r} in their names are made for both sides.
#pragma once

#include <string>
#include <vector>

#include "core/anatomy/limb_model.h"

namespace elbowroom::test {

enum class Carries { skin, nothing, no_joint };  // no_joint: a plain node that no skin uses
inline constexpr Carries kNone = Carries::nothing;

struct Row {
  const char* name;
  const char* parent;  // "" for none
  const char* place;   // see place_of in the .cpp
  Carries carries = Carries::skin;
};

struct Convention {
  const char* name;
  std::vector<Row> rows;
  // Names of the left arm's and leg's root, middle and end; the right ones follow by {l|r}.
  std::array<const char*, 3> arm, leg;
  std::vector<const char*> arm_driven = {}, leg_driven = {};  // between and beside, left ones
  // Straight bones in several pieces: without names and without fingers and toes nothing tells
  // which of the pieces meet in the elbow.
  bool in_pieces = false;
};

struct Stance {
  double arms_down = 0;    // radians from the T-pose
  double elbows_bent = 0;  // to the front
  double stride = 0;       // the left leg forward by this, the right one back; with bent knees
};

struct Placement {
  Vec3 scale{1.0};
  Quat rotation{1, 0, 0, 0};  // of a node above everything
  bool z_up = false;          // the data is Z-up, under a node that turns it
};

struct MadeRig {
  Model model;
  const Character& character() const { return model.characters[0]; }
  int joint(const std::string& name, bool left) const;  // by a row's name
  std::vector<std::string> row_names;                   // by node: before any renaming
};

// One joint, parents first. The parent counts from 1; 0 is the node above everything.
struct PlacedJoint {
  std::string name;
  int parent = 0;
  Vec3 place{0.0};  // y up, facing +z
  Carries carries = Carries::skin;
};
MadeRig make_rig(const std::vector<PlacedJoint>& placed, const Placement& placement = {},
                 bool nonsense_names = false);

MadeRig make_rig(const Convention& convention, const Stance& stance = {},
                 const Placement& placement = {}, bool nonsense_names = false);

std::vector<Convention> conventions();       // made after habits
std::vector<Convention> real_conventions();  // of rigs that exist

// The name for one side of a row's: of "{l|r}thigh" "lthigh" or "rthigh".
std::string sided(const std::string& name, bool left);

}  // namespace elbowroom::test
