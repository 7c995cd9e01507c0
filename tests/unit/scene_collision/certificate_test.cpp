// SPDX-License-Identifier: MIT
// What a certificate may say and what it has to: motions that collide between samples, and free
// ones.
#include "core/collision/certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "core/base/random.h"
#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

std::shared_ptr<Clip> moving_clip(const std::vector<float>& times, const std::vector<Vec3>& places,
                                  Interpolation interpolation = Interpolation::linear) {
  auto clip = std::make_shared<Clip>();
  Channel channel;
  channel.joint = 0;
  channel.path = Path::translation;
  channel.interpolation = interpolation;
  channel.components = 3;
  channel.times = times;
  for (const Vec3& p : places)
    for (int k = 0; k < 3; ++k) channel.values.push_back(static_cast<float>(p[k]));
  clip->channels.push_back(channel);
  clip->begin = times.front();
  clip->end = times.back();
  return clip;
}

// A plate 3 mm thick across z, 0.3 wide.
Actor plate(std::shared_ptr<const Clip> clip, const Vec3& half = Vec3(0.15, 0.15, 0.0015)) {
  auto model = make_object("Plate", box_shape(glm::vec3(half)));
  model->objects.front().animated = true;
  Actor moving = actor("plate.glb", model);
  moving.clip = std::move(clip);
  return moving;
}

// The arm, straight and level but for a swing about z, of some speed.
std::shared_ptr<Clip> waving() { return swing_clip({0, 0.3f, 0.7f, 1}, {-0.3, 0.5, -0.2, 0.4}); }

FigureOptions no_thigh() {
  FigureOptions options;
  options.thigh = false;
  return options;
}

bool seen_by_samples(SceneCollision& scene, double rate) {
  const auto samples = static_cast<int>(rate);
  for (int i = 0; i <= samples; ++i)
    if (scene.limb_in_contact(i / rate, 0, 0)) return true;
  return false;
}

TEST(Certificate, IsNotGivenToAPlateThatPassesBetweenSamples) {
  Random random(5);
  int unseen = 0;
  for (int i = 0; i < 20; ++i) {
    // Through the arm within a millisecond, between two samples of 240 Hz.
    const double sample = std::floor(random.uniform(20, 220)) / 240;
    const double at = sample + random.uniform(0.2, 0.6) / 240;
    const auto from = static_cast<float>(at), to = static_cast<float>(at + 0.001);
    const double x = random.uniform(0.35, 0.85);
    // Across the arm, whichever way it points then; it stays within ±0.6 rad.
    const auto clip = moving_clip({0, from, to, 1},
                                  {{x, 1.4, 0.4}, {x, 1.4, 0.4}, {x, 1.4, -0.4}, {x, 1.4, -0.4}});
    SceneCollision scene = scene_of(
        world_of(make_figure(no_thigh()), waving(), {plate(clip, Vec3(0.05, 0.6, 0.0015))}));
    if (!seen_by_samples(scene, 240)) ++unseen;
    bool collides = false;
    for (int s = 0; s <= 1000 && !collides; ++s)
      collides = scene.limb_in_contact(at + 1e-6 * s, 0, 0);
    ASSERT_TRUE(collides);
    const Certificate certificate = certify_limb(scene, 0, 0, 1);
    EXPECT_FALSE(certificate.holds) << i;
    EXPECT_EQ(certificate.part_b, "plate.glb/Plate");
    EXPECT_NEAR(certificate.time, at + 0.0005, 0.001);
    EXPECT_FALSE(certificate.reason.empty());
  }
  // Else the test would say nothing about what lies between samples.
  EXPECT_EQ(unseen, 20);
}

// The arm itself passes a thin thing that stands still.
TEST(Certificate, IsNotGivenToAnArmThatPassesAWireBetweenSamples) {
  Random random(6);
  for (int i = 0; i < 20; ++i) {
    const double at = (std::floor(random.uniform(40, 200)) + random.uniform(0.1, 0.5)) / 240;
    const auto from = static_cast<float>(at), to = static_cast<float>(at + 0.001);
    // Swept from -0.5 to 0.5 rad within a millisecond, past a wire along z.
    const auto clip = swing_clip({0, from, to, 1}, {-0.5, -0.5, 0.5, 0.5});
    const double angle = random.uniform(-0.3, 0.3);
    const Vec3 place = Vec3(0.2, 1.4, 0) + 0.6 * Vec3(std::cos(angle), std::sin(angle), 0);
    Actor wire =
        actor("wire.glb", make_object("Wire", tube_shape(0.003f, 0.5f, 4, 8, true)), place);
    SceneCollision scene = scene_of(world_of(make_figure(no_thigh()), clip, {wire}));
    EXPECT_FALSE(seen_by_samples(scene, 240));
    EXPECT_FALSE(certify_limb(scene, 0, 0, 1).holds) << i;
  }
}

// Thin things that pass at 2 mm or more, however fast: to be proven free.
TEST(Certificate, IsGivenAtTwoMillimetres) {
  Random random(7);
  long poses = 0, checks = 0;
  double shortest = 1;
  for (int i = 0; i < 20; ++i) {
    const double at = random.uniform(0.1, 0.9);
    const auto from = static_cast<float>(at), to = static_cast<float>(at + 0.001);
    // The arm turns about z through its shoulder at (0.2, 1.4, 0); its end is 0.1 across and 0.75
    // from there.
    const double x = 0.2 + std::hypot(0.75, 0.05) + random.uniform(0.002, 0.01) + 0.0015;
    const auto clip = moving_clip({0, from, to, 1},
                                  {{x, 1.4, 0.6}, {x, 1.4, 0.6}, {x, 1.4, -0.6}, {x, 1.4, -0.6}});
    SceneCollision scene = scene_of(
        world_of(make_figure(no_thigh()), waving(), {plate(clip, Vec3(0.0015, 0.8, 0.1))}));
    const double clearance = [&] {
      double least = 1;
      for (int s = 0; s <= 100; ++s)
        least = std::min(least, scene.limb_clearance(at + 1e-5 * s, 0, least));
      return least;
    }();
    EXPECT_GE(clearance, 0.002);
    const Certificate certificate = certify_limb(scene, 0, 0, 1);
    EXPECT_TRUE(certificate.holds) << certificate.part_a << " with " << certificate.part_b << " at "
                                   << certificate.time << ", plate at " << at;
    poses += certificate.poses;
    checks += certificate.pair_checks;
    shortest = std::min(shortest, certificate.shortest);
  }
  std::printf("  %.0f poses and %.0f pairs for a second, shortest interval %.2g s\n", poses / 20.0,
              checks / 20.0, shortest);
}

// The walk of the whole body does not count against its own parts.
TEST(Certificate, OfAnArmAtTheBodyDoesNotMindTheWalk) {
  FigureOptions options;
  options.thigh_side = 0.14;
  long poses[2];
  for (const bool walks : {false, true}) {
    auto clip =
        std::make_shared<Clip>(*swing_clip({0, 0.5f, 1}, {-kPi / 2, -kPi / 2 + 0.05, -kPi / 2}));
    if (walks) {
      auto walk = moving_clip({0, 1}, {{0, 1, 0}, {0, 1, 5}});
      walk->channels.front().joint = kHips;
      clip->channels.push_back(walk->channels.front());
    }
    SceneCollision scene = scene_of(world_of(make_figure(options), clip));
    const Certificate certificate = certify_limb(scene, 0, 0, 1);
    EXPECT_TRUE(certificate.holds) << certificate.part_a << " with " << certificate.part_b << " at "
                                   << certificate.time << ": " << certificate.reason;
    poses[walks ? 1 : 0] = certificate.poses;
  }
  EXPECT_LE(poses[1], poses[0] + 2);
}

// A step is crossed by no bound, and both its sides are looked at.
TEST(Certificate, TakesStepsAsTheyAre) {
  const auto jump = [](const Vec3& from, const Vec3& to) {
    return plate(moving_clip({0, 0.5f}, {from, to}, Interpolation::step));
  };
  const Vec3 before(0.7, 1.4, 0.4), behind(0.7, 1.4, -0.4), inside(0.7, 1.4, 0.0);
  const auto still = swing_clip({0, 1}, {0, 0.01});
  {
    SceneCollision scene = scene_of(world_of(make_figure(), still, {jump(before, behind)}));
    const Certificate certificate = certify_limb(scene, 0, 0, 1);
    EXPECT_TRUE(certificate.holds) << certificate.reason;
  }
  for (const bool first : {true, false}) {
    SceneCollision scene = scene_of(
        world_of(make_figure(), still, {first ? jump(inside, before) : jump(before, inside)}));
    const Certificate certificate = certify_limb(scene, 0, 0, 1);
    EXPECT_FALSE(certificate.holds);
    EXPECT_TRUE(first ? certificate.time < 0.5 : certificate.time >= 0.5) << certificate.time;
  }
  // A thing that turns up in the hand's way for a time, by an attachment to a carrier that is
  // there.
  Actor carrier = actor("carrier.glb", make_object("Carrier", box_shape(glm::vec3(0.01f))), inside);
  Actor visitor =
      actor("visitor.glb", make_object("Visitor", box_shape(glm::vec3(0.02f))), Vec3(0, 0, 3));
  carrier.world_from_file[3] = glm::dvec4(0.7, 2.4, 0, 1);
  visitor.attachment = Attachment{1, 0, {}, 0.4, 0.6};
  visitor.attachment->joint_from_object.translation = Vec3(0, -1, 0);
  SceneCollision scene = scene_of(world_of(make_figure(), still, {carrier, visitor}));
  const Certificate certificate = certify_limb(scene, 0, 0, 1);
  EXPECT_FALSE(certificate.holds);
  EXPECT_GE(certificate.time, 0.4);
  EXPECT_TRUE(certify_limb(scene, 0, 0, 0.39).holds);
  EXPECT_TRUE(certify_limb(scene, 0, 0.61, 1).holds);
}

// Deeper and deeper into what may touch: the patches are allowed, their depth is said to be
// sampled.
TEST(Certificate, SaysWhatItKnowsOfAllowedContactsBySamplesOnly) {
  const auto brush = swing_clip({0, 0.5f, 1}, {-1.2, -kPi / 2, -1.2});
  SceneCollision scene = scene_of(world_of(make_figure(), brush));
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, 0));
  const Certificate certificate = certify_limb(scene, 0, 0, 1);
  EXPECT_TRUE(certificate.holds) << certificate.part_a << " with " << certificate.part_b << " at "
                                 << certificate.time << ": " << certificate.reason;
  EXPECT_FALSE(certificate.depth_sampled.empty());
}

CertificateSettings closely() {
  CertificateSettings settings;
  settings.look_below = 1.0 / 240;
  return settings;
}

TEST(Certificate, WhatIsNotProvenIsLookedAtWhereItIsNot) {
  // A plate that comes up to the arm, but for little more than what counts as contact: no proof.
  const auto rising = [](double highest) {
    return moving_clip(
        {0, 0.4f, 0.5f, 1},
        {{0.6, highest - 0.3, 0}, {0.6, highest, 0}, {0.6, highest, 0}, {0.6, highest - 0.3, 0}});
  };
  const auto with_plate = [&](double highest) {
    return scene_of(world_of(make_figure(no_thigh()), swing_clip({0, 1}, {0, 0}),
                             {plate(rising(highest), Vec3(0.1, 0.01, 0.1))}));
  };
  SceneCollision far = with_plate(1.3);
  const double room = far.limb_clearance(0.45, 0, 0.1), epsilon = 1e-5 * kHeight;
  ASSERT_GT(room, 0.01);
  SceneCollision near = with_plate(1.3 + room - 1.25 * epsilon);
  ASSERT_FALSE(near.limb_in_contact(0.45, 0, epsilon));
  const Certificate proof = certify_limb(near, 0, 0, 1);
  EXPECT_FALSE(proof.holds);
  EXPECT_EQ(proof.looked_at, 0);
  EXPECT_FALSE(proof.beside_clip_contacts);
  const Certificate looked = certify_limb(near, 0, 0, 1, closely());
  EXPECT_TRUE(looked.holds) << looked.reason << " " << looked.time;
  EXPECT_GT(looked.looked_at, 0.1) << "no proof while it is there";
  EXPECT_LT(looked.looked_at, 0.15) << "elsewhere there is one";
  // A proof is one whether or not a closer look was asked for.
  const Certificate free = certify_limb(far, 0, 0, 1, closely());
  EXPECT_TRUE(free.holds);
  EXPECT_EQ(free.looked_at, 0);
}

TEST(Certificate, ACloserLookFindsWhatSamplesMiss) {
  Random random(7);
  int unseen = 0;
  for (int i = 0; i < 10; ++i) {
    // Into the arm and out again within two milliseconds, between two samples of 240 Hz.
    const double sample = std::floor(random.uniform(20, 220)) / 240;
    const double at = sample + random.uniform(0.2, 0.4) / 240;
    const auto from = static_cast<float>(at), middle = static_cast<float>(at + 0.001),
               to = static_cast<float>(at + 0.002);
    const double x = random.uniform(0.4, 0.8);
    const auto clip = moving_clip(
        {0, from, middle, to, 1},
        {{x, 1.4, 0.12}, {x, 1.4, 0.12}, {x, 1.4, 0.04}, {x, 1.4, 0.12}, {x, 1.4, 0.12}});
    SceneCollision scene = scene_of(world_of(make_figure(no_thigh()), swing_clip({0, 1}, {0, 0}),
                                             {plate(clip, Vec3(0.05, 0.1, 0.0015))}));
    unseen += !seen_by_samples(scene, 240);
    const Certificate looked = certify_limb(scene, 0, 0, 1, closely());
    EXPECT_FALSE(looked.holds);
    EXPECT_EQ(looked.reason, "the two are in contact");
    EXPECT_NEAR(looked.time, at + 0.001, 0.001);
    EXPECT_EQ(looked.part_b, "plate.glb/Plate");
    EXPECT_TRUE(scene.limb_in_contact(looked.time, 0, 0)) << "it can be seen";
  }
  EXPECT_GT(unseen, 5);
}

TEST(Certificate, RefusesWhatIsNoQuestion) {
  SceneCollision scene = scene_of(world_of(make_figure(), waving()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(certify_limb(scene, 3, 0, 1).holds);
  EXPECT_FALSE(certify_limb(scene, -1, 0, 1).holds);
  EXPECT_FALSE(certify_limb(scene, 0, nan, 1).holds);
  EXPECT_FALSE(certify_limb(scene, 0, 1, 0).holds);
  EXPECT_FALSE(certify_limb(scene, 0, 0, 1e300).holds);
  CertificateSettings none;
  none.smallest = nan;
  EXPECT_FALSE(certify_limb(scene, 0, 0, 1, none).holds);
  for (const double step : {0.0, -1.0, 1e-300, nan}) {
    CertificateSettings look = closely();
    look.look_step = step;
    EXPECT_FALSE(certify_limb(scene, 0, 0, 1, look).holds) << step;
  }
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(certify_limb(scene, 0, 0, 1, {}, stop.get_token()).holds);
  LimbState state;
  state.q.count = 7;
  scene.pose_limb(0, &state);
  EXPECT_FALSE(certify_limb(scene, 0, 0, 1).holds);
}

}  // namespace
}  // namespace elbowroom::test
