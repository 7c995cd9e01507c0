// SPDX-License-Identifier: MIT
// Contacts of a limb with the scene: needles, containment, rooms, what is carried, intervals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

// The arm goes from straight out (0) to hanging (-90°) in a second.
std::shared_ptr<Clip> lowering() { return swing_clip({0, 1}, {0, -kPi / 2}); }
std::shared_ptr<Clip> still() { return swing_clip({0, 1}, {0, 0}); }

TEST(SceneContacts, AFreeArmTouchesNothingThatCounts) {
  SceneCollision scene = scene_of(world_of(make_figure({.thigh = false}), still()));
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, kEpsilon));
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, 0.005));
  std::vector<ContactSample> contacts;
  scene.contacts_at(0.5, 0, true, contacts);
  EXPECT_FALSE(contacts.empty()) << "the seams touch always, and are listed as allowed";
  for (const ContactSample& contact : contacts) {
    EXPECT_TRUE(contact.allowed);
    EXPECT_EQ(contact.reason, AllowedReason::shared_joint);
  }
}

TEST(SceneContacts, ANeedleBetweenVerticesIsFoundFromBothItsSides) {
  // Thinner than any mesh spacing of the arm, long enough to come out on both sides.
  for (const bool upright : {true, false}) {
    Shape needle =
        upright ? box_shape({0.0005f, 0.3f, 0.0005f}) : box_shape({0.0005f, 0.0005f, 0.3f});
    const auto post = make_object("Needle", needle);
    SceneCollision scene = scene_of(
        world_of(make_figure(), still(), {actor("needle.glb", post, Vec3(0.6137, 1.4, 0.0113))}));
    EXPECT_TRUE(scene.limb_in_contact(0.5, 0, kEpsilon));
    std::vector<ContactSample> contacts;
    scene.contacts_at(0.5, 0, false, contacts);
    ASSERT_FALSE(contacts.empty());
    for (const ContactSample& contact : contacts) {
      EXPECT_EQ(contact.part_b, "needle.glb/Needle");
      EXPECT_EQ(contact.part_a.rfind("Ada/", 0), 0u) << contact.part_a;
      EXPECT_EQ(contact.limb, 0);
      EXPECT_FALSE(contact.allowed);
      EXPECT_LT(glm::distance(contact.place, Vec3(0.6, 1.4, 0)), 0.45);
    }
  }
}

TEST(SceneContacts, ANeedleAlongTheBonesIsInsideAcrossTheCuts) {
  const auto needle = make_object("Needle", box_shape({0.2f, 0.001f, 0.001f}));
  const World world =
      world_of(make_figure(), still(), {actor("needle.glb", needle, Vec3(0.6, 1.4, 0))});
  SceneCollision scene = scene_of(world);
  EXPECT_TRUE(scene.limb_in_contact(0.5, 0, kEpsilon));
  EXPECT_EQ(scene.limb_clearance(0.5, 0, 0.1), 0);
  EXPECT_TRUE(touches(scene, 0.5, "Needle"));
  ASSERT_FALSE(scene.scan(0, 1, 20, 0, false).empty());
}

TEST(SceneContacts, NearIsNotTouchingButForAWiderDistance) {
  // The tube has twelve sides; its lowest point is a vertex line at 1.35.
  const auto plate = make_object("Plate", box_shape({0.05f, 0.01f, 0.05f}));
  SceneCollision scene =
      scene_of(world_of(make_figure(), still(), {actor("p", plate, Vec3(0.62, 1.337, 0))}));
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, kEpsilon));
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, 0.0029));
  EXPECT_TRUE(scene.limb_in_contact(0.5, 0, 0.0031));
  EXPECT_NEAR(scene.limb_clearance(0.5, 0, 0.1), 0.003, 1e-6);
  EXPECT_EQ(scene.limb_clearance(0.5, 0, 0.002), 0.002);
}

TEST(SceneContacts, WhatLiesInsideTheForearmIsInContact) {
  const auto ball = make_object("Ball", sphere_shape(0.01f, 6, 8));
  SceneCollision scene =
      scene_of(world_of(make_figure(), still(), {actor("b", ball, Vec3(0.62, 1.4, 0))}));
  EXPECT_TRUE(scene.limb_in_contact(0.5, 0, kEpsilon));
  EXPECT_EQ(scene.limb_clearance(0.5, 0, 0.1), 0);
  std::vector<ContactSample> contacts;
  scene.contacts_at(0.5, 0, false, contacts);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_GT(contacts[0].depth, 0.03) << "as deep as the ball's far side is in the arm";
  EXPECT_LT(contacts[0].depth, 0.06);
}

TEST(SceneContacts, ARoomAroundTheFigureIsNoContactButItsWallsAre) {
  const auto room = make_object("Room", box_shape({2, 2, 2}));
  SceneCollision scene =
      scene_of(world_of(make_figure({.sword = true}), still(), {actor("r", room, Vec3(0, 1, 0))}));
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, kEpsilon));
  const auto narrow = make_object("Room", box_shape({0.9f, 2, 2}));
  SceneCollision cramped =
      scene_of(world_of(make_figure(), still(), {actor("r", narrow, Vec3(0, 1, 0))}));
  EXPECT_TRUE(cramped.limb_in_contact(0.5, 0, kEpsilon));
}

TEST(SceneContacts, OpenCupDoesNotContainTheHand) {
  // A tube without ends around the hand: nothing touches.
  const auto cuff = make_object("Cuff", tube_shape(0.2f, 0.2f, 4, 24, false));
  World world =
      world_of(make_figure({.thigh = false}), still(), {actor("c", cuff, Vec3(0.7, 1.4, 0))});
  SceneCollision scene = scene_of(world);
  std::vector<ContactSample> contacts;
  scene.contacts_at(0.5, 0, false, contacts);
  for (const auto& contact : contacts)
    EXPECT_GT(glm::distance(contact.place, Vec3(0.7, 1.4, 0)), 0.15) << "only its rim may cross";
}

TEST(SceneContacts, AnUmbrellaInTheHandCountsAsTheArm) {
  const auto rod = make_object("Canopy", box_shape({0.01f, 0.4f, 0.01f}));
  Actor umbrella = actor("umbrella.glb", rod);
  Attachment held;
  held.actor = 0;
  held.joint = kHand;
  held.joint_from_object.translation = Vec3(0.1, 0.3, 0);
  umbrella.attachment = held;
  const auto post = make_object("Post", box_shape({0.02f, 0.05f, 0.02f}));
  // The post stands where only the umbrella's upper end comes.
  World world =
      world_of(make_figure(), still(), {umbrella, actor("post.glb", post, Vec3(0.86, 2.0, 0))});
  SceneCollision scene = scene_of(world);
  std::vector<ContactSample> contacts;
  scene.contacts_at(0.5, 0, false, contacts);
  ASSERT_EQ(contacts.size(), 1u) << "and it may touch the hand that holds it";
  EXPECT_EQ(contacts[0].part_a, "umbrella.glb/Canopy");
  EXPECT_EQ(contacts[0].part_b, "post.glb/Post");
  EXPECT_EQ(contacts[0].limb, 0);
  EXPECT_TRUE(scene.limb_in_contact(0.5, 0, kEpsilon));

  bool holder = false;
  for (const auto& entry : scene.allowed_contacts().entries)
    holder = holder || (entry.reason == AllowedReason::clip &&
                        (entry.part_a + entry.part_b).find("Canopy") != std::string::npos);
  EXPECT_TRUE(holder);

  // Lying across the forearm it is in the way.
  world.actors[1].attachment->joint_from_object.translation = Vec3(-0.1, 0.0, 0);
  SceneCollision across = scene_of(world);
  EXPECT_TRUE(touches(across, 0.5, "ForeArm") || touches(across, 0.5, "Canopy"));
}

TEST(SceneContacts, WhatIsLetGoOfIsAnObstacle) {
  const auto rod = make_object("Rod", box_shape({0.01f, 0.3f, 0.01f}));
  Actor held = actor("rod.glb", rod, Vec3(0.62, 1.4, 0));  // where it stands by itself
  Attachment attachment;
  attachment.actor = 0;
  attachment.joint = kHand;
  attachment.joint_from_object.translation = Vec3(0.1, 0, 0);
  attachment.begin = 0.25;
  attachment.end = 0.75;
  held.attachment = attachment;
  SceneCollision scene = scene_of(world_of(make_figure(), still(), {held}));
  EXPECT_TRUE(scene.limb_in_contact(0.1, 0, kEpsilon));
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, kEpsilon));
  EXPECT_TRUE(scene.limb_in_contact(0.9, 0, kEpsilon));
  const auto intervals = scene.scan(0, 1, 30, 0, false);
  double first_end = 1, second_begin = 0;
  for (const auto& interval : intervals) {
    if (interval.begin < 0.25) first_end = std::min(first_end, interval.end);
    if (interval.end > 0.75) second_begin = std::max(second_begin, interval.begin);
  }
  EXPECT_LE(first_end, 0.25);
  EXPECT_GT(first_end, 0.25 - 1e-4);
  EXPECT_GT(second_begin, 0.75);
  EXPECT_LT(second_begin, 0.75 + 1e-4);
}

TEST(SceneContacts, ASwordOfTheFileIsTheLimbsSide) {
  const auto post = make_object("Post", box_shape({0.02f, 0.05f, 0.02f}));
  SceneCollision scene = scene_of(world_of(make_figure({.sword = true}), still(),
                                           {actor("post.glb", post, Vec3(0.85, 1.75, 0))}));
  std::vector<ContactSample> contacts;
  scene.contacts_at(0.5, 0, false, contacts);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].part_a, "Ada/Sword");
}

TEST(SceneContacts, OtherContactsAreListedAndFailNothing) {
  const auto post = make_object("Post", box_shape({0.05f, 0.05f, 0.05f}));
  SceneCollision scene = scene_of(world_of(make_figure(), still(),
                                           {actor("post.glb", post, Vec3(-0.2, 1.2, 0)),
                                            actor("other.glb", post, Vec3(-0.2, 1.22, 0))}));
  EXPECT_FALSE(scene.limb_in_contact(0.5, 0, kEpsilon));
  std::vector<ContactSample> contacts;
  scene.contacts_at(0.5, -1, false, contacts);
  ASSERT_EQ(contacts.size(), 2u)
      << "trunk with each post; what rests against what rests is not told";
  for (const auto& contact : contacts) {
    EXPECT_EQ(contact.limb, -1);
    EXPECT_EQ(contact.part_a, "Ada/Hips");
  }
  scene.contacts_at(0.5, 0, false, contacts);
  EXPECT_TRUE(contacts.empty());
}

TEST(SceneContacts, IntervalEndsAreBisected) {
  const auto post = make_object("Post", box_shape({0.03f, 0.03f, 0.03f}));
  const Vec3 at(0.2 + 0.6 * std::cos(0.7), 1.4 - 0.6 * std::sin(0.7), 0);
  SceneCollision scene =
      scene_of(world_of(make_figure(), lowering(), {actor("post.glb", post, at)}));
  const auto coarse = scene.scan(0, 1, 20, 0, false);
  ASSERT_FALSE(coarse.empty());
  double begin = 1, end = 0;
  for (const auto& interval : coarse) {
    begin = std::min(begin, interval.begin);
    end = std::max(end, interval.end);
    EXPECT_GT(interval.deepest.depth, 0.0);
    EXPECT_GE(interval.time_of_deepest, interval.begin);
    EXPECT_LE(interval.time_of_deepest, interval.end);
  }
  EXPECT_TRUE(scene.limb_in_contact(begin, 0, kEpsilon));
  EXPECT_FALSE(scene.limb_in_contact(begin - 1.01e-4, 0, kEpsilon));
  EXPECT_TRUE(scene.limb_in_contact(end, 0, kEpsilon));
  EXPECT_FALSE(scene.limb_in_contact(end + 1.01e-4, 0, kEpsilon));
}

TEST(SceneContacts, AScanIsStoppedAtTheNextMoment) {
  const auto post = make_object("Post", box_shape({0.03f, 0.03f, 0.03f}));
  SceneCollision scene = scene_of(world_of(make_figure(), swing_clip({0, 1}, {0, 0}),
                                           {actor("post.glb", post, Vec3(0.62, 1.4, 0))}));
  std::stop_source stop;
  EXPECT_FALSE(scene.scan(0, 1, 30, 0, false, stop.get_token()).empty());
  stop.request_stop();
  // Four million samples, of which none is looked at.
  EXPECT_TRUE(scene.scan(0, 1, 4e6, 0, false, stop.get_token()).empty());
}

TEST(SceneContacts, BothSidesOfAStepAreLookedAt) {
  // The arm jumps onto the post for less than the time between two samples.
  const auto post = make_object("Post", box_shape({0.03f, 0.03f, 0.03f}));
  const Vec3 at(0.2 + 0.6 * std::cos(0.7), 1.4 - 0.6 * std::sin(0.7), 0);
  const auto jumps = swing_clip({0, 0.5031f, 0.5037f, 1}, {0, -0.7, 0, 0}, Interpolation::step);
  SceneCollision scene = scene_of(world_of(make_figure(), jumps, {actor("post.glb", post, at)}));
  const auto intervals = scene.scan(0, 1, 10, 0, false);
  ASSERT_FALSE(intervals.empty());
  for (const auto& interval : intervals) {
    EXPECT_NEAR(interval.begin, 0.5031, 1e-6);
    EXPECT_NEAR(interval.end, 0.5037, 1e-6);
  }
}

TEST(SceneContacts, AnswersDoNotDependOnWhatWasAskedBefore) {
  const auto post = make_object("Post", box_shape({0.03f, 0.03f, 0.03f}));
  const Vec3 at(0.2 + 0.6 * std::cos(0.7), 1.4 - 0.6 * std::sin(0.7), 0);
  const World world = world_of(make_figure(), lowering(), {actor("post.glb", post, at)});
  SceneCollision one = scene_of(world), other = scene_of(world);
  std::vector<ContactSample> a, b;
  for (int i = 0; i <= 40; ++i) {
    one.contacts_at(i / 40.0, -1, true, a);
    other.contacts_at(1 - i / 40.0, -1, true, b);
    other.contacts_at(i / 40.0, -1, true, b);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].part_a, b[k].part_a);
      EXPECT_EQ(a[k].depth, b[k].depth);
      EXPECT_EQ(a[k].place, b[k].place);
    }
  }
}

TEST(SceneContacts, HostileQuestions) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const World world = world_of(make_figure(), still());
  const std::vector<LimbModel> arm = {arm_of(*world.actors[0].model)};
  EXPECT_FALSE(SceneCollision::build(world, 3, 0, arm, 0, 1, {}).ok());
  EXPECT_FALSE(SceneCollision::build(world, 0, -1, arm, 0, 1, {}).ok());
  EXPECT_FALSE(SceneCollision::build(world, 0, 0, arm, nan, 1, {}).ok());
  EXPECT_FALSE(SceneCollision::build(world, 0, 0, arm, 1, 0, {}).ok());
  CollisionSettings settings;
  settings.patch_size = nan;
  EXPECT_FALSE(SceneCollision::build(world, 0, 0, arm, 0, 1, settings).ok());
  LimbModel nowhere = arm[0];
  nowhere.limb.root = 99;
  EXPECT_FALSE(SceneCollision::build(world, 0, 0, {nowhere}, 0, 1, {}).ok());
  EXPECT_FALSE(SceneCollision::build({}, 0, 0, {}, 0, 1, {}).ok());
  // A matrix that is no number is named, not followed.
  auto broken = std::make_shared<Model>(*make_figure());
  broken->skins[0].inverse_bind[2][3][0] = nan;
  EXPECT_FALSE(SceneCollision::build(world_of(broken, still()), 0, 0, arm, 0, 1, {}).ok());

  SceneCollision scene = scene_of(world);
  EXPECT_TRUE(scene.limb_in_contact(nan, 0, kEpsilon));
  EXPECT_TRUE(scene.limb_in_contact(0.5, 0, nan));
  EXPECT_TRUE(scene.limb_in_contact(0.5, 7, kEpsilon));
  EXPECT_EQ(scene.limb_clearance(nan, 0, 1), 0);
  EXPECT_EQ(scene.limb_clearance(0.5, -1, 1), 0);
  std::vector<ContactSample> contacts;
  scene.contacts_at(nan, -1, true, contacts);
  EXPECT_TRUE(contacts.empty());
  EXPECT_TRUE(scene.scan(0, nan, 60, -1, false).empty());
  EXPECT_TRUE(scene.scan(1, 0, 60, -1, false).empty());
  EXPECT_TRUE(scene.scan(0, 1, nan, 9, false).empty());
  EXPECT_NO_FATAL_FAILURE(scene.scan(0, 1, -5, -1, false));
  scene.pose_limb(5, nullptr);

  // Without limbs and without a clip everything is other contacts.
  auto bare = SceneCollision::build(world_of(make_figure(), nullptr), 0, 0, {}, 0, 0, {});
  ASSERT_TRUE(bare.ok());
  bare->contacts_at(0, -1, true, contacts);
  EXPECT_TRUE(contacts.empty());
}

}  // namespace
}  // namespace elbowroom::test
