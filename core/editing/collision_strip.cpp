// SPDX-License-Identifier: MIT
#include "core/editing/collision_strip.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

constexpr double kStretch = 0.25;      // s, looked at in one go
constexpr double kScanRate = 120;      // Hz, of the contacts' intervals
constexpr double kSameContact = 2e-4;  // s: intervals of one pair that are no farther apart are one

bool same_pair(const ContactInterval& a, const ContactInterval& b) {
  return a.deepest.limb == b.deepest.limb && a.deepest.part_a == b.deepest.part_a &&
         a.deepest.part_b == b.deepest.part_b;
}

// Appends, or prolongs the interval that a border between stretches has cut.
void append(std::vector<ContactInterval>& list, const ContactInterval& fresh) {
  for (auto it = list.rbegin(); it != list.rend(); ++it) {
    if (!same_pair(*it, fresh) || it->end < fresh.begin - kSameContact) continue;
    it->end = std::max(it->end, fresh.end);
    if (fresh.deepest.depth > it->deepest.depth) {
      it->deepest = fresh.deepest;
      it->time_of_deepest = fresh.time_of_deepest;
    }
    return;
  }
  list.push_back(fresh);
}

// The depth and the room of every limb at one time.
void sample(SceneCollision& scene, double t, std::vector<ContactSample>& scratch,
            CollisionStrip& strip) {
  scene.contacts_at(t, -1, false, scratch);
  for (std::size_t limb = 0; limb < strip.limbs.size(); ++limb) {
    StripSample at;
    at.t = t;
    for (const ContactSample& contact : scratch) {
      if (contact.limb != static_cast<int>(limb)) continue;
      if (!at.contact || contact.depth > at.depth) {
        at.depth = contact.depth;
        at.place = contact.place;
      }
      at.contact = true;
    }
    if (!at.contact)
      at.clearance =
          scene.limb_clearance_from_scene(t, static_cast<int>(limb), kStripReach * scene.height());
    strip.limbs[limb].samples.push_back(at);
  }
}

void look_at_stretch(SceneCollision& scene, double from, double to, CollisionStrip& strip) {
  for (const ContactInterval& contact : scene.scan(from, to, kScanRate, -1, false)) {
    if (contact.deepest.limb < 0)
      append(strip.other, contact);
    else
      append(strip.limbs[static_cast<std::size_t>(contact.deepest.limb)].contacts, contact);
  }
  std::vector<ContactSample> scratch;
  // Samples lie on one grid over the whole clip, so that a renewed stretch fits in.
  const auto first = static_cast<long>(std::ceil((from - strip.begin) * kStripRate - 1e-9));
  for (long i = first;; ++i) {
    const double t = strip.begin + static_cast<double>(i) / kStripRate;
    if (t > to || (t >= to && to < strip.end)) break;
    sample(scene, t, scratch, strip);
  }
}

void finish(SceneCollision& scene, CollisionStrip& strip) {
  for (std::size_t limb = 0; limb < strip.limbs.size(); ++limb) {
    auto& of_limb = strip.limbs[limb];
    std::stable_sort(of_limb.contacts.begin(), of_limb.contacts.end(),
                     [](const auto& a, const auto& b) { return a.begin < b.begin; });
    of_limb.windows = propose_windows(scene, static_cast<int>(limb), of_limb.contacts,
                                      scene.settings().clearance * scene.height());
  }
}

// Looks at [from, to] stretch by stretch; false if stopped.
bool look(SceneCollision& scene, double from, double to, const std::stop_token& stop,
          const StripSink& grown, CollisionStrip& strip) {
  const auto stretches = static_cast<long>(std::max(1.0, std::ceil((to - from) / kStretch - 1e-9)));
  for (long i = 0; i < stretches; ++i) {
    if (stop.stop_requested()) return false;
    const double a = from + (to - from) * static_cast<double>(i) / static_cast<double>(stretches);
    const double b = i + 1 == stretches ? to
                                        : from + (to - from) * static_cast<double>(i + 1) /
                                                     static_cast<double>(stretches);
    look_at_stretch(scene, a, b, strip);
    if (i + 1 == stretches) break;
    strip.computed_to = b;
    if (grown) grown(strip);
  }
  return true;
}

// What of a list of contacts lies outside [from, to].
void cut_contacts(std::vector<ContactInterval>& list, double from, double to) {
  std::vector<ContactInterval> kept;
  for (const ContactInterval& contact : list) {
    if (contact.end < from || contact.begin > to) {
      kept.push_back(contact);
      continue;
    }
    if (contact.begin < from) {
      kept.push_back(contact);
      kept.back().end = from;
    }
    if (contact.end > to) {
      kept.push_back(contact);
      kept.back().begin = to;
    }
  }
  list = std::move(kept);
}

}  // namespace

CollisionStrip make_collision_strip(SceneCollision& scene, double begin, double end,
                                    std::stop_token stop, const StripSink& grown) {
  CollisionStrip strip;
  strip.begin = strip.computed_to = begin;
  strip.end = end;
  strip.limbs.resize(scene.limbs().size());
  if (!look(scene, begin, end, stop, grown, strip)) return strip;
  finish(scene, strip);
  strip.computed_to = end;
  if (grown) grown(strip);
  return strip;
}

CollisionStrip renew_collision_strip(SceneCollision& scene, const CollisionStrip& before,
                                     double from, double to, std::stop_token stop,
                                     const StripSink& grown) {
  if (!before.complete() || before.limbs.size() != scene.limbs().size())
    return make_collision_strip(scene, before.begin, before.end, stop, grown);
  from = std::clamp(from, before.begin, before.end);
  to = std::clamp(to, from, before.end);
  CollisionStrip strip = before;
  std::vector<std::vector<StripSample>> later(strip.limbs.size());
  cut_contacts(strip.other, from, to);
  for (std::size_t limb = 0; limb < strip.limbs.size(); ++limb) {
    LimbStrip& of_limb = strip.limbs[limb];
    cut_contacts(of_limb.contacts, from, to);
    of_limb.windows.clear();
    for (const StripSample& old : of_limb.samples)
      if (old.t > to || (old.t == to && to < strip.end)) later[limb].push_back(old);
    std::erase_if(of_limb.samples, [&](const StripSample& old) { return old.t >= from; });
  }
  // Until it is whole again nobody is told: its end would seem unknown.
  if (!look(scene, from, to, stop, {}, strip)) {
    strip.computed_to = from;
    return strip;
  }
  for (std::size_t limb = 0; limb < strip.limbs.size(); ++limb)
    strip.limbs[limb].samples.insert(strip.limbs[limb].samples.end(), later[limb].begin(),
                                     later[limb].end());
  // Contacts that the borders had cut in two are one again.
  const auto join = [](std::vector<ContactInterval>& list) {
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.begin < b.begin; });
    std::vector<ContactInterval> joined;
    for (const ContactInterval& contact : list) append(joined, contact);
    list = std::move(joined);
  };
  join(strip.other);
  for (LimbStrip& of_limb : strip.limbs) join(of_limb.contacts);
  finish(scene, strip);
  strip.computed_to = strip.end;
  if (grown) grown(strip);
  return strip;
}

const StripSample* strip_sample_at(const LimbStrip& limb, double t) {
  const auto& samples = limb.samples;
  const auto after = std::lower_bound(samples.begin(), samples.end(), t,
                                      [](const StripSample& s, double time) { return s.t < time; });
  const StripSample* nearest = nullptr;
  if (after != samples.end()) nearest = &*after;
  if (after != samples.begin() && (!nearest || t - (after - 1)->t < nearest->t - t))
    nearest = &*(after - 1);
  return nearest && std::abs(nearest->t - t) <= 2 / kStripRate ? nearest : nullptr;
}

}  // namespace elbowroom
