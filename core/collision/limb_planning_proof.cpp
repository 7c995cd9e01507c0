// SPDX-License-Identifier: MIT
// Certified edges of the planner's world.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/collision/limb_motion.h"
#include "core/collision/limb_planning_data.h"
#include "core/collision/world_steps.h"
#include "core/planning/interpolation.h"

namespace elbowroom {
namespace {

constexpr double kCoarse = 0.04;    // × height of travel: above it only bounding volumes are asked
constexpr double kFine = 2e-3;      // × height of travel: below it distances are exact
constexpr double kGiveUp = 2.5e-4;  // × height of travel: what is not free by then is refused
constexpr std::size_t kMostProven = 256;  // edges that are remembered
constexpr std::size_t kMostIntervals = 1 << 14;

}  // namespace

// Of the edge's part [begin, end], which no step of the world divides.
std::optional<bool> LimbPlanningSpace::Data::piece_free(const Configuration& from,
                                                        const Configuration& to, double begin,
                                                        double end, std::int64_t& looks,
                                                        std::int64_t most_looks) {
  const double height = scene.height;
  Dofs rate = from.q;
  for (int i = 0; i < rate.count; ++i) rate[i] = (to.q[i] - from.q[i]) / (to.t - from.t);

  const auto first = tracks->cell_at(begin), last = tracks->cell_at(end);
  const Segment& segment = segments[static_cast<std::size_t>(first.segment)];
  find_reached(first, last.row);
  open_intervals.assign(1, {begin, end, 0, 0});

  for (std::size_t next = 0; next < open_intervals.size(); ++next) {
    if (next >= kMostIntervals) return false;
    Interval interval = open_intervals[next];
    const double middle = 0.5 * (interval.begin + interval.end);
    Configuration c = interpolate_at(from, to, middle);
    const auto cell = tracks->cell_at(middle);
    if (looks >= most_looks) return false;
    ++looks;
    place_chain(cell, c, false);
    motion->set(c.q, rate, interval.begin, middle, interval.end, tracks->cell_at(interval.begin),
                cell, tracks->cell_at(interval.end), segment, state_at(c).residual);
    if (next == 0) {  // the whole edge: what it can come near at all
      open_near_pairs(cell, segment);
      interval.last = open_pairs.size();
      // Those that hit last come first.
      auto front = open_pairs.begin();
      for (const int pair : recent)
        if (const auto at = std::find(front, open_pairs.end(), pair); at != open_pairs.end())
          std::rotate(front, at, at + 1), ++front;
    }
    const std::size_t open = open_pairs.size();
    for (std::size_t i = interval.first; i < interval.last; ++i) {
      const int pair = open_pairs[i];
      const Pair& parts_of = pairs[static_cast<std::size_t>(pair)];
      const double travel = motion->travel(parts_of.a, parts_of.b);
      if (!std::isfinite(travel)) return false;
      const double gap = bounds_gap(pair, cell, segment);
      const double kept = pair_states[static_cast<std::size_t>(pair)].distance;
      if (gap > kept + travel) continue;
      if (travel <= kCoarse * height) {
        const bool fine = travel <= kFine * height + 4 * motion->flex();
        if (fine ? !near(pair, cell, segment, travel) : surely_clear(pair, cell, segment, travel))
          continue;
        if (travel <= kGiveUp * height + motion->flex()) return false;
      } else if (!boxes_near(pair, cell, segment, travel)) {
        continue;
      }
      if (!(gap > kept) && touches(pair, cell, segment)) return false;
      open_pairs.push_back(pair);
    }
    if (open_pairs.size() == open) continue;
    open_intervals.push_back({interval.begin, middle, open, open_pairs.size()});
    open_intervals.push_back({middle, interval.end, open, open_pairs.size()});
  }
  return true;
}

std::optional<bool> LimbPlanningSpace::certified_free(const Configuration& from,
                                                      const Configuration& to, std::int64_t& looks,
                                                      std::int64_t most_looks) {
  Data& d = *data_;
  const int count = d.limb.dof_count();
  if (!(from.t < to.t) || !std::isfinite(from.t) || !std::isfinite(to.t) || from.q.count < count ||
      to.q.count < count)
    return false;
  for (int i = 0; i < count; ++i)
    if (!std::isfinite(from.q[i]) || !std::isfinite(to.q[i])) return false;
  if (!d.motion) d.motion = std::make_shared<LimbMotion>(d);
  if (!d.motion->supported()) return std::nullopt;
  const auto same = [count](const Configuration& x, const Configuration& y) {
    return x.t == y.t &&
           std::equal(x.q.value.begin(), x.q.value.begin() + count, y.q.value.begin());
  };
  for (const auto& [known_from, known_to] : d.proven)
    if (same(known_from, from) && same(known_to, to)) return true;
  if (most_looks < std::numeric_limits<std::int64_t>::max() - looks) most_looks += looks;
  double begin = from.t;
  const auto& steps = d.tracks->steps();
  for (auto step = std::upper_bound(steps.begin(), steps.end(), from.t);
       step != steps.end() && *step <= to.t; ++step) {
    const auto free =
        d.piece_free(from, to, begin, std::max(begin, just_before(*step)), looks, most_looks);
    if (!free || !*free) return free;
    begin = *step;
  }
  const auto free = d.piece_free(from, to, begin, to.t, looks, most_looks);
  if (free && *free) {
    if (d.proven.size() < kMostProven) d.proven.resize(d.proven.size() + 1);
    d.proven[d.next_proven++ % kMostProven] = {from, to};
  }
  return free;
}

}  // namespace elbowroom
