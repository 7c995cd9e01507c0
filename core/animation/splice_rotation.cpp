// SPDX-License-Identifier: MIT
// Splices of rotations: cubic segments that are cut, quaternions' signs.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/animation/channel_keys.h"
#include "core/animation/splice.h"

namespace elbowroom {
namespace {

using Vec4 = glm::dvec4;  // x, y, z, w, as in the file
using Floats = std::array<float, 4>;

using Key = channel_keys::Key<4>;
using Keys = channel_keys::Keys<4>;
using channel_keys::just_before;

Vec4 wide(const Floats& f) { return Vec4(f[0], f[1], f[2], f[3]); }
Vec4 wide(const Quat& q) { return Vec4(q.x, q.y, q.z, q.w); }
Floats narrow(const Vec4& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
          static_cast<float>(v.w)};
}
Quat quat(const Vec4& v) { return glm::normalize(Quat(v.w, v.x, v.y, v.z)); }
Floats negated(const Floats& f) { return {-f[0], -f[1], -f[2], -f[3]}; }
bool finite(const Vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

// One Hermite segment as glTF 2.0 Appendix C has it, before normalization.
struct Segment {
  double begin, end;
  Vec4 value0, tangent0, value1, tangent1;

  Segment(const Key& a, const Key& b)
      : begin(a.time),
        end(b.time),
        value0(wide(a.value)),
        tangent0(wide(a.out)),
        value1(wide(b.value)),
        tangent1(wide(b.in)) {}

  Vec4 at(double t) const {
    const double h = end - begin, s = (t - begin) / h, s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * value0 + h * (s3 - 2 * s2 + s) * tangent0 +
           (3 * s2 - 2 * s3) * value1 + h * (s3 - s2) * tangent1;
  }
  Vec4 derivative_at(double t) const {
    const double h = end - begin, s = (t - begin) / h, s2 = s * s;
    return ((6 * s2 - 6 * s) * value0 + h * (3 * s2 - 4 * s + 1) * tangent0 +
            (6 * s - 6 * s2) * value1 + h * (3 * s2 - 2 * s) * tangent1) /
           h;
  }
  // d/dt of at(t) / |at(t)|.
  Vec4 unit_derivative_at(double t) const {
    const Vec4 p = at(t), d = derivative_at(t);
    const double length = glm::length(p);
    const Vec4 unit = p / length;
    return (d - unit * glm::dot(unit, d)) / length;
  }
};

// Largest angle between the normalized curves of `source` and of the keys `from`..`to`, sampled.
double difference(const Segment& source, const Keys& keys) {
  constexpr int kSamples = 16;
  double worst = 0;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    const Segment piece(keys[i], keys[i + 1]);
    for (int j = 0; j <= kSamples; ++j) {
      const double t = piece.begin + (piece.end - piece.begin) * j / kSamples;
      const Vec4 a = source.at(t), b = piece.at(t);
      const double lengths = glm::length(a) * glm::length(b);
      if (!(lengths > 1e-12)) return std::numeric_limits<double>::infinity();
      worst = std::fmax(worst, angle_between(quat(a), quat(b)));
    }
  }
  return worst;
}

// Keys that show the part [first.time, last.time] of `source`. The value of the key that is the
// source's own keeps its bits (`keep_first` or the last one's); the other one's is set, as are
// first.out and last.in.
Keys cover(const Segment& source, Key first, Key last, bool keep_first) {
  const auto set_key = [&](Key& key, bool keep_value) {
    // A kept value may be off unit length a little; the derivative of what is normalized is right
    // if it is scaled alike.
    if (!keep_value) key.value = narrow(glm::normalize(source.at(key.time)));
    return narrow(source.unit_derivative_at(key.time) * glm::length(wide(key.value)));
  };
  // Keys in float32 cost about 2e-7 rad by themselves.
  constexpr double kEnough = 4e-7;
  for (int pieces = 1; pieces <= 128; pieces *= 2) {
    Keys keys;
    for (int i = 0; i <= pieces; ++i) {
      Key key = i == 0 ? first : last;
      if (i > 0 && i < pieces) {
        key = Key{};
        key.time = static_cast<float>(first.time +
                                      (static_cast<double>(last.time) - first.time) * i / pieces);
        if (key.time <= keys.back().time || key.time >= last.time) continue;
      }
      const bool keep = i == 0 ? keep_first : (i == pieces && !keep_first);
      const Floats tangent = set_key(key, keep);
      if (i > 0) key.in = tangent;
      if (i < pieces) key.out = tangent;
      keys.push_back(key);
    }
    if (difference(source, keys) <= kEnough) return keys;
  }
  // Curves that run close to zero: the cut cubic itself, whose cut end is not unit, is exact.
  first.out = narrow(source.derivative_at(first.time));
  last.in = narrow(source.derivative_at(last.time));
  if (!keep_first) first.value = narrow(source.at(first.time));
  if (keep_first) last.value = narrow(source.at(last.time));
  return {first, last};
}

Error bad(const std::string& what, int joint, const std::string& remedy = "") {
  return channel_keys::bad(Path::rotation, joint, what, remedy);
}

Result<Keys> keys_of(const Channel& channel, int joint) {
  const auto is_rotation = [](const Key& key) {
    const double length = glm::length(wide(key.value));
    return finite(wide(key.in)) && finite(wide(key.out)) && std::isfinite(length) && length > 1e-6;
  };
  return channel_keys::read<4>(channel, Path::rotation, joint, is_rotation,
                               "the source channel holds a value that is no rotation");
}

// What stands left and right of a cut at `t`: for the left end of the window `keys` are those up to
// the cut and border is the last of them.
struct Cut {
  Keys kept;  // source keys outside the window, and those `cover` has put in
  Key border;
  Vec4 derivative{0.0};  // of the unit source at the cut, on the window's side if it is a key
  bool through_zero = false;
};

// The window's left end (`left`) or right end.
Cut cut_at(const Keys& source, float t, bool cubic, bool left) {
  auto side = channel_keys::side_of(source, t, left);
  const auto next = side.next;
  Cut cut;
  cut.kept = std::move(side.kept);
  if (side.exact) {
    cut.border = *next;
    if (cubic && left && next + 1 != source.end()) {
      cut.derivative = Segment(*next, *(next + 1)).unit_derivative_at(t);
    } else if (cubic && !left && next != source.begin()) {
      cut.derivative = Segment(*(next - 1), *next).unit_derivative_at(t);
    }
    return cut;
  }
  if (side.clamped) {
    cut.border.value = (next == source.begin() ? source.front() : source.back()).value;
    cut.border.time = t;
    return cut;
  }
  const Key &a = *(next - 1), &b = *next;
  cut.border.time = t;
  if (!cubic) {
    const double u = (static_cast<double>(t) - a.time) / (static_cast<double>(b.time) - a.time);
    // Slerp from the kept side, so that the border's sign is that of the key it is joined to.
    const Quat from = quat(wide(left ? a.value : b.value)),
               to = quat(wide(left ? b.value : a.value));
    cut.border.value = narrow(wide(slerp_shortest(from, to, left ? u : 1 - u)));
    return cut;
  }
  const Segment segment(a, b);
  cut.through_zero = !(glm::length(segment.at(t)) > 1e-3);
  if (cut.through_zero) return cut;
  cut.derivative = segment.unit_derivative_at(t);
  if (left) {
    const Keys part = cover(segment, a, cut.border, true);
    cut.kept.pop_back();
    cut.kept.insert(cut.kept.end(), part.begin(), part.end() - 1);
    cut.border = part.back();
  } else {
    const Keys part = cover(segment, cut.border, b, false);
    cut.border = part.front();
    Keys kept(part.begin() + 1, part.end());
    kept.insert(kept.end(), cut.kept.begin() + 1, cut.kept.end());
    cut.kept = std::move(kept);
  }
  return cut;
}

Status check_keys(const RotationKeys& keys, int joint, float begin, float end) {
  if (Status times = channel_keys::check_times(Path::rotation, joint, keys.times, begin, end);
      !times)
    return times;
  if (keys.values.size() != keys.times.size() ||
      (!keys.derivatives.empty() && keys.derivatives.size() != keys.times.size()))
    return bad("the planned keys are none or of unequal number", joint);
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    const double length = glm::length(wide(keys.values[i]));
    if (!finite(wide(keys.values[i])) || !(length > 1e-6) || !std::isfinite(length) ||
        (!keys.derivatives.empty() && !finite(wide(keys.derivatives[i]))))
      return bad("a planned value is no rotation", joint);
  }
  return Done{};
}

}  // namespace

Interpolation spliced_interpolation(const Channel* source, bool with_derivatives) {
  const bool cubic =
      source ? source->interpolation == Interpolation::cubic_spline : with_derivatives;
  return cubic ? Interpolation::cubic_spline : Interpolation::linear;
}

Result<Channel> splice_rotation(const Channel* source, const Quat& rest, int joint,
                                float window_begin, float window_end, const RotationKeys& keys) {
  if (Status checked = check_keys(keys, joint, window_begin, window_end); !checked)
    return checked.error();
  const bool derivatives = !keys.derivatives.empty();
  const Interpolation interpolation = spliced_interpolation(source, derivatives);
  const bool cubic = interpolation == Interpolation::cubic_spline;

  Keys old;
  if (source) {
    auto read = keys_of(*source, joint);
    if (!read) return read.error();
    old = *std::move(read);
  } else {
    const Vec4 value = wide(rest);
    if (!finite(value) || !(glm::length(value) > 1e-6)) {
      return bad("the rest rotation is no rotation", joint);
    }
    Key key;
    key.time = window_begin;
    key.value = narrow(glm::normalize(value));
    old.push_back(key);
  }

  Cut left = cut_at(old, window_begin, cubic, true);
  Cut right = cut_at(old, window_end, cubic, false);
  if (left.through_zero || right.through_zero) {
    return bad("the clip's spline passes through zero at the window's end", joint,
               "move that end of the window");
  }

  // The window's keys, from border to border, signs following one another from the left.
  Keys inside{left.border};
  inside.front().out = narrow(left.derivative);
  Vec4 in_at_end = right.derivative;
  const auto follow = [&](const Vec4& value) {
    return glm::dot(value, wide(inside.back().value)) < 0 ? -1.0 : 1.0;
  };
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    Vec4 value = glm::normalize(wide(keys.values[i]));
    Vec4 derivative = derivatives ? wide(keys.derivatives[i]) : Vec4(0.0);
    const bool at_begin = keys.times[i] == window_begin, at_end = keys.times[i] == window_end;
    if (at_begin || at_end) {
      const Floats& border = at_begin ? left.border.value : right.border.value;
      const double off = angle_between(quat(value), quat(wide(border)));
      if (!(off < kBorderTolerance)) {
        return bad("the planned rotation is " + std::to_string(off) +
                       " rad from the clip at the window's end",
                   joint);
      }
      const double sign = glm::dot(value, wide(border)) < 0 ? -1.0 : 1.0;
      if (derivatives && at_begin) inside.front().out = narrow(sign * derivative);
      if (derivatives && at_end) in_at_end = sign * derivative;
      continue;
    }
    const double sign = follow(value);
    Key key;
    key.time = keys.times[i];
    key.value = narrow(sign * value);
    key.in = key.out = narrow(sign * derivative);
    inside.push_back(key);
  }

  Key border = right.border;
  border.in = narrow(in_at_end);
  if (follow(wide(border.value)) < 0) {
    if (right.kept.empty()) {
      border.value = negated(border.value);
      border.in = negated(border.in);
      border.out = negated(border.out);
    } else {
      // Without tangents the curve between the two signs stays on the line through zero, so it is
      // the same rotation all the way.
      Key turn = border;
      turn.time = just_before(window_end);
      turn.value = negated(border.value);
      turn.in = negated(border.in);
      turn.out = Floats{};
      border.in = Floats{};
      if (turn.time > inside.back().time) {
        inside.push_back(turn);
      } else {
        inside.back().out = Floats{};
      }
    }
  }
  inside.push_back(border);
  if (cubic && !derivatives) {
    for (std::size_t i = 0; i + 1 < inside.size(); ++i) {
      Key &a = inside[i], &b = inside[i + 1];
      const Vec4 chord = (wide(b.value) - wide(a.value)) / (static_cast<double>(b.time) - a.time);
      a.out = b.in = narrow(glm::dot(wide(a.value), wide(b.value)) < 0 ? Vec4(0.0) : chord);
    }
  }

  return channel_keys::channel_of<4>(Path::rotation, joint, interpolation,
                                     {&left.kept, &inside, &right.kept});
}

}  // namespace elbowroom
