// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/animation/splice.h"

namespace elbowroom {
namespace {

using Floats = std::array<float, 3>;

// One key as the file has it; tangents only mean something for CUBICSPLINE.
struct Key {
  float time = 0;
  Floats in{}, value{}, out{};
};

Vec3 wide(const Floats& f) { return Vec3(f[0], f[1], f[2]); }
Floats narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
bool finite(const Vec3& v) {
  const auto fits = [](double x) { return std::isfinite(static_cast<float>(x)); };
  return fits(v.x) && fits(v.y) && fits(v.z);
}
float just_before(float t) { return std::nextafter(t, -std::numeric_limits<float>::infinity()); }

Error bad(const std::string& what, int joint) {
  return Error{what, "translation of joint " + std::to_string(joint), ""};
}

Result<std::vector<Key>> keys_of(const Channel& channel, int joint) {
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  const std::size_t stride = cubic ? 9 : 3, count = channel.times.size();
  if (channel.path != Path::translation || channel.components != 3 || count == 0 ||
      channel.values.size() != stride * count)
    return bad("the source channel is no translation channel", joint);
  std::vector<Key> keys(count);
  for (std::size_t i = 0; i < count; ++i) {
    keys[i].time = channel.times[i];
    if (!std::isfinite(keys[i].time) || (i > 0 && keys[i].time <= keys[i - 1].time))
      return bad("the source channel's times do not increase", joint);
    const float* at = channel.values.data() + stride * i;
    const auto take = [&at](Floats& to) {
      std::copy(at, at + 3, to.begin());
      at += 3;
    };
    if (cubic) take(keys[i].in);
    take(keys[i].value);
    if (cubic) take(keys[i].out);
    if (!finite(wide(keys[i].in)) || !finite(wide(keys[i].value)) || !finite(wide(keys[i].out)))
      return bad("the source channel holds a value that is not finite", joint);
  }
  return keys;
}

// STEP as LINEAR: each value held up to the last float32 before the next key.
std::vector<Key> with_holds(const std::vector<Key>& steps) {
  std::vector<Key> keys;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i > 0 && steps[i].value != steps[i - 1].value) {
      Key hold = steps[i - 1];
      hold.time = just_before(steps[i].time);
      if (hold.time > keys.back().time) keys.push_back(hold);
    }
    keys.push_back(steps[i]);
  }
  return keys;
}

// A key at t between two others, with the curve's derivative as both its tangents: then both halves
// are the curve itself.
Key key_between(const Key& a, const Key& b, float t, bool cubic) {
  const double h = static_cast<double>(b.time) - a.time;
  const double s = (static_cast<double>(t) - a.time) / h, s2 = s * s, s3 = s2 * s;
  const Vec3 p0 = wide(a.value), p1 = wide(b.value), m0 = wide(a.out), m1 = wide(b.in);
  Key key;
  key.time = t;
  if (!cubic) {
    key.value = narrow(p0 + s * (p1 - p0));
    return key;
  }
  key.value = narrow((2 * s3 - 3 * s2 + 1) * p0 + h * (s3 - 2 * s2 + s) * m0 +
                     (3 * s2 - 2 * s3) * p1 + h * (s3 - s2) * m1);
  key.in = key.out = narrow(((6 * s2 - 6 * s) * p0 + h * (3 * s2 - 4 * s + 1) * m0 +
                             (6 * s - 6 * s2) * p1 + h * (3 * s2 - 2 * s) * m1) /
                            h);
  return key;
}

// The window's left end (`left`) or right end: the source's keys outside it, and the one there.
struct Cut {
  std::vector<Key> kept;
  Key border;
};
Cut cut_at(const std::vector<Key>& source, float t, bool cubic, bool left) {
  Cut cut;
  const auto next = std::lower_bound(source.begin(), source.end(), t,
                                     [](const Key& key, float time) { return key.time < time; });
  const bool exact = next != source.end() && next->time == t;
  if (left)
    cut.kept.assign(source.begin(), next);
  else
    cut.kept.assign(exact ? next + 1 : next, source.end());
  if (exact) {
    cut.border = *next;
  } else if (next == source.begin() || next == source.end()) {
    // Where the source clamps its value holds; tangents that nothing used before are those of a
    // rest.
    cut.border.value = next == source.begin() ? source.front().value : source.back().value;
    cut.border.time = t;
    if (left && next == source.end()) cut.kept.back().out = Floats{};
    if (!left && next == source.begin()) cut.kept.front().in = Floats{};
  } else {
    cut.border = key_between(*(next - 1), *next, t, cubic);
  }
  return cut;
}

std::optional<Error> check_keys(const TranslationKeys& keys, int joint, float begin, float end) {
  if (!std::isfinite(begin) || !std::isfinite(end) || !(begin < end))
    return bad("the window is empty", joint);
  if (keys.times.empty() || keys.values.size() != keys.times.size())
    return bad("the planned keys are none or of unequal number", joint);
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    const float t = keys.times[i];
    if (!(t >= begin && t <= end) || (i > 0 && !(t > keys.times[i - 1])))
      return bad("the planned times do not increase or leave the window", joint);
    if (!finite(keys.values[i])) return bad("a planned value is not finite", joint);
  }
  return std::nullopt;
}

}  // namespace

Result<Channel> splice_translation(const Channel* source, const Vec3& rest, int joint,
                                   float window_begin, float window_end,
                                   const TranslationKeys& keys) {
  if (auto error = check_keys(keys, joint, window_begin, window_end)) return *error;
  std::vector<Key> old;
  const bool cubic = source && source->interpolation == Interpolation::cubic_spline;
  if (source) {
    auto read = keys_of(*source, joint);
    if (!read) return read.error();
    old = source->interpolation == Interpolation::step ? with_holds(*read) : *std::move(read);
  } else {
    if (!finite(rest)) return bad("the rest translation is not finite", joint);
    Key key;
    key.time = window_begin;
    key.value = narrow(rest);
    old.push_back(key);
  }
  const Cut left = cut_at(old, window_begin, cubic, true);
  const Cut right = cut_at(old, window_end, cubic, false);

  double longest = 0;
  for (const Vec3& value : keys.values) longest = std::max(longest, glm::length(value));
  for (const Cut* cut : {&left, &right})
    longest = std::max(longest, glm::length(wide(cut->border.value)));
  std::vector<Key> inside{left.border};
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    const bool at_begin = keys.times[i] == window_begin, at_end = keys.times[i] == window_end;
    if (at_begin || at_end) {
      const Vec3 border = wide((at_begin ? left : right).border.value);
      const double off = glm::distance(keys.values[i], border);
      if (!(off <= kBorderTolerance * longest))
        return bad("the planned translation is " + std::to_string(off) +
                       " from the clip at the window's end",
                   joint);
      continue;
    }
    Key key;
    key.time = keys.times[i];
    key.value = narrow(keys.values[i]);
    inside.push_back(key);
  }
  inside.push_back(right.border);
  for (std::size_t i = 0; cubic && i + 1 < inside.size(); ++i) {
    Key &a = inside[i], &b = inside[i + 1];
    a.out = b.in = narrow((wide(b.value) - wide(a.value)) / (static_cast<double>(b.time) - a.time));
  }

  Channel result;
  result.joint = joint;
  result.path = Path::translation;
  result.interpolation = cubic ? Interpolation::cubic_spline : Interpolation::linear;
  result.components = 3;
  for (const std::vector<Key>* part :
       {&left.kept, static_cast<const std::vector<Key>*>(&inside), &right.kept})
    for (const Key& key : *part) {
      result.times.push_back(key.time);
      const auto put = [&](const Floats& f) {
        result.values.insert(result.values.end(), f.begin(), f.end());
      };
      if (cubic) put(key.in);
      put(key.value);
      if (cubic) put(key.out);
    }
  return result;
}

}  // namespace elbowroom
