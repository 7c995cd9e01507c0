// SPDX-License-Identifier: MIT
#include "core/anatomy/limb_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string_view>

namespace elbowroom {
namespace {

enum class Word { side_left, side_right, part, finger, toe, helper, end_marker, noise };

const std::map<std::string, Word, std::less<>>& vocabulary() {
  static const std::map<std::string, Word, std::less<>> words = [] {
    std::map<std::string, Word, std::less<>> map;
    const auto add = [&](Word kind, std::initializer_list<const char*> list) {
      for (const char* word : list) map.emplace(word, kind);
    };
    add(Word::side_left, {"left"});
    add(Word::side_right, {"right"});
    add(Word::part,
        {"upper",   "up",      "upr",      "lower", "low",      "lo",     "lwr",    "fore",
         "arm",     "arms",    "leg",      "legs",  "hand",     "wrist",  "elbow",  "thigh",
         "shin",    "calf",    "knee",     "foot",  "feet",     "ankle",  "bicep",  "biceps",
         "femur",   "tibia",   "shoulder", "shldr", "clavicle", "clav",   "collar", "collarbone",
         "scapula", "humerus", "ulna",     "hip",   "hips",     "pelvis", "palm"});
    add(Word::finger, {"finger", "fingers", "thumb", "index", "middle", "ring", "pinky", "pinkie",
                       "little", "metacarpal", "carpal", "knuckle"});
    add(Word::toe, {"toe", "toes", "toebase", "ball", "heel"});
    add(Word::helper,
        {"ik",     "fk",     "ctrl",    "ctl",        "control", "controller", "cntrl",    "pole",
         "target", "orient", "twist",   "roll",       "helper",  "tweak",      "effector", "eff",
         "socket", "attach", "slot",    "prop",       "weapon",  "mch",        "org",      "pv",
         "pt",     "aux",    "aim",     "goal",       "locator", "hint",       "handle",   "driver",
         "jiggle", "muscle", "tracker", "corrective", "share"});
    add(Word::end_marker, {"end", "nub", "tip"});
    add(Word::noise, {"mixamorig", "bip",   "biped", "def", "deform",     "armature",  "skeleton",
                      "skel",      "joint", "jnt",   "jt",  "bone",       "bn",        "bind",
                      "skin",      "cc",    "base",  "rig", "char",       "character", "bend",
                      "stretch",   "b",     "j",     "sk",  "valvebiped", "main"});
    return map;
  }();
  return words;
}

// Sides in short; only where they stand alone or at an end of a compound.
Word short_side(std::string_view word, bool& is_side) {
  is_side = true;
  if (word == "l" || word == "lf" || word == "lft" || word == "lt") return Word::side_left;
  if (word == "r" || word == "rt" || word == "rgt") return Word::side_right;
  is_side = false;
  return Word::noise;
}

bool is_lower(unsigned char c) { return std::islower(c) != 0 || c >= 0x80; }
bool is_upper(unsigned char c) { return std::isupper(c) != 0; }
bool is_letter(unsigned char c) { return is_lower(c) || is_upper(c); }

// Lower-case words between separators, digits and capitals. A namespace (up to the last ':' or '|')
// is dropped.
std::vector<std::string> split(const std::string& name) {
  const std::size_t colon = name.find_last_of(":|");
  const std::size_t start = colon == std::string::npos || colon + 1 == name.size() ? 0 : colon + 1;
  std::vector<std::string> tokens;
  std::string token;
  const auto flush = [&] {
    if (!token.empty()) tokens.push_back(token);
    token.clear();
  };
  for (std::size_t i = start; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    if (!is_letter(c)) {
      flush();
      continue;
    }
    if (!token.empty() && is_upper(c)) {
      const bool after_lower = is_lower(static_cast<unsigned char>(name[i - 1]));
      const bool before_lower =
          i + 1 < name.size() && is_lower(static_cast<unsigned char>(name[i + 1]));
      if (after_lower || before_lower) flush();
    }
    token += static_cast<char>(is_upper(c) ? std::tolower(c) : c);
  }
  flush();
  return tokens;
}

// Cuts a compound such as "leftupleg" into known words, fewest first; empty if it is none.
std::vector<std::string> cut_compound(const std::string& token) {
  constexpr std::size_t kLongest = 40;
  if (token.size() > kLongest) return {};
  const auto& words = vocabulary();
  std::vector<std::vector<std::string>> best(token.size() + 1);
  std::vector<bool> reached(token.size() + 1, false);
  reached[0] = true;
  for (std::size_t end = 1; end <= token.size(); ++end) {
    for (std::size_t begin = 0; begin < end; ++begin) {
      if (!reached[begin]) continue;
      const std::string word = token.substr(begin, end - begin);
      // One letter says too little inside a compound, and a noise word proves nothing there.
      const auto found = words.find(word);
      if (found == words.end() || word.size() < 2) continue;
      if (reached[end] && best[end].size() <= best[begin].size() + 1) continue;
      best[end] = best[begin];
      best[end].push_back(word);
      reached[end] = true;
    }
  }
  return best[token.size()];
}

// The words of one token: known ones, else the token itself.
std::vector<std::string> words_of(const std::string& token) {
  bool side = false;
  short_side(token, side);
  if (side || vocabulary().count(token) != 0) return {token};
  std::vector<std::string> cut = cut_compound(token);
  if (!cut.empty()) return cut;
  // A side's letter at either end: "lthigh", "upperarml".
  if (token.size() > 3) {
    for (const bool front : {true, false}) {
      const std::string letter(1, front ? token.front() : token.back());
      if (letter != "l" && letter != "r") continue;
      cut = cut_compound(front ? token.substr(1) : token.substr(0, token.size() - 1));
      if (cut.empty()) continue;
      cut.push_back(letter);
      return cut;
    }
  }
  return {token};
}

BonePart part_of(const std::set<std::string>& has) {
  const auto any = [&](std::initializer_list<const char*> list) {
    return std::any_of(list.begin(), list.end(),
                       [&](const char* word) { return has.count(word) != 0; });
  };
  const bool upper = any({"upper", "up", "upr"});
  const bool lower = any({"lower", "low", "lo", "lwr", "fore"});
  const bool arm = any({"arm", "arms"});
  const bool leg = any({"leg", "legs"});
  if (any({"clavicle", "clav", "collar", "collarbone", "scapula"})) return BonePart::clavicle;
  if (any({"hand", "wrist", "palm"})) return BonePart::hand;
  if (any({"foot", "feet", "ankle"})) return BonePart::foot;
  if ((arm && lower) || any({"elbow", "ulna"})) return BonePart::forearm;
  if ((arm && upper) || any({"bicep", "biceps", "humerus"})) return BonePart::upper_arm;
  if ((leg && lower) || any({"shin", "calf", "knee", "tibia"})) return BonePart::shin;
  if ((leg && upper) || any({"thigh", "femur"})) return BonePart::thigh;
  if (arm) return BonePart::arm;
  if (leg) return BonePart::leg;
  if (any({"shoulder", "shldr"})) return BonePart::shoulder;
  if (any({"hip"})) return BonePart::hip;
  return BonePart::none;
}

}  // namespace

BoneName read_bone_name(const std::string& name, const std::set<std::string>& habit) {
  BoneName result;
  std::set<std::string> has;
  bool left = false, right = false, finger = false, toe = false;
  for (const std::string& token : split(name)) {
    if (habit.count(token) != 0) continue;
    for (const std::string& word : words_of(token)) {
      bool short_form = false;
      Word kind = short_side(word, short_form);
      if (!short_form) {
        const auto found = vocabulary().find(word);
        if (found == vocabulary().end()) {
          result.unknown.push_back(word);
          continue;
        }
        kind = found->second;
      }
      switch (kind) {
        case Word::side_left:
          left = true;
          break;
        case Word::side_right:
          right = true;
          break;
        case Word::part:
          has.insert(word);
          break;
        case Word::finger:
          finger = true;
          result.thumb = result.thumb || word == "thumb";
          break;
        case Word::toe:
          toe = true;
          break;
        case Word::helper:
          result.helper = true;
          break;
        case Word::end_marker:
          result.end_marker = true;
          break;
        case Word::noise:
          break;
      }
    }
  }
  if (left != right) result.side = left ? BoneSide::left : BoneSide::right;
  if (finger) {
    result.part = BonePart::finger;
  } else if (toe) {
    result.part = BonePart::toe;
  } else {
    result.part = part_of(has);
  }
  // "hips" without a side is the pelvis, and so is a "hip" in the middle.
  if (result.part == BonePart::hip && result.side == BoneSide::none) result.part = BonePart::none;
  return result;
}

std::set<std::string> common_words(const std::vector<std::string>& names) {
  std::map<std::string, std::size_t> count;
  for (const std::string& name : names) {
    const BoneName read = read_bone_name(name);
    for (const std::string& word :
         std::set<std::string>(read.unknown.begin(), read.unknown.end())) {
      ++count[word];
    }
  }
  std::set<std::string> common;
  for (const auto& [word, n] : count) {
    if (n >= 3 && 3 * n >= names.size()) common.insert(word);
  }
  return common;
}

}  // namespace elbowroom
