// SPDX-License-Identifier: MIT
// DESIGN.md, "Keys", of translations: the joints that follow a limb from elsewhere in the tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/animation/splice.h"
#include "core/base/random.h"

namespace elbowroom {
namespace {

constexpr Interpolation kKinds[] = {Interpolation::linear, Interpolation::step,
                                    Interpolation::cubic_spline};

Channel random_channel(Random& random, Interpolation interpolation) {
  Channel channel;
  channel.joint = 3;
  channel.path = Path::translation;
  channel.components = 3;
  channel.interpolation = interpolation;
  channel.source_channel = 7;
  float time = static_cast<float>(random.uniform(0, 0.3));
  const auto put = [&](double size) {
    for (int k = 0; k < 3; ++k)
      channel.values.push_back(static_cast<float>(random.uniform(-size, size)));
  };
  const int count = 1 + static_cast<int>(random.below(12));
  for (int i = 0; i < count; ++i) {
    channel.times.push_back(time);
    time += static_cast<float>(random.uniform(0.01, 0.5));
    const bool cubic = interpolation == Interpolation::cubic_spline;
    if (cubic) put(4);
    put(1);
    if (cubic) put(4);
  }
  return channel;
}

Vec3 value_at(const Channel* channel, const Vec3& rest, double t) {
  return channel ? sample_vector(*channel, t) : rest;
}

// Away from the source and back.
TranslationKeys detour(const Channel* source, const Vec3& rest, float begin, float end) {
  TranslationKeys keys;
  const int count = 2 + static_cast<int>((end - begin) * 60);
  for (int i = 0; i <= count; ++i) {
    const float t = i == 0       ? begin
                    : i == count ? end
                                 : static_cast<float>(begin + (end - begin) * i / count);
    if (!keys.times.empty() && t <= keys.times.back()) continue;
    const double u = (static_cast<double>(t) - begin) / (static_cast<double>(end) - begin);
    keys.times.push_back(t);
    keys.values.push_back(value_at(source, rest, static_cast<double>(t)) +
                          Vec3(0, 0, 0.3 * std::pow(std::sin(kPi * u), 2)));
  }
  return keys;
}

const float* value_of(const Channel& channel, std::size_t key) {
  return channel.values.data() +
         (channel.interpolation == Interpolation::cubic_spline ? 9 * key + 3 : 3 * key);
}

void expect_spliced(const Channel* source, const Vec3& rest, const Channel& result, float begin,
                    float end, const TranslationKeys& keys) {
  ASSERT_EQ(result.path, Path::translation);
  ASSERT_EQ(result.components, 3);
  ASSERT_EQ(result.source_channel, -1);
  for (std::size_t i = 1; i < result.times.size(); ++i)
    ASSERT_LT(result.times[i - 1], result.times[i]);
  const auto find = [&](float t) {
    const auto at = std::lower_bound(result.times.begin(), result.times.end(), t);
    EXPECT_TRUE(at != result.times.end() && *at == t) << t;
    return static_cast<std::size_t>(at - result.times.begin());
  };
  // Source keys outside keep their bits.
  for (std::size_t i = 0; source && i < source->times.size(); ++i) {
    const float t = source->times[i];
    if (t >= begin && t <= end) continue;
    ASSERT_EQ(std::memcmp(value_of(result, find(t)), value_of(*source, i), 12), 0);
  }
  // So does what is shown, to the rounding of a key at the cut; a player's clock is float32.
  const double first = std::min<double>(begin, source ? source->times.front() : begin) - 0.2;
  const double last = std::max<double>(end, source ? source->times.back() : end) + 0.2;
  for (int i = 0; i <= 300; ++i)
    for (const double t : {first + (begin - first) * i / 300, end + (last - end) * i / 300}) {
      const auto shown = static_cast<double>(static_cast<float>(t));
      ASSERT_LT(glm::distance(value_at(source, rest, shown), sample_vector(result, shown)), 2e-6)
          << shown << " window " << begin << ".." << end;
    }
  // Inside it the keys, and straight lines between them.
  for (std::size_t i = 0; i < keys.times.size(); ++i)
    ASSERT_LT(
        glm::distance(sample_vector(result, static_cast<double>(keys.times[i])), keys.values[i]),
        1e-5);
  for (std::size_t i = 0; i + 1 < keys.times.size(); ++i) {
    const double t =
        0.5 * (static_cast<double>(keys.times[i]) + static_cast<double>(keys.times[i + 1]));
    ASSERT_LT(glm::distance(sample_vector(result, t), 0.5 * (keys.values[i] + keys.values[i + 1])),
              1e-5);
  }
}

TEST(SpliceTranslation, KeepsTheSourceOutsideAnyWindow) {
  Random random(1);
  for (int trial = 0; trial < 900; ++trial) {
    SCOPED_TRACE(trial);
    const Channel source = random_channel(random, kKinds[trial % 3]);
    float begin, end;
    if (random.below(3) == 0) {
      begin = source.times[random.below(source.times.size())];
      end = source.times[random.below(source.times.size())];
      if (begin > end) std::swap(begin, end);
    } else {
      begin = static_cast<float>(random.uniform(-0.5, 3));
      end = begin + static_cast<float>(random.uniform(0.05, 2));
    }
    if (!(end > begin)) continue;
    const auto keys = detour(&source, Vec3(0.0), begin, end);
    const auto result = splice_translation(&source, Vec3(0.0), 3, begin, end, keys);
    ASSERT_TRUE(result.ok()) << result.error().message();
    EXPECT_EQ(result->interpolation, source.interpolation == Interpolation::cubic_spline
                                         ? Interpolation::cubic_spline
                                         : Interpolation::linear);
    expect_spliced(&source, Vec3(0.0), *result, begin, end, keys);
    // Again, elsewhere.
    const float later = end + 0.1f, last = end + 0.6f;
    const auto more = detour(&*result, Vec3(0.0), later, last);
    const auto twice = splice_translation(&*result, Vec3(0.0), 3, later, last, more);
    ASSERT_TRUE(twice.ok()) << twice.error().message();
    expect_spliced(&*result, Vec3(0.0), *twice, later, last, more);
  }
}

TEST(SpliceTranslation, WithoutASourceTheRestHoldsOutside) {
  const Vec3 rest(0.25, -3, 100);
  const auto keys = detour(nullptr, rest, 0.5f, 1.5f);
  const auto result = splice_translation(nullptr, rest, 5, 0.5f, 1.5f, keys);
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_EQ(result->joint, 5);
  EXPECT_EQ(result->interpolation, Interpolation::linear);
  EXPECT_EQ(sample_vector(*result, 0), rest);
  EXPECT_EQ(sample_vector(*result, 2), rest);
}

TEST(SpliceTranslation, RefusesWhatMakesNoSense) {
  Random random(4);
  Channel source = random_channel(random, Interpolation::linear);
  while (source.times.size() < 4) source = random_channel(random, Interpolation::linear);
  const float begin = 0.2f, end = 0.9f;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto good = detour(&source, Vec3(0.0), begin, end);
  ASSERT_TRUE(splice_translation(&source, Vec3(0.0), 3, begin, end, good).ok());
  EXPECT_FALSE(splice_translation(&source, Vec3(0.0), 3, end, begin, good).ok());
  EXPECT_FALSE(splice_translation(&source, Vec3(0.0), 3, begin, begin, good).ok());
  EXPECT_FALSE(splice_translation(&source, Vec3(0.0), 3, nan, end, good).ok());
  EXPECT_FALSE(splice_translation(&source, Vec3(0.0), 3, begin, end, {}).ok());
  const auto refused = [&](auto change) {
    TranslationKeys keys = good;
    change(keys);
    return !splice_translation(&source, Vec3(0.0), 3, begin, end, keys).ok();
  };
  EXPECT_TRUE(refused([&](TranslationKeys& k) { k.times[2] = nan; }));
  EXPECT_TRUE(refused([&](TranslationKeys& k) { k.times[2] = k.times[1]; }));
  EXPECT_TRUE(refused([&](TranslationKeys& k) { k.times.back() = end + 0.1f; }));
  EXPECT_TRUE(refused([&](TranslationKeys& k) { k.values[1].x = static_cast<double>(nan); }));
  EXPECT_TRUE(refused([&](TranslationKeys& k) { k.values[1].y = 1e300; }));
  EXPECT_TRUE(refused([&](TranslationKeys& k) { k.values.pop_back(); }));
  EXPECT_TRUE(refused([&](TranslationKeys& k) { k.values.front().z += 0.01; }));
  EXPECT_TRUE(refused([&](TranslationKeys& k) { k.values.back().z -= 0.01; }));
  for (const auto& spoil :
       {+[](Channel& c) { c.path = Path::scale; }, +[](Channel& c) { c.values.pop_back(); },
        +[](Channel& c) { c.times[1] = c.times[0]; }, +[](Channel& c) { c.values[4] = INFINITY; },
        +[](Channel& c) { c.times.clear(), c.values.clear(); }}) {
    Channel broken = source;
    spoil(broken);
    EXPECT_FALSE(splice_translation(&broken, Vec3(0.0), 3, begin, end, good).ok());
  }
  EXPECT_FALSE(splice_translation(nullptr, Vec3(0, INFINITY, 0), 3, begin, end, good).ok());
}

}  // namespace
}  // namespace elbowroom
