// SPDX-License-Identifier: MIT
// What a joint's name says about its place in a body.
//
// Reads the naming habits of the common rigs (VRM, Mixamo, Unreal, Rigify, 3ds Max biped,
// CC/iClone, DAZ, CMU and Biovision, MikuMikuDance, and of artists who invent their own) without a
// list of whole names: a name is cut into words at separators, capitals and digits, compounds are
// cut into known words, and the words are judged. So case, separators (also missing or encoded
// ones), prefixes and numbers don't matter.
//
// Pure functions, any thread. Names are UTF-8. core/anatomy/name_words.h has the words: English,
// and the parts of the body in a dozen other languages.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace elbowroom {

enum class BonePart {
  none,
  clavicle,
  shoulder,  // the clavicle in some habits, the upper arm in others
  upper_arm,
  arm,  // the upper arm in some habits; or any joint of a numbered chain
  forearm,
  hand,
  hip,  // of one side: the thigh in some habits
  thigh,
  leg,  // the shin where there is a thigh above; or any joint of a numbered chain
  shin,
  foot,
  finger,
  toe,
};

enum class BoneSide { none, left, right };

struct BoneName {
  BonePart part = BonePart::none;
  BoneSide side = BoneSide::none;
  bool thumb = false;
  bool helper = false;      // twist, control, target and the like: no limb joint of its own
  bool copy = false;        // "ORG": a copy that some rigs keep beside the joint itself
  bool end_marker = false;  // "_end", "nub": a leaf that only closes a bone
  std::vector<std::string> unknown;  // words that say nothing to us, lower case
};

// Words in `habit` (a prefix of the artist's own, for instance) are passed over.
BoneName read_bone_name(const std::string& name, const std::set<std::string>& habit = {});

// An artist's own words: the unknown ones that at least a third of the names have in common, and
// known ones that nearly all of them have, if the names tell parts of both sides without them.
std::set<std::string> common_words(const std::vector<std::string>& names);

}  // namespace elbowroom
