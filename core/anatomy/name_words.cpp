// SPDX-License-Identifier: MIT
#include "core/anatomy/name_words.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <sstream>
#include <utility>
#include <vector>

namespace elbowroom {
namespace {

// Words of one meaning, in English, with spaces between them.
struct Words {
  const char* meaning;
  const char* words;
};

// Of scripts that don't separate words: Japanese and Chinese, which share characters, and Korean;
// and Russian, small and with a capital. In MikuMikuDance's own names 腕 is the upper arm and 足
// the thigh.
constexpr Words kOtherScripts[] = {
    {"left", "左 ひだり 왼쪽 왼 левая Левая левый Левый левое Левое"},
    {"right", "右 みぎ 오른쪽 오른 правая Правая правый Правый правое Правое"},
    {"clavicle", "鎖骨 锁骨 쇄골 ключица Ключица"},
    {"scapula", "肩甲"},
    {"shoulder", "肩膀 肩 어깨"},
    {"upper arm", "二の腕 上腕 腕 大臂 上臂 위팔 윗팔 상완 плечо Плечо"},
    {"arm", "胳膊 臂 팔 рука Рука"},
    {"arm twist", "腕捩"},
    {"elbow", "手肘 ひじ ヒジ 肘 팔꿈치 локоть Локоть"},
    {"lower arm", "前腕 下腕 小臂 前臂 下臂 아래팔 전완 предплечье Предплечье"},
    {"wrist", "手首 手腕 손목 запястье Запястье"},
    {"hand", "手 손 кисть Кисть"},
    {"hand twist", "手捩"},
    {"palm", "手掌 掌"},
    {"thumb", "親指 拇指 엄지"},
    {"index", "人差指 人指 食指"},
    {"middle", "中指"},
    {"ring", "薬指"},
    {"pinky", "小指"},
    {"finger", "指 손가락 пальц Пальц палец Палец"},
    {"thigh", "太もも もも 大腿 허벅지 бедро Бедро"},
    {"upper leg", "足"},
    {"leg", "腿 다리 нога Нога"},
    {"knee", "ひざ ヒザ 膝盖 膝蓋 膝 무릎 колено Колено"},
    {"shin", "すね 脛 小腿 종아리 голень Голень"},
    {"ankle", "足首 脚踝 腳踝 발목 лодыжка Лодыжка"},
    {"foot", "脚 腳 발 стопа Стопа ступня Ступня"},
    {"toe", "足先 つま先 爪先 脚趾 腳趾 발가락 носок Носок"},
    {"twist", "捩 捻 ねじり"},
    {"sleeve", "袖"},
    {"helper", "親"},
    {"dummy", "ダミー"},
    {"cancel", "キャンセル"},
    {"end", "先"},
    {"ik", "\xef\xbc\xa9\xef\xbc\xab"},
};

// Letters with accents, by what stands for them.
constexpr Words kAccents[] = {
    {"ss", "ß"},  {"ae", "ä"},      {"oe", "ö"}, {"ue", "ü"}, {"a", "à á â ã ą"},
    {"c", "ç"},   {"e", "è é ê ę"}, {"E", "É"},  {"i", "í"},  {"l", "ł"},
    {"n", "ñ ń"}, {"o", "ó õ"},     {"s", "ś"},  {"u", "ú"},
};

// Of other languages in Latin letters, without accents: German, Dutch, French, Spanish, Italian,
// Portuguese, Polish, and Japanese as it is written there.
constexpr Words kTranslations[] = {
    {"left",
     "links linker linkes linke gauche izquierda izquierdo izq sinistra sinistro sx esquerda "
     "esquerdo esq lewa lewy lewe hidari"},
    {"right",
     "rechts rechter rechtes rechte droite droit derecha derecho der destra destro dx direita "
     "direito prawa prawy prawe migi"},
    {"shoulder", "schulter schouder epaule hombro spalla ombro kata"},
    {"clavicle", "schluesselbein sleutelbeen clavicule clavicula clavicola obojczyk"},
    {"upper arm", "oberarm bovenarm ramie"},
    {"lower arm", "unterarm onderarm avantbras antebrazo avambraccio antebraco przedramie"},
    {"elbow", "ellenbogen elleboog coude codo gomito cotovelo lokiec hiji"},
    {"wrist", "handgelenk pols poignet muneca polso pulso nadgarstek tekubi"},
    {"thumb", "daumen duim pouce pulgar pollice polegar oyayubi"},
    {"thigh", "oberschenkel bovenbeen cuisse muslo coscia coxa udo momo"},
    {"shin", "unterschenkel onderbeen canela sune"},
    {"knee", "knie genou rodilla ginocchio joelho kolano hiza"},
    {"calf", "wade mollet pantorrilla polpaccio panturrilha lydka"},
    {"ankle", "knoechel enkel cheville tobillo caviglia tornozelo ashikubi"},
    {"foot", "fuss voet pied pie piede stopa"},
    {"toe", "zeh zehe zehen teen orteil orteils tsumasaki"},
    {"finger", "vinger doigt doigts dedo dedos dito yubi nakayubi kusuriyubi koyubi"},
    {"arm", "bras brazo braccio braco ude"},
    {"fore", "avant"},
    {"leg", "jambe pierna gamba perna ashi"},
    {"hand", "mano mao dlon"},
    {"index", "indice hitosashiyubi"},
};

using Pairs = std::vector<std::pair<std::string, std::string>>;

// Each word with its meaning, longer ones before those they contain.
template <std::size_t N>
Pairs listed(const Words (&table)[N]) {
  Pairs pairs;
  for (const Words& row : table) {
    std::istringstream words(row.words);
    for (std::string word; words >> word;) pairs.emplace_back(word, row.meaning);
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
  return pairs;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

const std::map<std::string, NameWord, std::less<>>& name_words() {
  static const std::map<std::string, NameWord, std::less<>> words = [] {
    std::map<std::string, NameWord, std::less<>> map;
    const auto add = [&](NameWord kind, std::initializer_list<const char*> list) {
      for (const char* word : list) map.emplace(word, kind);
    };
    add(NameWord::side_left, {"left"});
    add(NameWord::side_right, {"right"});
    add(NameWord::part,
        {"upper",  "up",     "upr",     "lower",   "low",       "lo",       "lwr",   "fore",
         "down",   "dn",     "arm",     "arms",    "leg",       "legs",     "hand",  "wrist",
         "elbow",  "thigh",  "shin",    "calf",    "knee",      "foot",     "feet",  "ankle",
         "bicep",  "biceps", "femur",   "tibia",   "fibula",    "shoulder", "shldr", "clavicle",
         "clav",   "collar", "scapula", "ulna",    "radius",    "humerus",  "hip",   "hips",
         "pelvis", "palm",   "fist",    "forearm", "collarbone"});
    add(NameWord::finger,
        {"finger", "fingers", "thumb", "index", "middle", "ring", "pinky", "pinkie", "little",
         "metacarpal", "carpal", "knuckle", "digit", "digits"});
    add(NameWord::toe, {"toe", "toes", "toebase", "ball", "heel", "metatarsal", "midtarsal"});
    add(NameWord::helper,
        {"ik",     "fk",       "ctrl",    "ctl",        "control", "controller", "cntrl",
         "pole",   "target",   "tgt",     "orient",     "twist",   "roll",       "helper",
         "tweak",  "effector", "eff",     "socket",     "attach",  "attachment", "att",
         "slot",   "prop",     "weapon",  "mch",        "pv",      "pt",         "aux",
         "aim",    "goal",     "locator", "hint",       "handle",  "driver",     "jiggle",
         "muscle", "tracker",  "share",   "corrective", "assimp",  "dummy",      "cancel",
         "pivot",  "proxy",    "sleeve",  "skirt",      "cloth",   "armor",      "armour",
         "solver", "hlp",      "ref",     "assist",     "adj",     "holder",     "platform",
         "sec",    "ikfk"});
    add(NameWord::copy, {"org"});
    add(NameWord::end_marker, {"end", "nub", "tip"});
    add(NameWord::noise,
        {"mixamorig", "bip",   "biped",    "def",   "deform",      "armature",  "skeleton",
         "skel",      "joint", "jnt",      "jt",    "bone",        "bn",        "bind",
         "skin",      "cc",    "base",     "rig",   "char",        "character", "bend",
         "stretch",   "b",     "j",        "sk",    "valvebiped",  "main",      "fbx",
         "no",        "rot",   "rotation", "trans", "translation", "pre",       "node",
         "o",         "mesh",  "d",        "ex"});
    return map;
  }();
  return words;
}

const std::map<std::string, std::string, std::less<>>& translated_words() {
  static const std::map<std::string, std::string, std::less<>> words = [] {
    std::map<std::string, std::string, std::less<>> map;
    for (const auto& [word, meaning] : listed(kTranslations)) map.emplace(word, meaning);
    return map;
  }();
  return words;
}

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
        ascii = ascii && code < 0x80;
        i += 8;
        continue;
      }
    }
    plain += c;
  }
  constexpr std::size_t kLongest = 300;  // bytes; more is no name
  if (ascii || plain.size() > kLongest) return plain;
  static const Pairs kReplaced = [] {
    Pairs all;
    for (const auto& [word, meaning] : listed(kOtherScripts))
      all.emplace_back(word, " " + meaning + " ");
    for (const auto& pair : listed(kAccents)) all.push_back(pair);
    return all;
  }();
  for (const auto& [word, meaning] : kReplaced) {
    for (std::size_t at = plain.find(word); at != std::string::npos; at = plain.find(word, at)) {
      plain.replace(at, word.size(), meaning);
      at += meaning.size();
    }
  }
  return plain;
}

}  // namespace elbowroom
