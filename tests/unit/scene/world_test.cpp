// SPDX-License-Identifier: MIT
// w(t): clocks, placements and attachments [SKF07 3].
#include "core/scene/world.h"

#include <gtest/gtest.h>

#include "tests/unit/scene/figures.h"

namespace elbowroom {
namespace {

using test::add_joint;
using test::add_mesh;

std::shared_ptr<const Model> arm(double unit = 1) {
  auto model = std::make_shared<Model>();
  add_joint(*model, "armature", -1, {0, 0, 0});
  model->skeleton.joints[0].rest.scale = Vec3(unit);
  add_joint(*model, "shoulder", 0, Vec3(0, 1, 0) / unit);
  add_joint(*model, "hand", 1, Vec3(1, 0, 0) / unit);
  link_skeleton(model->skeleton);
  return model;
}

std::shared_ptr<const Model> prop() {
  auto model = std::make_shared<Model>();
  add_joint(*model, "umbrella", -1, {0, 0.5, 0});
  add_mesh(*model, 0, -1, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}});
  link_skeleton(model->skeleton);
  return model;
}

// Turns the shoulder from 0° to 90° about z within one second.
std::shared_ptr<const Clip> raise() {
  auto clip = std::make_shared<Clip>();
  Channel channel;
  channel.joint = 1;
  channel.path = Path::rotation;
  channel.times = {0, 1};
  const auto half = static_cast<float>(std::sqrt(0.5));
  channel.values = {0, 0, 0, 1, 0, 0, half, half};
  clip->channels.push_back(channel);
  clip->end = 1;
  return clip;
}

void expect_at(const Mat4& m, const Vec3& expected, double tolerance = 1e-6) {
  EXPECT_LT(glm::distance(Vec3(m[3]), expected), tolerance)
      << m[3].x << " " << m[3].y << " " << m[3].z;
}

World with_umbrella(double unit = 1) {
  World world;
  world.actors.resize(2);
  world.actors[0].model = arm(unit);
  world.actors[0].clip = raise();
  world.actors[0].world_from_file = glm::translate(Mat4(1.0), Vec3(10, 0, 0));
  world.actors[1].model = prop();
  world.actors[1].world_from_file = glm::translate(Mat4(1.0), Vec3(0, 0, 7));
  Attachment attachment;
  attachment.actor = 0;
  attachment.joint = 2;
  attachment.joint_from_object.translation = {0, 0, 0.25};
  world.actors[1].attachment = attachment;
  return world;
}

TEST(World, PlaysItsClipsOnOneClockAndClamps) {
  const World world = with_umbrella();
  std::vector<ActorState> states;
  world_state_at(world, 0, states);
  ASSERT_EQ(states.size(), 2u);
  expect_at(states[0].world_from_joint[2], {11, 1, 0});
  world_state_at(world, 1, states);
  expect_at(states[0].world_from_joint[2], {10, 2, 0});
  world_state_at(world, 99, states);
  expect_at(states[0].world_from_joint[2], {10, 2, 0});
  world_state_at(world, -99, states);
  expect_at(states[0].world_from_joint[2], {11, 1, 0});
}

TEST(World, AnAttachedObjectFollowsItsJoint) {
  const World world = with_umbrella();
  std::vector<ActorState> states;
  world_state_at(world, 0, states);
  expect_at(states[1].world_from_joint[0], {11, 1.5, 0.25});
  world_state_at(world, 1, states);
  // The hand has turned by 90°: the umbrella's own y now points to -x.
  expect_at(states[1].world_from_joint[0], {10 - 0.5, 2, 0.25});
}

TEST(World, AnAttachedObjectKeepsItsSizeUnderAnArmatureScale) {
  for (const double unit : {100.0, 0.01}) {
    const World world = with_umbrella(unit);
    std::vector<ActorState> states;
    world_state_at(world, 0, states);
    expect_at(states[1].world_from_joint[0], {11, 1.5, 0.25});
    EXPECT_NEAR(glm::length(Vec3(states[1].world_from_joint[0][0])), 1, 1e-9);
  }
}

TEST(World, AnAttachmentHoldsForItsTime) {
  World world = with_umbrella();
  world.actors[1].attachment->begin = 0.25;
  world.actors[1].attachment->end = 0.75;
  std::vector<ActorState> states;
  for (const double t : {0.2, 0.8}) {
    world_state_at(world, t, states);
    expect_at(states[1].world_from_joint[0], {0, 0.5, 7});
  }
  for (const double t : {0.25, 0.5, 0.75}) {
    world_state_at(world, t, states);
    EXPECT_GT(states[1].world_from_joint[0][3].x, 9) << t;
  }
}

TEST(World, IsAPureFunctionOfTime) {
  const World world = with_umbrella();
  std::vector<ActorState> once, again;
  world_state_at(world, 0.3, once);
  for (const double t : {0.9, -5.0, 0.3}) world_state_at(world, t, again);
  for (std::size_t a = 0; a < 2; ++a) {
    EXPECT_EQ(once[a].world_from_joint, again[a].world_from_joint);
  }
}

TEST(World, WithoutAClipIsAtRest) {
  World world = with_umbrella();
  world.actors[0].clip = nullptr;
  std::vector<ActorState> states;
  world_state_at(world, 0.7, states);
  expect_at(states[0].world_from_joint[2], {11, 1, 0});
}

TEST(World, SurvivesBadReferences) {
  World world = with_umbrella();
  std::vector<ActorState> states;
  for (const int carrier : {-1, 1, 5}) {
    world.actors[1].attachment->actor = carrier;
    world_state_at(world, 0, states);
    expect_at(states[1].world_from_joint[0], {0, 0.5, 7});
  }
  world.actors[1].attachment->actor = 0;
  for (const int joint : {-1, 3}) {
    world.actors[1].attachment->joint = joint;
    world_state_at(world, 0, states);
    expect_at(states[1].world_from_joint[0], {0, 0.5, 7});
  }
  world.actors[0].model = nullptr;
  world_state_at(world, 0, states);
  EXPECT_TRUE(states[0].world_from_joint.empty());
  world_state_at(World{}, 0, states);
  EXPECT_TRUE(states.empty());
}

}  // namespace
}  // namespace elbowroom
