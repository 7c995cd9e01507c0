// SPDX-License-Identifier: MIT
#include "core/anatomy/limb_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <sstream>
#include <string_view>

#include "core/anatomy/name_words.h"

namespace elbowroom {
namespace {

// Sides in short; only where they stand alone or at an end of a compound.
NameWord short_side(std::string_view word, bool& is_side) {
  is_side = true;
  for (const char* left : {"l", "lf", "lft", "lt", "Л", "л"}) {
    if (word == left) return NameWord::side_left;
  }
  for (const char* right : {"r", "rf", "rt", "rgt", "П", "п"}) {
    if (word == right) return NameWord::side_right;
  }
  is_side = false;
  return NameWord::noise;
}

bool is_lower(unsigned char c) { return std::islower(c) != 0 || c >= 0x80; }
bool is_upper(unsigned char c) { return std::isupper(c) != 0; }
bool is_letter(unsigned char c) { return is_lower(c) || is_upper(c); }

// Lower-case words between separators, digits and capitals. A namespace (up to the last ':' or '|')
// is dropped, and so are the folders of a path ("root/hips/thigh_l").
std::vector<std::string> split(const std::string& text) {
  const std::string name = plain_name(text);
  const std::size_t colon = name.find_last_of(":|");
  std::size_t start = colon == std::string::npos || colon + 1 == name.size() ? 0 : colon + 1;
  const std::size_t slash = name.find_last_of('/');
  constexpr std::size_t kShortest = 3;  // less is a side: "arm/L"
  if (slash != std::string::npos && slash > start && name.size() - slash > kShortest)
    start = slash + 1;
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
    const auto lower_at = [&](std::size_t k) {
      return k < name.size() && is_lower(static_cast<unsigned char>(name[k]));
    };
    // A side that lost its separator behind capitals: "heelIKl".
    const auto side_at = [&](std::size_t k) {
      return k < name.size() && (name[k] == 'l' || name[k] == 'r') && !lower_at(k + 1);
    };
    const auto upper_at = [&](std::size_t k) {
      return is_upper(static_cast<unsigned char>(name[k]));
    };
    if (!token.empty() && is_upper(c)) {
      if (lower_at(i - 1) || (lower_at(i + 1) && !side_at(i + 1))) flush();
    } else if (token.size() >= 2 && side_at(i) && upper_at(i - 1) && upper_at(i - 2)) {
      flush();
    }
    token += static_cast<char>(is_upper(c) ? std::tolower(c) : c);
  }
  flush();
  return tokens;
}

// Cuts a compound such as "leftupleg" into known words, fewest first; empty if it is none. One
// side's letter may stand between them ("bip01" lost its spaces: "biplupperarm").
std::vector<std::string> cut_compound(const std::string& token, bool with_letter = false) {
  constexpr std::size_t kLongest = 40;
  if (token.size() > kLongest) return {};
  const auto& words = name_words();
  const auto& translated = translated_words();
  // By whether the letter is used up.
  std::array<std::vector<std::vector<std::string>>, 2> best;
  std::array<std::vector<char>, 2> reached;
  for (const std::size_t used : {0u, 1u}) {
    best[used].resize(token.size() + 1);
    reached[used].assign(token.size() + 1, 0);
  }
  reached[0][0] = 1;
  for (std::size_t end = 1; end <= token.size(); ++end) {
    for (std::size_t begin = 0; begin < end; ++begin) {
      const std::string word = token.substr(begin, end - begin);
      // One letter says too little inside a compound, and a noise word proves nothing there.
      // Nor do the shortest words of other languages.
      const bool known = (word.size() >= 2 && words.count(word) != 0) ||
                         (word.size() >= 4 && translated.count(word) != 0);
      const bool letter = with_letter && (word == "l" || word == "r");
      if (!known && !letter) continue;
      for (const std::size_t used : {0u, 1u}) {
        const std::size_t now = letter ? 1 : used;
        if (!reached[used][begin] || (letter && used == 1)) continue;
        if (reached[now][end] && best[now][end].size() <= best[used][begin].size() + 1) continue;
        best[now][end] = best[used][begin];
        best[now][end].push_back(word);
        reached[now][end] = 1;
      }
    }
  }
  if (reached[0][token.size()]) return best[0][token.size()];
  return best[1][token.size()];
}

// A word in English: itself, or what it means.
void add_meaning(const std::string& word, std::vector<std::string>& words) {
  const auto found = translated_words().find(word);
  if (found == translated_words().end()) {
    words.push_back(word);
    return;
  }
  std::istringstream meaning(found->second);
  for (std::string part; meaning >> part;) words.push_back(part);
}

// The words of one token: known ones, else the token itself.
std::vector<std::string> words_of(const std::string& token) {
  std::vector<std::string> words;
  bool side = false;
  short_side(token, side);
  if (side || name_words().count(token) != 0) return {token};
  if (translated_words().count(token) != 0) {
    add_meaning(token, words);
    return words;
  }
  // "LUArm", a side and an upper one.
  if (token == "lu" || token == "ru") return {token.substr(0, 1), "upper"};
  std::vector<std::string> cut = cut_compound(token);
  // With a side's letter: "lthigh", "upperarml", "biplupperarm".
  if (cut.empty() && token.size() > 3) {
    cut = cut_compound(token, true);
    if (cut.size() < 2) cut.clear();
  }
  if (cut.empty()) return {token};
  for (const std::string& word : cut) add_meaning(word, words);
  return words;
}

BonePart part_of(const std::set<std::string>& has) {
  const auto any = [&](std::initializer_list<const char*> list) {
    return std::any_of(list.begin(), list.end(),
                       [&](const char* word) { return has.count(word) != 0; });
  };
  const bool upper = any({"upper", "up", "upr"});
  const bool lower = any({"lower", "low", "lo", "lwr", "fore", "down", "dn"});
  const bool arm = any({"arm", "arms"});
  const bool leg = any({"leg", "legs"});
  if (any({"clavicle", "clav", "collar", "collarbone", "scapula"})) return BonePart::clavicle;
  if (any({"hand", "wrist", "palm", "fist"})) return BonePart::hand;
  if (any({"foot", "feet", "ankle"})) return BonePart::foot;
  if ((arm && lower) || any({"forearm", "elbow", "ulna", "radius"})) return BonePart::forearm;
  if ((arm && upper) || any({"bicep", "biceps", "humerus"})) return BonePart::upper_arm;
  if ((leg && lower) || any({"shin", "calf", "knee", "tibia", "fibula"})) return BonePart::shin;
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
      NameWord kind = short_side(word, short_form);
      if (!short_form) {
        const auto found = name_words().find(word);
        if (found == name_words().end()) {
          result.unknown.push_back(word);
          continue;
        }
        kind = found->second;
      }
      switch (kind) {
        case NameWord::side_left:
          left = true;
          break;
        case NameWord::side_right:
          right = true;
          break;
        case NameWord::part:
          has.insert(word);
          break;
        case NameWord::finger:
          finger = true;
          result.thumb = result.thumb || word == "thumb";
          break;
        case NameWord::toe:
          toe = true;
          break;
        case NameWord::helper:
          result.helper = true;
          break;
        case NameWord::copy:
          result.copy = true;
          break;
        case NameWord::end_marker:
          result.end_marker = true;
          break;
        case NameWord::noise:
          break;
      }
    }
  }
  if (left != right) result.side = left ? BoneSide::left : BoneSide::right;
  // A toe may be called the leg's digit or the foot's index.
  const bool of_leg = has.count("leg") + has.count("legs") + has.count("foot") > 0;
  if (toe || (finger && of_leg)) {
    result.part = BonePart::toe;
  } else if (finger) {
    result.part = BonePart::finger;
  } else {
    result.part = part_of(has);
  }
  // "hips" without a side is the pelvis, and so is a "hip" in the middle.
  if (result.part == BonePart::hip && result.side == BoneSide::none) result.part = BonePart::none;
  return result;
}

namespace {

// Words that mean something to us and stand in nearly all names: "FootSoldier_LeftArm".
std::vector<std::string> shared_known_words(const std::vector<std::string>& names) {
  constexpr std::size_t kFewest = 8;
  std::vector<std::string> shared;
  if (names.size() < kFewest) return shared;
  std::map<std::string, std::size_t> count;
  for (const std::string& name : names) {
    const std::vector<std::string> tokens = split(name);
    for (const std::string& token : std::set<std::string>(tokens.begin(), tokens.end())) {
      const auto known = name_words().find(token);
      const bool says = known != name_words().end() && known->second != NameWord::noise &&
                        known->second != NameWord::side_left &&
                        known->second != NameWord::side_right;
      if (says || translated_words().count(token) != 0) ++count[token];
    }
  }
  for (const auto& [token, n] : count) {
    if (20 * n >= 17 * names.size()) shared.push_back(token);
  }
  return shared;
}

// Whether parts of both sides are still named when these words are passed over; of a hand's own
// skeleton, where "hand" and "left" are in all names, they are not.
bool tell_both_sides(const std::vector<std::string>& names, const std::set<std::string>& habit) {
  bool left = false, right = false;
  for (const std::string& name : names) {
    const BoneName read = read_bone_name(name, habit);
    if (read.part == BonePart::none || read.helper) continue;
    left = left || read.side == BoneSide::left;
    right = right || read.side == BoneSide::right;
  }
  return left && right;
}

}  // namespace

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
  for (const std::string& word : shared_known_words(names)) {
    std::set<std::string> with = common;
    with.insert(word);
    if (tell_both_sides(names, with)) common = with;
  }
  return common;
}

}  // namespace elbowroom
