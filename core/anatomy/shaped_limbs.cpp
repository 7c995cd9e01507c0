// SPDX-License-Identifier: MIT
#include "core/anatomy/shaped_limbs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/chain_shape.h"

namespace elbowroom {
namespace {

constexpr std::size_t kMostSiblings = 24;  // that are compared in pairs
constexpr std::size_t kMostPairs = 60;     // kept, the best ones
constexpr double kAlike = 0.2;             // of both sides' bones, on the logarithm of lengths
constexpr double kUnlikeCost = 2;          // for each unit of it
constexpr double kMostExtent = 2;          // one side against the other, with what it holds
constexpr double kApart = 0.02;            // of a limb's length, between the roots of a pair
constexpr double kMostCost = 1.6;          // for each of a pair: worse is no limb
constexpr double kTrunk = 0.2;             // of a limb's length, between shoulders and hips
constexpr double kSameSides = 0.85;        // cosine, between shoulders' and hips' lines
constexpr double kAcross = 0.4;            // cosine, between the trunk and those lines
constexpr double kSymmetric = 0.8;         // of the joints, where one pair is all there is
constexpr double kStands = 0.12;           // of its length, by which the rest is above a lone pair
constexpr double kMirrorNear = 0.05;       // of the figure's size

struct Fit {
  std::array<ChainFit, 2> side;  // of both chains
  double cost = INFINITY;        // mean of both
  double length = 0;             // root to end along the bones, mean
  double score() const { return length * std::exp(-cost); }
};

struct Pair {
  std::array<const ShapedChain*, 2> chains;
  int above = -1;  // the joint they leave; -1: none
  Fit arm, leg;
};

double unlike(double a, double b) { return std::abs(std::log(a / b)); }

class Finder {
 public:
  Finder(const BoundFigure& figure, const std::vector<int>& members)
      : figure_(figure), members_(members), shape_(figure, members) {}

  ShapedLimbs find() {
    collect_pairs();
    ShapedLimbs found;
    found.no_arms = found.no_legs =
        "no two chains of three joints or more are alike on both sides of the body";
    if (pairs_.empty()) return found;
    const Pair* arms = nullptr;
    const Pair* legs = nullptr;
    double best = 0;
    for (const Pair& a : pairs_) {
      for (const Pair& b : pairs_) {
        const double value = together(a, b);
        if (!(value > best)) continue;
        best = value;
        arms = &a;
        legs = &b;
      }
    }
    if (arms == nullptr) choose_one(arms, legs, found);
    if (arms != nullptr) found.arms = limbs_of(*arms, arms->arm, "arms");
    if (legs != nullptr) found.legs = limbs_of(*legs, legs->leg, "legs");
    return found;
  }

 private:
  void collect_pairs() {
    std::vector<int> roots;  // of the members' own trees
    std::vector<char> member(figure_.globals.size(), 0);
    for (const int joint : members_) member[static_cast<std::size_t>(joint)] = 1;
    for (const int joint : members_) {
      const int parent = figure_.parent(joint);
      if ((parent < 0 || !member[static_cast<std::size_t>(parent)]) && figure_.carries(joint)) {
        roots.push_back(joint);
      }
    }
    pairs_among(-1, roots);
    for (const int joint : members_) pairs_among(joint, shape_.below(joint));
    std::stable_sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
      return std::max(a.arm.score(), a.leg.score()) > std::max(b.arm.score(), b.leg.score());
    });
    if (pairs_.size() > kMostPairs) pairs_.resize(kMostPairs);
  }

  void pairs_among(int above, std::vector<int> siblings) {
    if (siblings.size() < 2) return;
    std::stable_sort(siblings.begin(), siblings.end(),
                     [&](int a, int b) { return shape_.extent(a) > shape_.extent(b); });
    if (siblings.size() > kMostSiblings) siblings.resize(kMostSiblings);
    for (std::size_t i = 0; i < siblings.size(); ++i) {
      for (std::size_t j = i + 1; j < siblings.size(); ++j) {
        if (shape_.extent(siblings[i]) > kMostExtent * shape_.extent(siblings[j])) break;
        if (shape_.chain(siblings[i]).joints.size() < 3 ||
            shape_.chain(siblings[j]).joints.size() < 3)
          continue;
        Pair pair;
        pair.above = above;
        pair.chains = {&shape_.chain(siblings[i]), &shape_.chain(siblings[j])};
        pair.arm = fit_both(pair, true);
        pair.leg = fit_both(pair, false);
        if (pair.arm.cost <= kMostCost || pair.leg.cost <= kMostCost) pairs_.push_back(pair);
      }
    }
  }

  // The same three places along both chains where that fits, else the best ones of each.
  Fit fit_both(const Pair& pair, bool arm) {
    Fit best;
    const auto take = [&](const ChainFit& a, const ChainFit& b, double extra) {
      const double off = std::max(unlike(a.upper, b.upper), unlike(a.lower, b.lower));
      const double cost = 0.5 * (a.cost + b.cost) + extra + kUnlikeCost * off;
      if (!(cost < best.cost) || !(off < kAlike)) return;
      const double length = 0.5 * (a.upper + a.lower + b.upper + b.lower);
      if (!(glm::distance(place(pair, 0, a.root), place(pair, 1, b.root)) > kApart * length))
        return;
      best.side = {a, b};
      best.cost = cost;
      best.length = length;
    };
    const std::vector<ChainFit> first = shape_.fits(*pair.chains[0], pair.chains[1], arm);
    const std::vector<ChainFit> second = shape_.fits(*pair.chains[1], pair.chains[0], arm);
    const auto key = [](const ChainFit& fit) { return std::array{fit.root, fit.middle, fit.end}; };
    // Both are in the order of their indices.
    auto b = second.begin();
    for (const ChainFit& a : first) {
      while (b != second.end() && key(*b) < key(a)) ++b;
      if (b != second.end() && key(*b) == key(a)) take(a, *b, 0);
    }
    if (pair.chains[0]->joints.size() != pair.chains[1]->joints.size() && !first.empty() &&
        !second.empty()) {
      const auto cheaper = [](const ChainFit& a, const ChainFit& b) { return a.cost < b.cost; };
      take(*std::min_element(first.begin(), first.end(), cheaper),
           *std::min_element(second.begin(), second.end(), cheaper), 0.2);
    }
    return best;
  }

  Vec3 place(const Pair& pair, std::size_t side, std::size_t index) const {
    return figure_.place(pair.chains[side]->joints[index]);
  }
  Vec3 middle(const Pair& pair, const Fit& fit, std::size_t ChainFit::*which) const {
    return 0.5 * (place(pair, 0, fit.side[0].*which) + place(pair, 1, fit.side[1].*which));
  }
  Vec3 across(const Pair& pair, const Fit& fit) const {
    return place(pair, 0, fit.side[0].root) - place(pair, 1, fit.side[1].root);
  }
  bool apart(const Pair& a, const Pair& b) const {
    const Skeleton& skeleton = figure_.model.skeleton;
    for (const ShapedChain* x : a.chains) {
      for (const ShapedChain* y : b.chains) {
        if (skeleton.is_within(x->joints.front(), y->joints.front()) ||
            skeleton.is_within(y->joints.front(), x->joints.front()))
          return false;
      }
    }
    return true;
  }

  // How well two pairs make a body's arms and legs; 0: not at all.
  double together(const Pair& arms, const Pair& legs) const {
    if (&arms == &legs || arms.arm.cost > kMostCost || legs.leg.cost > kMostCost) return 0;
    const double arm = arms.arm.length, leg = legs.leg.length;
    if (!(arm < 3 * leg && leg < 6 * arm) || !apart(arms, legs)) return 0;
    const Vec3 shoulders = middle(arms, arms.arm, &ChainFit::root);
    const Vec3 hips = middle(legs, legs.leg, &ChainFit::root);
    const Vec3 trunk = shoulders - hips;
    if (!(glm::length(trunk) > kTrunk * 0.5 * (arm + leg))) return 0;
    const auto a = direction(across(arms, arms.arm)), b = direction(across(legs, legs.leg));
    const auto up = direction(trunk);
    if (!a || !b || !up || std::abs(glm::dot(*a, *b)) < kSameSides) return 0;
    if (std::abs(glm::dot(*a, *up)) > kAcross || std::abs(glm::dot(*b, *up)) > kAcross) return 0;

    double value = arms.arm.score() + legs.leg.score();
    // Legs point away from the shoulders, and leave the trunk nearer to the skeleton's root.
    const Vec3 legs_way = middle(legs, legs.leg, &ChainFit::end) - hips;
    const double away = -glm::dot(legs_way, *up) / leg;
    value *= 1.0 + 0.5 * std::clamp(away, -1.0, 1.0);
    const int arms_depth = depth(arms.above), legs_depth = depth(legs.above);
    if (arms_depth != legs_depth) value *= legs_depth < arms_depth ? 1.25 : 0.8;
    // Hair and ears leave the trunk beyond the arms.
    if (outdone(arms, legs)) value *= 0.75;
    // Standing in the file's own up they are the lower ones.
    const Vec3 arm_ends = middle(arms, arms.arm, &ChainFit::end);
    const Vec3 leg_ends = middle(legs, legs.leg, &ChainFit::end);
    value *= leg_ends.y < arm_ends.y ? 1.1 : 0.9;
    return value;
  }

  // Whether a pair that could be arms leaves the trunk between the legs and this one.
  bool outdone(const Pair& arms, const Pair& legs) const {
    const Skeleton& skeleton = figure_.model.skeleton;
    return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& other) {
      return other.above >= 0 && arms.above >= 0 && other.above != arms.above &&
             skeleton.is_within(arms.above, other.above) &&
             (legs.above < 0 || !skeleton.is_within(legs.above, other.above)) &&
             other.arm.cost <= kMostCost && other.arm.length > 0.6 * arms.arm.length &&
             apart(other, legs);
    });
  }

  int depth(int joint) const {
    int count = 0;
    for (; joint >= 0; joint = figure_.parent(joint)) ++count;
    return count;
  }

  // Where there is but one pair: is the whole figure its own mirror image in it, and does the rest
  // of it stand on the pair (legs) or not (arms)?
  void choose_one(const Pair*& arms, const Pair*& legs, ShapedLimbs& found) const {
    for (const Pair& pair : pairs_) {  // best first
      const bool could_be_arms = pair.arm.cost <= kMostCost;
      const bool could_be_legs = pair.leg.cost <= kMostCost;
      const Fit& fit = could_be_legs ? pair.leg : pair.arm;
      if (!symmetric_about(pair, fit)) continue;
      const Vec3 roots = middle(pair, fit, &ChainFit::root);
      const auto way = direction(middle(pair, fit, &ChainFit::end) - roots);
      const bool stands = way && glm::dot(*way, rest_of_body(pair) - roots) < -kStands * fit.length;
      if (stands && could_be_legs) {
        legs = &pair;
        found.no_arms = "beside the legs no pair of chains has three joints that fit an arm";
      } else if (!stands && could_be_arms) {
        arms = &pair;
        found.no_legs = "beside the arms no pair of chains has three joints that fit a leg";
      } else {
        continue;
      }
      return;
    }
    found.no_arms = found.no_legs =
        "of the chains alike on both sides none fit arms and legs on a trunk";
  }

  bool symmetric_about(const Pair& pair, const Fit& fit) const {
    const auto normal = direction(across(pair, fit));
    if (!normal) return false;
    const Vec3 centre = middle(pair, fit, &ChainFit::root);
    std::vector<Vec3> places;
    Vec3 low(INFINITY), high(-INFINITY);
    constexpr std::size_t kMostCompared = 1000;
    for (const int joint : members_) {
      if (!figure_.carries(joint) || places.size() >= kMostCompared) continue;
      places.push_back(figure_.place(joint));
      low = glm::min(low, places.back());
      high = glm::max(high, places.back());
    }
    if (places.size() < 8) return false;
    const double near = kMirrorNear * glm::length(high - low);
    std::size_t matched = 0;
    for (const Vec3& p : places) {
      const Vec3 image = p - 2.0 * glm::dot(p - centre, *normal) * *normal;
      matched += std::any_of(places.begin(), places.end(),
                             [&](const Vec3& q) { return glm::distance(image, q) < near; });
    }
    return static_cast<double>(matched) >= kSymmetric * static_cast<double>(places.size());
  }

  Vec3 rest_of_body(const Pair& pair) const {
    const Skeleton& skeleton = figure_.model.skeleton;
    Vec3 sum(0.0);
    int count = 0;
    for (const int joint : members_) {
      if (!figure_.carries(joint) || skeleton.is_within(joint, pair.chains[0]->joints.front()) ||
          skeleton.is_within(joint, pair.chains[1]->joints.front()))
        continue;
      sum += figure_.place(joint);
      ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : sum;
  }

  ShapedPair limbs_of(const Pair& pair, const Fit& fit, const char* what) const {
    ShapedPair limbs;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& joints = pair.chains[side]->joints;
      const ChainFit& own = fit.side[side];
      limbs[side] = {joints[own.root], joints[own.middle], joints[own.end], ""};
      std::string from = "no joint";
      if (pair.above >= 0) {
        const std::string& name =
            figure_.model.skeleton.joints[static_cast<std::size_t>(pair.above)].name;
        from = name.empty() ? "node " + std::to_string(pair.above) : "'" + name + "'";
      }
      char text[160];
      std::snprintf(text, sizeof text,
                    "two chains alike on both sides as %s are, bones %.3g and %.3g", what,
                    own.upper, own.lower);
      limbs[side].why = std::string(text) + ", leaving " + from + own.remark;
    }
    return limbs;
  }

  const BoundFigure& figure_;
  const std::vector<int>& members_;
  ChainShapes shape_;
  std::vector<Pair> pairs_;
};

}  // namespace

ShapedLimbs find_shaped_limbs(const BoundFigure& figure, const std::vector<int>& members) {
  // A body has some dozens of joints, a crowd or a hostile file has thousands.
  constexpr std::size_t kMostJoints = 5000;
  if (members.size() > kMostJoints) {
    ShapedLimbs none;
    none.no_arms = none.no_legs =
        "it has " + std::to_string(members.size()) + " joints, too many to look for it by shape";
    return none;
  }
  return Finder(figure, members).find();
}

}  // namespace elbowroom
