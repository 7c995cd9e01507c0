// SPDX-License-Identifier: MIT
#include "core/anatomy/named_limbs.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_joints.h"
#include "core/anatomy/limb_names.h"

namespace elbowroom {
namespace {

// The names of one family of limbs, from the root to the end.
struct Family {
  bool arm;
  BonePart upper, plain, fore, end, weak;
  const char* upper_word;
  const char* fore_word;
  const char* end_word;
};
constexpr std::array<Family, 2> kFamilies = {
    Family{true, BonePart::upper_arm, BonePart::arm, BonePart::forearm, BonePart::hand,
           BonePart::shoulder, "upper arm", "forearm", "hand"},
    Family{false, BonePart::thigh, BonePart::leg, BonePart::shin, BonePart::foot, BonePart::hip,
           "thigh", "shin", "foot"}};

struct Candidate {
  int joint = -1;
  BonePart part = BonePart::none;
  int rank = 0;  // of the same part those with the highest are taken
};

struct Finder {
  const BoundFigure& figure;
  const Model& model;
  const std::vector<int>& members;  // nodes that could be joints of the character, parents first
  std::vector<BoneName> names;      // by node

  std::string quoted(int joint) const { return quoted_joint(model, joint); }
  double distance(int a, int b) const { return glm::distance(figure.place(a), figure.place(b)); }
  bool below(int joint, int ancestor) const {
    return joint != ancestor && model.skeleton.is_within(joint, ancestor);
  }
};

struct Chain {
  int root = -1, middle = -1, end = -1;
  std::string remark;  // what is unusual, for `why`
};

void read_names(Finder& finder) {
  const auto& joints = finder.model.skeleton.joints;
  std::vector<std::string> names;
  for (const int joint : finder.members)
    names.push_back(joints[static_cast<std::size_t>(joint)].name);
  const std::set<std::string> habit = common_words(names);
  finder.names.resize(joints.size());
  for (const int joint : finder.members) {
    const auto j = static_cast<std::size_t>(joint);
    finder.names[j] = read_bone_name(joints[j].name, habit);
  }
}

// Joints that move skin push out those that move none, then what is no copy (Rigify's ORG bones)
// copies, then names of known words names with others in them, then joints of a skin plain nodes.
int rank_of(const Finder& finder, int joint) {
  const BoneName& name = finder.names[static_cast<std::size_t>(joint)];
  return (finder.figure.carries(joint) ? 8 : 0) + (name.copy ? 0 : 4) +
         (name.unknown.empty() ? 2 : 0) + (is_skin_joint(finder.figure.character, joint) ? 1 : 0);
}

bool of_family(const Family& family, BonePart part) {
  return part == family.upper || part == family.plain || part == family.fore ||
         part == family.end || part == family.weak;
}

// The joints of one family on one side; of each part those of the highest rank.
std::vector<Candidate> candidates_of(const Finder& finder, const Family& family, BoneSide side,
                                     const std::vector<BoneSide>& sides) {
  std::vector<Candidate> all;
  for (const int joint : finder.members) {
    const auto j = static_cast<std::size_t>(joint);
    const BoneName& name = finder.names[j];
    if (sides[j] != side || name.helper || name.end_marker || !of_family(family, name.part)) {
      continue;
    }
    all.push_back({joint, name.part, rank_of(finder, joint)});
  }
  // What a bare "arm" or "leg" means: the lower one below an upper one, the upper one above a lower
  // one ("Leg" is the shin where there is an "UpLeg").
  std::vector<Candidate> resolved = all;
  for (Candidate& candidate : resolved) {
    if (candidate.part != family.plain) continue;
    bool has_upper = false, has_fore = false;
    for (const Candidate& other : all) {
      if (other.part == family.upper && finder.below(candidate.joint, other.joint)) {
        has_upper = true;
      }
      if (other.part == family.fore && finder.below(other.joint, candidate.joint)) has_fore = true;
    }
    if (has_upper && !has_fore) candidate.part = family.fore;
    if (has_fore && !has_upper) candidate.part = family.upper;
  }
  std::vector<Candidate> kept;
  for (const Candidate& candidate : resolved) {
    const bool outdone = std::any_of(resolved.begin(), resolved.end(), [&](const Candidate& other) {
      return other.part == candidate.part && other.rank > candidate.rank;
    });
    if (!outdone) kept.push_back(candidate);
  }
  return kept;
}

int descendants(const Finder& finder, int joint) {
  return static_cast<int>(std::count_if(finder.members.begin(), finder.members.end(),
                                        [&](int m) { return finder.below(m, joint); }));
}

// Nearest below `from` with the wanted part; of equally near ones that with most below it, then the
// first. `several` tells of the others.
int nearest_below(const Finder& finder, const std::vector<Candidate>& candidates, BonePart part,
                  int from, bool& several) {
  const Skeleton& skeleton = finder.model.skeleton;
  int best = -1, best_depth = 0, best_weight = 0;
  several = false;
  for (const Candidate& candidate : candidates) {
    if (candidate.part != part || !finder.below(candidate.joint, from)) continue;
    int depth = 0;
    for (int j = candidate.joint; j != from;
         j = skeleton.joints[static_cast<std::size_t>(j)].parent) {
      ++depth;
    }
    const int weight = descendants(finder, candidate.joint);
    if (best >= 0 && depth == best_depth) several = true;
    if (best < 0 || depth < best_depth || (depth == best_depth && weight > best_weight)) {
      if (best < 0 || depth < best_depth) several = false;
      best = candidate.joint;
      best_depth = depth;
      best_weight = weight;
    }
  }
  return best;
}

// The end of a limb that names none: the child of the forearm or shin that carries most, at a fair
// distance.
int unnamed_end(const Finder& finder, const Family& family, int root, int fore) {
  int best = -1, best_weight = -1;
  const double least = 0.2 * finder.distance(root, fore);
  for (const int joint : finder.members) {
    const auto j = static_cast<std::size_t>(joint);
    if (finder.model.skeleton.joints[j].parent != fore) continue;
    const BoneName& name = finder.names[j];
    const bool closes = name.end_marker || name.part == BonePart::none ||
                        name.part == BonePart::finger || name.part == BonePart::toe ||
                        name.part == family.fore;
    if (name.helper || !closes || !(finder.distance(fore, joint) >= least)) continue;
    const int weight = descendants(finder, joint);
    if (weight > best_weight) {
      best = joint;
      best_weight = weight;
    }
  }
  return best;
}

// The root above a forearm or shin: the topmost joint named an upper arm, else the topmost plain
// "arm", else the nearest "shoulder" (some habits call the upper arm so, with a collar above).
int root_above(const Finder& finder, const Family& family, const std::vector<Candidate>& candidates,
               int fore) {
  for (const BonePart part : {family.upper, family.plain, family.weak}) {
    int found = -1;
    for (const Candidate& candidate : candidates) {  // parents first
      if (candidate.part != part || !finder.below(fore, candidate.joint)) continue;
      if (found < 0 || part == family.weak) found = candidate.joint;
    }
    if (found >= 0) return found;
  }
  return -1;
}

// Limbs whose joints bear one name and a number ("arm_joint_L_1", "Leg02"): of the chain they form,
// with a named end if there is one, the three joints with the longest two bones between them.
std::optional<Chain> numbered_chain(const Finder& finder, const Family& family,
                                    const std::vector<Candidate>& candidates) {
  std::vector<int> best;
  int best_end = -1;
  for (const Candidate& last : candidates) {
    if (last.part != family.plain && last.part != family.upper && last.part != family.fore)
      continue;
    std::vector<int> chain;
    for (const Candidate& other : candidates) {
      if (other.part != family.end && other.part != family.weak &&
          (other.joint == last.joint || finder.below(last.joint, other.joint))) {
        chain.push_back(other.joint);
      }
    }
    bool several = false;
    const int end = nearest_below(finder, candidates, family.end, last.joint, several);
    const auto better = [](bool end_a, std::size_t a, bool end_b, std::size_t b) {
      return end_a != end_b ? end_a : a > b;
    };
    if (best.empty() || better(end >= 0, chain.size(), best_end >= 0, best.size())) {
      best = chain;
      best_end = end;
    }
  }
  if (best_end >= 0) best.push_back(best_end);
  if (best.size() < 3) return std::nullopt;
  Chain found;
  double longest = -1;
  for (std::size_t i = 0; i + 2 < best.size(); ++i) {
    // A named end stays the end.
    const std::size_t last = best_end >= 0 ? best.size() - 1 : i + 2;
    for (std::size_t m = i + 1; m < last; ++m) {
      const double a = finder.distance(best[i], best[m]);
      const double b = finder.distance(best[m], best[last]);
      const double score = best_end >= 0 ? std::min(a, b) : a + b;
      if (score > longest) {
        longest = score;
        found = {best[i], best[m], best[last], ""};
      }
    }
  }
  found.remark = "of the joints so named, those with the longest two bones between them";
  return found;
}

std::optional<Chain> named_chain(const Finder& finder, const Family& family,
                                 const std::vector<Candidate>& candidates, std::string& reason) {
  std::optional<Chain> best;
  int best_score = -1;
  for (const Candidate& fore : candidates) {
    if (fore.part != family.fore) continue;
    const bool topmost =
        std::none_of(candidates.begin(), candidates.end(), [&](const Candidate& other) {
          return other.part == family.fore && finder.below(fore.joint, other.joint);
        });
    if (!topmost) continue;
    Chain chain;
    chain.middle = fore.joint;
    chain.root = root_above(finder, family, candidates, fore.joint);
    if (chain.root < 0) {
      if (!best) {
        reason =
            "above " + finder.quoted(fore.joint) + " no joint is named as the " + family.upper_word;
      }
      continue;
    }
    bool several = false;
    chain.end = nearest_below(finder, candidates, family.end, fore.joint, several);
    int score = 4;
    if (chain.end < 0) {
      chain.end = unnamed_end(finder, family, chain.root, fore.joint);
      score = 2;
      if (chain.end < 0) {
        if (!best) {
          reason = std::string("below ") + finder.quoted(fore.joint) + " is no joint for the " +
                   family.end_word;
        }
        continue;
      }
      chain.remark = std::string("no joint below the ") + family.fore_word + " is named as the " +
                     family.end_word + ", " + finder.quoted(chain.end) + " is nearest to one";
    } else if (several) {
      chain.remark = "the " + std::string(family.end_word) + " is of several joints, " +
                     finder.quoted(chain.end) + " stands for them";
    }
    if (finder.figure.carries(fore.joint)) ++score;
    if (score > best_score) {
      best = chain;
      best_score = score;
    }
  }
  return best;
}

// Sides by position for families whose names tell none.
std::vector<BoneSide> sides_of(const Finder& finder, std::array<bool, 2>& by_position) {
  std::vector<BoneSide> sides(finder.names.size(), BoneSide::none);
  for (const int joint : finder.members) {
    sides[static_cast<std::size_t>(joint)] = finder.names[static_cast<std::size_t>(joint)].side;
  }
  for (std::size_t f = 0; f < kFamilies.size(); ++f) {
    const Family& family = kFamilies[f];
    by_position[f] = std::none_of(finder.members.begin(), finder.members.end(), [&](int joint) {
      const BoneName& name = finder.names[static_cast<std::size_t>(joint)];
      return name.side != BoneSide::none && of_family(family, name.part);
    });
    if (!by_position[f]) continue;
    // For the time being towards +x, since glTF figures face +z.
    std::vector<Vec3> places;
    for (const int joint : finder.members) {
      if (of_family(family, finder.names[static_cast<std::size_t>(joint)].part))
        places.push_back(finder.figure.place(joint));
    }
    const Vec3 left = widest_way(places);
    double middle = 0, low = INFINITY, high = -INFINITY;
    for (const int joint : finder.figure.character.joints) {
      const double along = glm::dot(finder.figure.place(joint), left);
      low = std::min(low, along);
      high = std::max(high, along);
      middle += along;
    }
    middle /= std::max<double>(1.0, static_cast<double>(finder.figure.character.joints.size()));
    for (const int joint : finder.members) {
      const auto j = static_cast<std::size_t>(joint);
      if (!of_family(family, finder.names[j].part)) continue;
      const double along = glm::dot(finder.figure.place(joint), left) - middle;
      if (std::abs(along) < 0.01 * (high - low)) continue;
      sides[j] = along > 0 ? BoneSide::left : BoneSide::right;
    }
  }
  return sides;
}

// A hand or foot that does not hang from its limb, or nothing.
int detached_end(const Finder& finder, const Family& family,
                 const std::vector<Candidate>& candidates, const Chain& chain) {
  for (const Candidate& candidate : candidates) {
    if (candidate.part == family.end && !finder.below(candidate.joint, chain.root)) {
      return candidate.joint;
    }
  }
  return -1;
}

NamedLimb find_one(const Finder& finder, const Family& family, LimbKind kind,
                   const std::vector<BoneSide>& sides) {
  NamedLimb limb;
  const bool left = kind == LimbKind::left_arm || kind == LimbKind::left_leg;
  const std::vector<Candidate> candidates =
      candidates_of(finder, family, left ? BoneSide::left : BoneSide::right, sides);
  limb.why =
      std::string("no joint is named as ") + (family.arm ? "an arm" : "a leg") + " of that side";
  if (!candidates.empty()) {
    limb.why = "the joints named like one do not form a chain of three (" +
               finder.quoted(candidates.front().joint) + ")";
  }
  // The search below tries pairs of names; a body has a few, a hostile file may have thousands.
  constexpr std::size_t kMostNames = 200;
  if (candidates.size() > kMostNames) {
    limb.why = std::to_string(candidates.size()) + " joints are named like it";
    return limb;
  }
  std::optional<Chain> chain = named_chain(finder, family, candidates, limb.why);
  if (!chain) chain = numbered_chain(finder, family, candidates);
  if (!chain) return limb;
  const double upper = finder.distance(chain->root, chain->middle);
  const double fore = finder.distance(chain->middle, chain->end);
  const double least = 1e-6 * std::max(finder.figure.character.height, upper + fore);
  if (!(upper > least) || !(fore > least)) {
    limb.why = finder.quoted(chain->root) + ", " + finder.quoted(chain->middle) + " and " +
               finder.quoted(chain->end) + " lie in one place";
    return limb;
  }
  const int detached = detached_end(finder, family, candidates, *chain);
  if (detached >= 0) {
    const int parent = finder.figure.parent(detached);
    const std::string what = finder.quoted(detached) + " hangs " +
                             (parent < 0 ? "free" : "from " + finder.quoted(parent)) +
                             ", not from the limb, and will not follow it";
    if (!chain->remark.empty()) chain->remark += "; ";
    chain->remark += what;
    limb.warnings.push_back(what);
  }
  limb.root = chain->root;
  limb.middle = chain->middle;
  limb.end = chain->end;
  limb.why = "names: " + std::string(family.upper_word) + " " + finder.quoted(chain->root) + ", " +
             family.fore_word + " " + finder.quoted(chain->middle) + ", " + family.end_word + " " +
             finder.quoted(chain->end) + ", each below the last";
  if (!chain->remark.empty()) limb.why += "; " + chain->remark;
  return limb;
}

}  // namespace

std::array<NamedLimb, 4> find_named_limbs(const BoundFigure& figure,
                                          const std::vector<int>& members) {
  Finder finder{figure, figure.model, members, {}};
  read_names(finder);
  std::array<bool, 2> by_position{};
  const std::vector<BoneSide> sides = sides_of(finder, by_position);
  std::array<NamedLimb, 4> found;
  for (const LimbKind kind :
       {LimbKind::left_arm, LimbKind::right_arm, LimbKind::left_leg, LimbKind::right_leg}) {
    const std::size_t family = kind == LimbKind::left_arm || kind == LimbKind::right_arm ? 0 : 1;
    NamedLimb& limb = found[static_cast<std::size_t>(kind)];
    limb = find_one(finder, kFamilies[family], kind, sides);
    limb.side_by_place = by_position[family];
  }
  return found;
}

}  // namespace elbowroom
