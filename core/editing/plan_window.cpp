// SPDX-License-Identifier: MIT
#include "core/editing/plan_window.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

#include "core/editing/motion_cost.h"
#include "core/editing/verify_window.h"

namespace elbowroom {
namespace {

constexpr int kWays = 4;             // motions planned in one view, at least, for each asked for
constexpr int kWaysOnSkin = 1;       // where one costs a hundred times more, and in brief
constexpr int kHopeless = 2;         // seeds without a path, after which the first view is given up
constexpr int kHopelessFurther = 1;  // and any other
constexpr double kGoodEnough = 0.02;  // a cost at which no more ways are looked for
constexpr int kVerifiedInAView = 3;   // at most, for each asked for
constexpr int kTriesForAProof = 3;    // after a motion that is verified but not proven
constexpr int kLessons = 1;           // a view of rigid parts is told about the skin, at most
constexpr int kWaysTaught = 2;        // and then not looked at as long
constexpr std::size_t kTaught = 2;    // views that are
// What a seed may cost: shares of the iterations, and checks. A check on the skin costs ten times
// more; where a view is looked at again the way is known to be short; and where parts are near each
// other all along, as in a figure in armour, checks are dear and a search in vain is long.
constexpr double kSkinEffort = 0.1, kLessonEffort = 0.25;
constexpr std::int64_t kFirstChecks = 120000, kFurtherChecks = 40000, kLessonChecks = 12000,
                       kSkinChecks = 6000;
constexpr double kLargestMargin = 0.04;  // × height: skin that leaves its part farther is not met
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
      const std::vector<PlanningView> views = views_of();
      for (std::size_t k = 0; k < views.size() && !enough() && !stop_.stop_requested(); ++k)
        try_view(views[k], k);
    }
    p_.scene->set_clip(p_.clip);
    const double total = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
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
      report_.reason = "the limb is in contact at the window's " +
                       std::string(t == p_.begin ? "begin" : "end") +
                       "; choose a window whose ends are free";
      char at[32];
      std::snprintf(at, sizeof at, " at %.3f s", t);
      if (!contacts.empty())
        report_.blocked_by = contacts.front().part_a + " with " + contacts.front().part_b + at;
      return false;
    }
    return true;
  }

  std::vector<PlanningView> views_of() const {
    const double skin = 0.01 * p_.scene->height();
    const double all = wanted(), little = 0.1 * wanted(), least = 2 * touching();
    // Where the animator has set sampling intervals, they alone say first where to search.
    const double near_first = wishes_.sampling.empty() ? 0.25 : 0.0;
    const auto parts = [](double clearance, double from_body, double margin, double near_share,
                          std::int64_t checks) {
      PlanningView view;
      view.clearance = clearance;
      view.body_clearance = from_body;
      view.margin = margin;
      view.near_share = near_share;
      view.most_checks = checks;
      return view;
    };
    const auto on_skin = [](double clearance, double from_body, double near_share,
                            bool as_verified) {
      PlanningView view;
      view.on_skin = true;
      view.as_verified = as_verified;
      view.clearance = clearance;
      view.body_clearance = from_body;
      view.near_share = near_share;
      view.effort = kSkinEffort;
      view.most_checks = kSkinChecks;
      return view;
    };
    return {parts(all, all, 0, near_first, kFirstChecks),
            parts(all, little, 0, 0.9, kFurtherChecks),
            on_skin(all, all, 0.8, false),
            parts(all, little, skin, 0.9, kFurtherChecks),
            on_skin(little, little, 0.9, true),
            parts(least, least, 0, 0.9, kFurtherChecks),
            on_skin(least, least, 0.9, true)};
  }

  // Another view shows no other ways; it may bring a proof.
  bool enough() const {
    if (held_.empty()) return false;
    return brief_ || held_.front().report.certified || tries_for_proof_ <= 0;
  }

  // Where motions through rigid parts touch on the skin, the pairs that do get a margin of their
  // own, by what the skin was seen to do, and the view is looked at again: a margin for all would
  // close ways that are open.
  void try_view(PlanningView view, std::size_t index) {
    const int lessons = index >= kTaught ? 0 : kLessons;
    for (int lesson = 0; lesson <= lessons && !stop_.stop_requested(); ++lesson) {
      std::string said = view.text() + ": ", reason;
      auto world = std::make_unique<PlanningWorld>(p_, view);
      const std::vector<Way> ways = ways_in(*world, index, said, reason);
      // On the skin it poses the limb.
      if (view.on_skin) world.reset();
      if (ways.empty()) {
        report_.reason = reason;
        report_.attempts.push_back(said + reason +
                                   (report_.blocked_by.empty() ? "" : "; " + report_.blocked_by));
        return;
      }
      lesson_ = {};
      const std::size_t before = held_.size();
      verify_ways(ways, said, lesson < lessons ? world.get() : nullptr);
      if (held_.size() > before || enough() || lesson_.empty()) return;
      take_lesson(view);
    }
  }

  // Margins by pair that would have kept planning from a motion that touches: the largest at any of
  // the times of a glance.
  void learn(const WindowMotion& motion, const KeyedMotion& keyed, PlanningWorld& world) {
    const double most = kLargestMargin * p_.scene->height();
    for (const GlancedContact& seen : contacts_at_a_glance(p_, keyed, stop_)) {
      std::size_t part = 0;
      while (part + 1 < motion.until.size() && seen.time > motion.until[part]) ++part;
      LimbPlanningSpace* space = world.rigid(part);
      if (space == nullptr) continue;
      const auto margin = space->margin_to_refuse(
          {motion.at(seen.time).value(seen.time), seen.time}, seen.part_a, seen.part_b, most);
      if (!margin) continue;
      auto at = std::find_if(lesson_.begin(), lesson_.end(), [&](const auto& pair) {
        return pair.part_a == seen.part_a && pair.part_b == seen.part_b;
      });
      if (at == lesson_.end()) at = lesson_.insert(at, {seen.part_a, seen.part_b, 0});
      at->margin = std::max(at->margin, *margin);
    }
  }

  void take_lesson(PlanningView& view) const {
    view.effort = kLessonEffort;
    view.most_checks = kLessonChecks;
    // Elsewhere on its way the skin may do a little more.
    const double more = 0.1 * wanted();
    for (const auto& learnt : lesson_) {
      const auto at =
          std::find_if(view.pair_margins.begin(), view.pair_margins.end(), [&](const auto& pair) {
            return pair.part_a == learnt.part_a && pair.part_b == learnt.part_b;
          });
      if (at == view.pair_margins.end())
        view.pair_margins.push_back({learnt.part_a, learnt.part_b, learnt.margin + more});
      else
        at->margin += learnt.margin + more;
    }
  }

  // Plans paths, of which the first that has a curve may do; if not, curves are fitted along the
  // others, the nearest to what is wanted first. One that is no nearer than a curve's own path, and
  // the same way around, would bring nothing new.
  std::vector<Way> ways_in(PlanningWorld& world, std::size_t index, std::string& said,
                           std::string& reason) {
    const PlanningView& view = world.view();
    std::vector<Way> ways;
    std::vector<Planned> waiting;
    const bool taught = !view.pair_margins.empty();
    const int most = (view.on_skin || brief_ ? kWaysOnSkin : taught ? kWaysTaught : kWays) * asked_;
    int planned = 0, seeds = 0;
    const auto is_good = [&] {
      return asked_ == 1 && !ways.empty() && ways.front().keeps_accelerations &&
             ways.front().cost.total() < kGoodEnough;
    };
    for (; seeds < most && !stop_.stop_requested() && !is_good(); ++seeds) {
      if (seeds - planned >= (index == 0 && !taught ? kHopeless : kHopelessFurther)) break;
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
      if (ways.empty())
        reason = fit_way(world, next, ways);
      else
        waiting.push_back(std::move(next));
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

  // `world`, if given, learns from what touches.
  void verify_ways(const std::vector<Way>& ways, const std::string& said, PlanningWorld* world) {
    int verified = 0;
    std::string found;
    for (const Way& way : ways) {
      if (stop_.stop_requested() || verified >= kVerifiedInAView * asked_) break;
      if (!held_.empty() && is_known(way.motion)) continue;
      ++verified;
      WindowReport report = report_;
      const std::string hit = verify(way, report, world);
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
  std::string verify(const Way& way, WindowReport& report, PlanningWorld* world) {
    auto keyed = key_motion(p_, way.motion);
    unkeyed_ = keyed ? std::string() : keyed.error().message();
    if (!keyed) return unkeyed_;
    const std::string hit = verify_keys(p_, *keyed, way.seed, stop_, progress_, report);
    if (!hit.empty()) {
      if (world) learn(way.motion, *keyed, *world);
      return hit;
    }
    report.status = CorrectionStatus::corrected;
    report.reason.clear();
    report.blocked_by.clear();
    report.seed = way.seed;
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
  std::vector<LimbPlanningSpace::PairMargin> lesson_;  // of the motions verified last
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
