// SPDX-License-Identifier: MIT
#include "core/anatomy/chain_shape.h"

#include <algorithm>
#include <cmath>

#include "core/anatomy/bind_geometry.h"

namespace elbowroom {
namespace {

constexpr double kDegree = kPi / 180;
constexpr std::size_t kLongestChain = 12;  // joints looked at from a chain's begin
constexpr double kBranch = 0.35;           // of the longest branch: less is no branch but a helper
constexpr double kSamePlace = 1e-4;        // of what is beyond: two joints where one would do
constexpr double kTogether = 0.03;         // of a bone: joints in one place

// --- What a limb looks like. Arms: upper arm to forearm about 1 : 0.9, a clavicle of less than
// half of both, a hand with fingers of 0.7 of the forearm. Legs: thigh to shin about 1 : 1, a foot
// with toes of 0.6. Costs are per unit of the logarithm or of the share by which a chain is off.
constexpr double kFreeRatio = 0.15, kRatioCost = 1.5;
constexpr double kOnLineCost = 0.25, kOffLineCost = 1.0;
constexpr double kLongAbove = 0.6, kLongAboveCost = 2.0;
constexpr double kLongBeyond = 1.2, kLongBeyondCost = 1.5;
constexpr double kShoulders = 0.3, kShouldersCost = 1.2;  // breadth, of an arm's length
constexpr double kForkHere = -0.3, kForkBelow = 0.5, kForkAbove = 0.6;
constexpr double kAbove = 0.4, kHipPiece = 0.15;
constexpr double kHipPieceLength = 0.15, kHipPieceAslant = 35 * kDegree;
constexpr double kShortEnd = 0.45, kPalm = 0.2;
constexpr double kAnkleTurn = 35 * kDegree, kAnkleBonus = -0.3;
constexpr double kBends = 20 * kDegree, kStill = 4 * kDegree;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

bool is_hip_piece(const Vec3& hip, const Vec3& thigh, const Vec3& knee) {
  const Vec3 piece = thigh - hip, bone = knee - thigh;
  return glm::length(piece) < kHipPieceLength * glm::length(bone) &&
         angle_between(piece, bone) > kHipPieceAslant;
}

double log_ratio(double a, double b) { return std::abs(std::log(a / b)); }

}  // namespace

ChainShapes::ChainShapes(const BoundFigure& figure, const std::vector<int>& members)
    : figure_(figure) {
  const std::size_t count = figure.globals.size();
  below_.resize(count);
  extent_.assign(count, 0.0);
  weight_.assign(count, 0);
  std::vector<char> member(count, 0);
  for (const int joint : members) member[static_cast<std::size_t>(joint)] = 1;
  for (const int joint : members) {
    std::vector<int>& below = below_[static_cast<std::size_t>(joint)];
    for (const bool carrying : {true, false}) {
      for (const int child : figure.children(joint)) {
        if (member[static_cast<std::size_t>(child)] && (!carrying || figure.carries(child))) {
          below.push_back(child);
        }
      }
      if (!below.empty()) break;
    }
  }
  for (std::size_t i = members.size(); i-- > 0;) {
    const int joint = members[i];
    const auto j = static_cast<std::size_t>(joint);
    double farthest = 0;
    for (const int child : below_[j]) {
      farthest = std::max(farthest, extent_[static_cast<std::size_t>(child)]);
      weight_[j] += 1 + weight_[static_cast<std::size_t>(child)];
    }
    const int parent = figure.parent(joint);
    const double bone = parent < 0 ? 0 : glm::distance(figure.place(joint), figure.place(parent));
    extent_[j] = farthest + (std::isfinite(bone) ? bone : 0);
  }
}

const ShapedChain& ChainShapes::chain(int joint) {
  const auto known = chains_.find(joint);
  if (known != chains_.end()) return known->second;
  return chains_.emplace(joint, follow(joint)).first->second;
}

// Of joints in one place, into which some importers split a joint, the first one that a skin uses
// stands for all.
void ChainShapes::add(ShapedChain& chain, int joint) const {
  if (!chain.joints.empty()) {
    int& last = chain.joints.back();
    const double apart = glm::distance(figure_.place(last), figure_.place(joint));
    if (apart <= kSamePlace * (extent(joint) + extent(last))) {
      if (!is_skin_joint(figure_.character, last)) last = joint;
      return;
    }
  }
  chain.joints.push_back(joint);
  chain.forks.push_back(0);
}

ShapedChain ChainShapes::follow(int joint) const {
  ShapedChain chain;
  while (joint >= 0 && chain.joints.size() < 2 * kLongestChain) {
    add(chain, joint);
    std::vector<int> branches = below(joint);
    std::stable_sort(branches.begin(), branches.end(),
                     [&](int a, int b) { return extent(a) > extent(b); });
    int next = branches.empty() ? -1 : branches.front();
    bool fork = false;
    if (branches.size() >= 2) {
      const auto sizeable = [&](int other) {
        return extent(other) >= kBranch * extent(next) && !lies_along(figure_, other, joint, next);
      };
      fork = std::any_of(branches.begin() + 1, branches.end(), sizeable);
      // Several joints in one place, as rigs without a wrist have them: that with most below it,
      // the first one of equals in the file's order.
      const double bone = glm::distance(figure_.place(next), figure_.place(joint));
      const double same = std::max(kTogether * bone, kSamePlace * extent(next));
      int together = -1;
      int count = 0;
      for (const int other : below(joint)) {
        if (!figure_.carries(other)) continue;  // sockets and targets stand anywhere
        if (glm::distance(figure_.place(other), figure_.place(next)) > same) continue;
        ++count;
        if (together < 0 || weight_[static_cast<std::size_t>(other)] >
                                weight_[static_cast<std::size_t>(together)]) {
          together = other;
        }
      }
      if (count >= 2 && bone > same) {
        // Where they stand is where the limb forks.
        add(chain, together);
        fork = true;
        const std::vector<int>& on = below(together);
        next = on.empty() ? -1 : *std::max_element(on.begin(), on.end(), [&](int a, int b) {
          return extent(a) < extent(b);
        });
      } else if (count >= 2) {
        fork = true;  // they stand where this one does
      }
    }
    if (fork) chain.forks.back() = 1;
    joint = next;
  }
  chain.beyond.assign(chain.joints.size(), 0.0);
  for (std::size_t i = chain.joints.size() - 1; i-- > 0;) {
    chain.beyond[i] = chain.beyond[i + 1] + glm::distance(figure_.place(chain.joints[i]),
                                                          figure_.place(chain.joints[i + 1]));
  }
  chain.bends = bends_in_clips(chain.joints);
  return chain;
}

std::vector<double> ChainShapes::bends_in_clips(const std::vector<int>& joints) const {
  constexpr int kMostClips = 20, kMostKeys = 60;
  std::vector<double> bends(joints.size(), 0.0);
  bool any = false;
  const auto& clips = figure_.model.clips;
  for (std::size_t c = 0; c < clips.size() && c < kMostClips; ++c) {
    for (std::size_t i = 0; i + 1 < joints.size() && i < kLongestChain; ++i) {
      const int index = clips[c].find_channel(joints[i], Path::rotation);
      if (index < 0) continue;
      const Channel& channel = clips[c].channels[static_cast<std::size_t>(index)];
      const auto bone = direction(
          figure_.model.skeleton.joints[static_cast<std::size_t>(joints[i + 1])].rest.translation);
      if (!bone || channel.times.empty()) continue;
      const auto keys = static_cast<int>(std::min<std::size_t>(channel.times.size(), kMostKeys));
      Vec3 first(0.0);
      for (int k = 0; k < keys; ++k) {
        const std::size_t key = keys > 1
                                    ? static_cast<std::size_t>(k) * (channel.times.size() - 1) /
                                          static_cast<std::size_t>(keys - 1)
                                    : 0;
        const Vec3 way = sample_rotation(channel, static_cast<double>(channel.times[key])) * *bone;
        if (!finite(way)) continue;
        if (first == Vec3(0.0)) first = way;
        bends[i] = std::max(bends[i],
                            std::atan2(glm::length(glm::cross(first, way)), glm::dot(first, way)));
      }
      any = any || bends[i] > kBends;
    }
  }
  return any ? bends : std::vector<double>{};
}

std::vector<ChainFit> ChainShapes::fits(const ShapedChain& chain, const ShapedChain* other,
                                        bool arm) const {
  std::vector<ChainFit> found;
  const std::size_t count = std::min(chain.joints.size(), kLongestChain);
  std::vector<Vec3> place;
  for (std::size_t i = 0; i < chain.joints.size(); ++i)
    place.push_back(figure_.place(chain.joints[i]));
  const std::size_t fork = static_cast<std::size_t>(
      std::find(chain.forks.begin(), chain.forks.end(), 1) - chain.forks.begin());
  constexpr double kHopeless = 4;
  for (std::size_t i = 0; i + 2 < count; ++i) {
    for (std::size_t j = i + 1; j + 1 < count; ++j) {
      for (std::size_t k = j + 1; k < count; ++k) {
        ChainFit fit;
        fit.root = i;
        fit.middle = j;
        fit.end = k;
        fit.upper = glm::distance(place[i], place[j]);
        fit.lower = glm::distance(place[j], place[k]);
        const double length = fit.upper + fit.lower;
        if (!(fit.upper > 0.02 * length && fit.lower > 0.02 * length) || !std::isfinite(length)) {
          continue;
        }
        double cost = kRatioCost * std::max(0.0, log_ratio(fit.upper, fit.lower) - kFreeRatio);
        // Joints passed over.
        int twists = 0;
        for (std::size_t m = i + 1; m < k; ++m) {
          if (m == j) continue;
          const bool twist =
              lies_along(place[m], m < j ? place[i] : place[j], m < j ? place[j] : place[k]);
          cost += twist ? kOnLineCost : kOffLineCost;
          if (!chain.bends.empty() && chain.bends[m] > kBends) cost += kOffLineCost;
          ++twists;
        }
        // What is above the root: at most a clavicle; of a leg a short bone of the hips.
        const double above = (chain.beyond.front() - chain.beyond[i]) / length;
        cost += kLongAboveCost * std::max(0.0, above - (arm ? kLongAbove : 0.1));
        const std::size_t usual = arm ? 1 : 0;
        if (i > usual) cost += kAbove * static_cast<double>(i - usual);
        // A short piece aslant before the thigh is of the hips.
        if (!arm && i == 1 && is_hip_piece(place[0], place[1], place[j]))
          cost -= kAbove - kHipPiece;
        // Beyond the end: a hand or a foot.
        const double beyond = chain.beyond[k] / fit.lower;
        cost += kLongBeyondCost * std::max(0.0, beyond - kLongBeyond);
        // A foot is what lies between the ankle and where the toes fork; a palm may lie between the
        // wrist and where the fingers do.
        const bool short_end = fork < chain.forks.size() && k + 1 == fork &&
                               glm::distance(place[k], place[fork]) < kShortEnd * fit.lower;
        if (short_end) {
          cost += arm ? kPalm : kForkHere;
        } else if (fork < chain.forks.size()) {
          if (k == fork) cost += kForkHere;
          if (k < fork) cost += kForkBelow * static_cast<double>(fork - k);
          if (k > fork) cost += kForkAbove * static_cast<double>(k - fork);
        }
        if (!arm && k + 1 < chain.joints.size()) {
          const Vec3 shin = place[k] - place[j], foot = place[k + 1] - place[k];
          if (angle_between(shin, foot) > kAnkleTurn && glm::length(foot) > 0) cost += kAnkleBonus;
        }
        if (arm && other != nullptr && i < other->joints.size()) {
          const double breadth = glm::distance(place[i], figure_.place(other->joints[i])) / length;
          cost += kShouldersCost * std::max(0.0, kShoulders - breadth) / kShoulders;
        }
        if (!chain.bends.empty()) {
          if (chain.bends[j] < kStill) cost += 0.8;
          if (chain.bends[i] < kStill) cost += 0.4;
        }
        if (!(cost < kHopeless)) continue;
        fit.cost = cost;
        if (twists > 0) fit.remark = "; joints between them taken for twist joints";
        found.push_back(fit);
      }
    }
  }
  return found;
}

}  // namespace elbowroom
