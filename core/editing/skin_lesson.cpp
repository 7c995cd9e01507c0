// SPDX-License-Identifier: MIT
#include "core/editing/skin_lesson.h"

#include <algorithm>
#include <cstddef>

namespace elbowroom {
namespace {

using PairMargin = LimbPlanningSpace::PairMargin;

constexpr double kLargestMargin = 0.04;  // × height: skin that leaves its part farther is not met
constexpr double kMore = 0.1;            // × the view's clearance
constexpr double kEffort = 0.25;
constexpr std::int64_t kMostChecks = 12000;
constexpr int kWays = 2;
constexpr double kApart[] = {0, 1e-3, 2e-3};  // s, of looks about a moment of contact

// The margin of those two parts, 0 at first.
PairMargin& margin_of(std::vector<PairMargin>& all, const std::string& a, const std::string& b) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const PairMargin& pair) {
    return pair.part_a == a && pair.part_b == b;
  });
  return at != all.end() ? *at : all.emplace_back(PairMargin{a, b, 0});
}

}  // namespace

void SkinLesson::learn(WindowProblem& problem, PlanningWorld& world, const WindowMotion& motion,
                       const KeyedMotion& keyed, const std::stop_token& stop) {
  const double most = kLargestMargin * problem.scene->height();
  for (const GlancedContact& seen : contacts_at_a_glance(problem, keyed, stop)) {
    std::size_t part = 0;
    while (part + 1 < motion.until.size() && seen.time > motion.until[part]) ++part;
    LimbPlanningSpace* space = world.rigid(part);
    if (space == nullptr) continue;
    const auto margin = space->margin_to_refuse({motion.at(seen.time).value(seen.time), seen.time},
                                                seen.part_a, seen.part_b, most);
    if (margin) learn(PairMargin{seen.part_a, seen.part_b, *margin});
  }
}

void SkinLesson::learn(const PairMargin& pair) {
  PairMargin& known = margin_of(margins_, pair.part_a, pair.part_b);
  known.margin = std::max(known.margin, pair.margin);
}

void SkinLesson::learn(double time) {
  for (const double apart : kApart) {
    moments_.push_back(time - apart);
    moments_.push_back(time + apart);
  }
}

PlanningView SkinLesson::taught(PlanningView view) const {
  if (view.on_skin) {
    view.moments = moments_;
    view.as_verified = true;
    return view;
  }
  for (const PairMargin& learnt : margins_)
    margin_of(view.pair_margins, learnt.part_a, learnt.part_b).margin +=
        learnt.margin + kMore * view.clearance;
  view.effort = kEffort;
  view.most_checks = kMostChecks;
  view.ways = kWays;
  view.seeds_in_vain = 1;
  view.lessons = 0;
  return view;
}

}  // namespace elbowroom
