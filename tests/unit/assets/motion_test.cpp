// SPDX-License-Identifier: MIT
// The mannequin's clips: their times, the gait against the published figures, and feet that stay
// where they are put down.
#include <gtest/gtest.h>

#include <algorithm>

#include "assets/demo.h"
#include "assets/generator/gait.h"
#include "tests/unit/assets/demo_world.h"

namespace elbowroom::test {
namespace {

constexpr double kDegrees = kPi / 180.0;

TEST(Clips, HaveTheirLengthsAndThirtyKeysASecond) {
  const Model& model = mannequin();
  ASSERT_EQ(model.clips.size(), 3u);
  EXPECT_EQ(model.clips[0].name, demo::kIdleClip);
  EXPECT_EQ(model.clips[1].name, demo::kWalkClip);
  EXPECT_EQ(model.clips[2].name, demo::kDemoClip);
  EXPECT_NEAR(model.clips[0].duration(), 4.0, 1e-6);
  EXPECT_NEAR(model.clips[1].duration(), 1.1, 1e-6);
  EXPECT_GT(model.clips[2].duration(), 3.0);
  EXPECT_LT(model.clips[2].duration(), 5.0);
  for (const Clip& clip : model.clips) {
    EXPECT_NEAR(key_rate(clip), 30.0, 0.01) << clip.name;
    EXPECT_EQ(clip.begin, 0.0);
  }
}

TEST(Clips, LoopsCloseAndHaveNoJumps) {
  const Model& model = mannequin();
  for (const Clip& clip : model.clips)
    for (const Channel& channel : clip.channels) {
      const std::size_t n = channel.times.size(), c = static_cast<std::size_t>(channel.components);
      if (clip.name != demo::kDemoClip) {
        for (std::size_t i = 0; i < c; ++i)
          EXPECT_EQ(channel.values[i], channel.values[(n - 1) * c + i]);
      }
      if (channel.path != Path::rotation) continue;
      for (std::size_t k = 0; k + 1 < n; ++k) {
        const double angle = angle_between(sample_rotation(channel, channel.times[k]),
                                           sample_rotation(channel, channel.times[k + 1]));
        EXPECT_LT(angle, 25.0 * kDegrees)
            << clip.name << " "
            << model.skeleton.joints[static_cast<std::size_t>(channel.joint)].name << " " << k;
      }
    }
}

TEST(Clips, DemoWalksFourToSixMetresAhead) {
  const Model& model = mannequin();
  const auto first = globals_at(model, demo::kDemoClip, 0);
  const auto last = globals_at(model, demo::kDemoClip, 100);
  const Vec3 way = joint_position(model, last, "Hips") - joint_position(model, first, "Hips");
  EXPECT_GT(way.z, 4.0);
  EXPECT_LT(way.z, 6.0);
  EXPECT_LT(std::abs(way.x), 0.05);
}

// Angles of the left leg in the sagittal plane, from joint positions.
struct LegAngles {
  double hip, knee, ankle;
};
LegAngles left_leg(const Model& model, const std::vector<Mat4>& g) {
  const auto at = [&](const char* name) { return joint_position(model, g, name); };
  const Vec3 thigh = at("LeftLowerLeg") - at("LeftUpperLeg");
  const Vec3 shank = at("LeftFoot") - at("LeftLowerLeg");
  const int joint = model.skeleton.find("LeftFoot");
  const Vec3 ahead = Vec3(g[static_cast<std::size_t>(joint)] * glm::dvec4(0, 0, 1, 0));
  const double thigh_angle = std::atan2(thigh.z, -thigh.y);
  const double shank_angle = std::atan2(shank.z, -shank.y);
  return {thigh_angle, thigh_angle - shank_angle, std::atan2(ahead.y, ahead.z) - shank_angle};
}

TEST(Gait, FollowsThePublishedAngles) {
  const Model& model = mannequin();
  const demo::Gait gait = demo::natural_gait();
  const double period = model.clips[1].duration();
  double hip = 0, knee = 0, ankle = 0;
  constexpr int kSteps = 100;
  for (int i = 0; i < kSteps; ++i) {
    const double phase = static_cast<double>(i) / kSteps;
    const LegAngles a = left_leg(model, globals_at(model, demo::kWalkClip, phase * period));
    hip += std::pow(a.hip - gait.hip(phase), 2);
    knee += std::pow(a.knee - gait.knee(phase), 2);
    ankle += std::pow(a.ankle - gait.ankle(phase), 2);
  }
  const auto rms = [&](double sum) { return std::sqrt(sum / kSteps) / kDegrees; };
  RecordProperty("hip_rms_degrees", std::to_string(rms(hip)));
  RecordProperty("knee_rms_degrees", std::to_string(rms(knee)));
  RecordProperty("ankle_rms_degrees", std::to_string(rms(ankle)));
  // About one standard deviation of the subjects measured.
  EXPECT_LT(rms(hip), 5.0);
  EXPECT_LT(rms(knee), 5.0);
  EXPECT_LT(rms(ankle), 9.0);  // its zero depends on the shoe
}

TEST(Gait, FeetStandStillAndNeverSinkIn) {
  const Model& model = mannequin();
  const Body body = welded(model);
  // The soles' vertices: those of foot and toes near the ground in the bind pose.
  std::vector<std::size_t> soles;
  for (std::size_t i = 0; i < body.positions.size(); ++i)
    if (body.positions[i].y < 0.004) soles.push_back(i);
  ASSERT_GT(soles.size(), 50u);
  // A point that is down in three frames running has stood still between the first two.
  std::vector<std::vector<Vec3>> last;
  double slip = 0, deepest = 0, highest = 0;
  for (const double t : key_times(model, demo::kDemoClip)) {
    last.push_back(deformed(model, body, globals_at(model, demo::kDemoClip, t)));
    const std::vector<Vec3>& p = last.back();
    double lowest = 1e9;
    for (const std::size_t i : soles) {
      lowest = std::min(lowest, p[i].y);
      if (last.size() < 3 || p[i].y > 0.004 || last[0][i].y > 0.004 || last[1][i].y > 0.004)
        continue;
      const Vec3 way = last[1][i] - last[0][i];
      slip = std::max(slip, 30.0 * std::hypot(way.x, way.z));
    }
    deepest = std::min(deepest, lowest);
    highest = std::max(highest, lowest);
    if (last.size() == 3) last.erase(last.begin());
  }
  RecordProperty("slip_metres_a_second", std::to_string(slip));
  EXPECT_LT(slip, 0.30);  // while the body moves at 1.2 m/s
  EXPECT_GT(deepest, -0.004);
  EXPECT_LT(highest, 0.006);
}

TEST(Gait, SwingingFootClearsTheGround) {
  const Model& model = mannequin();
  const Body body = welded(model);
  std::vector<std::size_t> left_sole;
  for (std::size_t i = 0; i < body.positions.size(); ++i)
    if (body.positions[i].y < 0.004 && body.positions[i].x > 0) left_sole.push_back(i);
  for (int i = 0; i <= 20; ++i) {
    const double phase = 0.70 + 0.25 * i / 20;  // of the left leg's cycle, well inside its swing
    const double t = phase * mannequin().clips[1].duration();
    const std::vector<Vec3> p = deformed(model, body, globals_at(model, demo::kWalkClip, t));
    double lowest = 1e9;
    for (const std::size_t k : left_sole) lowest = std::min(lowest, p[k].y);
    EXPECT_GT(lowest, 0.004) << phase;
  }
}

}  // namespace
}  // namespace elbowroom::test
