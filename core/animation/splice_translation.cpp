// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/animation/channel_keys.h"
#include "core/animation/splice.h"

namespace elbowroom {
namespace {

using Floats = std::array<float, 3>;

using Key = channel_keys::Key<3>;
using Keys = channel_keys::Keys<3>;

Vec3 wide(const Floats& f) { return Vec3(f[0], f[1], f[2]); }
Floats narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
bool finite(const Vec3& v) {
  const auto fits = [](double x) { return std::isfinite(static_cast<float>(x)); };
  return fits(v.x) && fits(v.y) && fits(v.z);
}

Error bad(const std::string& what, int joint) {
  return channel_keys::bad(Path::translation, joint, what);
}

Result<Keys> keys_of(const Channel& channel, int joint) {
  const auto is_finite = [](const Key& key) {
    return finite(wide(key.in)) && finite(wide(key.value)) && finite(wide(key.out));
  };
  return channel_keys::read<3>(channel, Path::translation, joint, is_finite,
                               "the source channel holds a value that is not finite");
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
  Keys kept;
  Key border;
};
Cut cut_at(const Keys& source, float t, bool cubic, bool left) {
  auto side = channel_keys::side_of(source, t, left);
  Cut cut;
  cut.kept = std::move(side.kept);
  if (side.exact) {
    cut.border = *side.next;
  } else if (side.clamped) {
    cut.border.value = (side.next == source.begin() ? source.front() : source.back()).value;
    cut.border.time = t;
  } else {
    cut.border = key_between(*(side.next - 1), *side.next, t, cubic);
  }
  return cut;
}

Status check_keys(const TranslationKeys& keys, int joint, float begin, float end) {
  if (Status times = channel_keys::check_times(Path::translation, joint, keys.times, begin, end);
      !times)
    return times;
  if (keys.values.size() != keys.times.size())
    return bad("the planned keys are none or of unequal number", joint);
  for (const Vec3& value : keys.values)
    if (!finite(value)) return bad("a planned value is not finite", joint);
  return Done{};
}

}  // namespace

Result<Channel> splice_translation(const Channel* source, const Vec3& rest, int joint,
                                   float window_begin, float window_end,
                                   const TranslationKeys& keys) {
  if (Status checked = check_keys(keys, joint, window_begin, window_end); !checked)
    return checked.error();
  Keys old;
  const bool cubic = source && source->interpolation == Interpolation::cubic_spline;
  if (source) {
    auto read = keys_of(*source, joint);
    if (!read) return read.error();
    old = *std::move(read);
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
  Keys inside{left.border};
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

  return channel_keys::channel_of<3>(Path::translation, joint,
                                     cubic ? Interpolation::cubic_spline : Interpolation::linear,
                                     {&left.kept, &inside, &right.kept});
}

}  // namespace elbowroom
