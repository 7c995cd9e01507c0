// SPDX-License-Identifier: MIT
#include "core/editing/collision_strip.h"

#include <algorithm>
#include <cmath>

#include "core/editing/contact_rate.h"

namespace elbowroom {
namespace {

constexpr double kStretch = 0.25;      // s, looked at in one go
constexpr double kSameTime = 2e-8;     // s: samples
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

// Samples lie on one grid over the whole clip, so that a renewed stretch fits in, and where
// contacts are deepest.
double sample_time(const CollisionStrip& strip, long i) {
  return strip.begin + static_cast<double>(i) / kStripRate;
}
// The first sample that belongs to what begins at t.
long first_sample(const CollisionStrip& strip, double t) {
  return static_cast<long>(std::ceil((t - strip.begin) * kStripRate - 1e-6));
}

void look_at_stretch(SceneCollision& scene, double from, double to, CollisionStrip& strip) {
  std::vector<std::size_t> known;
  for (const LimbStrip& of_limb : strip.limbs) known.push_back(of_limb.samples.size());
  std::vector<double> deepest;
  for (const ContactInterval& contact : scene.scan(from, to, kContactRate, -1, false)) {
    if (contact.deepest.limb >= 0) deepest.push_back(contact.time_of_deepest);
    if (contact.deepest.limb < 0)
      append(strip.other, contact);
    else
      append(strip.limbs[static_cast<std::size_t>(contact.deepest.limb)].contacts, contact);
  }
  std::vector<ContactSample> scratch;
  const long end = first_sample(strip, to);
  for (long i = first_sample(strip, from); i < end; ++i)
    sample(scene, sample_time(strip, i), scratch, strip);
  if (to >= strip.end && sample_time(strip, end) <= strip.end)
    sample(scene, sample_time(strip, end), scratch, strip);
  // What a contact is said to come to is to be found in the samples.
  std::sort(deepest.begin(), deepest.end());
  double last = from - 1;
  for (const double t : deepest) {
    const double grid = (t - strip.begin) * kStripRate;
    if (t < from || (t >= to && to < strip.end) || t - last < kSameTime ||
        std::abs(grid - std::round(grid)) < kSameTime * kStripRate)
      continue;
    sample(scene, t, scratch, strip);
    last = t;
  }
  for (std::size_t limb = 0; limb < strip.limbs.size(); ++limb) {
    auto& samples = strip.limbs[limb].samples;
    std::stable_sort(samples.begin() + static_cast<std::ptrdiff_t>(known[limb]), samples.end(),
                     [](const StripSample& a, const StripSample& b) { return a.t < b.t; });
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

// Widens [from, to] to whole contacts: half a contact has another deepest point.
void widen_to_contacts(const std::vector<ContactInterval>& list, double& from, double& to,
                       bool& widened) {
  for (const ContactInterval& contact : list) {
    if (contact.end < from || contact.begin > to) continue;
    if (contact.begin >= from && contact.end <= to) continue;
    from = std::min(from, contact.begin);
    to = std::max(to, contact.end);
    widened = true;
  }
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
  for (bool widened = true; widened;) {
    widened = false;
    widen_to_contacts(strip.other, from, to, widened);
    for (const LimbStrip& of_limb : strip.limbs)
      widen_to_contacts(of_limb.contacts, from, to, widened);
  }
  from = std::max(from, strip.begin);
  to = std::min(to, strip.end);
  // What comes later waits, so that everything is appended in order.
  CollisionStrip later = strip;
  const auto split = [&](std::vector<ContactInterval>& before_it,
                         std::vector<ContactInterval>& after_it) {
    std::erase_if(before_it, [&](const auto& contact) { return contact.end >= from; });
    std::erase_if(after_it, [&](const auto& contact) { return contact.begin <= to; });
  };
  split(strip.other, later.other);
  for (std::size_t limb = 0; limb < strip.limbs.size(); ++limb) {
    LimbStrip& of_limb = strip.limbs[limb];
    split(of_limb.contacts, later.limbs[limb].contacts);
    of_limb.windows.clear();
    std::erase_if(of_limb.samples,
                  [&](const auto& sample) { return sample.t >= from - kSameTime; });
    std::erase_if(later.limbs[limb].samples,
                  [&](const auto& sample) { return to >= strip.end || sample.t < to - kSameTime; });
  }
  // Until it is whole again nobody is told: its end would seem unknown.
  if (!look(scene, from, to, stop, {}, strip)) {
    strip.computed_to = from;
    return strip;
  }
  for (const ContactInterval& contact : later.other) append(strip.other, contact);
  for (std::size_t limb = 0; limb < strip.limbs.size(); ++limb) {
    LimbStrip& of_limb = strip.limbs[limb];
    for (const ContactInterval& contact : later.limbs[limb].contacts)
      append(of_limb.contacts, contact);
    of_limb.samples.insert(of_limb.samples.end(), later.limbs[limb].samples.begin(),
                           later.limbs[limb].samples.end());
  }
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
