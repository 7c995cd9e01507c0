// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/editing/correct.h"
#include "core/editing/key_time.h"

namespace elbowroom {
namespace {

// An animator leads into a dodge and out of it; a third of a second on each side is a natural
// reaction and return, and leaves speeds moderate.
constexpr double kLead = 0.35;            // s
constexpr double kSearchStep = 1.0 / 60;  // s, in looking for a free end farther out

// The first time at or beyond `from`, going by `step` (signed) no farther than `bound`, at which
// the limb is free with `clearance`; with none, one at which it merely does not touch. False if it
// touches all the way.
bool find_free_end(SceneCollision& scene, int limb, double from, double step, double bound,
                   double clearance, double& found) {
  const double touching = scene.settings().epsilon * scene.height();
  bool any = false;
  for (double t = from;; t += step) {
    const bool last = step > 0 ? t >= bound : t <= bound;
    if (last) t = bound;
    const double rounded = as_float32(t);
    if (!scene.limb_in_contact(rounded, limb, clearance)) {
      found = rounded;
      return true;
    }
    if (!any && !scene.limb_in_contact(rounded, limb, touching)) {
      found = rounded;  // kept in case nothing better comes
      any = true;
    }
    if (last) return any;
  }
}

}  // namespace

std::vector<ProposedWindow> propose_windows(SceneCollision& scene, int limb,
                                            const std::vector<ContactInterval>& contacts,
                                            double clearance) {
  const auto& clip = scene.world().actors[static_cast<std::size_t>(scene.actor())].clip;
  std::vector<ContactInterval> own;
  for (const auto& contact : contacts)
    if (contact.deepest.limb == limb && !contact.deepest.allowed) own.push_back(contact);
  std::stable_sort(own.begin(), own.end(),
                   [](const auto& a, const auto& b) { return a.begin < b.begin; });

  std::vector<ProposedWindow> windows;
  for (const auto& contact : own) {
    ProposedWindow window;
    window.contacts = {contact};
    const double from = std::max(clip->begin, contact.begin - kLead);
    const double to = std::min(clip->end, contact.end + kLead);
    const bool begins =
        find_free_end(scene, limb, from, -kSearchStep, clip->begin, clearance, window.begin);
    const bool ends = find_free_end(scene, limb, to, kSearchStep, clip->end, clearance, window.end);
    if (!begins) window.begin = as_float32(clip->begin);
    if (!ends) window.end = as_float32(clip->end);
    if (!begins && !ends)
      window.blocked =
          "the limb is in contact from where the clip begins to where it ends, so there is nothing "
          "to begin a way around from; move what is in the way, or what the limb holds";
    else if (!begins || !ends)
      window.blocked = std::string("the limb is ") +
                       (begins ? "still in contact where the clip ends"
                               : "in contact already where the clip begins") +
                       ", and a way around has to " + (begins ? "end" : "begin") +
                       " free; move what is in the way, or let the clip be longer";
    if (!windows.empty() && window.begin <= windows.back().end) {
      ProposedWindow& last = windows.back();
      last.end = std::max(last.end, window.end);
      last.contacts.push_back(contact);
      if (last.blocked.empty()) last.blocked = window.blocked;
    } else {
      windows.push_back(window);
    }
  }
  return windows;
}

std::optional<Interval> widened_window(SceneCollision& scene, int limb, const Interval& window,
                                       double by, double clearance) {
  const auto& clip = scene.world().actors[static_cast<std::size_t>(scene.actor())].clip;
  if (!clip) return std::nullopt;
  Interval wide = window;
  double found = 0;
  const double from = std::max(clip->begin, window.lower - by);
  const double to = std::min(clip->end, window.upper + by);
  if (find_free_end(scene, limb, from, -kSearchStep, clip->begin, clearance, found))
    wide.lower = std::min(wide.lower, found);
  if (find_free_end(scene, limb, to, kSearchStep, clip->end, clearance, found))
    wide.upper = std::max(wide.upper, found);
  const double grown = (window.lower - wide.lower) + (wide.upper - window.upper);
  if (grown < 0.25 * by) return std::nullopt;
  return wide;
}

}  // namespace elbowroom
