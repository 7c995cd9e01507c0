// SPDX-License-Identifier: MIT
#include "core/editing/correct.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/editing/contact_rate.h"
#include "core/editing/motion_cost.h"
#include "core/editing/plan_window.h"
#include "core/editing/suggestions.h"

namespace elbowroom {
namespace {

// A window of its own making is made wider where it fails, or where there is too little time to
// move naturally.
constexpr double kEarlierAndLater[] = {0.25, 0.6};  // s, on each side
constexpr double kHurried = 0.3;                    // a cost worth a try with more time
constexpr std::size_t kEasyAttempts = 2;            // views of the world that it took

bool involves(const ContactInterval& contact, const std::vector<int>& limbs) {
  return std::find(limbs.begin(), limbs.end(), contact.deepest.limb) != limbs.end();
}

// What a plan that was not taken cost is part of the whole.
void add_costs(const WindowReport& spent, WindowReport& report) {
  report.plan_ms += spent.plan_ms;
  report.smooth_ms += spent.smooth_ms;
  report.verify_ms += spent.verify_ms;
  report.certify_ms += spent.certify_ms;
  report.total_ms += spent.total_ms;
  report.validity_checks += spent.validity_checks;
  report.edge_checks += spent.edge_checks;
  report.iterations += spent.iterations;
}

// Plans a window that nobody has set: a wider one where it fails or is hurried, if that is better.
WindowPlan plan_with_time(SceneCollision& scene, const std::shared_ptr<const Clip>& clip, int limb,
                          const ProposedWindow& window, const PlanningWishes& wishes,
                          double clearance, double before, double after,
                          const std::stop_token& stop, const ProgressSink& progress) {
  WindowPlan best =
      plan_window(scene, clip, limb, window.begin, window.end, wishes, stop, progress);
  Interval tried_last{window.begin, window.end};
  for (const double by : kEarlierAndLater) {
    // What was hard to find at all is not looked for again for the sake of its pace.
    const bool easy = best.report.attempts.size() <= kEasyAttempts;
    if (stop.stop_requested() || (best.correction && (best.report.cost < kHurried || !easy))) break;
    auto wide = widened_window(scene, limb, {window.begin, window.end}, by, clearance);
    if (!wide) continue;
    // Not into the windows beside it.
    wide->lower = std::max(wide->lower, std::min(before, window.begin));
    wide->upper = std::min(wide->upper, std::max(after, window.end));
    if (wide->lower == tried_last.lower && wide->upper == tried_last.upper) continue;
    tried_last = *wide;
    WindowPlan other =
        plan_window(scene, clip, limb, wide->lower, wide->upper, wishes, stop, progress);
    if (stop.stop_requested()) break;
    // Costs are means over the window: as sums they compare.
    const double best_sum = best.report.cost * (best.report.end - best.report.begin);
    const double other_sum = other.report.cost * (other.report.end - other.report.begin);
    const bool better = other.correction &&
                        (!best.correction ||
                         (other.report.certified >= best.report.certified && other_sum < best_sum));
    std::vector<Suggestion> tried = best.report.suggestions;
    if (!best.correction && !other.correction)
      tried.push_back({Suggestion::Kind::wider_window, false, *wide,
                       scene.limbs()[static_cast<std::size_t>(limb)].limb.name});
    const WindowReport spent = better ? best.report : other.report;
    if (better) best = std::move(other);
    add_costs(spent, best.report);
    if (!best.correction) best.report.suggestions = std::move(tried);
  }
  return best;
}

std::string length_text(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", length);
  return text;
}

// What was asked for and is not so.
void note_what_is_missing(const std::string& limb, const WindowPlan& plan,
                          const PlanningWishes& wishes, double clearance,
                          std::vector<std::string>& notes) {
  char what[120];
  std::snprintf(what, sizeof what, "%s, %.3f to %.3f s: ", limb.c_str(), plan.report.begin,
                plan.report.end);
  if (plan.report.planned_clearance < clearance)
    notes.push_back(what + ("no way was found that keeps " + length_text(clearance)) +
                    " from the scene; this one was planned with " +
                    length_text(plan.report.planned_clearance));
  const std::size_t found = 1 + plan.alternatives.size();
  if (found < static_cast<std::size_t>(std::max(1, wishes.alternatives)))
    notes.push_back(what + std::to_string(found) + " of " + std::to_string(wishes.alternatives) +
                    " ways around were found; the others were the same way again, or none");
}

}  // namespace

bool CorrectionOutcome::all_corrected() const {
  return std::all_of(windows.begin(), windows.end(), [](const WindowReport& window) {
    return window.status == CorrectionStatus::corrected;
  });
}

bool CorrectionOutcome::cancelled() const {
  return interrupted || std::any_of(windows.begin(), windows.end(), [](const WindowReport& window) {
           return window.status == CorrectionStatus::cancelled;
         });
}

void look_at_contacts(SceneCollision& scene, const std::vector<int>& limbs,
                      std::vector<ContactInterval>& own, std::vector<ContactInterval>* other,
                      const std::stop_token& stop) {
  const auto& clip = scene.world().actors[static_cast<std::size_t>(scene.actor())].clip;
  if (!clip) return;
  for (auto& contact : scene.scan(clip->begin, clip->end, kContactRate, -1, false, stop)) {
    if (involves(contact, limbs))
      own.push_back(std::move(contact));
    else if (contact.deepest.limb < 0 && other != nullptr)
      other->push_back(std::move(contact));
  }
}

Result<CorrectionOutcome> correct(SceneCollision& scene, const std::vector<int>& limbs,
                                  const Task& task, std::stop_token stop,
                                  const ProgressSink& progress) {
  const auto index = static_cast<std::size_t>(scene.actor());
  const std::shared_ptr<const Clip> source = scene.world().actors[index].clip;
  const Model& model = *scene.world().actors[index].model;
  if (!source)
    return Error{"the character has no clip to correct", model.path.string(),
                 "give a file with an animation"};
  if (Status wishes = check_wishes(scene, limbs, task.wishes); !wishes) return wishes.error();
  if (task.window && (task.window->upper <= source->begin || task.window->lower >= source->end))
    return Error{"the window lies outside the clip", model.path.string(),
                 "the clip runs from " + std::to_string(source->begin) + " to " +
                     std::to_string(source->end) + " s"};
  auto tell = [&](const std::string& phase, double fraction) {
    if (progress) progress({phase, fraction});
  };

  CorrectionOutcome outcome;
  outcome.clip = source;
  tell("looking for contacts", -1);
  look_at_contacts(scene, limbs, outcome.before, &outcome.other, stop);
  // Asked for while nothing was planned, or after the last plan: no window tells of it.
  const auto interrupted = [&] { return outcome.interrupted = stop.stop_requested(); };

  const double clearance = task.wishes.clearance > 0 ? task.wishes.clearance
                                                     : scene.settings().clearance * scene.height();
  for (const int limb : limbs) {
    if (interrupted()) return outcome;
    const auto& model_of_limb = scene.limbs()[static_cast<std::size_t>(limb)];
    // Earlier limbs' corrections may have changed this one's contacts: looked at afresh.
    scene.set_clip(outcome.clip);
    const auto contacts = outcome.corrections.empty() ? outcome.before
                                                      : scene.scan(source->begin, source->end,
                                                                   kContactRate, limb, false, stop);
    std::vector<ProposedWindow> windows;
    if (task.window) {
      ProposedWindow window;
      // What lies beyond the clip's keys has nothing to replan.
      window.begin =
          static_cast<double>(static_cast<float>(std::max(task.window->lower, source->begin)));
      window.end =
          static_cast<double>(static_cast<float>(std::min(task.window->upper, source->end)));
      for (const auto& contact : contacts)
        if (contact.deepest.limb == limb && contact.end >= window.begin &&
            contact.begin <= window.end)
          window.contacts.push_back(contact);
      if (!window.contacts.empty() || task.even_if_free) windows.push_back(window);
    } else {
      windows = propose_windows(scene, limb, contacts, clearance);
    }
    for (std::size_t w = 0; w < windows.size(); ++w) {
      const ProposedWindow& window = windows[w];
      const std::string what = model_of_limb.limb.name + ", window " + std::to_string(w + 1) +
                               " of " + std::to_string(windows.size());
      tell(what, static_cast<double>(w) / static_cast<double>(windows.size()));
      if (!window.blocked.empty()) {
        WindowReport report;
        report.limb = limb;
        report.begin = window.begin;
        report.end = window.end;
        report.seed = task.wishes.seed;
        report.reason = window.blocked;
        const auto& first = window.contacts.front().deepest;
        report.blocked_by = first.part_a + " with " + first.part_b;
        outcome.windows.push_back(report);
        continue;
      }
      const double before = w > 0 ? windows[w - 1].end : source->begin;
      const double after = w + 1 < windows.size() ? windows[w + 1].begin : source->end;
      auto planned = task.window ? plan_window(scene, outcome.clip, limb, window.begin, window.end,
                                               task.wishes, stop, progress)
                                 : plan_with_time(scene, outcome.clip, limb, window, task.wishes,
                                                  clearance, before, after, stop, progress);
      if (planned.correction) {
        note_what_is_missing(model_of_limb.limb.name, planned, task.wishes, clearance,
                             outcome.notes);
      } else if (!stop.stop_requested()) {
        try_suggestions(scene, planned.report, task.wishes, stop, progress);
      }
      outcome.windows.push_back(planned.report);
      for (auto& other : planned.alternatives) {
        other.correction.task = task.name;
        outcome.other_ways.push_back(
            {outcome.windows.size() - 1, std::move(other.report), std::move(other.correction)});
      }
      if (planned.correction) {
        auto laid = lay_over(model.skeleton, *outcome.clip, {*planned.correction});
        if (!laid) return laid.error();
        outcome.clip = std::make_shared<const Clip>(std::move(*laid));
        planned.correction->name = model_of_limb.limb.name + " " + std::to_string(w + 1);
        planned.correction->task = task.name;
        outcome.corrections.push_back(std::move(*planned.correction));
      }
      if (interrupted()) return outcome;
    }
  }
  scene.set_clip(outcome.clip);
  if (interrupted()) return outcome;
  if (outcome.corrections.empty()) {
    outcome.after = outcome.before;
    return outcome;
  }
  tell("looking at the result", -1);
  look_at_contacts(scene, limbs, outcome.after, nullptr, stop);
  interrupted();
  return outcome;
}

}  // namespace elbowroom
