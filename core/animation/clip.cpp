// SPDX-License-Identifier: MIT
#include "core/animation/clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace elbowroom {
namespace {

// Where t falls among the keys: between `key` and key + 1 at fraction u of the interval, or on
// `key` alone (u = 0).
struct Place {
  std::size_t key = 0;
  bool between = false;
  double u = 0;
  double interval = 0;  // seconds between the two keys
};

// Keys are mostly regular, so the index is guessed from t first and searched for only where the
// guess is off.
Place place_of(const std::vector<float>& times, double t) {
  const std::size_t count = times.size();
  Place place;
  if (count < 2 || !(t > times.front())) return place;  // NaN clamps to the first key
  if (t >= times.back()) {
    place.key = count - 1;
    return place;
  }
  const double span = static_cast<double>(times.back()) - times.front();
  auto guess =
      static_cast<std::size_t>((t - times.front()) / span * static_cast<double>(count - 1));
  guess = std::min(guess, count - 2);
  if (!(times[guess] <= t && t < times[guess + 1])) {
    const auto above = std::upper_bound(times.begin(), times.end(), t,
                                        [](double value, float key) { return value < key; });
    guess = static_cast<std::size_t>(above - times.begin()) - 1;
  }
  place.key = guess;
  place.interval = static_cast<double>(times[guess + 1]) - times[guess];
  place.u = (t - times[guess]) / place.interval;
  place.between = place.u > 0;
  return place;
}

// Offset in Channel::values of the value proper (not its tangents) of a key.
std::size_t value_offset(const Channel& channel, std::size_t key) {
  const auto components = static_cast<std::size_t>(channel.components);
  return channel.interpolation == Interpolation::cubic_spline ? (3 * key + 1) * components
                                                              : key * components;
}

// Component `c` at `place` for everything but LINEAR rotations (glTF 2.0, Appendix C.3 and C.5).
double interpolate(const Channel& channel, const Place& place, std::size_t c) {
  const float* values = channel.values.data();
  const double from = values[value_offset(channel, place.key) + c];
  if (!place.between || channel.interpolation == Interpolation::step) return from;
  const std::size_t to_offset = value_offset(channel, place.key + 1);
  const double to = values[to_offset + c];
  const double u = place.u;
  if (channel.interpolation == Interpolation::linear) return from + (to - from) * u;

  const auto components = static_cast<std::size_t>(channel.components);
  const double out_tangent =
      place.interval * values[value_offset(channel, place.key) + components + c];
  const double in_tangent = place.interval * values[to_offset - components + c];
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * from + (u3 - 2 * u2 + u) * out_tangent + (3 * u2 - 2 * u3) * to +
         (u3 - u2) * in_tangent;
}

Quat key_rotation(const Channel& channel, std::size_t key) {
  const float* v = channel.values.data() + value_offset(channel, key);
  const Quat q(v[3], v[0], v[1], v[2]);
  const double norm = glm::length(q);
  return norm > 0 ? q / norm : Quat(1, 0, 0, 0);
}

}  // namespace

int Clip::find_channel(int joint, Path path) const {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].joint == joint && channels[i].path == path) return static_cast<int>(i);
  }
  return -1;
}

Quat sample_rotation(const Channel& channel, double t) {
  const Place place = place_of(channel.times, t);
  if (!place.between || channel.interpolation == Interpolation::step) {
    return key_rotation(channel, place.key);
  }
  if (channel.interpolation == Interpolation::linear) {
    return slerp_shortest(key_rotation(channel, place.key), key_rotation(channel, place.key + 1),
                          place.u);
  }
  const Quat q(interpolate(channel, place, 3), interpolate(channel, place, 0),
               interpolate(channel, place, 1), interpolate(channel, place, 2));
  const double norm = glm::length(q);
  // A spline may pass through the origin, where no rotation is meant; hold the key then.
  return norm > 1e-12 ? q / norm : key_rotation(channel, place.key);
}

Vec3 sample_vector(const Channel& channel, double t) {
  const Place place = place_of(channel.times, t);
  return Vec3(interpolate(channel, place, 0), interpolate(channel, place, 1),
              interpolate(channel, place, 2));
}

void sample_weights(const Channel& channel, double t, std::vector<double>& weights) {
  const auto count = static_cast<std::size_t>(channel.components);
  weights.resize(count);
  const Place place = place_of(channel.times, t);
  for (std::size_t c = 0; c < count; ++c) weights[c] = interpolate(channel, place, c);
}

void sample_clip(const Clip& clip, double t, Pose& pose) {
  for (const Channel& channel : clip.channels) {
    const auto joint = static_cast<std::size_t>(channel.joint);
    if (channel.joint < 0 || joint >= pose.local.size() || channel.times.empty()) continue;
    switch (channel.path) {
      case Path::translation:
        pose.local[joint].translation = sample_vector(channel, t);
        break;
      case Path::rotation:
        pose.local[joint].rotation = sample_rotation(channel, t);
        break;
      case Path::scale:
        pose.local[joint].scale = sample_vector(channel, t);
        break;
      case Path::weights:
        if (joint < pose.morph_weights.size()) {
          sample_weights(channel, t, pose.morph_weights[joint]);
        }
        break;
    }
  }
}

std::vector<double> step_times(const Clip& clip) {
  std::vector<double> times;
  for (const Channel& channel : clip.channels) {
    if (channel.interpolation != Interpolation::step) continue;
    const auto components = static_cast<std::ptrdiff_t>(channel.components);
    for (std::size_t key = 1; key < channel.times.size(); ++key) {
      const auto now = channel.values.begin() + static_cast<std::ptrdiff_t>(key) * components;
      if (!std::equal(now, now + components, now - components)) times.push_back(channel.times[key]);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

double key_rate(const Clip& clip) {
  constexpr double kDefault = 30.0, kLowest = 1.0, kHighest = 240.0;
  std::vector<double> intervals;
  for (const Channel& channel : clip.channels) {
    if (channel.path != Path::rotation) continue;
    for (std::size_t key = 1; key < channel.times.size(); ++key) {
      intervals.push_back(static_cast<double>(channel.times[key]) - channel.times[key - 1]);
    }
  }
  if (intervals.empty()) return kDefault;
  // Exporters that thin out keys leave multiples of the frame, and many put one odd short interval
  // at an end: the tenth percentile is the frame in both cases.
  const auto tenth = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 10);
  std::nth_element(intervals.begin(), tenth, intervals.end());
  const double rate = 1.0 / *tenth;
  if (!(rate < kHighest)) return kHighest;
  // float32 times of a 30 Hz clip give 29.9999 and 30.0001; people mean 30.
  const double whole = std::round(rate);
  return std::max(kLowest, std::abs(rate - whole) < 0.01 * whole ? whole : rate);
}

}  // namespace elbowroom
