// SPDX-License-Identifier: MIT
#include "core/editing/suggestions.h"

#include <algorithm>
#include <cstdio>

#include "core/editing/contact_rate.h"
#include "core/editing/plan_window.h"

namespace elbowroom {
namespace {

constexpr double kWider[] = {0.3, 0.7};  // s, on each side

// Another limb that a text of the form "Ada/LeftHand with post at 0.5 s" names.
int limb_in_the_way(const SceneCollision& scene, int limb, const std::string& blocked_by) {
  const auto& actor = scene.world().actors[static_cast<std::size_t>(scene.actor())];
  const auto& joints = actor.model->skeleton.joints;
  const auto names = [&](const LimbModel& model) {
    std::vector<int> own = model.limb.joints;
    for (const FollowingJoint& other : model.limb.following) own.push_back(other.joint);
    return std::any_of(own.begin(), own.end(), [&](int joint) {
      const std::string name = "/" + joints[static_cast<std::size_t>(joint)].name;
      for (std::size_t at = blocked_by.find(name); at != std::string::npos;
           at = blocked_by.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if (end == blocked_by.size() || blocked_by[end] == ' ') return true;
      }
      return false;
    });
  };
  for (std::size_t i = 0; i < scene.limbs().size(); ++i)
    if (static_cast<int>(i) != limb && names(scene.limbs()[i])) return static_cast<int>(i);
  return -1;
}

// Windows that would be chosen for what the limb touches in the one that failed. Says in its reason
// what is to be done where one of its ends is not free.
std::vector<Interval> windows_instead(SceneCollision& scene, double clearance, WindowReport& failed,
                                      const std::stop_token& stop) {
  const auto& clip = scene.world().actors[static_cast<std::size_t>(scene.actor())].clip;
  const auto contacts = scene.scan(clip->begin, clip->end, kContactRate, failed.limb, false, stop);
  std::vector<Interval> chosen;
  std::string blocked;
  for (const ProposedWindow& window : propose_windows(scene, failed.limb, contacts, clearance)) {
    if (window.end < failed.begin || window.begin > failed.end) continue;
    if (window.blocked.empty())
      chosen.push_back({window.begin, window.end});
    else
      blocked = window.blocked;
  }
  if (failed.ends_touch)
    failed.reason += "; " + (blocked.empty() ? "choose a window whose ends are free" : blocked);
  return chosen;
}

}  // namespace

const char* suggestion_id(Suggestion::Kind kind) {
  switch (kind) {
    case Suggestion::Kind::wider_window:
      return "wider_window";
    case Suggestion::Kind::wider_intervals:
      return "wider_intervals";
    case Suggestion::Kind::another_limb:
      break;
  }
  return "another_limb";
}

std::string Suggestion::text() const {
  char text[200];
  switch (kind) {
    case Kind::wider_window:
      std::snprintf(text, sizeof text, "a wider window, %.3f to %.3f s, %s", window.lower,
                    window.upper, works ? "would do" : "would not do");
      return text;
    case Kind::wider_intervals:
      return std::string("without the sampling intervals that are set it ") +
             (works ? "would do" : "would not do");
    case Kind::another_limb:
      break;
  }
  return "correcting " + limb + " instead " + (works ? "would do" : "would not do");
}

void try_suggestions(SceneCollision& scene, WindowReport& failed, const PlanningWishes& wishes,
                     const std::stop_token& stop, const ProgressSink& progress) {
  std::vector<Suggestion>& tried = failed.suggestions;
  const auto clip = scene.world().actors[static_cast<std::size_t>(scene.actor())].clip;
  const double clearance =
      wishes.clearance > 0 ? wishes.clearance : scene.settings().clearance * scene.height();
  const std::vector<Interval> chosen = windows_instead(scene, clearance, failed, stop);
  PlanningWishes once = wishes;
  once.alternatives = 1;
  // True if it works: then no other needs to be tried.
  const auto attempt = [&](Suggestion suggestion, int limb, const PlanningWishes& with) {
    const WindowPlan plan =
        plan_window(scene, clip, limb, suggestion.window.lower, suggestion.window.upper, with, stop,
                    progress, Effort::brief);
    suggestion.works = plan.correction.has_value();
    if (!stop.stop_requested()) tried.push_back(suggestion);
    return suggestion.works || stop.stop_requested();
  };

  const std::string name = scene.limbs()[static_cast<std::size_t>(failed.limb)].limb.name;
  const Interval window{failed.begin, failed.end};
  if (!wishes.sampling.empty()) {
    PlanningWishes freely = once;
    freely.sampling.clear();
    if (attempt({Suggestion::Kind::wider_intervals, false, window, name}, failed.limb, freely))
      return;
  }
  const bool wider_tried = std::any_of(tried.begin(), tried.end(), [](const Suggestion& s) {
    return s.kind == Suggestion::Kind::wider_window;
  });
  for (const Interval& other : chosen)
    if (!wider_tried && !(other == window) &&
        attempt({Suggestion::Kind::wider_window, false, other, name}, failed.limb, once))
      return;
  for (const double by : kWider) {
    if (wider_tried) break;
    const auto wide = widened_window(scene, failed.limb, window, by, clearance);
    if (!wide) continue;
    if (attempt({Suggestion::Kind::wider_window, false, *wide, name}, failed.limb, once)) return;
  }
  const int other = limb_in_the_way(scene, failed.limb, failed.blocked_by);
  if (other >= 0) {
    PlanningWishes freely = once;
    freely.sampling.clear();
    attempt({Suggestion::Kind::another_limb, false, window,
             scene.limbs()[static_cast<std::size_t>(other)].limb.name},
            other, freely);
  }
}

}  // namespace elbowroom
