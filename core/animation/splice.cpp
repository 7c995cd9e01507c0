// SPDX-License-Identifier: MIT
#include "core/animation/splice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace elbowroom {
namespace {

using Vec4 = glm::dvec4;  // x, y, z, w, as in the file
using Floats = std::array<float, 4>;

// One key as the file has it; tangents only mean something for CUBICSPLINE.
struct Key {
  float time = 0;
  Floats in{}, value{}, out{};
};

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
float just_before(float t) { return std::nextafter(t, -std::numeric_limits<float>::infinity()); }

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
double difference(const Segment& source, const std::vector<Key>& keys) {
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
std::vector<Key> cover(const Segment& source, Key first, Key last, bool keep_first) {
  const auto set_key = [&](Key& key, bool keep_value) {
    // A kept value may be off unit length a little; the derivative of what is normalized is right
    // if it is scaled alike.
    if (!keep_value) key.value = narrow(glm::normalize(source.at(key.time)));
    return narrow(source.unit_derivative_at(key.time) * glm::length(wide(key.value)));
  };
  // Keys in float32 cost about 2e-7 rad by themselves.
  constexpr double kEnough = 4e-7;
  for (int pieces = 1; pieces <= 128; pieces *= 2) {
    std::vector<Key> keys;
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

Error bad(const std::string& what, int joint, const std::string& remedy = "") {
  return Error{what, "rotation of joint " + std::to_string(joint), remedy};
}

Result<std::vector<Key>> keys_of(const Channel& channel, int joint) {
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  const std::size_t stride = cubic ? 12 : 4, count = channel.times.size();
  if (channel.path != Path::rotation || channel.components != 4 || count == 0 ||
      channel.values.size() != stride * count) {
    return bad("the source channel is no rotation channel", joint);
  }
  std::vector<Key> keys(count);
  for (std::size_t i = 0; i < count; ++i) {
    keys[i].time = channel.times[i];
    if (!std::isfinite(keys[i].time) || (i > 0 && keys[i].time <= keys[i - 1].time)) {
      return bad("the source channel's times do not increase", joint);
    }
    const float* at = channel.values.data() + stride * i;
    const auto take = [&at](Floats& to) {
      std::copy(at, at + 4, to.begin());
      at += 4;
    };
    if (cubic) take(keys[i].in);
    take(keys[i].value);
    if (cubic) take(keys[i].out);
    const double length = glm::length(wide(keys[i].value));
    if (!finite(wide(keys[i].in)) || !finite(wide(keys[i].out)) || !std::isfinite(length) ||
        !(length > 1e-6)) {
      return bad("the source channel holds a value that is no rotation", joint);
    }
  }
  return keys;
}

// What stands left and right of a cut at `t`: for the left end of the window `keys` are those up to
// the cut and border is the last of them.
struct Cut {
  std::vector<Key> kept;  // source keys outside the window, and those `cover` has put in
  Key border;
  Vec4 derivative{0.0};  // of the unit source at the cut, on the window's side if it is a key
  bool through_zero = false;
};

// The window's left end (`left`) or right end.
Cut cut_at(const std::vector<Key>& source, float t, bool cubic, bool left) {
  Cut cut;
  const auto next = std::lower_bound(source.begin(), source.end(), t,
                                     [](const Key& key, float time) { return key.time < time; });
  const bool exact = next != source.end() && next->time == t;
  if (left) {
    cut.kept.assign(source.begin(), next);
  } else {
    cut.kept.assign(exact ? next + 1 : next, source.end());
  }
  if (exact) {
    cut.border = *next;
    if (cubic && left && next + 1 != source.end()) {
      cut.derivative = Segment(*next, *(next + 1)).unit_derivative_at(t);
    } else if (cubic && !left && next != source.begin()) {
      cut.derivative = Segment(*(next - 1), *next).unit_derivative_at(t);
    }
    return cut;
  }
  if (next == source.begin() || next == source.end()) {
    // Where the source clamps its value holds; the tangents towards the clamped side, which nothing
    // used before, become those of a rest.
    const Key& held = next == source.begin() ? source.front() : source.back();
    cut.border.value = held.value;
    if (left && next == source.end()) cut.kept.back().out = Floats{};
    if (!left && next == source.begin()) cut.kept.front().in = Floats{};
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
    const std::vector<Key> part = cover(segment, a, cut.border, true);
    cut.kept.pop_back();
    cut.kept.insert(cut.kept.end(), part.begin(), part.end() - 1);
    cut.border = part.back();
  } else {
    const std::vector<Key> part = cover(segment, cut.border, b, false);
    cut.border = part.front();
    std::vector<Key> kept(part.begin() + 1, part.end());
    kept.insert(kept.end(), cut.kept.begin() + 1, cut.kept.end());
    cut.kept = std::move(kept);
  }
  return cut;
}

std::optional<Error> check_keys(const RotationKeys& keys, int joint, float begin, float end) {
  if (!std::isfinite(begin) || !std::isfinite(end) || !(begin < end)) {
    return bad("the window is empty", joint);
  }
  if (keys.times.empty() || keys.values.size() != keys.times.size() ||
      (!keys.derivatives.empty() && keys.derivatives.size() != keys.times.size())) {
    return bad("the planned keys are none or of unequal number", joint);
  }
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    const float t = keys.times[i];
    if (!(t >= begin && t <= end) || (i > 0 && !(t > keys.times[i - 1]))) {
      return bad("the planned times do not increase or leave the window", joint);
    }
    const double length = glm::length(wide(keys.values[i]));
    if (!finite(wide(keys.values[i])) || !(length > 1e-6) || !std::isfinite(length) ||
        (!keys.derivatives.empty() && !finite(wide(keys.derivatives[i])))) {
      return bad("a planned value is no rotation", joint);
    }
  }
  return std::nullopt;
}

}  // namespace

Interpolation spliced_interpolation(const Channel* source, bool with_derivatives) {
  const bool cubic =
      source ? source->interpolation == Interpolation::cubic_spline : with_derivatives;
  return cubic ? Interpolation::cubic_spline : Interpolation::linear;
}

Result<Channel> splice_rotation(const Channel* source, const Quat& rest, int joint,
                                float window_begin, float window_end, const RotationKeys& keys) {
  if (auto error = check_keys(keys, joint, window_begin, window_end)) return *error;
  const bool derivatives = !keys.derivatives.empty();
  const Interpolation interpolation = spliced_interpolation(source, derivatives);
  const bool cubic = interpolation == Interpolation::cubic_spline;

  std::vector<Key> old;
  if (source) {
    auto read = keys_of(*source, joint);
    if (!read) return read.error();
    old = source->interpolation == Interpolation::step ? with_holds(*read) : *std::move(read);
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
  std::vector<Key> inside{left.border};
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

  Channel result;
  result.joint = joint;
  result.path = Path::rotation;
  result.interpolation = interpolation;
  result.components = 4;
  const auto append = [&](const std::vector<Key>& part) {
    for (const Key& key : part) {
      result.times.push_back(key.time);
      const auto put = [&](const Floats& f) {
        result.values.insert(result.values.end(), f.begin(), f.end());
      };
      if (cubic) put(key.in);
      put(key.value);
      if (cubic) put(key.out);
    }
  };
  append(left.kept);
  append(inside);
  append(right.kept);
  return result;
}

Clip apply_splices(const Clip& clip, const std::vector<Channel>& spliced) {
  Clip result = clip;
  for (const Channel& channel : spliced) {
    const auto same = std::find_if(
        result.channels.begin(), result.channels.end(),
        [&](const Channel& c) { return c.joint == channel.joint && c.path == channel.path; });
    Channel& place = same != result.channels.end() ? *same : result.channels.emplace_back();
    place = channel;
    place.source_channel = -1;
    if (channel.times.empty()) continue;
    const bool first = clip.channels.empty() && result.channels.size() == 1;
    const double begin = channel.times.front(), end = channel.times.back();
    result.begin = first ? begin : std::fmin(result.begin, begin);
    result.end = first ? end : std::fmax(result.end, end);
  }
  return result;
}

}  // namespace elbowroom
