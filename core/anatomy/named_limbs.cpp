// SPDX-License-Identifier: MIT
#include "core/anatomy/named_limbs.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_candidates.h"

namespace elbowroom {
namespace {

constexpr double kLeastHalf = 0.15;  // of a bone: shorter is no half of it
constexpr double kAlikeBones = 0.6;  // the shorter of two bones, of the longer
constexpr double kRounding = 1e-6;

struct Chain {
  int root = -1, middle = -1, end = -1;
  std::string remark;  // what is unusual, for `why`
};

// The end of a limb that names none: the child of the forearm or shin that carries most, at a fair
// distance.
int unnamed_end(const NamedFigure& figure, const LimbFamily& family, int root, int fore) {
  int best = -1, best_weight = -1;
  const double least = 0.2 * figure.distance(root, fore);
  for (const int joint : figure.members) {
    const auto j = static_cast<std::size_t>(joint);
    if (figure.model.skeleton.joints[j].parent != fore) continue;
    const BoneName& name = figure.names[j];
    const bool closes = name.end_marker || name.part == BonePart::none ||
                        name.part == BonePart::finger || name.part == BonePart::toe ||
                        name.part == family.fore;
    if (name.helper || !closes || !(figure.distance(fore, joint) >= least)) continue;
    const int weight = figure.descendants(joint);
    if (weight > best_weight) {
      best = joint;
      best_weight = weight;
    }
  }
  return best;
}

// How much two bones are like a limb's, in units of length: long, and about equal.
double likeness(double upper, double lower) {
  const double shorter = std::min(upper, lower), longer = std::max(upper, lower);
  return longer > 0 ? shorter * shorter / longer : 0;
}

// The root above a forearm or shin: the topmost joint named an upper arm on that bone's line, else
// the topmost plain "arm" on it, else a "shoulder" (some habits call the upper arm so, with a
// collar above; there may be twist joints so named below it): of several the one that makes the two
// bones most equal.
int root_above(const NamedFigure& figure, const LimbFamily& family,
               const std::vector<LimbCandidate>& candidates, int fore, int end) {
  for (const BonePart part : {family.upper, family.plain, family.weak}) {
    int found = -1;
    double best = -1;
    for (const LimbCandidate& candidate : candidates) {  // parents first
      if (candidate.part != part || !figure.below(fore, candidate.joint)) continue;
      if (part != family.weak) {
        // What is named like it below is a piece of the same bone; if not, this one is a helper
        // above it.
        const bool helper =
            std::any_of(candidates.begin(), candidates.end(), [&](const LimbCandidate& other) {
              return other.part == part && figure.below(other.joint, candidate.joint) &&
                     figure.below(fore, other.joint) &&
                     !lies_along(figure.figure.place(other.joint),
                                 figure.figure.place(candidate.joint), figure.figure.place(fore));
            });
        if (helper) continue;
        found = candidate.joint;
        break;
      }
      const double fit =
          end < 0 ? 0
                  : likeness(figure.distance(candidate.joint, fore), figure.distance(fore, end));
      if (fit >= best) {
        found = candidate.joint;
        best = fit;
      }
    }
    if (found >= 0) return found;
  }
  return -1;
}

// Where no joint is named an upper arm: one named a clavicle right above the forearm that is as
// long as an upper arm.
int misnamed_root(const NamedFigure& figure, const LimbFamily& family, int fore, int end) {
  const int above = figure.figure.parent(fore);
  if (!family.arm || end < 0 || above < 0 || !figure.is_member(above)) return -1;
  const BoneName& name = figure.name(above);
  if (name.part != BonePart::clavicle || name.helper) return -1;
  const double upper = figure.distance(above, fore), lower = figure.distance(fore, end);
  return std::min(upper, lower) >= kAlikeBones * std::max(upper, lower) ? above : -1;
}

// Limbs whose joints bear one name and a number ("arm_joint_L_1", "Leg02"): of the chain they form,
// with a named end if there is one, the three joints with two long and equal bones between them.
std::optional<Chain> numbered_chain(const NamedFigure& figure, const LimbFamily& family,
                                    const std::vector<LimbCandidate>& candidates) {
  std::vector<int> best;
  int best_end = -1;
  for (const LimbCandidate& last : candidates) {
    if (last.part != family.plain && last.part != family.upper && last.part != family.fore)
      continue;
    std::vector<int> chain;
    for (const LimbCandidate& other : candidates) {
      if (other.part != family.end && other.part != family.weak &&
          (other.joint == last.joint || figure.below(last.joint, other.joint))) {
        chain.push_back(other.joint);
      }
    }
    bool several = false;
    const int end = nearest_below(figure, candidates, family.end, last.joint, several);
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
      // A clavicle above or twist joints between make the bones less equal. Of two elbows in one
      // place the lower one is it.
      const double fit =
          likeness(figure.distance(best[i], best[m]), figure.distance(best[m], best[last]));
      const bool same_root = found.root == best[i];
      if (fit > longest * (1 + kRounding) || (same_root && fit >= longest * (1 - kRounding))) {
        longest = fit;
        found.root = best[i];
        found.middle = best[m];
        found.end = best[last];
      }
    }
  }
  found.remark = "of the joints so named, those with two long and equal bones between them";
  return found;
}

std::optional<Chain> named_chain(const NamedFigure& figure, const LimbFamily& family,
                                 const std::vector<LimbCandidate>& candidates,
                                 std::string& reason) {
  std::optional<Chain> best;
  int best_score = -1;
  for (const LimbCandidate& fore : candidates) {
    if (fore.part != family.fore) continue;
    const bool topmost =
        std::none_of(candidates.begin(), candidates.end(), [&](const LimbCandidate& other) {
          return other.part == family.fore && figure.below(fore.joint, other.joint);
        });
    if (!topmost) continue;
    Chain chain;
    chain.middle = fore.joint;
    bool several = false;
    chain.end = nearest_below(figure, candidates, family.end, fore.joint, several);
    chain.root = root_above(figure, family, candidates, fore.joint, chain.end);
    if (chain.root < 0) {
      chain.root = misnamed_root(figure, family, fore.joint, chain.end);
      if (chain.root >= 0) {
        chain.remark = figure.quoted(chain.root) + ", named a clavicle, is the " +
                       family.upper_word + " by its length";
      }
    }
    if (chain.root < 0) {
      if (!best) {
        reason =
            "above " + figure.quoted(fore.joint) + " no joint is named as the " + family.upper_word;
      }
      continue;
    }
    int score = 4;
    if (chain.end < 0) {
      chain.end = unnamed_end(figure, family, chain.root, fore.joint);
      score = 2;
      if (chain.end < 0) {
        if (!best) {
          reason = std::string("below ") + figure.quoted(fore.joint) + " is no joint for the " +
                   family.end_word;
        }
        continue;
      }
      if (!chain.remark.empty()) chain.remark += "; ";
      chain.remark += std::string("no joint below the ") + family.fore_word + " is named as the " +
                      family.end_word + ", " + figure.quoted(chain.end) + " is nearest to one";
    } else if (several) {
      if (!chain.remark.empty()) chain.remark += "; ";
      chain.remark += "the " + std::string(family.end_word) + " is of several joints, " +
                      figure.quoted(chain.end) + " stands for them";
    }
    if (figure.figure.carries(fore.joint)) ++score;
    if (score > best_score) {
      best = chain;
      best_score = score;
    }
  }
  return best;
}

// Hands, fingers, feet and toes of the limb's side that move skin but do not hang from it; of each
// branch the topmost.
std::vector<int> detached_ends(const NamedFigure& figure, const LimbFamily& family,
                               const std::vector<LimbCandidate>& candidates, BoneSide side,
                               const Chain& chain) {
  const BonePart digit = family.arm ? BonePart::finger : BonePart::toe;
  std::vector<int> detached;
  for (const LimbCandidate& candidate : candidates) {
    if (candidate.part == family.end && !figure.below(candidate.joint, chain.root))
      detached.push_back(candidate.joint);
  }
  for (const int joint : figure.members) {
    const BoneName& name = figure.name(joint);
    if (name.part != digit || name.side != side || name.helper || name.end_marker || name.copy ||
        figure.below(joint, chain.root) || !is_skin_joint(figure.figure.character, joint) ||
        !figure.figure.carries(joint))
      continue;
    const bool covered = std::any_of(detached.begin(), detached.end(), [&](int other) {
      return joint == other || figure.below(joint, other);
    });
    if (!covered) detached.push_back(joint);
  }
  return detached;
}

// Some rigs split a bone and call its first half the twist ("thigh_twist" above "thigh_stretch"):
// that is where the limb begins.
void begin_at_the_first_half(const NamedFigure& figure, const LimbFamily& family, Chain& chain) {
  const auto half_above = [&](int joint, int next, std::initializer_list<BonePart> parts) {
    const int above = figure.figure.parent(joint);
    if (above < 0 || !figure.is_member(above) || !figure.figure.carries(above)) return -1;
    const BoneName& name = figure.name(above);
    const bool named = std::find(parts.begin(), parts.end(), name.part) != parts.end();
    const double bone = figure.distance(above, next);
    if (!named || !name.helper || name.side != figure.name(joint).side ||
        !(figure.distance(above, joint) > kLeastHalf * bone) ||
        !lies_along(figure.figure.place(joint), figure.figure.place(above),
                    figure.figure.place(next)))
      return -1;
    return above;
  };
  const int root = half_above(chain.root, chain.middle, {family.upper, family.plain});
  const int middle = half_above(chain.middle, chain.end, {family.fore});
  if (root >= 0) {
    chain.remark += (chain.remark.empty() ? "" : "; ") + figure.quoted(root) +
                    " is the first half of the bone of " + figure.quoted(chain.root);
    chain.root = root;
  }
  if (middle >= 0 && figure.below(middle, chain.root)) {
    chain.remark += (chain.remark.empty() ? "" : "; ") + figure.quoted(middle) +
                    " is the first half of the bone of " + figure.quoted(chain.middle);
    chain.middle = middle;
  }
}

NamedLimb find_one(const NamedFigure& figure, const LimbFamily& family, LimbKind kind,
                   const std::vector<BoneSide>& sides) {
  NamedLimb limb;
  const bool left = kind == LimbKind::left_arm || kind == LimbKind::left_leg;
  const BoneSide side = left ? BoneSide::left : BoneSide::right;
  const std::vector<LimbCandidate> candidates = candidates_of(figure, family, side, sides);
  limb.why =
      std::string("no joint is named as ") + (family.arm ? "an arm" : "a leg") + " of that side";
  if (!candidates.empty()) {
    limb.why = "the joints named like one do not form a chain of three (" +
               figure.quoted(candidates.front().joint) + ")";
  }
  // The search below tries pairs of names; a body has a few, a hostile file may have thousands.
  constexpr std::size_t kMostNames = 200;
  if (candidates.size() > kMostNames) {
    limb.why = std::to_string(candidates.size()) + " joints are named like it";
    return limb;
  }
  std::optional<Chain> chain = named_chain(figure, family, candidates, limb.why);
  if (!chain) chain = numbered_chain(figure, family, candidates);
  if (!chain) return limb;
  begin_at_the_first_half(figure, family, *chain);
  const double upper = figure.distance(chain->root, chain->middle);
  const double fore = figure.distance(chain->middle, chain->end);
  const double least = 1e-6 * std::max(figure.figure.character.height, upper + fore);
  if (!(upper > least) || !(fore > least)) {
    limb.why = figure.quoted(chain->root) + ", " + figure.quoted(chain->middle) + " and " +
               figure.quoted(chain->end) + " lie in one place";
    return limb;
  }
  limb.detached = detached_ends(figure, family, candidates, side, *chain);
  limb.root = chain->root;
  limb.middle = chain->middle;
  limb.end = chain->end;
  limb.why = "names: " + std::string(family.upper_word) + " " + figure.quoted(chain->root) + ", " +
             family.fore_word + " " + figure.quoted(chain->middle) + ", " + family.end_word + " " +
             figure.quoted(chain->end) + ", each below the last";
  if (!chain->remark.empty()) limb.why += "; " + chain->remark;
  return limb;
}

}  // namespace

std::array<NamedLimb, 4> find_named_limbs(const BoundFigure& bound,
                                          const std::vector<int>& members) {
  const NamedFigure figure(bound, members);
  std::array<bool, 2> by_place{};
  const std::vector<BoneSide> sides = sides_of(figure, by_place);
  std::array<NamedLimb, 4> found;
  for (const LimbKind kind :
       {LimbKind::left_arm, LimbKind::right_arm, LimbKind::left_leg, LimbKind::right_leg}) {
    const std::size_t family = kind == LimbKind::left_arm || kind == LimbKind::right_arm ? 0 : 1;
    NamedLimb& limb = found[static_cast<std::size_t>(kind)];
    limb = find_one(figure, kLimbFamilies[family], kind, sides);
    limb.side_by_place = by_place[family];
  }
  return found;
}

}  // namespace elbowroom
