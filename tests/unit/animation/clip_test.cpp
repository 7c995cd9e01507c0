// SPDX-License-Identifier: MIT
// Sampling against glTF 2.0, Appendix C, and against values worked out by hand.
#include "core/animation/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace elbowroom {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Channel vector_channel(Interpolation interpolation, std::vector<float> times,
                       std::vector<float> values) {
  Channel channel;
  channel.joint = 0;
  channel.path = Path::translation;
  channel.interpolation = interpolation;
  channel.components = 3;
  channel.times = std::move(times);
  channel.values = std::move(values);
  return channel;
}

Channel rotation_channel(Interpolation interpolation, std::vector<float> times,
                         std::vector<float> values) {
  Channel channel = vector_channel(interpolation, std::move(times), std::move(values));
  channel.path = Path::rotation;
  channel.components = 4;
  return channel;
}

// x, y, z, w of a turn about z.
std::vector<float> about_z(double degrees) {
  const double half = degrees * kPi / 360.0;
  return {0, 0, static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}

std::vector<float> joined(std::initializer_list<std::vector<float>> parts) {
  std::vector<float> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

double degrees_about_z(const Quat& q) { return 2 * std::atan2(q.z, q.w) * 180.0 / kPi; }

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(SampleLinear, IsOnTheLineBetweenTwoKeys) {
  const Channel c = vector_channel(Interpolation::linear, {1, 3, 4}, {0, 0, 0, 2, -4, 8, 2, -4, 9});
  expect_near(sample_vector(c, 1.0), {0, 0, 0}, 0);
  expect_near(sample_vector(c, 1.5), {0.5, -1, 2}, 1e-15);
  expect_near(sample_vector(c, 3.0), {2, -4, 8}, 0);
  expect_near(sample_vector(c, 3.25), {2, -4, 8.25}, 1e-15);
}

TEST(SampleLinear, ClampsOutsideItsKeys) {
  const Channel c = vector_channel(Interpolation::linear, {1, 3}, {1, 2, 3, 4, 5, 6});
  for (const double before : {0.999, 0.0, -1e9, -kInfinity, kNaN}) {
    expect_near(sample_vector(c, before), {1, 2, 3}, 0);
  }
  for (const double after : {3.0, 3.001, 1e9, kInfinity}) {
    expect_near(sample_vector(c, after), {4, 5, 6}, 0);
  }
}

TEST(SampleLinear, OneKeyHoldsForever) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::step}) {
    const Channel c = vector_channel(interpolation, {2}, {1, 2, 3});
    for (const double t : {-1.0, 2.0, 5.0}) expect_near(sample_vector(c, t), {1, 2, 3}, 0);
  }
  const Channel spline =
      vector_channel(Interpolation::cubic_spline, {2}, {9, 9, 9, 1, 2, 3, 9, 9, 9});
  for (const double t : {-1.0, 2.0, 5.0}) expect_near(sample_vector(spline, t), {1, 2, 3}, 0);
}

TEST(SampleLinear, FindsTheRightKeyAmongIrregularOnes) {
  Random random(7);
  std::vector<float> times, values;
  float t = -3;
  for (int i = 0; i < 200; ++i) {
    t += static_cast<float>(std::pow(10.0, random.uniform(-4.0, 0.5)));
    times.push_back(t);
    for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(i));
  }
  const Channel c = vector_channel(Interpolation::step, times, values);
  for (std::size_t key = 0; key < times.size(); ++key) {
    const auto value = static_cast<double>(key);
    EXPECT_EQ(sample_vector(c, times[key]).x, value);
    EXPECT_EQ(sample_vector(c, std::nextafter(double{times[key]}, kInfinity)).x, value);
    EXPECT_EQ(sample_vector(c, std::nextafter(double{times[key]}, -kInfinity)).x,
              key == 0 ? 0 : value - 1);
  }
}

TEST(SampleStep, HoldsUntilTheNextKey) {
  const Channel c = vector_channel(Interpolation::step, {0, 1}, {1, 1, 1, 5, 5, 5});
  expect_near(sample_vector(c, 0.999999), {1, 1, 1}, 0);
  expect_near(sample_vector(c, 1.0), {5, 5, 5}, 0);

  const Channel r =
      rotation_channel(Interpolation::step, {0, 1}, joined({about_z(10), about_z(80)}));
  EXPECT_NEAR(degrees_about_z(sample_rotation(r, 0.9999)), 10, 1e-5);
  EXPECT_NEAR(degrees_about_z(sample_rotation(r, 1.0)), 80, 1e-5);
}

TEST(SampleLinearRotation, IsSlerpAtConstantSpeed) {
  const Channel c =
      rotation_channel(Interpolation::linear, {0, 2}, joined({about_z(10), about_z(90)}));
  for (const double u : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(degrees_about_z(sample_rotation(c, 2 * u)), 10 + 80 * u, 1e-5);
  }
}

TEST(SampleLinearRotation, GoesTheShortWay) {
  std::vector<float> far = about_z(90);
  for (float& v : far) v = -v;  // the same rotation with the other sign
  const Channel c = rotation_channel(Interpolation::linear, {0, 1}, joined({about_z(10), far}));
  EXPECT_NEAR(degrees_about_z(sample_rotation(c, 0.5)), 50, 1e-5);
  // 170° and -170° are 20° apart.
  const Channel across =
      rotation_channel(Interpolation::linear, {0, 1}, joined({about_z(170), about_z(-170)}));
  EXPECT_NEAR(std::abs(degrees_about_z(sample_rotation(across, 0.5))), 180, 1e-5);
}

TEST(SampleLinearRotation, FollowsAppendixC) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<float> values;
    Quat ends[2];
    for (Quat& q : ends) {
      q = glm::normalize(Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                              random.uniform(-1, 1)));
      for (const double v : {q.x, q.y, q.z, q.w}) values.push_back(static_cast<float>(v));
    }
    const Channel c = rotation_channel(Interpolation::linear, {0, 1}, values);
    const double t = random.uniform();
    // a = arccos(|q_k · q_k+1|), s the sign of the product.
    const double d = glm::dot(ends[0], ends[1]);
    const double a = std::acos(std::abs(d)), s = d < 0 ? -1 : 1;
    const Quat expected = ends[0] * (std::sin(a * (1 - t)) / std::sin(a)) +
                          ends[1] * (s * std::sin(a * t) / std::sin(a));
    EXPECT_LT(angle_between(sample_rotation(c, t), glm::normalize(expected)), 1e-6);
  }
}

TEST(SampleLinearRotation, IsUnitEvenIfItsKeysAreNot) {
  const Channel c = rotation_channel(Interpolation::linear, {0, 1}, {0, 0, 0, 2, 0, 0, 3, 0});
  EXPECT_NEAR(glm::length(sample_rotation(c, 0.3)), 1, 1e-12);
  EXPECT_NEAR(degrees_about_z(sample_rotation(c, 0.5)), 90, 1e-9);
  const Channel zero = rotation_channel(Interpolation::linear, {0}, {0, 0, 0, 0});
  EXPECT_NEAR(glm::length(sample_rotation(zero, 0)), 1, 1e-12);
}

TEST(SampleLinearRotation, EqualKeysGiveThatKey) {
  const Channel c =
      rotation_channel(Interpolation::linear, {0, 1}, joined({about_z(33), about_z(33)}));
  EXPECT_NEAR(degrees_about_z(sample_rotation(c, 0.77)), 33, 1e-5);
}

// v_t = (2u³ - 3u² + 1) v_k + d (u³ - 2u² + u) b_k + (-2u³ + 3u²) v_k+1 + d (u³ - u²) a_k+1.
TEST(SampleCubicSpline, FollowsAppendixC) {
  //                      a_0      v_0      b_0      a_1      v_1      b_1
  const Channel c = vector_channel(Interpolation::cubic_spline, {1, 3},
                                   {7, 7, 7, 1, 0, 0, 0, 3, 0, 0, 0, -2, 5, 0, 0, 8, 8, 8});
  // u = 0.5, d = 2: 0.5·1 + 0.5·5 = 3; 2·0.125·3 = 0.75; 2·(-0.125)·(-2) = 0.5.
  expect_near(sample_vector(c, 2.0), {3, 0.75, 0.5}, 1e-15);
  // u = 0.25: h00 = 0.84375, h10 = 0.140625, h01 = 0.15625, h11 = -0.046875.
  expect_near(sample_vector(c, 1.5),
              {0.84375 * 1 + 0.15625 * 5, 2 * 0.140625 * 3, 2 * -0.046875 * -2}, 1e-15);
  expect_near(sample_vector(c, 1.0), {1, 0, 0}, 0);
  expect_near(sample_vector(c, 3.0), {5, 0, 0}, 0);
  expect_near(sample_vector(c, 0.0), {1, 0, 0}, 0);
  expect_near(sample_vector(c, 9.0), {5, 0, 0}, 0);
}

TEST(SampleCubicSpline, TangentsScaleWithTheInterval) {
  // A straight line of slope 2 stays one whatever the interval.
  for (const float length : {0.1f, 1.0f, 7.0f}) {
    const Channel c = vector_channel(
        Interpolation::cubic_spline, {0, length},
        {0, 0, 0, 0, 0, 0, 2, 2, 2, 2, 2, 2, 2 * length, 2 * length, 2 * length, 0, 0, 0});
    for (const double u : {0.1, 0.5, 0.8}) {
      EXPECT_NEAR(sample_vector(c, u * length).x, 2 * u * length, 1e-6);
    }
  }
}

TEST(SampleCubicSpline, RotationIsNormalized) {
  std::vector<float> values(24, 0.0f);
  const std::vector<float> from = about_z(0), to = about_z(120);
  std::copy(from.begin(), from.end(), values.begin() + 4);
  std::copy(to.begin(), to.end(), values.begin() + 16);
  const Channel c = rotation_channel(Interpolation::cubic_spline, {0, 1}, values);
  const Quat q = sample_rotation(c, 0.5);
  EXPECT_NEAR(glm::length(q), 1, 1e-12);
  EXPECT_NEAR(degrees_about_z(q), 60, 1e-5);  // by symmetry
  // u = 0.25 weighs the keys 0.84375 and 0.15625.
  const double z = 0.15625 * std::sin(kPi / 3), w = 0.84375 + 0.15625 * std::cos(kPi / 3);
  EXPECT_NEAR(degrees_about_z(sample_rotation(c, 0.25)), 2 * std::atan2(z, w) * 180 / kPi, 1e-5);
}

TEST(SampleWeights, AreSampledByTarget) {
  Channel c = vector_channel(Interpolation::linear, {0, 1}, {0, 1, 1, 0});
  c.path = Path::weights;
  c.components = 2;
  std::vector<double> weights;
  sample_weights(c, 0.25, weights);
  ASSERT_EQ(weights.size(), 2u);
  EXPECT_DOUBLE_EQ(weights[0], 0.25);
  EXPECT_DOUBLE_EQ(weights[1], 0.75);
}

TEST(SampleClip, SetsWhatItAnimatesAndLeavesTheRest) {
  Skeleton skeleton;
  skeleton.joints.resize(2);
  skeleton.joints[1].parent = 0;
  skeleton.joints[1].rest.translation = {0, 1, 0};
  ASSERT_TRUE(link_skeleton(skeleton));
  Clip clip;
  clip.channels.push_back(
      rotation_channel(Interpolation::linear, {0, 1}, joined({about_z(0), about_z(90)})));
  clip.channels[0].joint = 1;
  clip.channels.push_back(vector_channel(Interpolation::linear, {0}, {9, 9, 9}));
  clip.channels[1].joint = 5;  // not in this skeleton
  Pose pose = rest_pose(skeleton);
  sample_clip(clip, 0.5, pose);
  EXPECT_NEAR(degrees_about_z(pose.local[1].rotation), 45, 1e-5);
  expect_near(pose.local[1].translation, {0, 1, 0}, 0);
  EXPECT_EQ(pose.local[0].rotation, Quat(1, 0, 0, 0));
  EXPECT_EQ(clip.find_channel(1, Path::rotation), 0);
  EXPECT_EQ(clip.find_channel(1, Path::scale), -1);
}

TEST(StepTimes, AreWhereAValueChanges) {
  Clip clip;
  clip.channels.push_back(
      vector_channel(Interpolation::step, {0, 1, 2, 3}, {0, 0, 0, 0, 0, 0, 5, 0, 0, 5, 0, 1}));
  clip.channels.push_back(vector_channel(Interpolation::step, {0.5f, 2}, {0, 0, 0, 1, 1, 1}));
  clip.channels.push_back(vector_channel(Interpolation::linear, {0, 1.5f}, {0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(step_times(clip), (std::vector<double>{2, 3}));
}

TEST(KeyRate, IsTheFrameRateOfTheExport) {
  const auto clip_at = [](double rate, int keys, int skip) {
    Clip clip;
    std::vector<float> times, values;
    for (int i = 0; i < keys; i += 1 + (i % skip)) {
      times.push_back(static_cast<float>(0.042 + i / rate));
      values.insert(values.end(), {0, 0, 0, 1});
    }
    clip.channels.push_back(rotation_channel(Interpolation::linear, times, values));
    return clip;
  };
  for (const double rate : {24.0, 30.0, 60.0, 120.0}) {
    EXPECT_EQ(key_rate(clip_at(rate, 100, 1)), rate);
    EXPECT_EQ(key_rate(clip_at(rate, 100, 3)), rate) << "thinned out";
  }
  EXPECT_EQ(key_rate(clip_at(1000, 100, 1)), 240);
  EXPECT_EQ(key_rate(clip_at(0.1, 10, 1)), 1);
  EXPECT_EQ(key_rate(clip_at(30, 1, 1)), 30) << "one key says nothing";
  EXPECT_EQ(key_rate(Clip{}), 30);
}

}  // namespace
}  // namespace elbowroom
