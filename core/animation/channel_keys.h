// SPDX-License-Identifier: MIT
// A channel's keys taken apart and put together again: what splices of rotations and translations
// have in common. Private to the animation folder.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "core/animation/clip.h"
#include "core/base/result.h"

namespace elbowroom::channel_keys {

// One key as the file has it; tangents only mean something for CUBICSPLINE.
template <std::size_t N>
struct Key {
  float time = 0;
  std::array<float, N> in{}, value{}, out{};
};
template <std::size_t N>
using Keys = std::vector<Key<N>>;

inline float just_before(float t) {
  return std::nextafter(t, -std::numeric_limits<float>::infinity());
}

inline std::string name_of(Path path) {
  return path == Path::rotation      ? "rotation"
         : path == Path::translation ? "translation"
                                     : "channel";
}
// "rotation of joint 7": where an error is.
inline Error bad(Path path, int joint, const std::string& what, const std::string& remedy = "") {
  return Error{what, name_of(path) + " of joint " + std::to_string(joint), remedy};
}

// STEP as LINEAR: each value held up to the last float32 before the next key.
template <std::size_t N>
Keys<N> with_holds(const Keys<N>& steps) {
  Keys<N> keys;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i > 0 && steps[i].value != steps[i - 1].value) {
      Key<N> hold = steps[i - 1];
      hold.time = just_before(steps[i].time);
      if (hold.time > keys.back().time) keys.push_back(hold);
    }
    keys.push_back(steps[i]);
  }
  return keys;
}

// A channel's keys, those of STEP as LINEAR. Error: a channel that is not of that path or not well
// formed, times that do not increase, or a key that is no `good(key)`, of which `fault` tells.
template <std::size_t N, typename Good>
Result<Keys<N>> read(const Channel& channel, Path path, int joint, const Good& good,
                     const std::string& fault) {
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  const std::size_t stride = cubic ? 3 * N : N, count = channel.times.size();
  if (channel.path != path || channel.components != static_cast<int>(N) || count == 0 ||
      channel.values.size() != stride * count)
    return bad(path, joint, "the source channel is no " + name_of(path) + " channel");
  Keys<N> keys(count);
  for (std::size_t i = 0; i < count; ++i) {
    Key<N>& key = keys[i];
    key.time = channel.times[i];
    if (!std::isfinite(key.time) || (i > 0 && key.time <= keys[i - 1].time))
      return bad(path, joint, "the source channel's times do not increase");
    const float* at = channel.values.data() + stride * i;
    const auto take = [&at](std::array<float, N>& to) {
      std::copy(at, at + N, to.begin());
      at += N;
    };
    if (cubic) take(key.in);
    take(key.value);
    if (cubic) take(key.out);
    if (!good(key)) return bad(path, joint, fault);
  }
  return channel.interpolation == Interpolation::step ? with_holds(keys) : keys;
}

// Keys cut at a time: those of the side that is kept, and where the cut is.
template <std::size_t N>
struct Side {
  Keys<N> kept;
  typename Keys<N>::const_iterator next;  // the first that is not before the cut
  bool exact = false;                     // it stands at the cut; it is not kept
  bool clamped = false;                   // the cut is outside of all keys
};

// Kept is what is before t (`left`) or after it. Where the keys clamp there, their tangents towards
// that side, which nothing used before, become those of a rest.
template <std::size_t N>
Side<N> side_of(const Keys<N>& keys, float t, bool left) {
  Side<N> side;
  side.next = std::lower_bound(keys.begin(), keys.end(), t,
                               [](const Key<N>& key, float time) { return key.time < time; });
  side.exact = side.next != keys.end() && side.next->time == t;
  if (left)
    side.kept.assign(keys.begin(), side.next);
  else
    side.kept.assign(side.exact ? side.next + 1 : side.next, keys.end());
  side.clamped = !side.exact && (side.next == keys.begin() || side.next == keys.end());
  if (side.clamped && left && side.next == keys.end()) side.kept.back().out = {};
  if (side.clamped && !left && side.next == keys.begin()) side.kept.front().in = {};
  return side;
}

// Error: a window that is empty or not finite, or times that do not increase within it.
inline Status check_times(Path path, int joint, const std::vector<float>& times, float begin,
                          float end) {
  if (!std::isfinite(begin) || !std::isfinite(end) || !(begin < end))
    return bad(path, joint, "the window is empty");
  if (times.empty()) return bad(path, joint, "the planned keys are none or of unequal number");
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!(times[i] >= begin && times[i] <= end) || (i > 0 && !(times[i] > times[i - 1])))
      return bad(path, joint, "the planned times do not increase or leave the window");
  return Done{};
}

// A channel of these keys.
template <std::size_t N>
Channel channel_of(Path path, int joint, Interpolation interpolation,
                   std::initializer_list<const Keys<N>*> parts) {
  Channel channel;
  channel.joint = joint;
  channel.path = path;
  channel.interpolation = interpolation;
  channel.components = static_cast<int>(N);
  const bool cubic = interpolation == Interpolation::cubic_spline;
  for (const Keys<N>* part : parts)
    for (const Key<N>& key : *part) {
      channel.times.push_back(key.time);
      const auto put = [&](const std::array<float, N>& f) {
        channel.values.insert(channel.values.end(), f.begin(), f.end());
      };
      if (cubic) put(key.in);
      put(key.value);
      if (cubic) put(key.out);
    }
  return channel;
}

}  // namespace elbowroom::channel_keys
