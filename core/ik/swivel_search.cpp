// SPDX-License-Identifier: MIT
#include "core/ik/swivel_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/ik/limit_excess.h"

namespace elbowroom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr int kVariants = 4;       // of what a target leaves open, over its limits
constexpr int kVariantCoarse = 4;  // their grid of swivels is coarser by this
constexpr std::size_t kDescents = 24;
constexpr int kDescentSteps = 120;
constexpr int kRefineSteps = 40;      // of bisection and of golden sections
constexpr double kFlat = 1e-7;        // a bend's limit is exceeded alike at every swivel
constexpr double kBeyondReach = 1e3;  // more than limits are ever exceeded by, radians
constexpr int kMaxGreedySteps = 400;

// Of the numbers that stand for one rotation those that keep the limits, if some do.
void choose_turns(const LimbModel& limb, const DofSpace& space, Dofs& q) {
  const auto dof = [&](int i) -> const Dof& { return space.dofs[static_cast<std::size_t>(i)]; };
  const auto turn = [&](int i) {
    const double lower = dof(i).lower, upper = dof(i).upper;
    if (q[i] >= lower && q[i] <= upper) return;
    const double middle = 0.5 * (lower + upper);
    const double other = middle + std::remainder(q[i] - middle, 2 * kPi);
    if (std::isfinite(other)) q[i] = other;
  };
  for (const JointModel& joint : limb.joints) {
    const int first = joint.first_dof;
    if (joint.kind == JointModelKind::fixed) continue;
    if (joint.kind == JointModelKind::hinge) {
      turn(first);
      turn(first + 1);
      continue;
    }
    if (joint.kind == JointModelKind::ball) turn(first + 2);
    // exp(v) is one rotation with exp(v - 2π v/|v|).
    const double length = std::hypot(q[first], q[first + 1]);
    if (length < 0.5 * kPi) continue;
    Dofs other = q;
    const double shrink = (length - 2 * kPi) / length;
    other[first] *= shrink;
    other[first + 1] *= shrink;
    const double here = limit_excess(space, q).radians;
    if (here > 0 && limit_excess(space, other).radians < here) q = other;
  }
}

int flexion_dof(const LimbModel& limb) {
  const JointModel& middle = limb.joints[1];
  return middle.first_dof + (middle.kind == JointModelKind::ball ? 1 : 0);
}

class Search {
 public:
  Search(const LimbIk& ik, const IkTarget& target, const SwivelSearch& settings,
         const PostureCheck& valid)
      : ik_(ik),
        target_(target),
        settings_(settings),
        valid_(valid),
        space_(settings.limits != nullptr ? *settings.limits : ik.limb().space) {}

  IkResult run() {
    const Dofs& near = settings_.near && settings_.near->count == ik_.current().count
                           ? *settings_.near
                           : ik_.current();
    start_ = clamp_to_limits(space_, near);
    set_range(near);
    result_.state = ik_.state(start_);
    result_.swivel = initial_;
    result_.miss = kInfinity;
    result_.orientation_served = !target_.orientation || ik_.serves_orientation();

    if (!ik_.may_reach(target_)) {
      // Stretched towards it, in the first posture within limits; an orientation that no posture
      // there takes up is given up, as the position already is.
      greedy(start_, true);
      if (rank_ == kNone && target_.orientation) {
        const IkTarget place{target_.position, {}};
        // An orientation that is none is no reason to pass it over.
        if (!ik_.may_reach(place)) {
          target_ = place;
          greedy(start_, true);
        }
      }
      return finish();
    }
    if (greedy(start_, false)) return finish();
    if (settings_.resolution <= 0) return finish();
    std::vector<int> open;
    const std::vector<Dofs> all = variants(open);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const int coarse = i == 0 ? 1 : kVariantCoarse;
      if (exhausted() || all_round(all[i], settings_.resolution / coarse)) return finish();
    }
    // Between the variants, and where nothing reaches between steps too (what a limb reaches that
    // is all but stretched may depend on its twist): from those that are off least.
    if (rank_ != kMisses && (open.empty() || rank_ != kExceeds)) return finish();
    std::stable_sort(lowest_.begin(), lowest_.end(),
                     [](const Lowest& a, const Lowest& b) { return a.excess < b.excess; });
    for (std::size_t i = 0; i < lowest_.size() && i < kDescents; ++i)
      if (descend(lowest_[i], open)) break;
    return finish();
  }

 private:
  enum Rank { kCollides, kExceeds, kMisses, kNone };

  void set_range(const Dofs& near) {
    initial_ = settings_.initial.value_or(ik_.swivel_of(near));
    if (!std::isfinite(initial_)) initial_ = 0;
    const bool empty = !(settings_.lower <= settings_.upper);
    double lower = settings_.lower, upper = settings_.upper;
    if (empty) lower = upper = initial_;
    if (upper - lower >= 2 * kPi - 1e-9) {
      below_ = above_ = kPi;
      return;
    }
    // The turn of the initial swivel that is in the range or nearest to it.
    const double middle = 0.5 * (lower + upper);
    initial_ = middle + std::remainder(initial_ - middle, 2 * kPi);
    initial_ = std::clamp(initial_, lower, upper);
    below_ = initial_ - lower;
    above_ = upper - initial_;
  }

  bool exhausted() const {
    return settings_.max_checks > 0 && result_.checked >= settings_.max_checks;
  }

  // The posture at a swivel with this sense, and how far it is beyond limits.
  struct Tried {
    Dofs q;
    double miss = 0;
    LimitExcess excess;
  };
  bool try_posture(double swivel, const Dofs& near, int sense, Tried& tried) {
    const auto look = [&](const Dofs& from) {
      const auto one = ik_.solve_at_swivel(target_, swivel, from, sense);
      if (!one) return false;
      ++result_.tried;
      tried.q = one->q;
      tried.miss = one->miss;
      choose_turns(ik_.limb(), space_, tried.q);
      tried.excess = limit_excess(space_, tried.q);
      return true;
    };
    if (!look(near)) return false;
    // Where the end has a twist of its own it takes over what the middle's limits refuse.
    const JointModel& middle = ik_.limb().joints[1];
    const JointModel& end = ik_.limb().joints[2];
    if (!target_.orientation || end.kind != JointModelKind::ball) return true;
    const int twist = middle.first_dof + middle.dof_count() - 1, own = end.first_dof + 2;
    Dofs from = near;
    for (int round = 0; round < 3 && tried.miss == 0 && tried.excess.dof == twist; ++round) {
      if (tried.excess.radians <= 0) break;
      const Dof& limits = space_.dofs[static_cast<std::size_t>(twist)];
      const double inside = std::clamp(tried.q[twist], limits.lower, limits.upper);
      const Dof& own_limits = space_.dofs[static_cast<std::size_t>(own)];
      from[own] = std::clamp(from[own] + middle.side * end.side * (tried.q[twist] - inside),
                             own_limits.lower, own_limits.upper);
      const Tried before = tried;
      if (!look(from) || tried.excess.radians >= before.excess.radians) {
        tried = before;
        break;
      }
    }
    return true;
  }

  // How far beyond limits; where nothing reaches, beyond kBeyondReach by the share of the limb's
  // length that is missing; infinite where there is no posture.
  double badness_at(double swivel, const Dofs& near, int sense) {
    Tried tried;
    if (!try_posture(swivel, near, sense, tried)) return kInfinity;
    return tried.miss != 0 ? kBeyondReach + tried.miss / ik_.length() : tried.excess.radians;
  }
  // Infinite where nothing reaches.
  double excess_at(double swivel, const Dofs& near, int sense) {
    const double badness = badness_at(swivel, near, sense);
    return badness < kBeyondReach ? badness : kInfinity;
  }

  void remember(const Tried& tried, Rank rank, double swivel, const Dofs& near) {
    const double excess = std::max(0.0, tried.excess.radians);
    const double offset = std::abs(std::remainder(swivel - initial_, 2 * kPi));
    const bool better =
        rank != rank_ ? rank < rank_
                      : excess < excess_ - 1e-9 || (excess <= excess_ + 1e-9 && offset < offset_);
    if (!better) return;
    rank_ = rank;
    excess_ = excess;
    offset_ = offset;
    best_ = tried;
    best_near_ = near;
    result_.swivel = swivel;
  }

  // True with a valid posture, which is then the result.
  bool consider(double swivel, const Dofs& near) {
    for (int sense = 0; sense < 2; ++sense) {
      Tried one;
      if (!try_posture(swivel, near, sense, one)) continue;
      if (one.miss != 0) {
        remember(one, kMisses, swivel, near);
      } else if (!space_.within_limits(one.q)) {
        remember(one, kExceeds, swivel, near);
      } else {
        if (exhausted()) return false;
        const LimbState state = ik_.state(one.q);
        if (valid_) ++result_.checked;
        if (!valid_ || valid_(state)) {
          result_.status = IkStatus::solved;
          result_.state = state;
          result_.swivel = swivel;
          solved_ = true;
          return true;
        }
        remember(one, kCollides, swivel, near);
      }
    }
    return false;
  }

  bool greedy(const Dofs& near, bool stretched) {
    double step = settings_.step > 1e-4 && std::isfinite(settings_.step) ? settings_.step
                                                                         : SwivelSearch{}.step;
    const double growth =
        settings_.growth >= 1 && std::isfinite(settings_.growth) ? settings_.growth : 1.0;
    double offset = 0;
    for (int i = 0; i < kMaxGreedySteps; ++i) {
      if (offset <= above_ && consider(initial_ + offset, near)) return true;
      if (offset > 0 && offset <= below_ && consider(initial_ - offset, near)) return true;
      if (stretched && rank_ == kMisses && excess_ <= 0) return false;
      if (offset >= std::max(below_, above_) || exhausted()) return false;
      // The range's own ends are tried too.
      double next = offset + step;
      for (const double end : {below_, above_})
        if (offset < end && next > end) next = std::min(next, end);
      offset = next;
      step *= growth;
    }
    return false;
  }

  // Starting postures for the exhaustive search: the first one; then what the target leaves open
  // over its limits.
  std::vector<Dofs> variants(std::vector<int>& open) const {
    std::vector<Dofs> all = {start_};
    const auto vary = [&](int dof) {
      open.push_back(dof);
      const Dof& limits = space_.dofs[static_cast<std::size_t>(dof)];
      if (!std::isfinite(limits.upper - limits.lower)) return;
      std::vector<double> values;
      for (int i = 0; i <= kVariants; ++i)
        values.push_back(limits.lower + (limits.upper - limits.lower) * i / kVariants);
      std::stable_sort(values.begin(), values.end(), [&](double a, double b) {
        return std::abs(a - start_[dof]) < std::abs(b - start_[dof]);
      });
      const std::size_t before = all.size();
      for (const double value : values)
        for (std::size_t i = 0; i < before; ++i) {
          Dofs varied = all[i];
          varied[dof] = value;
          all.push_back(varied);
        }
    };
    const JointModel& middle = ik_.limb().joints[1];
    const JointModel& end = ik_.limb().joints[2];
    if (!target_.orientation || !ik_.serves_orientation())
      vary(middle.first_dof + middle.dof_count() - 1);
    else if (end.kind == JointModelKind::ball)
      vary(end.first_dof + 2);
    if (middle.kind == JointModelKind::ball) vary(middle.first_dof);
    return all;
  }

  bool in_range(double swivel, double& unwrapped) const {
    const double offset = std::remainder(swivel - initial_, 2 * kPi);
    unwrapped = initial_ + offset;
    if (offset <= above_ && offset >= -below_) return true;
    const double other = offset + (offset > 0 ? -2 * kPi : 2 * kPi);
    unwrapped = initial_ + other;
    return other <= above_ && other >= -below_;
  }

  // Between a swivel that keeps limits and one that does not: the last that does.
  double edge(double inside, double outside, const Dofs& near, int sense) {
    for (int i = 0; i < kRefineSteps && std::abs(inside - outside) > 1e-6; ++i) {
      const double middle = 0.5 * (inside + outside);
      (excess_at(middle, near, sense) <= 0 ? inside : outside) = middle;
    }
    return inside;
  }

  // A swivel in (a, b) that keeps limits, by golden sections on the excess; NaN if none is found.
  double dip(double a, double b, const Dofs& near, int sense) {
    constexpr double kGolden = 0.61803398874989484820;
    double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
    double at_c = excess_at(c, near, sense), at_d = excess_at(d, near, sense);
    for (int i = 0; i < kRefineSteps; ++i) {
      if (at_c <= 0) return c;
      if (at_d <= 0) return d;
      if (at_c <= at_d) {
        b = d;
        d = c;
        at_d = at_c;
        c = b - kGolden * (b - a);
        at_c = excess_at(c, near, sense);
      } else {
        a = c;
        c = d;
        at_c = at_d;
        d = a + kGolden * (b - a);
        at_d = excess_at(d, near, sense);
      }
    }
    return kNotANumber;
  }

  // A lowest badness of one round.
  struct Lowest {
    double excess = kInfinity, swivel = 0;
    int sense = 0;
    Dofs near;
  };

  // Lowers the excess over the swivel and what else is open, one number after the other, or two at
  // once where limits leave a crease, with steps that shrink; considers what keeps limits.
  bool descend(Lowest at, const std::vector<int>& open) {
    double step = 4 * kPi / 180;
    for (int i = 0; i < kDescentSteps && at.excess > 0 && step > 1e-6; ++i) {
      bool lower = false;
      const auto moved = [&](Lowest from, std::size_t k, double move) {
        if (k == open.size()) {
          from.swivel += move;
        } else {
          const Dof& limits = space_.dofs[static_cast<std::size_t>(open[k])];
          from.near[open[k]] = std::clamp(from.near[open[k]] + move, limits.lower, limits.upper);
        }
        return from;
      };
      const auto take = [&](Lowest next) {
        next.excess = badness_at(next.swivel, next.near, next.sense);
        if (!(next.excess < at.excess)) return false;
        at = next;
        lower = true;
        return true;
      };
      for (std::size_t k = 0; k <= open.size(); ++k)
        for (const double move : {step, -step})
          if (take(moved(at, k, move))) break;
      for (std::size_t k = 0; k <= open.size() && !lower; ++k)
        for (std::size_t other = k + 1; other <= open.size() && !lower; ++other)
          for (const double one : {step, -step})
            for (const double two : {step, -step})
              if (!lower) take(moved(moved(at, k, one), other, two));
      step *= lower ? 1.2 : 0.4;
    }
    double unwrapped = 0;
    return at.excess <= 0 && in_range(at.swivel, unwrapped) && consider(unwrapped, at.near);
  }

  bool all_round(const Dofs& near, int resolution) {
    const int n = std::max(8, resolution);
    const double width = 2 * kPi / n;
    std::array<std::vector<double>, 2> excess;
    for (auto& values : excess) values.assign(static_cast<std::size_t>(n), kInfinity);
    const auto at = [&](int i) { return -kPi + width * i; };
    for (int i = 0; i < n; ++i) {
      for (int sense = 0; sense < 2; ++sense)
        excess[static_cast<std::size_t>(sense)][static_cast<std::size_t>(i)] =
            badness_at(at(i), near, sense);
    }
    // Where each sense is off least, and less than on both sides: one basin may lead to where
    // limits are kept and a lower one not.
    for (int sense = 0; sense < 2; ++sense) {
      const auto& values = excess[static_cast<std::size_t>(sense)];
      const std::size_t before = lowest_.size();
      for (int i = 0; i < n; ++i) {
        const double value = values[static_cast<std::size_t>(i)];
        if (std::isfinite(value) && value < values[static_cast<std::size_t>((i + n - 1) % n)] &&
            value <= values[static_cast<std::size_t>((i + 1) % n)])
          lowest_.push_back({value, at(i), sense, near});
      }
      // What is missing does not hang on the swivel where nothing but the place is asked for.
      if (lowest_.size() == before && std::isfinite(values.front()))
        lowest_.push_back({values.front(), at(0), sense, near});
    }
    for (auto& values : excess)
      for (double& value : values)
        if (value >= kBeyondReach) value = kInfinity;
    std::vector<double> swivels;
    const auto propose = [&](double swivel) {
      double unwrapped = 0;
      if (in_range(swivel, unwrapped)) swivels.push_back(unwrapped);
    };
    for (int sense = 0; sense < 2; ++sense) {
      const auto value = [&](int i) {
        return excess[static_cast<std::size_t>(sense)][static_cast<std::size_t>((i + n) % n)];
      };
      for (int i = 0; i < n; ++i) {
        if (value(i) <= 0) {
          propose(at(i));
          if (value(i - 1) <= 0) continue;
          // A stretch that keeps limits begins here.
          int last = i;
          while (last < i + n - 1 && value(last + 1) <= 0) ++last;
          const double begin = edge(at(i), at(i - 1), near, sense);
          const double end = edge(at(last), at(last + 1), near, sense);
          propose(begin);
          propose(0.5 * (begin + end));
          propose(end);
        } else if (std::isfinite(value(i)) && value(i) <= value(i - 1) &&
                   value(i) <= value(i + 1) &&
                   value(i) < std::max(value(i - 1), value(i + 1)) - kFlat) {
          // Between steps it falls about as steeply as from the neighbours.
          const double fall = std::max(value(i - 1), value(i + 1)) - value(i);
          const double inside =
              value(i) > 2 * fall ? kNotANumber : dip(at(i - 1), at(i + 1), near, sense);
          if (std::isnan(inside)) {
            propose(at(i));
            continue;
          }
          const double begin = edge(inside, at(i - 1), near, sense);
          const double end = edge(inside, at(i + 1), near, sense);
          propose(begin);
          propose(0.5 * (begin + end));
          propose(end);
        }
      }
    }
    if (swivels.empty()) {
      // Nothing reaches, or the same limit is exceeded all round: remembered for that.
      consider(initial_, near);
      return false;
    }
    std::sort(swivels.begin(), swivels.end(), [&](double a, double b) {
      const double from_a = std::abs(a - initial_), from_b = std::abs(b - initial_);
      return from_a != from_b ? from_a < from_b : a < b;
    });
    swivels.erase(std::unique(swivels.begin(), swivels.end()), swivels.end());
    for (const double swivel : swivels) {
      if (consider(swivel, near)) return true;
      if (exhausted()) return false;
    }
    return false;
  }

  IkResult finish() {
    if (solved_) {
      result_.miss = 0;
      return result_;
    }
    switch (rank_) {
      case kCollides:
        result_.status = IkStatus::in_collision;
        result_.miss = 0;
        result_.state = ik_.state(best_.q);
        return result_;
      case kExceeds:
        result_.status = IkStatus::at_limit;
        result_.miss = 0;
        break;
      case kMisses:
        result_.status = IkStatus::out_of_reach;
        result_.miss = best_.miss;
        break;
      case kNone:
        result_.status = IkStatus::out_of_reach;
        if (const double beyond = glm::length(target_.position - ik_.points(start_).root);
            std::isfinite(beyond))
          result_.miss = std::max(0.0, beyond - ik_.length());
        return result_;
    }
    if (best_.excess.radians > 0) {
      result_.dof = best_.excess.dof;
      result_.excess = best_.excess.radians;
    }
    // A bend beyond its limit still leaves the limb pointing at the target.
    Dofs q = best_.q;
    const int bend = flexion_dof(ik_.limb());
    const Dof& limits = space_.dofs[static_cast<std::size_t>(bend)];
    if (q[bend] < limits.lower || q[bend] > limits.upper) {
      const double clamped = std::clamp(q[bend], limits.lower, limits.upper);
      if (auto pointed = ik_.point_at(target_, result_.swivel, best_near_, clamped)) {
        q = *pointed;
        choose_turns(ik_.limb(), space_, q);
      }
    }
    result_.state = ik_.state(clamp_to_limits(space_, q));
    // What an orientation kept from stretching may reach farther without it.
    if (result_.status == IkStatus::out_of_reach)
      result_.miss =
          std::min(result_.miss, glm::distance(ik_.points(result_.state.q).end, target_.position));
    return result_;
  }

  const LimbIk& ik_;
  IkTarget target_;
  const SwivelSearch& settings_;
  const PostureCheck& valid_;
  const DofSpace& space_;
  IkResult result_;
  bool solved_ = false;
  double initial_ = 0, below_ = kPi, above_ = kPi;
  Dofs start_;
  Rank rank_ = kNone;
  double excess_ = 0, offset_ = 0;
  std::vector<Lowest> lowest_;
  Tried best_;
  Dofs best_near_;
};

}  // namespace

const char* ik_status_id(IkStatus status) {
  switch (status) {
    case IkStatus::solved:
      return "solved";
    case IkStatus::out_of_reach:
      return "out_of_reach";
    case IkStatus::at_limit:
      return "at_limit";
    case IkStatus::in_collision:
      break;
  }
  return "in_collision";
}

IkResult search_swivel(const LimbIk& ik, const IkTarget& target, const SwivelSearch& settings,
                       const PostureCheck& valid) {
  return Search(ik, target, settings, valid).run();
}

}  // namespace elbowroom
