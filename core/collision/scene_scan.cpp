// SPDX-License-Identifier: MIT
// A clip's contacts over time, as intervals.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include "core/collision/scene_collision_data.h"
#include "core/collision/world_steps.h"

namespace elbowroom {
namespace {

using Data = SceneCollision::Data;

constexpr double kEndTolerance = 1e-4;  // s, of an interval's ends
constexpr double kUsualRate = 60;       // Hz, where the rate given is none
constexpr double kMostSamples = 4e6;    // of a hostile interval or rate

// What makes two samples the same contact: bodies, parts, limb and verdict.
using Key = std::tuple<int, int, std::string, std::string, int, bool, AllowedReason>;

Key key_of(int a, int b, const ContactSample& sample) {
  return {a, b, sample.part_a, sample.part_b, sample.limb, sample.allowed, sample.reason};
}

// The first body of a contact by enclosure: the whole skin.
constexpr int kWholeSkin = -1;

std::vector<double> scan_times(const Data& data, double begin, double end, double rate) {
  if (!(rate > 0) || !std::isfinite(rate)) rate = kUsualRate;
  std::vector<double> times;
  const double wanted = std::ceil((end - begin) * rate - 1e-9);
  const auto samples = static_cast<std::int64_t>(std::clamp(wanted, 1.0, kMostSamples));
  for (std::int64_t i = 0; i <= samples; ++i)
    times.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(samples));
  const auto inside = [&](double t) {
    if (t >= begin && t <= end) times.push_back(t);
  };
  if (const auto& clip = data.world.actors[static_cast<std::size_t>(data.actor)].clip)
    for (const Channel& channel : clip->channels)
      for (const float key : channel.times) inside(key);
  for (const double step : world_steps(data.world, begin, end)) {
    inside(just_before(step));
    inside(step);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

struct Scan {
  Data& data;
  int only_limb;
  bool list_allowed;
  std::vector<ContactSample> scratch;

  // Is the contact there at t?
  bool present(const Key& key, double t) {
    data.pose(t);
    if (std::get<0>(key) == kWholeSkin) {
      const auto objects = enclosed_objects(data, only_limb);
      return std::any_of(objects.begin(), objects.end(), [&](const auto& object) {
        return key_of(kWholeSkin, object.body, enclosed_sample(data, object, only_limb)) == key;
      });
    }
    for (TestPair& pair : data.pairs_now().pairs) {
      if (pair.a != std::get<0>(key) || pair.b != std::get<1>(key)) continue;
      scratch.clear();
      data.pair_contacts(pair, only_limb, list_allowed, scratch);
      return std::any_of(scratch.begin(), scratch.end(),
                         [&](const auto& sample) { return key_of(pair.a, pair.b, sample) == key; });
    }
    return false;
  }

  // The time nearest to `without` at which the contact, present at `with`, still is.
  double bisect(const Key& key, double without, double with) {
    while (std::abs(with - without) > kEndTolerance) {
      const double middle = 0.5 * (with + without);
      (present(key, middle) ? with : without) = middle;
    }
    return with;
  }
};

}  // namespace

std::vector<ContactInterval> SceneCollision::scan(double begin, double end, double rate,
                                                  int only_limb, bool list_allowed,
                                                  const std::stop_token& stop) {
  std::vector<ContactInterval> intervals;
  Data& data = *data_;
  if (!(std::isfinite(begin) && std::isfinite(end) && begin <= end) || !data.knows(only_limb))
    return intervals;
  Scan scan{data, only_limb, list_allowed, {}};
  std::map<Key, ContactInterval> open;
  std::map<Key, ContactSample> now;
  std::vector<ContactSample> samples;
  double before = begin;
  bool first = true;
  for (const double t : scan_times(data, begin, end, rate)) {
    if (stop.stop_requested()) break;
    now.clear();
    data.pose(t);
    for (TestPair& pair : data.pairs_now().pairs) {
      if (!data.concerns(pair, only_limb)) continue;
      samples.clear();
      data.pair_contacts(pair, only_limb, list_allowed, samples);
      for (ContactSample& sample : samples) now.try_emplace(key_of(pair.a, pair.b, sample), sample);
    }
    for (const EnclosedObject& object : enclosed_objects(data, only_limb)) {
      const ContactSample sample = enclosed_sample(data, object, only_limb);
      const bool known = std::any_of(now.begin(), now.end(), [&](const auto& other) {
        return other.second.part_b == sample.part_b && !other.second.allowed;
      });
      if (!known) now.try_emplace(key_of(kWholeSkin, object.body, sample), sample);
    }
    for (auto it = open.begin(); it != open.end();) {
      if (now.contains(it->first)) {
        ++it;
        continue;
      }
      it->second.end = scan.bisect(it->first, t, before);
      intervals.push_back(it->second);
      it = open.erase(it);
    }
    for (const auto& [key, sample] : now) {
      const auto [at, fresh] = open.try_emplace(key);
      ContactInterval& interval = at->second;
      if (fresh) {
        interval.begin = first ? t : scan.bisect(key, before, t);
        interval.deepest = sample;
        interval.time_of_deepest = t;
      } else if (sample.depth > interval.deepest.depth) {
        interval.deepest = sample;
        interval.time_of_deepest = t;
      }
      interval.end = t;
    }
    before = t;
    first = false;
  }
  for (const auto& [key, interval] : open) intervals.push_back(interval);
  std::stable_sort(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) {
    return std::tie(a.begin, a.deepest.part_a, a.deepest.part_b) <
           std::tie(b.begin, b.deepest.part_a, b.deepest.part_b);
  });
  return intervals;
}

}  // namespace elbowroom
