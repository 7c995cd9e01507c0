// SPDX-License-Identifier: MIT
// What a stack of corrections shows: muted ones not, those that don't fit not either, and it says
// so.
#include "core/editing/motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace elbowroom {
namespace {

struct Scene {
  Skeleton skeleton;
  std::shared_ptr<const Clip> clip;
};

Quat about_z(double angle) { return Quat(std::cos(angle / 2), 0, 0, std::sin(angle / 2)); }

// One joint that turns about z at 1 rad/s for two seconds.
Scene one_joint() {
  Scene scene;
  Joint joint;
  joint.name = "arm";
  scene.skeleton.joints.push_back(joint);
  link_skeleton(scene.skeleton);
  Clip clip;
  clip.name = "turn";
  Channel channel;
  channel.joint = 0;
  channel.source_channel = 0;
  for (int i = 0; i <= 20; ++i) {
    const Quat q = about_z(0.1 * i);
    channel.times.push_back(static_cast<float>(0.1 * i));
    for (const double v : {q.x, q.y, q.z, q.w}) channel.values.push_back(static_cast<float>(v));
  }
  clip.channels.push_back(channel);
  clip.end = static_cast<double>(channel.times.back());
  scene.clip = std::make_shared<const Clip>(clip);
  return scene;
}

// Stays on the clip at its ends, `by` off it in the middle.
Correction detour(float begin, float end, double by, double begin_angle, double end_angle) {
  Correction correction;
  correction.name = "detour";
  correction.begin = begin;
  correction.end = end;
  JointKeys keys;
  keys.joint = "arm";
  keys.node = 0;
  for (int i = 0; i <= 10; ++i) {
    const double u = i / 10.0;
    keys.keys.times.push_back(i == 10 ? end : begin + (end - begin) * static_cast<float>(u));
    keys.keys.values.push_back(
        about_z(begin_angle + (end_angle - begin_angle) * u + by * std::sin(u * kPi)));
  }
  correction.joints.push_back(keys);
  return correction;
}

double angle_at(const Clip& clip, double t) {
  const Quat q = sample_rotation(clip.channels.front(), t);
  return 2 * std::atan2(q.z, q.w);
}

TEST(MotionOf, NothingToLayOverIsTheSourceItself) {
  const Scene scene = one_joint();
  EXPECT_EQ(motion_of(scene.skeleton, scene.clip, {}).clip, scene.clip);
  Correction muted = detour(0.5f, 1.0f, 0.3, 0.5, 1.0);
  muted.muted = true;
  const Motion motion = motion_of(scene.skeleton, scene.clip, {muted});
  EXPECT_EQ(motion.clip, scene.clip);
  EXPECT_FALSE(motion.problems[0].has_value());
}

TEST(MotionOf, CorrectionsShowInTheirWindowsOnly) {
  const Scene scene = one_joint();
  const Motion motion = motion_of(scene.skeleton, scene.clip, {detour(0.5f, 1.0f, 0.3, 0.5, 1.0)});
  EXPECT_NEAR(angle_at(*motion.clip, 0.75), 0.75 + 0.3, 0.01);
  EXPECT_NEAR(angle_at(*motion.clip, 0.3), 0.3, 1e-5);
  EXPECT_NEAR(angle_at(*motion.clip, 1.5), 1.5, 1e-5);
}

TEST(MotionOf, OneThatDoesNotFitIsNamedAndPassedOver) {
  const Scene scene = one_joint();
  // The second begins where the first has led the joint; with the first muted it hangs in the air.
  Correction first = detour(0.5f, 1.5f, 0.3, 0.5, 1.5);
  const double there = 1.0 + 0.3;
  Correction second = detour(1.0f, 1.8f, 0.2, there, 1.8);
  Motion both = motion_of(scene.skeleton, scene.clip, {first, second});
  EXPECT_FALSE(both.problems[0].has_value());
  EXPECT_FALSE(both.problems[1].has_value()) << both.problems[1]->message();
  first.muted = true;
  Motion alone = motion_of(scene.skeleton, scene.clip, {first, second});
  ASSERT_TRUE(alone.problems[1].has_value());
  EXPECT_NE(alone.problems[1]->message().find("arm"), std::string::npos);
  EXPECT_NEAR(angle_at(*alone.clip, 1.4), 1.4, 1e-5);
}

TEST(ChangedBetween, IsTheUnionOfTheWindowsThatDiffer) {
  const Correction a = detour(0.5f, 1.0f, 0.3, 0.5, 1.0), b = detour(1.2f, 1.6f, 0.1, 1.2, 1.6);
  EXPECT_FALSE(changed_between({a}, {a}).has_value());
  auto changed = changed_between({a}, {a, b});
  ASSERT_TRUE(changed.has_value());
  EXPECT_FLOAT_EQ(static_cast<float>(changed->lower), 1.2f);
  EXPECT_FLOAT_EQ(static_cast<float>(changed->upper), 1.6f);
  Correction muted = a;
  muted.muted = true;
  changed = changed_between({a, b}, {muted, b});
  ASSERT_TRUE(changed.has_value());
  EXPECT_FLOAT_EQ(static_cast<float>(changed->upper), 1.0f);
  Correction renamed = a;
  renamed.name = "other";
  EXPECT_FALSE(changed_between({a}, {renamed}).has_value());
}

}  // namespace
}  // namespace elbowroom
