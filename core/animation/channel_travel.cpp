// SPDX-License-Identifier: MIT
#include "core/animation/channel_travel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace elbowroom {
namespace {

// Up to four components at once; the unused ones are 0.
using Values = std::array<double, 4>;

double norm(const Values& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
}

double distance(const Values& a, const Values& b) {
  return norm({a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]});
}

// The components [first, first + count) of a channel, between its keys.
struct Reader {
  const Channel& channel;
  std::size_t first, count;

  bool cubic() const { return channel.interpolation == Interpolation::cubic_spline; }

  // part 0: in-tangent, 1: value, 2: out-tangent of a CUBICSPLINE key.
  Values raw(std::size_t key, std::size_t part) const {
    const auto components = static_cast<std::size_t>(channel.components);
    const std::size_t at = (cubic() ? 3 * key + part : key) * components + first;
    Values v{};
    for (std::size_t c = 0; c < count; ++c) v[c] = channel.values[at + c];
    return v;
  }
  Values value(std::size_t key) const { return raw(key, 1); }

  // Of the spline between two keys at share u of the way: value, first and second derivative by u.
  Values hermite(std::size_t key, double u, int derivative) const {
    const double h = static_cast<double>(channel.times[key + 1]) - channel.times[key];
    const Values p0 = value(key), p1 = value(key + 1), m0 = raw(key, 2), m1 = raw(key + 1, 0);
    double a, b, c, d;
    if (derivative == 0) {
      const double u2 = u * u, u3 = u2 * u;
      a = 2 * u3 - 3 * u2 + 1, b = u3 - 2 * u2 + u, c = 3 * u2 - 2 * u3, d = u3 - u2;
    } else if (derivative == 1) {
      a = 6 * u * u - 6 * u, b = 3 * u * u - 4 * u + 1, c = 6 * u - 6 * u * u,
      d = 3 * u * u - 2 * u;
    } else {
      a = 12 * u - 6, b = 6 * u - 4, c = 6 - 12 * u, d = 6 * u - 2;
    }
    Values v{};
    for (std::size_t k = 0; k < count; ++k)
      v[k] = a * p0[k] + b * h * m0[k] + c * p1[k] + d * h * m1[k];
    return v;
  }

  // The greatest |derivative by u| over [u0, u1].
  double steepest(std::size_t key, double u0, double u1) const {
    const Values at0 = hermite(key, u0, 1), at1 = hermite(key, u1, 1), bend = hermite(key, u0, 2);
    Values between{};
    for (std::size_t k = 0; k < count; ++k) between[k] = at0[k] + 0.5 * (u1 - u0) * bend[k];
    return std::max({norm(at0), norm(between), norm(at1)});
  }
};

// Calls visit(key, from, to) for the pieces of [begin, end] between neighbouring keys, in order;
// `from` and `to` are times inside the piece that starts at `key`.
template <typename Visit>
void for_pieces(const Channel& channel, double begin, double end, const Visit& visit) {
  const auto& times = channel.times;
  if (times.size() < 2) return;
  const auto after = std::upper_bound(times.begin(), times.end(), begin,
                                      [](double t, float key) { return t < key; });
  auto key = static_cast<std::size_t>(after - times.begin());
  key = key == 0 ? 0 : key - 1;
  for (; key + 1 < times.size() && static_cast<double>(times[key]) < end; ++key) {
    const double from = std::max(begin, static_cast<double>(times[key]));
    const double to = std::min(end, static_cast<double>(times[key + 1]));
    if (to > from) visit(key, from, to);
  }
}

double share(const Channel& channel, std::size_t key, double t) {
  const double h = static_cast<double>(channel.times[key + 1]) - channel.times[key];
  return std::clamp((t - channel.times[key]) / h, 0.0, 1.0);
}

// Sum of what `way(key, u0, u1)` says of the pieces before and after the middle; the larger one.
template <typename Way>
double longer_side(const Channel& channel, double begin, double end, double middle,
                   const Way& way) {
  double sides[2] = {0, 0};
  for (int side = 0; side < 2; ++side)
    for_pieces(channel, side ? middle : begin, side ? end : middle,
               [&](std::size_t key, double from, double to) {
                 sides[side] += way(key, share(channel, key, from), share(channel, key, to));
               });
  return std::max(sides[0], sides[1]);
}

// Keys that hold within [begin, end] for a STEP channel: first and one past the last.
struct Held {
  std::size_t first, last;
};
Held held(const Channel& channel, double begin, double end) {
  const auto index = [&](double t) {
    const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), t,
                                        [](double x, float key) { return x < key; });
    const auto at = static_cast<std::size_t>(after - channel.times.begin());
    return at == 0 ? 0 : at - 1;
  };
  return {index(begin), index(end) + 1};
}

Quat key_rotation(const Reader& reader, std::size_t key) {
  const Values v = reader.value(key);
  const double length = norm(v);
  return length > 0 ? Quat(v[3], v[0], v[1], v[2]) / length : Quat(1, 0, 0, 0);
}

// Accurate for small angles, where an arc cosine is not; of the two signs the nearer one counts.
double angle_of_keys(const Quat& a, const Quat& b) {
  const Quat same = a - b, opposite = a + b;
  const double chord = std::min(glm::length(same), glm::length(opposite));
  return 4 * std::asin(std::min(1.0, 0.5 * chord));
}

double travel_of(const Reader& reader, double begin, double end, double middle) {
  const Channel& channel = reader.channel;
  if (channel.times.empty() || !(begin <= middle && middle <= end)) return 0;
  if (channel.interpolation == Interpolation::step) {
    const Values from = reader.value(held(channel, middle, middle).first);
    const Held keys = held(channel, begin, end);
    double most = 0;
    for (std::size_t k = keys.first; k < keys.last; ++k)
      most = std::max(most, distance(reader.value(k), from));
    return most;
  }
  const auto at = [&](std::size_t key, double u) {
    if (reader.cubic()) return reader.hermite(key, u, 0);
    const Values a = reader.value(key), b = reader.value(key + 1);
    Values v{};
    for (std::size_t k = 0; k < reader.count; ++k) v[k] = a[k] + (b[k] - a[k]) * u;
    return v;
  };
  Values from{};
  bool known = false;
  for_pieces(channel, begin, end, [&](std::size_t key, double x0, double x1) {
    if (!known && middle >= x0 && middle <= x1) {
      from = at(key, share(channel, key, middle));
      known = true;
    }
  });
  if (!known)  // the middle lies outside the keys, where the value is that of the nearer end
    from = reader.value(middle <= channel.times.front() ? 0 : channel.times.size() - 1);
  // A piece lies in the hull of its ends and, where it bends, of its Bézier points.
  double most = 0;
  for_pieces(channel, begin, end, [&](std::size_t key, double x0, double x1) {
    const double u0 = share(channel, key, x0), u1 = share(channel, key, x1);
    const Values first = at(key, u0), last = at(key, u1);
    most = std::max({most, distance(first, from), distance(last, from)});
    if (!reader.cubic()) return;
    const Values out = reader.hermite(key, u0, 1), in = reader.hermite(key, u1, 1);
    Values after{}, before{};
    for (std::size_t k = 0; k < reader.count; ++k) {
      after[k] = first[k] + (u1 - u0) / 3 * out[k];
      before[k] = last[k] - (u1 - u0) / 3 * in[k];
    }
    most = std::max({most, distance(after, from), distance(before, from)});
  });
  return most;
}

}  // namespace

double rotation_travel(const Channel& channel, double begin, double end, double middle) {
  if (channel.times.empty() || !(begin <= middle && middle <= end)) return 0;
  const Reader reader{channel, 0, 4};
  double most = 0;
  if (channel.interpolation == Interpolation::step) {
    const Quat from = key_rotation(reader, held(channel, middle, middle).first);
    const Held keys = held(channel, begin, end);
    for (std::size_t k = keys.first; k < keys.last; ++k)
      most = std::max(most, angle_of_keys(key_rotation(reader, k), from));
  } else if (reader.cubic()) {
    most = longer_side(channel, begin, end, middle, [&](std::size_t key, double u0, double u1) {
      const double speed = reader.steepest(key, u0, u1);
      const double length = norm(reader.hermite(key, 0.5 * (u0 + u1), 0)) - 0.5 * (u1 - u0) * speed;
      // A length of 1e-9 is where normalizing begins to lose its meaning (clip.h holds the key).
      return length > 1e-9 ? 2 * speed / length * (u1 - u0) : kPi;
    });
  } else {
    most = longer_side(channel, begin, end, middle, [&](std::size_t key, double u0, double u1) {
      return angle_of_keys(key_rotation(reader, key), key_rotation(reader, key + 1)) * (u1 - u0);
    });
  }
  return std::min(most, kPi);
}

double vector_travel(const Channel& channel, double begin, double end, double middle) {
  return travel_of({channel, 0, 3}, begin, end, middle);
}

double component_travel(const Channel& channel, int component, double begin, double end,
                        double middle) {
  return travel_of({channel, static_cast<std::size_t>(component), 1}, begin, end, middle);
}

}  // namespace elbowroom
