// SPDX-License-Identifier: MIT
#include "core/editing/correct.h"

#include <algorithm>
#include <cmath>

#include "core/editing/plan_window.h"

namespace elbowroom {
namespace {

constexpr double kScanRate = 120;  // Hz, of the contacts listed before and after

bool involves(const ContactInterval& contact, const std::vector<int>& limbs) {
  return std::find(limbs.begin(), limbs.end(), contact.deepest.limb) != limbs.end();
}

}  // namespace

bool CorrectionOutcome::all_corrected() const {
  return std::all_of(windows.begin(), windows.end(), [](const WindowReport& window) {
    return window.status == CorrectionStatus::corrected;
  });
}

bool CorrectionOutcome::cancelled() const {
  return std::any_of(windows.begin(), windows.end(), [](const WindowReport& window) {
    return window.status == CorrectionStatus::cancelled;
  });
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
  for (auto& contact : scene.scan(source->begin, source->end, kScanRate, -1, false)) {
    if (contact.deepest.limb < 0)
      outcome.other.push_back(std::move(contact));
    else if (involves(contact, limbs))
      outcome.before.push_back(std::move(contact));
  }

  const double clearance = task.wishes.clearance > 0 ? task.wishes.clearance
                                                     : scene.settings().clearance * scene.height();
  for (const int limb : limbs) {
    const auto& model_of_limb = scene.limbs()[static_cast<std::size_t>(limb)];
    // Earlier limbs' corrections may have changed this one's contacts: looked at afresh.
    scene.set_clip(outcome.clip);
    const auto contacts = outcome.corrections.empty()
                              ? outcome.before
                              : scene.scan(source->begin, source->end, kScanRate, limb, false);
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
      auto planned = plan_window(scene, outcome.clip, limb, window.begin, window.end, task.wishes,
                                 stop, progress);
      outcome.windows.push_back(planned.report);
      if (planned.correction) {
        auto laid = lay_over(model.skeleton, *outcome.clip, {*planned.correction});
        if (!laid) return laid.error();
        outcome.clip = std::make_shared<const Clip>(std::move(*laid));
        planned.correction->name = model_of_limb.limb.name + " " + std::to_string(w + 1);
        outcome.corrections.push_back(std::move(*planned.correction));
      }
      if (stop.stop_requested()) return outcome;
    }
  }
  scene.set_clip(outcome.clip);
  if (outcome.corrections.empty()) {
    outcome.after = outcome.before;
    return outcome;
  }
  tell("looking at the result", -1);
  for (auto& contact : scene.scan(source->begin, source->end, kScanRate, -1, false))
    if (involves(contact, limbs)) outcome.after.push_back(std::move(contact));
  return outcome;
}

}  // namespace elbowroom
