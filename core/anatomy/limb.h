// SPDX-License-Identifier: MIT
// Which joints of a character are its arms and legs, and why we think so.
//
// A limb is an open linkage from its root (shoulder, hip) over its middle (elbow, knee) to its end
// (wrist, ankle). Between and beside them may stand twist or helper joints: driven joints, which
// keep their clip relation to the limb joint they serve. Some of these hang from elsewhere in the
// tree (a foot from the rig's root, a garment's own skeleton): the limb takes them along.
//
// Whose word counts: the animator's own, then the file's (VRM's humanoid bones), then the joints'
// names, then the figure's shape (core/anatomy/shaped_limbs.h).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/model.h"

namespace elbowroom {

enum class LimbKind { left_arm, right_arm, left_leg, right_leg, chain };

const char* limb_id(LimbKind kind);  // "left_arm", ... as on the command line and in reports

// A driven joint that hangs from none of the limb's own. It keeps its clip relation to the joint it
// serves, and what hangs from it comes along: core/anatomy/following.h.
struct FollowingJoint {
  int joint = -1;
  int serves = -1;  // of Limb::joints, or of those of a limb that hangs from it
  bool operator==(const FollowingJoint&) const = default;
};

struct Limb {
  LimbKind kind = LimbKind::chain;
  std::string name;         // limb_id, or FROM..TO for a chain
  std::vector<int> joints;  // node indices, root to end, driven ones between them included
  std::vector<int> beside;  // twist joints that hang from root or middle and lie along its bone
  std::vector<FollowingJoint> following;  // parents first
  int root = -1, middle = -1, end = -1;   // shoulder/hip, elbow/knee, wrist/ankle
  std::string why;                        // what the finding rests on, for people
  bool named_side = false;                // the file or its names say which side it is on

  bool is_arm() const { return kind == LimbKind::left_arm || kind == LimbKind::right_arm; }
  bool follows(int joint) const;  // it is one of `following`
  bool is_left() const { return kind == LimbKind::left_arm || kind == LimbKind::left_leg; }
};

struct LimbFindings {
  std::vector<Limb> limbs;            // at most one of each kind
  std::vector<std::string> warnings;  // one for each limb not found, with the reason and what can
                                      // be done; and what is odd about those found: joints that
                                      // cannot follow a limb though they belong to it
};

// What an animator says that a limb goes from and to, by joint names (or node indices): of an arm
// or leg by its limb_id, or of a chain by any name. Without a middle the joint that leaves the most
// equal bones is taken. Without any joint the limb is said to be none: it is not looked for.
struct LimbJoints {
  std::string from, middle, to;
  bool none() const { return from.empty() && middle.empty() && to.empty(); }
  bool operator==(const LimbJoints&) const = default;
};
using LimbOverrides = std::map<std::string, LimbJoints>;

// Finds arms and legs; a limb's joints stand one below the other. Never fails; what isn't found is
// absent, with a warning that says why. Overrides come first; one that cannot be is a warning.
// Cost: O(nodes + vertices), some milliseconds.
LimbFindings find_limbs(const Model& model, const Character& character,
                        const LimbOverrides& overrides = {});

// The limb named on a command line: left_arm, ..., the name of an override, or FROM..TO by joint
// names (exact, or by node index). Of a chain that is not one of the limbs found, the middle is the
// joint that bends most like a hinge: see the code. Error: no such limb or joint, with what there
// is.
Result<Limb> limb_by_name(const Model& model, const Character& character, const std::string& name,
                          const LimbOverrides& overrides = {});

// The limb of that name between joints named; of the kind that the name says, else a chain. Error:
// no such joints, or no chain between them.
Result<Limb> limb_between(const Model& model, const Character& character, const std::string& name,
                          const LimbJoints& joints);

// The body's own axes at the bind pose, the file's space, unit, right-handed: up (along legs and
// trunk), left (right limb roots to left ones, or the other way where feet and knees say that the
// names are swapped), forward = left × up. An axis near one of the file's is taken to be that one.
struct BodyAxes {
  Vec3 up, left, forward;
};
BodyAxes body_axes(const Model& model, const Character& character, const LimbFindings& findings);

// The height that tolerances are shares of, file units: Character::height; of a figure that does
// not stand along the file's up in its bind pose, its extent along its own.
double body_height(const Model& model, const Character& character, const LimbFindings& findings);

}  // namespace elbowroom
