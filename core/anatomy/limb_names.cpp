// SPDX-License-Identifier: MIT
#include "core/anatomy/limb_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string_view>

namespace elbowroom {
namespace {

enum class Word { side_left, side_right, part, finger, toe, helper, copy, end_marker, noise };

const std::map<std::string, Word, std::less<>>& vocabulary() {
  static const std::map<std::string, Word, std::less<>> words = [] {
    std::map<std::string, Word, std::less<>> map;
    const auto add = [&](Word kind, std::initializer_list<const char*> list) {
      for (const char* word : list) map.emplace(word, kind);
    };
    add(Word::side_left, {"left"});
    add(Word::side_right, {"right"});
    add(Word::part,
        {"upper",   "up",      "upr",      "lower",  "low",      "lo",     "lwr",    "fore",
         "arm",     "arms",    "leg",      "legs",   "hand",     "wrist",  "elbow",  "thigh",
         "shin",    "calf",    "knee",     "foot",   "feet",     "ankle",  "bicep",  "biceps",
         "femur",   "tibia",   "shoulder", "shldr",  "clavicle", "clav",   "collar", "collarbone",
         "scapula", "humerus", "ulna",     "hip",    "hips",     "pelvis", "palm",   "radius",
         "fibula",  "down",    "dn",       "forearm"});
    // German, French, Spanish, Italian, Portuguese.
    add(Word::part,
        {"oberarm",     "unterarm",    "ellenbogen", "handgelenk", "oberschenkel", "unterschenkel",
         "knie",        "fuss",        "knoechel",   "bras",       "avantbras",    "coude",
         "poignet",     "cuisse",      "jambe",      "genou",      "cheville",     "pied",
         "brazo",       "antebrazo",   "codo",       "mano",       "muneca",       "muslo",
         "pierna",      "pantorrilla", "rodilla",    "pie",        "tobillo",      "braccio",
         "avambraccio", "gomito",      "polso",      "coscia",     "gamba",        "ginocchio",
         "piede",       "caviglia",    "braco",      "antebraco",  "cotovelo",     "coxa",
         "perna",       "joelho",      "tornozelo"});
    add(Word::side_left, {"links", "linker", "linkes", "linke", "gauche", "izquierda", "izquierdo",
                          "izq", "sinistra", "sinistro", "esquerda", "esquerdo", "hidari"});
    add(Word::side_right, {"rechts", "rechter", "rechtes", "rechte", "droite", "droit", "derecha",
                           "derecho", "destra", "destro", "direita", "direito", "migi"});
    add(Word::finger, {"daumen", "pouce", "pulgar", "pollice", "polegar", "doigt", "dedo"});
    add(Word::finger, {"finger", "fingers", "thumb", "index", "middle", "ring", "pinky", "pinkie",
                       "little", "metacarpal", "carpal", "knuckle"});
    add(Word::toe, {"toe", "toes", "toebase", "ball", "heel"});
    add(Word::helper,
        {"ik",       "fk",     "ctrl",   "ctl",    "control", "controller", "cntrl",
         "pole",     "target", "orient", "twist",  "roll",    "helper",     "tweak",
         "effector", "eff",    "socket", "attach", "slot",    "prop",       "weapon",
         "mch",      "pv",     "pt",     "aux",    "aim",     "goal",       "locator",
         "hint",     "handle", "driver", "jiggle", "muscle",  "tracker",    "corrective",
         "share",    "assimp", "dummy",  "cancel", "pivot",   "proxy",      "sleeve",
         "skirt",    "cloth",  "armor",  "armour"});
    add(Word::copy, {"org"});
    add(Word::end_marker, {"end", "nub", "tip"});
    add(Word::noise,
        {"mixamorig", "bip",   "biped",    "def",   "deform",      "armature",  "skeleton",
         "skel",      "joint", "jnt",      "jt",    "bone",        "bn",        "bind",
         "skin",      "cc",    "base",     "rig",   "char",        "character", "bend",
         "stretch",   "b",     "j",        "sk",    "valvebiped",  "main",      "fbx",
         "no",        "rot",   "rotation", "trans", "translation", "pre",       "node",
         "o",         "mesh"});
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

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// Words of the scripts that don't separate words, and of those that our tokens don't hold, with
// what they mean; longer ones before those they contain. MikuMikuDance's own names first: 腕 is the
// upper arm there, 足 the thigh, D bones are the ones that move the skin.
struct Foreign {
  const char* word;
  const char* meaning;
};
constexpr Foreign kForeign[] = {
    {"左", " left "},
    {"右", " right "},
    {"親指", " thumb "},
    {"人差指", " index "},
    {"人指", " index "},
    {"中指", " middle "},
    {"薬指", " ring "},
    {"小指", " pinky "},
    {"指", " finger "},
    {"手首", " wrist "},
    {"足首", " ankle "},
    {"足先", " toe "},
    {"つま先", " toe "},
    {"爪先", " toe "},
    {"腕捩", " arm twist "},
    {"手捩", " hand twist "},
    {"捩", " twist "},
    {"捻", " twist "},
    {"肩", " shoulder "},
    {"ひじ", " elbow "},
    {"肘", " elbow "},
    {"ひざ", " knee "},
    {"膝", " knee "},
    {"前腕", " lower arm "},
    {"上腕", " upper arm "},
    {"腕", " upper arm "},
    {"太もも", " thigh "},
    {"大腿", " thigh "},
    {"小腿", " shin "},
    {"大臂", " upper arm "},
    {"上臂", " upper arm "},
    {"小臂", " lower arm "},
    {"前臂", " lower arm "},
    {"脚踝", " ankle "},
    {"脚趾", " toe "},
    {"脚", " foot "},
    {"足", " upper leg "},
    {"手", " hand "},
    {"袖", " sleeve "},
    {"親", " helper "},
    {"ダミー", " dummy "},
    {"キャンセル", " cancel "},
    {"先", " end "},
    {"\xef\xbc\xa9\xef\xbc\xab", " ik "},  // full-width letters
    {"왼쪽", " left "},
    {"왼", " left "},
    {"오른쪽", " right "},
    {"오른", " right "},
    {"ß", "ss"},
    {"ö", "oe"},
    {"ç", "c"},
    {"ñ", "n"},
    {"ã", "a"},
    {"é", "e"},
    {"avant-bras", "avantbras"},
    {"Avant-bras", "avantbras"},
    {"Avant-Bras", "avantbras"},
};

// A name as its artist wrote it: %2E, FBXASC046 and the like are characters again, and words of
// other scripts are ours.
std::string plain_name(const std::string& text) {
  std::string plain;
  bool ascii = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    ascii = ascii && static_cast<unsigned char>(c) < 0x80;
    if (c == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
        hex_digit(text[i + 2]) >= 0) {
      const int code = 16 * hex_digit(text[i + 1]) + hex_digit(text[i + 2]);
      plain += static_cast<char>(code);
      ascii = ascii && code < 0x80;
      i += 2;
      continue;
    }
    constexpr std::string_view kAutodesk = "FBXASC";
    if (c == 'F' && text.compare(i, kAutodesk.size(), kAutodesk) == 0 && i + 9 <= text.size()) {
      int code = 0;
      bool digits = true;
      for (std::size_t k = i + 6; k < i + 9; ++k) {
        digits = digits && std::isdigit(static_cast<unsigned char>(text[k])) != 0;
        code = 10 * code + (text[k] - '0');
      }
      if (digits && code < 256) {
        plain += static_cast<char>(code);
        i += 8;
        continue;
      }
    }
    plain += c;
  }
  const bool french = plain.find("vant-") != std::string::npos;
  if (ascii && !french) return plain;
  constexpr std::size_t kLongest = 300;  // bytes; more is no name
  if (plain.size() > kLongest) return plain;
  for (const auto& [word, meaning] : kForeign) {
    const std::size_t length = std::string_view(word).size();
    for (std::size_t at = plain.find(word); at != std::string::npos; at = plain.find(word, at)) {
      plain.replace(at, length, meaning);
      at += std::string_view(meaning).size();
    }
  }
  return plain;
}

// Lower-case words between separators, digits and capitals. A namespace (up to the last ':' or '|')
// is dropped.
std::vector<std::string> split(const std::string& text) {
  const std::string name = plain_name(text);
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

// Cuts a compound such as "leftupleg" into known words, fewest first; empty if it is none. One
// side's letter may stand between them ("bip01" lost its spaces: "biplupperarm").
std::vector<std::string> cut_compound(const std::string& token, bool with_letter = false) {
  constexpr std::size_t kLongest = 40;
  if (token.size() > kLongest) return {};
  const auto& words = vocabulary();
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
      const bool known = word.size() >= 2 && words.count(word) != 0;
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

// The words of one token: known ones, else the token itself.
std::vector<std::string> words_of(const std::string& token) {
  bool side = false;
  short_side(token, side);
  if (side || vocabulary().count(token) != 0) return {token};
  std::vector<std::string> cut = cut_compound(token);
  if (!cut.empty()) return cut;
  // With a side's letter: "lthigh", "upperarml", "biplupperarm".
  if (token.size() > 3) cut = cut_compound(token, true);
  if (cut.size() >= 2) return cut;
  return {token};
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
  if (any({"hand", "wrist", "palm", "handgelenk", "poignet", "mano", "muneca", "polso"}))
    return BonePart::hand;
  if (any({"foot", "feet", "ankle", "fuss", "knoechel", "pied", "cheville", "pie", "tobillo",
           "piede", "caviglia", "tornozelo"}))
    return BonePart::foot;
  if ((arm && lower) ||
      any({"forearm", "elbow", "ulna", "radius", "unterarm", "ellenbogen", "avantbras", "coude",
           "antebrazo", "codo", "avambraccio", "gomito", "antebraco", "cotovelo"}))
    return BonePart::forearm;
  if ((arm && upper) || any({"bicep", "biceps", "humerus", "oberarm"})) return BonePart::upper_arm;
  if ((leg && lower) || any({"shin", "calf", "knee", "tibia", "fibula", "unterschenkel", "knie",
                             "genou", "pantorrilla", "rodilla", "ginocchio", "joelho"}))
    return BonePart::shin;
  if ((leg && upper) ||
      any({"thigh", "femur", "oberschenkel", "cuisse", "muslo", "coscia", "coxa"}))
    return BonePart::thigh;
  if (arm || any({"bras", "brazo", "braccio", "braco"})) return BonePart::arm;
  if (leg || any({"jambe", "pierna", "gamba", "perna"})) return BonePart::leg;
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
        case Word::copy:
          result.copy = true;
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
