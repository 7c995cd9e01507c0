// SPDX-License-Identifier: MIT
// Bounds on a channel's travel against what sampling sees: never exceeded, and not much more.
#include "core/animation/channel_travel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/base/random.h"

namespace elbowroom {
namespace {

// Keys as clips have them (smooth) or as a hostile file may (any numbers).
Channel random_channel(Path path, Interpolation interpolation, bool smooth, Random& random) {
  Channel channel;
  channel.path = path;
  channel.interpolation = interpolation;
  channel.components = path == Path::rotation ? 4 : 3;
  const int keys = 1 + static_cast<int>(random.below(12));
  const bool cubic = interpolation == Interpolation::cubic_spline;
  double t = random.uniform(-1, 1);
  Quat turn = quat_from_rotation_vector(
      {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)});
  for (int k = 0; k < keys; ++k) {
    channel.times.push_back(static_cast<float>(t));
    t += random.uniform(0.01, 0.1);
    const Vec3 step(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                    random.uniform(-0.3, 0.3));
    turn = turn * quat_from_rotation_vector(step);
    const double value[4] = {turn.x, turn.y, turn.z, turn.w};
    for (int part = cubic ? 0 : 1; part < (cubic ? 3 : 2); ++part)
      for (int c = 0; c < channel.components; ++c)
        channel.values.push_back(static_cast<float>(
            part == 1 && smooth ? value[c] : random.uniform(smooth ? -2 : -50, smooth ? 2 : 50)));
  }
  return channel;
}

struct Seen {
  double most = 0;                // travel over bound
  std::vector<double> tightness;  // the same, of intervals that move
};

Seen compare(Path path, Interpolation interpolation, bool smooth, int cases) {
  Random random(11 + static_cast<std::uint64_t>(interpolation) + 7 * (smooth ? 1u : 0u));
  Seen seen;
  for (int i = 0; i < cases; ++i) {
    const Channel channel = random_channel(path, interpolation, smooth, random);
    const double first = channel.times.front(), last = channel.times.back();
    double begin = random.uniform(first - 0.1, last + 0.1);
    double end = begin + random.uniform(0, 0.3) * random.uniform();
    if (random.below(4) == 0) begin = channel.times[random.below(channel.times.size())];
    if (!(end >= begin)) end = begin;
    const double middle = random.below(2) ? 0.5 * (begin + end) : random.uniform(begin, end);
    const double bound = path == Path::rotation ? rotation_travel(channel, begin, end, middle)
                                                : vector_travel(channel, begin, end, middle);
    std::vector<double> times = {begin, end};
    for (const float key : channel.times)
      if (key >= begin && key <= end) {
        times.push_back(key);
        times.push_back(std::max(begin, static_cast<double>(std::nextafter(key, -1e9f))));
      }
    for (int s = 0; s < 60; ++s) times.push_back(random.uniform(begin, end));
    double most = 0;
    for (const double t : times) {
      const double travel =
          path == Path::rotation
              ? angle_between(sample_rotation(channel, middle), sample_rotation(channel, t))
              : glm::distance(sample_vector(channel, middle), sample_vector(channel, t));
      most = std::max(most, travel);
      EXPECT_LE(travel, bound * (1 + 1e-9) + 2e-8) << "case " << i << " at " << t;
      if (path == Path::rotation) continue;
      for (int c = 0; c < 3; ++c)
        EXPECT_LE(std::abs(sample_vector(channel, middle)[c] - sample_vector(channel, t)[c]),
                  component_travel(channel, c, begin, end, middle) * (1 + 1e-9) + 1e-9);
    }
    if (bound > 1e-6) {
      seen.most = std::max(seen.most, most / bound);
      seen.tightness.push_back(most / bound);
    }
  }
  std::sort(seen.tightness.begin(), seen.tightness.end());
  return seen;
}

class ChannelTravel : public ::testing::TestWithParam<std::tuple<Path, Interpolation, bool>> {};

TEST_P(ChannelTravel, IsNeverExceededAndNotFarAbove) {
  const auto [path, interpolation, smooth] = GetParam();
  const Seen seen = compare(path, interpolation, smooth, 1500);
  ASSERT_GT(seen.tightness.size(), 200u);
  const double median = seen.tightness[seen.tightness.size() / 2];
  std::printf("  travel / bound: median %.3f, most %.4f\n", median, seen.most);
  // A bound that is always far above would pass the rest.
  EXPECT_GT(median, smooth ? 0.4 : 0.2);
}

INSTANTIATE_TEST_SUITE_P(All, ChannelTravel,
                         ::testing::Combine(::testing::Values(Path::rotation, Path::translation),
                                            ::testing::Values(Interpolation::linear,
                                                              Interpolation::step,
                                                              Interpolation::cubic_spline),
                                            ::testing::Bool()));

TEST(ChannelTravel, OfNoMotionIsNone) {
  Random random(3);
  Channel channel = random_channel(Path::translation, Interpolation::linear, true, random);
  EXPECT_EQ(vector_travel(channel, 5, 6, 5.5), 0);
  EXPECT_EQ(vector_travel(channel, -9, -8, -8.5), 0);
  EXPECT_EQ(rotation_travel(Channel{}, 0, 1, 0.5), 0);
}

// Through the origin of quaternions a spline turns as fast as it likes.
TEST(ChannelTravel, OfASplineThroughZeroIsAHalfTurn) {
  Channel channel;
  channel.interpolation = Interpolation::cubic_spline;
  channel.times = {0, 1};
  channel.values = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0};
  EXPECT_EQ(rotation_travel(channel, 0.4, 0.6, 0.5), kPi);
}

}  // namespace
}  // namespace elbowroom
