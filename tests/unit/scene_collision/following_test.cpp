// SPDX-License-Identifier: MIT
// A hand that hangs from the hips is the arm's all the same: planning, skin and proof see what they
// see of one that hangs from the forearm.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/base/random.h"
#include "core/collision/certificate.h"
#include "core/collision/limb_planning_space.h"
#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

// The hand of a detached figure where that of the other one is, keyed at `rate` Hz; the hips turn
// and go along besides if they are asked to.
std::shared_ptr<Clip> moving_clip(bool detached, bool walks, int rate = 240) {
  auto clip = swing_clip({0, 1}, {0.6, -1.2});
  const auto add = [&](int joint, Path path, const std::vector<float>& times, auto value) {
    Channel channel;
    channel.joint = joint;
    channel.path = path;
    channel.components = path == Path::rotation ? 4 : 3;
    for (const float t : times) {
      channel.times.push_back(t);
      for (const double v : value(static_cast<double>(t)))
        channel.values.push_back(static_cast<float>(v));
    }
    clip->channels.push_back(channel);
  };
  if (walks) {
    add(kHips, Path::translation, {0, 1}, [](double t) {
      return std::vector<double>{0.2 * t, 1, 0.3 * t};
    });
    add(kHips, Path::rotation, {0, 1}, [](double t) {
      return std::vector<double>{0, std::sin(0.2 * t), 0, std::cos(0.2 * t)};
    });
  }
  if (!detached) return clip;
  std::vector<float> times;
  for (int i = 0; i <= rate; ++i) times.push_back(static_cast<float>(i) / static_cast<float>(rate));
  const auto angle = [&](double t) {
    const Quat q = sample_rotation(clip->channels.front(), t);
    return 2 * std::atan2(q.z, q.w);
  };
  add(kHand, Path::rotation, times, [&](double t) {
    return std::vector<double>{0, 0, std::sin(angle(t) / 2), std::cos(angle(t) / 2)};
  });
  add(kHand, Path::translation, times, [&](double t) {
    return std::vector<double>{0.2 + 0.55 * std::cos(angle(t)), 0.4 + 0.55 * std::sin(angle(t)), 0};
  });
  return clip;
}

World post_world(bool detached, bool walks) {
  const auto post = make_object("Post", box_shape({0.02f, 1.0f, 0.02f}));
  const auto plate = make_object("Plate", box_shape({0.15f, 0.002f, 0.15f}));
  return world_of(make_figure({.detached_hand = detached, .thigh_side = 0.13}),
                  moving_clip(detached, walks),
                  {actor("post.glb", post, Vec3(0.55, 1.0, 0.25)),
                   actor("plate.glb", plate, Vec3(0.5, 1.75, 0.1))});
}

LimbState state_at(const SceneCollision& scene, double t) {
  std::vector<ActorState> states;
  world_state_at(scene.world(), t, states);
  return limb_state(scene.limbs()[0], states[0].pose);
}

Configuration random_configuration(Random& random) {
  Configuration c;
  c.q.count = 7;
  for (int i = 0; i < 7; ++i) c.q[i] = random.uniform(-1.3, 1.3);
  c.q[3] = random.uniform(0, 1.8);
  c.t = random.uniform(0.1, 0.9);
  return c;
}

class Following : public testing::TestWithParam<bool> {};

TEST_P(Following, IsSeenAsWhatHangsFromTheLimb) {
  SceneCollision attached = scene_of(post_world(false, GetParam()));
  SceneCollision detached = scene_of(post_world(true, GetParam()));
  const auto space_of = [](const SceneCollision& scene) {
    return LimbPlanningSpace(scene, 0, 0.1, 0.9, state_at(scene, 0.1), state_at(scene, 0.9),
                             {0.005, 0.01});
  };
  LimbPlanningSpace a = space_of(attached), b = space_of(detached);
  Random random(3);
  int hits = 0, skin_differs = 0, planner_differs = 0;
  std::vector<RigidTransform> places_a, places_b;
  for (int i = 0; i < 400; ++i) {
    const Configuration c = random_configuration(random);
    LimbState state;
    state.q = c.q;
    attached.pose_limb(0, &state);
    detached.pose_limb(0, &state);
    const bool hit = attached.limb_in_contact(c.t, 0, 1e-5);
    hits += hit;
    skin_differs += hit != detached.limb_in_contact(c.t, 0, 1e-5);
    planner_differs += a.valid(c) != b.valid(c);
    a.placements(c, places_a);
    b.placements(c, places_b);
    for (std::size_t p = 0; p < b.parts().size(); ++p) {
      if (b.parts()[p].name.find("Hand") == std::string::npos) continue;
      EXPECT_TRUE(b.parts()[p].limb);
      // The same name there; parts may be cut in another order.
      double nearest = 1;
      for (std::size_t q = 0; q < a.parts().size(); ++q)
        if (a.parts()[q].name == b.parts()[p].name)
          nearest =
              std::min(nearest, glm::distance(places_a[q].translation, places_b[p].translation));
      EXPECT_LT(nearest, 1e-4) << c.t;
    }
  }
  EXPECT_GT(hits, 50);
  EXPECT_LT(hits, 350);
  // The clips differ by what keys leave between them.
  EXPECT_LE(skin_differs, 2);
  EXPECT_LE(planner_differs, 2);
}

TEST_P(Following, EdgesAreCertifiedAsSurely) {
  SceneCollision scene = scene_of(post_world(true, GetParam()));
  LimbPlanningSpace space(scene, 0, 0.1, 0.9, state_at(scene, 0.1), state_at(scene, 0.9),
                          {0.005, 0.0});
  Random random(9);
  int proven = 0;
  for (int i = 0; i < 200; ++i) {
    Configuration from = random_configuration(random), to = from;
    to.t = std::min(0.9, from.t + 0.1);
    for (int d = 0; d < 7; ++d) to.q[d] += random.uniform(-0.4, 0.4);
    std::int64_t looks = 0;
    const auto free = space.certified_free(from, to, looks);
    if (!free || !*free) continue;
    ++proven;
    for (int k = 0; k <= 50; ++k) {
      Configuration c = from;
      const double u = k / 50.0;
      c.t += u * (to.t - from.t);
      for (int d = 0; d < 7; ++d) c.q[d] += u * (to.q[d] - from.q[d]);
      EXPECT_TRUE(space.valid(c)) << "edge " << i << " at " << u;
    }
  }
  EXPECT_GT(proven, 30);
}

INSTANTIATE_TEST_SUITE_P(StandingAndWalking, Following, testing::Bool());

TEST(FollowingSkin, IsOfTheLimb) {
  SceneCollision scene = scene_of(post_world(true, true));
  // Hips keep nothing of the hand's; what the hand meets is the arm's to avoid.
  LimbState state = state_at(scene, 0.5);
  bool met = false;
  for (double swing = -1.5; swing < 1.5 && !met; swing += 0.05) {
    state.q[1] = swing;
    state.q[0] = -0.3;
    scene.pose_limb(0, &state);
    std::vector<ContactSample> contacts;
    scene.contacts_at(0.5, 0, false, contacts);
    for (const ContactSample& contact : contacts)
      met = met || contact.part_a.find("Hand") != std::string::npos ||
            contact.part_a.find("Finger") != std::string::npos;
  }
  EXPECT_TRUE(met);
}

TEST(FollowingSkin, WhatIsPlayedIsProven) {
  const auto post = make_object("Post", box_shape({0.02f, 1.0f, 0.02f}));
  for (const double z : {0.3, 0.0}) {
    SceneCollision scene =
        scene_of(world_of(make_figure({.thigh = false, .detached_hand = true}),
                          moving_clip(true, false), {actor("post.glb", post, Vec3(0.85, 1.0, z))}));
    const Certificate certificate = certify_limb(scene, 0, 0, 1);
    EXPECT_EQ(certificate.holds, z > 0) << certificate.part_a << " " << certificate.part_b << " "
                                        << certificate.time << " " << certificate.reason;
  }
}

TEST(FollowingSkin, OneThatIsNoneIsRefused) {
  const auto figure = make_figure({.detached_hand = true});
  for (const FollowingJoint wrong :
       {FollowingJoint{-1, kFore}, FollowingJoint{77, kFore}, FollowingJoint{kHand, kHips},
        FollowingJoint{kFore, kForeEnd}, FollowingJoint{kHips, kFore}}) {
    LimbModel arm = arm_of(*figure);
    arm.limb.following = {wrong};
    EXPECT_FALSE(SceneCollision::build(world_of(figure, nullptr), 0, 0, {arm}, 0, 1, {}).ok());
  }
}

}  // namespace
}  // namespace elbowroom::test
