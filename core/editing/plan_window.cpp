// SPDX-License-Identifier: MIT
#include "core/editing/plan_window.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

#include "core/base/stopwatch.h"
#include "core/editing/motion_cost.h"
#include "core/editing/skin_lesson.h"
#include "core/editing/verify_window.h"
#include "core/editing/view_order.h"

namespace elbowroom {
namespace {

constexpr double kGoodEnough = 0.02;  // a cost at which no more ways are looked for
constexpr int kVerifiedInAView = 3;   // at most, for each asked for
constexpr int kTriesForAProof = 3;    // after a motion that is verified but not proven
constexpr std::uint64_t kViewSeed = 1000003, kWaySeed = 7919;

using Clock = std::chrono::steady_clock;

// A motion that was planned, with what is known of it.
struct Way {
  WindowMotion motion;
  MotionCost cost;
  std::uint64_t seed = 0;
  double path_cost = 0;  // of the path that the curve was fitted along
  int landmarks = 0;
  std::vector<std::string> limits_widened;
  bool keeps_accelerations = true;

  bool better_than(const Way& other) const {
    return keeps_accelerations != other.keeps_accelerations ? keeps_accelerations
                                                            : cost.total() < other.cost.total();
  }
};

struct Planned {
  WindowPaths paths;
  double cost = 0;
};

// A motion that was verified.
struct Held {
  WindowReport report;
  Correction correction;
  WindowMotion motion;
  double cost = 0;
  bool keeps_accelerations = true;
};

class WindowPlanner {
 public:
  WindowPlanner(WindowProblem problem, const PlanningWishes& wishes, const std::stop_token& stop,
                const ProgressSink& progress, Effort effort)
      : p_(std::move(problem)),
        wishes_(wishes),
        stop_(stop),
        progress_(progress),
        brief_(effort == Effort::brief),
        asked_(brief_ ? 1 : std::max(1, wishes.alternatives)) {
    report_.limb = p_.limb_index;
    report_.begin = p_.begin;
    report_.end = p_.end;
    report_.seed = wishes.seed;
    report_.limits_widened = p_.limits_widened;
  }

  WindowPlan run() {
    const auto start = Clock::now();
    p_.scene->set_clip(p_.clip);
    if (ends_are_free()) {
      ViewOrder order(
          planning_views(wanted(), touching(), p_.scene->height(), !wishes_.sampling.empty()));
      while (!enough() && !stop_.stop_requested()) {
        const auto next = order.next();
        if (!next) break;
        if (look(*next)) order.found();
      }
    }
    p_.scene->set_clip(p_.clip);
    const double total = ms_since(start);
    return plan(total);
  }

 private:
  double touching() const { return p_.scene->settings().epsilon * p_.scene->height(); }
  double wanted() const {
    return wishes_.clearance > 0 ? wishes_.clearance
                                 : p_.scene->settings().clearance * p_.scene->height();
  }

  bool ends_are_free() {
    for (const double t : {p_.begin, p_.end}) {
      if (!p_.scene->limb_in_contact(t, p_.limb_index, touching())) continue;
      std::vector<ContactSample> contacts;
      p_.scene->contacts_at(t, p_.limb_index, false, contacts);
      report_.ends_touch = true;
      report_.reason =
          "the limb is in contact at the window's " + std::string(t == p_.begin ? "begin" : "end");
      char at[32];
      std::snprintf(at, sizeof at, " at %.3f s", t);
      if (!contacts.empty())
        report_.blocked_by = contacts.front().part_a + " with " + contacts.front().part_b + at;
      return false;
    }
    return true;
  }

  // Another view shows no other ways; it may bring a proof.
  bool enough() const {
    if (held_.empty()) return false;
    return brief_ || held_.front().report.certified || tries_for_proof_ <= 0;
  }

  // Whether there is one more motion that holds, or enough of them.
  bool look(const ViewOrder::Look& next) {
    const PlanningView& view = next.view;
    std::string said = view.text() + ": ", reason;
    auto world = std::make_unique<PlanningWorld>(p_, view);
    const std::vector<Way> ways = ways_in(*world, next.index, said, reason);
    if (ways.empty()) {
      report_.reason = reason;
      report_.attempts.push_back(said + reason +
                                 (report_.blocked_by.empty() ? "" : "; " + report_.blocked_by));
      return false;
    }
    // On the skin it poses the limb.
    if (view.on_skin) world.reset();
    const std::size_t before = held_.size();
    verify_ways(ways, said, {&view, world.get(), next.lesson});
    return held_.size() > before || enough();
  }

  // Plans paths, of which the first that has a curve may do; if not, curves are fitted along the
  // others, the nearest to what is wanted first. One that is no nearer than a curve's own path, and
  // the same way around, would bring nothing new.
  std::vector<Way> ways_in(PlanningWorld& world, std::size_t index, std::string& said,
                           std::string& reason) {
    const PlanningView& view = world.view();
    std::vector<Way> ways;
    std::vector<Planned> waiting;
    const int most = (brief_ ? 1 : view.ways) * asked_;
    int planned = 0, seeds = 0;
    const auto is_good = [&] {
      return asked_ == 1 && !ways.empty() && ways.front().keeps_accelerations &&
             ways.front().cost.total() < kGoodEnough;
    };
    for (; seeds < most && !stop_.stop_requested() && !is_good(); ++seeds) {
      if (seeds - planned >= view.seeds_in_vain * asked_) break;
      Planned next;
      const std::uint64_t seed =
          wishes_.seed + kViewSeed * index + kWaySeed * static_cast<std::uint64_t>(seeds);
      next.paths = plan_paths(p_, world, wishes_, seed, stop_, progress_, costs_);
      if (next.paths.parts.empty()) {
        reason = next.paths.reason;
        continue;
      }
      ++planned;
      next.cost = path_cost(p_, next.paths);
      if (!ways.empty()) {
        waiting.push_back(std::move(next));
        continue;
      }
      reason = fit_way(world, next, ways);
      // What touches is a lesson that further seeds would only repeat.
      if (!view.on_skin && view.lessons > 0 && asked_ == 1 && !ways.empty() &&
          touches(ways.front())) {
        ++seeds;
        break;
      }
    }
    std::stable_sort(waiting.begin(), waiting.end(),
                     [](const Planned& a, const Planned& b) { return a.cost < b.cost; });
    for (const Planned& next : waiting) {
      if (is_good() || stop_.stop_requested()) break;
      // Where several are asked for, curves tell better than paths which are apart.
      const bool known =
          asked_ == 1 && std::any_of(ways.begin(), ways.end(), [&](const Way& way) {
            return way.path_cost <= next.cost && same_way_around(world, p_, way.motion, next.paths);
          });
      if (!known) fit_way(world, next, ways);
    }
    report_.blocked_by = world.blocked_by();
    said += std::to_string(planned) + " of " + std::to_string(seeds) + " seeds planned, " +
            std::to_string(ways.size()) + " curves, ";
    return ways;
  }

  // Whether a motion is seen to touch on the skin.
  bool touches(const Way& way) {
    const auto keyed = key_motion(p_, way.motion);
    return keyed && touches_at_a_glance(p_, *keyed, stop_);
  }

  // One more way, in order of cost; or why there is none.
  std::string fit_way(PlanningWorld& world, const Planned& planned, std::vector<Way>& ways) {
    MotionResult result = fit_motion(p_, world, planned.paths, stop_, progress_, costs_);
    if (result.motion.empty()) return result.reason;
    Way way;
    way.seed = planned.paths.seed;
    way.path_cost = planned.cost;
    way.landmarks = result.landmarks;
    way.limits_widened = std::move(result.limits_widened);
    way.keeps_accelerations = result.keeps_accelerations;
    way.cost = motion_cost(p_, result.motion);
    way.motion = std::move(result.motion);
    ways.push_back(std::move(way));
    std::stable_sort(ways.begin(), ways.end(),
                     [](const Way& a, const Way& b) { return a.better_than(b); });
    return {};
  }

  // Where a motion comes from, if something is to be learnt from it.
  struct PlannedFrom {
    const PlanningView* view;
    PlanningWorld* world;  // null: the skin
    SkinLesson* lesson;
  };

  void verify_ways(const std::vector<Way>& ways, const std::string& said, const PlannedFrom& from) {
    int verified = 0;
    std::string found;
    for (const Way& way : ways) {
      if (stop_.stop_requested() || verified >= kVerifiedInAView * asked_) break;
      if (!held_.empty() && is_known(way.motion)) continue;
      ++verified;
      WindowReport report = report_;
      const std::string hit = verify(way, report, from);
      take_costs(report);
      if (!hit.empty()) {
        report_.reason = unkeyed_.empty() ? "the planned motion touches on the deformed skin"
                                          : "the planned motion can't be made keys: " + unkeyed_;
        report_.blocked_by = unkeyed_.empty() ? hit : "";
        found +=
            (found.empty() ? "" : "; ") + report_.reason + (unkeyed_.empty() ? ", " + hit : "");
        continue;
      }
      found += (found.empty() ? "" : "; ") +
               (held_.back().report.certified
                    ? std::string("found and proven")
                    : "found and verified, not proven: " + held_.back().report.not_certified);
      if (!held_.back().report.certified) --tries_for_proof_;
      sort_held();
      if (asked_ > 1) drop_copies();
      if (static_cast<int>(held_.size()) > asked_) held_.resize(static_cast<std::size_t>(asked_));
      if (static_cast<int>(held_.size()) >= asked_ && enough()) break;
    }
    report_.attempts.push_back(said + found);
  }

  // What lies between two looks of one way may come nearer than the clearance asked for, but not
  // touch.
  PlanningView between_looks() const {
    const double least = 2 * touching();
    PlanningView view;
    view.clearance = view.body_clearance = least;
    return view;
  }

  // Another look of a way that is held already; one that is not proven may be replaced.
  bool is_known(const WindowMotion& motion) {
    if (asked_ == 1) return false;
    PlanningWorld world(p_, between_looks());
    return std::any_of(held_.begin(), held_.end(), [&](const Held& held) {
      return held.report.certified && same_way_around(world, p_, held.motion, motion);
    });
  }

  // Of two looks of one way the better stays.
  void drop_copies() {
    PlanningWorld world(p_, between_looks());
    for (std::size_t i = 0; i < held_.size(); ++i)
      for (std::size_t k = held_.size() - 1; k > i; --k)
        if (same_way_around(world, p_, held_[i].motion, held_[k].motion))
          held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(k));
  }

  // Empty and one more in held_, or what it touches.
  std::string verify(const Way& way, WindowReport& report, const PlannedFrom& from) {
    auto keyed = key_motion(p_, way.motion);
    unkeyed_ = keyed ? std::string() : keyed.error().message();
    if (!keyed) return unkeyed_;
    const SeenContact hit = verify_keys(p_, *keyed, way.seed, stop_, progress_, report);
    if (!hit.none()) {
      if (from.lesson && from.world)
        from.lesson->learn(p_, *from.world, way.motion, *keyed, stop_);
      else if (from.lesson)
        from.lesson->learn(hit.time);
      return hit.text;
    }
    report.status = CorrectionStatus::corrected;
    report.reason.clear();
    report.blocked_by.clear();
    report.seed = way.seed;
    report.planned_clearance = std::min(from.view->clearance, wanted());
    report.landmarks = way.landmarks;
    for (const std::string& name : way.limits_widened) {
      auto& all = report.limits_widened;
      if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
    }
    measure_motion(p_, way.motion, report);
    MotionCost cost = way.cost;
    cost.nearness = nearness_cost(report.min_clearance, wanted());
    report.cost = cost.total();
    Held held{report, std::move(keyed->correction), way.motion, cost.total(),
              way.keeps_accelerations};
    held.correction.made_with = wishes_;
    held.correction.made_with.seed = way.seed;
    held_.push_back(std::move(held));
    return {};
  }

  // Proven motions come before those that are only verified, then those that keep acceleration
  // limits, then the cheaper ones.
  void sort_held() {
    std::stable_sort(held_.begin(), held_.end(), [](const Held& a, const Held& b) {
      if (a.report.certified != b.report.certified) return a.report.certified;
      if (a.keeps_accelerations != b.keeps_accelerations) return a.keeps_accelerations;
      return a.cost < b.cost;
    });
  }

  // What an attempt cost is part of the whole, whether or not it is taken.
  void take_costs(const WindowReport& spent) {
    report_.verify_ms = spent.verify_ms;
    report_.certify_ms = spent.certify_ms;
  }

  WindowPlan plan(double total) {
    report_.plan_ms = costs_.plan_ms;
    report_.smooth_ms = costs_.smooth_ms;
    report_.validity_checks = costs_.validity_checks;
    report_.edge_checks = costs_.edge_checks;
    report_.iterations = costs_.iterations;
    report_.total_ms = total;
    WindowPlan result;
    if (held_.empty() || stop_.stop_requested()) {
      result.report = report_;
      result.report.status =
          stop_.stop_requested() ? CorrectionStatus::cancelled : CorrectionStatus::failed;
      return result;
    }
    for (Held& held : held_) {
      WindowReport& report = held.report;
      report.attempts = report_.attempts;
      report.plan_ms = report_.plan_ms;
      report.smooth_ms = report_.smooth_ms;
      report.verify_ms = report_.verify_ms;
      report.certify_ms = report_.certify_ms;
      report.total_ms = total;
      report.validity_checks = report_.validity_checks;
      report.edge_checks = report_.edge_checks;
      report.iterations = report_.iterations;
    }
    result.report = held_.front().report;
    result.correction = std::move(held_.front().correction);
    for (std::size_t i = 1; i < held_.size(); ++i)
      result.alternatives.push_back({std::move(held_[i].report), std::move(held_[i].correction)});
    return result;
  }

  WindowProblem p_;
  const PlanningWishes& wishes_;
  const std::stop_token& stop_;
  const ProgressSink& progress_;
  std::string unkeyed_;  // why the last motion could not be made keys; usually empty
  bool brief_ = false;
  int asked_ = 1;
  WindowReport report_;
  PlanningCosts costs_;
  std::vector<Held> held_;
  int tries_for_proof_ = kTriesForAProof;
};

}  // namespace

WindowPlan plan_window(SceneCollision& scene, const std::shared_ptr<const Clip>& clip, int limb,
                       double begin, double end, const PlanningWishes& wishes,
                       const std::stop_token& stop, const ProgressSink& progress, Effort effort) {
  scene.set_clip(clip);
  return plan_window(window_problem(scene, clip, limb, begin, end, wishes), wishes, stop, progress,
                     effort);
}

WindowPlan plan_window(WindowProblem p, const PlanningWishes& wishes, const std::stop_token& stop,
                       const ProgressSink& progress, Effort effort) {
  return WindowPlanner(std::move(p), wishes, stop, progress, effort).run();
}

}  // namespace elbowroom
