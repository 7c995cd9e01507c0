// SPDX-License-Identifier: MIT
// DESIGN.md, "Keys": what a corrected stretch may change in a channel, and what not.
#include "core/animation/splice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/random.h"

namespace elbowroom {
namespace {

Quat random_rotation(Random& random) {
  const Vec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return quat_from_rotation_vector(2.0 * v);
}

// A channel of a moving joint: keys 0.01 to 0.5 s apart, turning up to `step` radians between keys,
// now and then with the other sign as careless exporters write it.
Channel random_channel(Random& random, Interpolation interpolation, double step) {
  Channel channel;
  channel.joint = 3;
  channel.interpolation = interpolation;
  channel.source_channel = 7;
  const int count = 1 + static_cast<int>(random.below(12));
  float time = static_cast<float>(random.uniform(0, 0.3));
  Quat q = random_rotation(random);
  const auto put = [&](const Quat& value) {
    for (const double c : {value.x, value.y, value.z, value.w}) {
      channel.values.push_back(static_cast<float>(c));
    }
  };
  const auto tangent = [&] {
    return Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                random.uniform(-1, 1)) *
           step;
  };
  for (int i = 0; i < count; ++i) {
    channel.times.push_back(time);
    time += static_cast<float>(random.uniform(0.01, 0.5));
    const bool cubic = interpolation == Interpolation::cubic_spline;
    if (cubic) put(tangent());
    put(!cubic && random.below(8) == 0 ? -q : q);
    if (cubic) put(tangent());
    q = glm::normalize(
        q * quat_from_rotation_vector(
                step * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))));
  }
  return channel;
}

// Keys over the window that leave the source and come back, at 60 Hz.
RotationKeys detour(const Channel* source, const Quat& rest, float begin, float end, double angle,
                    bool derivatives) {
  const auto curve = [&](double t) {
    const double u = (t - begin) / (static_cast<double>(end) - begin);
    const double bump = std::pow(std::sin(kPi * u), 2);
    return (source ? sample_rotation(*source, t) : rest) *
           quat_from_rotation_vector(Vec3(0, 0, angle * bump));
  };
  RotationKeys keys;
  const int count = 2 + static_cast<int>((end - begin) * 60);
  for (int i = 0; i <= count; ++i) {
    const float t = i == 0       ? begin
                    : i == count ? end
                                 : static_cast<float>(begin + (end - begin) * i / count);
    if (!keys.times.empty() && t <= keys.times.back()) continue;
    keys.times.push_back(t);
    keys.values.push_back(curve(t) * (i % 3 == 1 ? -1.0 : 1.0));
    if (derivatives) {
      const double h = 1e-5;
      Quat a = curve(std::max<double>(begin, t - h)), b = curve(std::min<double>(end, t + h));
      if (glm::dot(a, keys.values.back()) < 0) a = -a;
      if (glm::dot(b, keys.values.back()) < 0) b = -b;
      keys.derivatives.push_back((b - a) * (1 / (2 * h)));
    }
  }
  return keys;
}

int find_time(const Channel& channel, float t) {
  const auto at = std::lower_bound(channel.times.begin(), channel.times.end(), t);
  return at != channel.times.end() && *at == t ? static_cast<int>(at - channel.times.begin()) : -1;
}

const float* value_of(const Channel& channel, int key) {
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  return channel.values.data() + (cubic ? 12 * key + 4 : 4 * key);
}

void expect_well_formed(const Channel& channel) {
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  ASSERT_EQ(channel.values.size(), channel.times.size() * (cubic ? 12 : 4));
  for (std::size_t i = 1; i < channel.times.size(); ++i) {
    ASSERT_LT(channel.times[i - 1], channel.times[i]);
  }
  for (const float v : channel.values) ASSERT_TRUE(std::isfinite(v));
  for (std::size_t i = 0; i < channel.times.size(); ++i) {
    const float* v = value_of(channel, static_cast<int>(i));
    ASSERT_NEAR(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3], 1, 1e-5);
  }
}

// Everything "Keys" says of the part outside the window.
void expect_outside_kept(const Channel* source, const Quat& rest, const Channel& result,
                         float begin, float end) {
  if (source) {
    for (std::size_t i = 0; i < source->times.size(); ++i) {
      const float t = source->times[i];
      if (t >= begin && t <= end) continue;
      const int key = find_time(result, t);
      ASSERT_GE(key, 0) << "key at " << t << " lost";
      ASSERT_EQ(std::memcmp(value_of(result, key), value_of(*source, static_cast<int>(i)), 16), 0);
    }
  }
  const auto expect_same = [&](double t) {
    const Quat a = source ? sample_rotation(*source, t) : rest;
    ASSERT_LT(angle_between(a, sample_rotation(result, t)), 1e-6)
        << "at " << t << ", window " << begin << ".." << end;
  };
  const double first = std::min<double>(begin, source ? source->times.front() : begin) - 0.2;
  const double last = std::max<double>(end, source ? source->times.back() : end) + 0.2;
  for (int i = 0; i <= 200; ++i) {
    // A player's clock is float32 for the held values of STEP: no float falls on their slope.
    expect_same(static_cast<float>(first + (begin - first) * i / 200));
    expect_same(static_cast<float>(end + (last - end) * i / 200));
  }
}

Interpolation kind_of(int i) {
  return i % 3 == 0 ? Interpolation::linear
                    : (i % 3 == 1 ? Interpolation::step : Interpolation::cubic_spline);
}

TEST(Splice, KeepsTheSourceOutsideAnyWindow) {
  Random random(1);
  int refused = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    const Channel source = random_channel(random, kind_of(trial), random.uniform(0.02, 1.2));
    const float first = source.times.front(), last = source.times.back();
    float begin, end;
    if (random.below(3) == 0) {  // ends on keys
      begin = source.times[random.below(source.times.size())];
      end = source.times[random.below(source.times.size())];
      if (begin > end) std::swap(begin, end);
      if (begin == end) end += 0.25f;
    } else {
      begin = static_cast<float>(random.uniform(first - 0.4, last + 0.2));
      end = begin + static_cast<float>(random.uniform(0.001, 1.5));
    }
    const bool derivatives = random.below(2) == 0;
    const RotationKeys keys =
        detour(&source, Quat(1, 0, 0, 0), begin, end, random.uniform(-1, 1), derivatives);
    const auto result = splice_rotation(&source, Quat(1, 0, 0, 0), 3, begin, end, keys);
    if (!result) {
      // The generator's own splines may run through zero; nothing else may be refused.
      ASSERT_NE(result.error().what.find("through zero"), std::string::npos)
          << result.error().message();
      ASSERT_EQ(source.interpolation, Interpolation::cubic_spline);
      ++refused;
      continue;
    }
    ASSERT_EQ(result->interpolation, spliced_interpolation(&source, derivatives));
    ASSERT_EQ(result->source_channel, -1);
    ASSERT_NO_FATAL_FAILURE(expect_well_formed(*result));
    ASSERT_NO_FATAL_FAILURE(expect_outside_kept(&source, Quat(1, 0, 0, 0), *result, begin, end));
    for (std::size_t i = 0; i < keys.times.size(); ++i) {
      ASSERT_LT(
          angle_between(sample_rotation(*result, keys.times[i]), glm::normalize(keys.values[i])),
          keys.times[i] == begin || keys.times[i] == end ? kBorderTolerance : 1e-6);
    }
  }
  EXPECT_LT(refused, 10);
}

TEST(Splice, StaysInTheWindowsHemisphere) {
  Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    Channel source = random_channel(random, kind_of(trial), 0.3);
    const float begin = source.times.front(), end = begin + 0.7f;
    const auto keys = detour(&source, Quat(1, 0, 0, 0), begin, end, 0.5, true);
    const auto result = splice_rotation(&source, Quat(1, 0, 0, 0), 3, begin, end, keys);
    if (!result) continue;
    for (std::size_t i = 1; i < result->times.size(); ++i) {
      if (result->times[i] <= begin || result->times[i] >= end) continue;
      if (source.interpolation == Interpolation::step) continue;  // may jump anywhere
      const float *a = value_of(*result, static_cast<int>(i) - 1),
                  *b = value_of(*result, static_cast<int>(i));
      if (result->times[i] == std::nextafter(end, -1e9f)) continue;
      EXPECT_GT(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3], 0);
    }
  }
}

TEST(Splice, GivesAnUnkeyedJointAChannelThatRestsOutside) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Quat rest = random_rotation(random);
    const float begin = static_cast<float>(random.uniform(0, 1)), end = begin + 0.8f;
    const bool derivatives = trial % 2 == 0;
    const auto keys = detour(nullptr, rest, begin, end, 0.7, derivatives);
    const auto result = splice_rotation(nullptr, rest, 5, begin, end, keys);
    ASSERT_TRUE(result.ok()) << result.error().message();
    EXPECT_EQ(result->joint, 5);
    EXPECT_EQ(result->interpolation,
              derivatives ? Interpolation::cubic_spline : Interpolation::linear);
    expect_well_formed(*result);
    expect_outside_kept(nullptr, rest, *result, begin, end);
    EXPECT_EQ(result->times.front(), begin);
    EXPECT_EQ(result->times.back(), end);
  }
}

TEST(Splice, CanBeSplicedAgain) {
  Random random(4);
  int spliced = 0;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE(trial);
    const Channel source = random_channel(random, kind_of(trial), 0.5);
    const float a = source.times.front() + 0.1f, b = a + 0.3f, c = a + 0.15f + 0.3f * (trial % 2),
                d = c + 0.4f;
    const auto once = splice_rotation(&source, Quat(1, 0, 0, 0), 3, a, b,
                                      detour(&source, Quat(1, 0, 0, 0), a, b, 0.4, true));
    if (!once) continue;
    const auto keys = detour(&*once, Quat(1, 0, 0, 0), c, d, -0.4, true);
    const auto twice = splice_rotation(&*once, Quat(1, 0, 0, 0), 3, c, d, keys);
    if (!twice) continue;
    ++spliced;
    ASSERT_NO_FATAL_FAILURE(expect_well_formed(*twice));
    ASSERT_NO_FATAL_FAILURE(expect_outside_kept(&*once, Quat(1, 0, 0, 0), *twice, c, d));
  }
  EXPECT_GT(spliced, 590);
}

// A planned path that winds once round its joint ends on the other sign.
TEST(Splice, WindsOnceRoundWithoutASwing) {
  for (const Interpolation interpolation :
       {Interpolation::linear, Interpolation::step, Interpolation::cubic_spline}) {
    Channel source;
    source.joint = 0;
    source.interpolation = interpolation;
    for (int i = 0; i < 5; ++i) {
      source.times.push_back(static_cast<float>(i));
      if (interpolation == Interpolation::cubic_spline)
        source.values.insert(source.values.end(), 4, 0);
      for (const float v : {0.f, 0.f, 0.f, 1.f}) source.values.push_back(v);
      if (interpolation == Interpolation::cubic_spline)
        source.values.insert(source.values.end(), 4, 0);
    }
    RotationKeys keys;
    for (int i = 0; i <= 100; ++i) {
      keys.times.push_back(1.5f + 0.01f * static_cast<float>(i));
      const double angle = kPi * i / 100;
      keys.values.push_back(Quat(std::cos(angle), 0, 0, std::sin(angle)));
      keys.derivatives.push_back(Quat(-std::sin(angle), 0, 0, std::cos(angle)) * kPi);
    }
    const auto result =
        splice_rotation(&source, Quat(1, 0, 0, 0), 0, 1.5f, keys.times.back(), keys);
    ASSERT_TRUE(result.ok()) << result.error().message();
    expect_well_formed(*result);
    expect_outside_kept(&source, Quat(1, 0, 0, 0), *result, 1.5f, keys.times.back());
    for (int i = 0; i <= 5000; ++i) {
      const double u = std::min(1.0, i / 5000.0);
      const double t = 1.5 + u * (static_cast<double>(keys.times.back()) - 1.5);
      const Quat expected = quat_from_rotation_vector(Vec3(0, 0, 2 * kPi * u));
      ASSERT_LT(angle_between(sample_rotation(*result, t), expected), 1e-4) << t;
    }
  }
}

TEST(Splice, MeetsTheClipsVelocityWhereItIsASpline) {
  Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const Channel source = random_channel(random, Interpolation::cubic_spline, 0.6);
    if (source.times.size() < 3) continue;
    const float begin = static_cast<float>(
                    random.uniform(source.times.front() + 0.001, source.times.back() - 0.002)),
                end =
                    static_cast<float>(random.uniform(begin + 0.001, source.times.back() - 0.0005));
    RotationKeys keys;  // no key at the ends: the source's own derivative stands there
    keys.times = {std::nextafter((begin + end) / 2, end)};
    keys.values = {sample_rotation(source, keys.times[0])};
    keys.derivatives = {Quat(0, 0, 0, 0)};
    const auto result = splice_rotation(&source, Quat(1, 0, 0, 0), 3, begin, end, keys);
    if (!result) continue;
    for (const double t : {static_cast<double>(begin), static_cast<double>(end)}) {
      const double h = 1e-5;
      const Vec3 before =
          rotation_vector_from_quat(glm::conjugate(sample_rotation(*result, t - h)) *
                                    sample_rotation(*result, t)) /
          h;
      const Vec3 after = rotation_vector_from_quat(glm::conjugate(sample_rotation(*result, t)) *
                                                   sample_rotation(*result, t + h)) /
                         h;
      // Second differences of random splines are large; a lost tangent is of the order of 1.
      const double bound =
          0.02 * (1 + glm::length(before)) + 40 * h / (end - begin) / (end - begin);
      EXPECT_LT(glm::length(before - after), bound) << trial << " at " << t;
    }
  }
}

TEST(Splice, RefusesWhatIsNoMotion) {
  Random random(5);
  const Channel source = random_channel(random, Interpolation::linear, 0.2);
  const Quat rest(1, 0, 0, 0);
  const float begin = source.times.front(), end = begin + 0.5f;
  const RotationKeys good = detour(&source, rest, begin, end, 0.2, true);
  ASSERT_TRUE(splice_rotation(&source, rest, 3, begin, end, good).ok());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();

  EXPECT_FALSE(splice_rotation(&source, rest, 3, end, begin, good).ok());
  EXPECT_FALSE(splice_rotation(&source, rest, 3, begin, begin, good).ok());
  EXPECT_FALSE(splice_rotation(&source, rest, 3, nan, end, good).ok());
  EXPECT_FALSE(splice_rotation(&source, rest, 3, begin, inf, good).ok());
  EXPECT_FALSE(splice_rotation(&source, rest, 3, begin, end, RotationKeys{}).ok());

  const auto refused = [&](auto change) {
    RotationKeys keys = good;
    change(keys);
    return !splice_rotation(&source, rest, 3, begin, end, keys).ok();
  };
  EXPECT_TRUE(refused([&](RotationKeys& k) { k.times[2] = nan; }));
  EXPECT_TRUE(refused([&](RotationKeys& k) { k.times[2] = k.times[1]; }));
  EXPECT_TRUE(refused([&](RotationKeys& k) { k.times.back() = end + 0.1f; }));
  EXPECT_TRUE(refused([&](RotationKeys& k) { k.values[1] = Quat(0, 0, 0, 0); }));
  EXPECT_TRUE(refused([&](RotationKeys& k) { k.values[1].x = nan; }));
  EXPECT_TRUE(refused([&](RotationKeys& k) { k.values.pop_back(); }));
  EXPECT_TRUE(refused([&](RotationKeys& k) { k.derivatives.pop_back(); }));
  EXPECT_TRUE(refused([&](RotationKeys& k) { k.derivatives[1].w = inf; }));
  EXPECT_TRUE(refused([&](RotationKeys& k) {
    k.values[0] = k.values[0] * quat_from_rotation_vector(Vec3(2e-4, 0, 0));
  }));

  Channel broken = source;
  broken.values.pop_back();
  EXPECT_FALSE(splice_rotation(&broken, rest, 3, begin, end, good).ok());
  broken = source;
  broken.values[0] = nan;
  EXPECT_FALSE(splice_rotation(&broken, rest, 3, begin, end, good).ok());
  broken = source;
  broken.path = Path::translation;
  EXPECT_FALSE(splice_rotation(&broken, rest, 3, begin, end, good).ok());
  broken = source;
  broken.times.clear();
  broken.values.clear();
  EXPECT_FALSE(splice_rotation(&broken, rest, 3, begin, end, good).ok());
  EXPECT_FALSE(splice_rotation(nullptr, Quat(0, 0, 0, 0), 3, begin, end, good).ok());
}

TEST(Splice, ReplacesAndAddsChannelsOfAClip) {
  Random random(8);
  Clip clip;
  clip.source_animation = 2;
  clip.channels = {random_channel(random, Interpolation::linear, 0.2),
                   random_channel(random, Interpolation::linear, 0.2)};
  clip.channels[1].joint = 9;
  clip.begin = 0;
  clip.end = 1;
  Channel changed = random_channel(random, Interpolation::linear, 0.1), added = changed;
  changed.joint = 9;
  added.joint = 4;
  added.times.back() += 100;
  const Clip result = apply_splices(clip, {changed, added});
  ASSERT_EQ(result.channels.size(), 3u);
  EXPECT_EQ(result.channels[0].source_channel, 7);
  EXPECT_EQ(result.channels[0].times, clip.channels[0].times);
  EXPECT_EQ(result.channels[1].source_channel, -1);
  EXPECT_EQ(result.channels[1].times, changed.times);
  EXPECT_EQ(result.channels[2].joint, 4);
  EXPECT_EQ(result.source_animation, 2);
  EXPECT_EQ(result.end, added.times.back());
}

}  // namespace
}  // namespace elbowroom
