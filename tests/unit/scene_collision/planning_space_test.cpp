// SPDX-License-Identifier: MIT
// The world as the planner sees it against the deformed skin, and its promises.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/collision/limb_planning_space.h"
#include "core/collision/skin_deviation.h"
#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

LimbState state_at(const SceneCollision& scene, double t) {
  std::vector<ActorState> states;
  world_state_at(scene.world(), t, states);
  return limb_state(scene.limbs()[0], states[0].pose);
}

LimbPlanningSpace space_of(const SceneCollision& scene, double begin, double end,
                           const LimbPlanningSpace::Settings& settings = {0.005, 0.0}) {
  return LimbPlanningSpace(scene, 0, begin, end, state_at(scene, begin), state_at(scene, end),
                           settings);
}

Configuration random_configuration(Random& random, double begin, double end) {
  Configuration c;
  c.q.count = 7;
  for (int i = 0; i < 7; ++i) c.q[i] = random.uniform(-1.3, 1.3);
  c.q[3] = random.uniform(0, 1.8);
  c.t = random.uniform(begin, end);
  return c;
}

World post_world(double thigh_side = 0.13) {
  const auto post = make_object("Post", box_shape({0.02f, 1.0f, 0.02f}));
  const auto plate = make_object("Plate", box_shape({0.15f, 0.002f, 0.15f}));
  return world_of(make_figure({.thigh_side = thigh_side}), swing_clip({0, 1}, {0.6, -1.2}),
                  {actor("post.glb", post, Vec3(0.55, 1.0, 0.25)),
                   actor("plate.glb", plate, Vec3(0.5, 1.75, 0.1))});
}

TEST(LimbPlanningSpace, AgreesWithTheSkin) {
  SceneCollision scene = scene_of(post_world());
  for (const double margin : {0.0, 0.01}) {
    LimbPlanningSpace space = space_of(scene, 0.1, 0.9, {0.005, margin});
    Random random(5);
    int both_free = 0, both_hit = 0, rigid_only = 0, skin_only = 0;
    for (int i = 0; i < 1500; ++i) {
      const Configuration c = random_configuration(random, 0.1, 0.9);
      LimbState state;
      state.q = c.q;
      scene.pose_limb(0, &state);
      const bool hit = scene.limb_in_contact(c.t, 0, kEpsilon);
      const bool said = !space.valid(c);
      ++(hit ? (said ? both_hit : skin_only) : (said ? rigid_only : both_free));
    }
    scene.pose_limb(0, nullptr);
    RecordProperty("skin_only", skin_only);
    std::printf("margin %.3f: both free %d, both hit %d, rigid only %d, skin only %d\n", margin,
                both_free, both_hit, rigid_only, skin_only);
    EXPECT_GT(both_free, 100);
    EXPECT_GT(both_hit, 100);
    EXPECT_LE(skin_only, margin > 0 ? 3 : 15) << "of 1500 the skin may touch what parts do not";
    EXPECT_LE(rigid_only, margin > 0 ? 180 : 120)
        << "clearance and margin refuse some that are free";
  }
}

TEST(LimbPlanningSpace, AMarginOfTwoPartsIsTheirsAlone) {
  SceneCollision scene = scene_of(post_world());
  LimbPlanningSpace plain = space_of(scene, 0.1, 0.9);
  const std::string post = "post.glb/Post";
  Random random(6);
  int told = 0;
  for (int i = 0; i < 400; ++i) {
    const Configuration c = random_configuration(random, 0.1, 0.9);
    if (!plain.valid(c)) continue;
    for (const std::string part : {"Ada/Hand", "Ada/ForeArm", "Ada/UpperArm"}) {
      const auto margin = plain.margin_to_refuse(c, part, post, 0.08);
      EXPECT_EQ(plain.margin_to_refuse(c, post, part, 0.08), margin) << "in either order";
      if (!margin) continue;
      ASSERT_GT(*margin, 0) << "it is valid";
      ASSERT_LE(*margin, 0.08);
      ++told;
      if (told % 8 != 0) continue;
      const auto with = [&](const std::string& other, double more) {
        return space_of(scene, 0.1, 0.9, {0.005, 0.0, -1, {{part, other, more}}});
      };
      EXPECT_FALSE(with(post, *margin).valid(c));
      EXPECT_TRUE(with(post, *margin - 0.08 / 16).valid(c));
      EXPECT_TRUE(with("plate.glb/no such part", *margin).valid(c)) << "of no other pair";
    }
  }
  EXPECT_GT(told, 40);
  const Configuration c = random_configuration(random, 0.1, 0.9);
  EXPECT_FALSE(plain.margin_to_refuse(c, "Ada/Hand", "nobody", 0.08));
  EXPECT_FALSE(plain.margin_to_refuse(c, "Ada/Hand", post, 0));
  EXPECT_FALSE(
      plain.margin_to_refuse({c.q, std::numeric_limits<double>::quiet_NaN()}, "Ada/Hand", post, 1));
}

TEST(LimbPlanningSpace, AProofOfFewLooksEnds) {
  SceneCollision scene = scene_of(post_world());
  LimbPlanningSpace space = space_of(scene, 0.1, 0.9);
  Random random(9);
  int proven = 0, given_up = 0;
  for (int i = 0; i < 300; ++i) {
    Configuration from = random_configuration(random, 0.1, 0.8), to = from;
    for (int k = 0; k < to.q.count; ++k) to.q[k] += random.uniform(-0.2, 0.2);
    to.t = from.t + 0.1;
    if (!space.valid(from) || !space.valid(to)) continue;
    std::int64_t looks = 0;
    const bool few = space.certified_free(from, to, looks, 4).value_or(false);
    EXPECT_LE(looks, 4);
    looks = 100;
    const bool free = space.certified_free(from, to, looks).value_or(false);
    EXPECT_GE(looks, 100) << "they add up";
    EXPECT_TRUE(free || !few) << "what few looks prove is proven";
    proven += few;
    given_up += free && !few;
  }
  EXPECT_GT(proven, 10);
  EXPECT_GT(given_up, 10);
}

TEST(LimbPlanningSpace, TheClipItselfIsFreeButForObstacles) {
  SceneCollision scene =
      scene_of(world_of(make_figure({.thigh_side = 0.16}), swing_clip({0, 1}, {-0.4, -kPi / 2})));
  LimbPlanningSpace space = space_of(scene, 0, 1, {0.005, 0.01});
  for (int i = 0; i <= 100; ++i) {
    const Configuration c{state_at(scene, i / 100.0).q, i / 100.0};
    EXPECT_TRUE(space.valid(c)) << c.t;
  }
  // Through the thigh is another matter.
  Configuration through{state_at(scene, 1).q, 1};
  through.q[1] -= 0.15;
  EXPECT_FALSE(space.valid(through));
  EXPECT_EQ(space.most_blocking().second, "Ada/Hips");
}

TEST(LimbPlanningSpace, SeesWhatIsCarried) {
  const auto rod = make_object("Rod", box_shape({0.01f, 0.4f, 0.01f}));
  Actor held = actor("rod.glb", rod);
  Attachment attachment;
  attachment.actor = 0;
  attachment.joint = kHand;
  attachment.joint_from_object.translation = Vec3(0.1, 0.3, 0);
  held.attachment = attachment;
  const auto post = make_object("Post", box_shape({0.05f, 0.05f, 0.05f}));
  World world = world_of(make_figure({.thigh = false}), swing_clip({0, 1}, {0, 0}),
                         {held, actor("post.glb", post, Vec3(0.86, 2.05, 0.3))});
  SceneCollision scene = scene_of(world);
  LimbPlanningSpace space = space_of(scene, 0, 1);
  Configuration c{state_at(scene, 0.5).q, 0.5};
  EXPECT_TRUE(space.valid(c));
  c.q[6] = 0;
  // Forward in the shoulder takes the rod's upper end to the post at z = 0.3.
  bool hit = false;
  for (int i = 0; i <= 60 && !hit; ++i) {
    c.q[0] = -1.5 + 0.05 * i;
    hit = !space.valid(c);
  }
  EXPECT_TRUE(hit);
  EXPECT_EQ(space.most_blocking().first, "rod.glb/Rod");
  std::vector<Vec3> points;
  space.metric_points(c, points);
  EXPECT_EQ(points.size(), 10u);
}

TEST(LimbPlanningSpace, AttachmentsThatBeginAndEndAreSteps) {
  const auto rod = make_object("Rod", box_shape({0.01f, 0.3f, 0.01f}));
  Actor held = actor("rod.glb", rod, Vec3(0.62, 1.4, 0));
  Attachment attachment;
  attachment.actor = 0;
  attachment.joint = kHand;
  attachment.joint_from_object.translation = Vec3(0.1, 0, 0);
  attachment.begin = 0.25;
  attachment.end = 0.75;
  held.attachment = attachment;
  SceneCollision scene = scene_of(world_of(make_figure(), swing_clip({0, 1}, {0, 0}), {held}));
  LimbPlanningSpace space = space_of(scene, 0, 1);
  ASSERT_EQ(space.step_times().size(), 2u);
  EXPECT_EQ(space.step_times()[0], 0.25);
  const Dofs q = state_at(scene, 0).q;
  EXPECT_FALSE(space.valid({q, 0.2}));
  EXPECT_FALSE(space.valid({q, std::nextafter(0.25, 0.0)}));
  EXPECT_TRUE(space.valid({q, 0.25}));
  EXPECT_TRUE(space.valid({q, 0.75}));
  EXPECT_FALSE(space.valid({q, space.step_times()[1]}));
}

TEST(LimbPlanningSpace, PlacementsFollowTheClip) {
  SceneCollision scene = scene_of(post_world());
  LimbPlanningSpace space = space_of(scene, 0.1, 0.9);
  std::vector<RigidTransform> placed;
  std::vector<ActorState> states;
  for (const double t : {0.1, 0.2371, 0.5, 0.8999}) {
    space.placements({state_at(scene, t).q, t}, placed);
    ASSERT_EQ(placed.size(), space.parts().size());
    world_state_at(scene.world(), t, states);
    std::vector<Vec3> skin;
    const Model& model = *scene.world().actors[0].model;
    deform(model, model.meshes[0], states[0].pose, states[0].world_from_joint, skin);
    // Every vertex of a part is on or near the skin; the straight forearm's are on it.
    for (std::size_t p = 0; p < placed.size(); ++p) {
      if (space.parts()[p].name != "Ada/ForeArm") continue;
      for (const glm::vec3& v : space.parts()[p].mesh->positions()) {
        const Vec3 at = placed[p] * Vec3(v);
        double nearest = 1;
        for (const Vec3& s : skin) nearest = std::min(nearest, glm::distance(s, at));
        EXPECT_LT(nearest, 1e-3);
      }
    }
  }
}

// What culling leaves out is out of contact: every pair, asked one by one without any of it.
void expect_no_pair_forgotten(const World& world, double clearance, int least_free) {
  SceneCollision scene = scene_of(world);
  LimbPlanningSpace space = space_of(scene, 0.1, 0.9, {clearance, 0.0});
  Random random(21);
  std::vector<RigidTransform> placed;
  int free = 0;
  for (int i = 0; i < 1500; ++i) {
    const Configuration c = random_configuration(random, 0.1, 0.9);
    const bool valid = space.valid(c);
    free += valid;
    space.placements(c, placed);
    int strict = 0, allowed_too = 0;
    for (const auto& pair : space.pairs()) {
      const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
      const CollisionMesh &mesh_a = *space.parts()[a].mesh, &mesh_b = *space.parts()[b].mesh;
      const RigidTransform a_from_b = inverse(placed[a]) * placed[b];
      strict += in_contact(mesh_a, mesh_b, a_from_b, clearance, pair.filter);
      allowed_too += in_contact(mesh_a, mesh_b, a_from_b, clearance);
    }
    if (valid) {
      EXPECT_EQ(strict, 0) << "configuration " << i;
    } else {
      EXPECT_GT(allowed_too, 0) << "configuration " << i;
    }
  }
  EXPECT_GE(free, least_free);
}

TEST(LimbPlanningSpace, ForgetsNoPair) {
  expect_no_pair_forgotten(post_world(), 0.0, 100);
  expect_no_pair_forgotten(post_world(), 0.02, 100);
}

TEST(LimbPlanningSpace, SeesWhatIsInsideOfWhat) {
  // A closed room about it all: no surface is near.
  World room = post_world();
  room.actors.push_back(actor("room.glb", make_object("Room", box_shape({4, 4, 4}))));
  expect_no_pair_forgotten(room, 0.0, 0);
  // A hall about a hand at a time, and small things that an arm may hold inside.
  World hall = post_world();
  hall.actors.push_back(
      actor("hall.glb", make_object("Hall", box_shape({0.2f, 0.2f, 0.2f})), Vec3(0.45, 1.0, 0.2)));
  hall.actors.push_back(actor("bead.glb", make_object("Bead", box_shape({0.002f, 0.002f, 0.002f})),
                              Vec3(0.3, 1.3, 0.15)));
  expect_no_pair_forgotten(hall, 0.0, 20);
}

TEST(LimbPlanningSpace, SameAnswersInAnyOrder) {
  SceneCollision scene = scene_of(post_world());
  LimbPlanningSpace one = space_of(scene, 0.1, 0.9), other = space_of(scene, 0.1, 0.9);
  Random random(9);
  std::vector<Configuration> list;
  for (int i = 0; i < 400; ++i) list.push_back(random_configuration(random, 0.1, 0.9));
  std::vector<bool> forward;
  for (const auto& c : list) forward.push_back(one.valid(c));
  for (std::size_t i = list.size(); i-- > 0;) EXPECT_EQ(other.valid(list[i]), forward[i]);
}

TEST(LimbPlanningSpace, FarAwayAndScaledTheSame) {
  SceneCollision near = scene_of(post_world());
  World moved = post_world();
  for (Actor& a : moved.actors) a.world_from_file[3] += glm::dvec4(1e5, 2e4, -5e4, 0);
  SceneCollision far = scene_of(moved);
  LimbPlanningSpace a = space_of(near, 0.1, 0.9), b = space_of(far, 0.1, 0.9);
  Random random(11);
  for (int i = 0; i < 400; ++i) {
    const Configuration c = random_configuration(random, 0.1, 0.9);
    EXPECT_EQ(a.valid(c), b.valid(c)) << i;
  }
}

TEST(SkinDeviation, IsSmallAwayFromJointsAndLeavesTheSceneAsItWas) {
  SceneCollision scene = scene_of(post_world());
  std::vector<ContactSample> before, after;
  scene.contacts_at(0.4, 0, true, before);
  const SkinDeviation deviation = measure_skin_deviation(scene, 0, 0.4, 40, 3);
  scene.contacts_at(0.4, 0, true, after);
  EXPECT_EQ(before.size(), after.size());
  EXPECT_GT(deviation.measured, 1000u);
  EXPECT_LE(deviation.median, deviation.percentile_95);
  EXPECT_LE(deviation.percentile_95, deviation.largest);
  EXPECT_LT(deviation.percentile_95, 0.005);
  EXPECT_EQ(measure_skin_deviation(scene, 0, 0.4, 40, 3).largest, deviation.largest);
  EXPECT_EQ(measure_skin_deviation(scene, 4, 0.4, 40, 3).measured, 0u);
}

TEST(LimbPlanningSpace, HostileConfigurations) {
  SceneCollision scene = scene_of(post_world());
  LimbPlanningSpace space = space_of(scene, 0.1, 0.9);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Configuration c{state_at(scene, 0.5).q, nan};
  EXPECT_FALSE(space.valid(c));
  c.t = 0.5;
  EXPECT_TRUE(space.valid(c));
  c.q[2] = nan;
  EXPECT_FALSE(space.valid(c));
  c.q[2] = 1e300;
  EXPECT_NO_FATAL_FAILURE((void)space.valid(c));
  c.q.count = 2;
  EXPECT_FALSE(space.valid(c));
  std::vector<Vec3> points;
  space.metric_points({state_at(scene, 0.5).q, 0.5}, points);
  EXPECT_EQ(points.size(), 6u);
  // A window of no length, and negative lengths.
  LimbPlanningSpace instant = space_of(scene, 0.5, 0.5, {-1, nan});
  EXPECT_TRUE(instant.valid({state_at(scene, 0.5).q, 0.5}));
}

}  // namespace
}  // namespace elbowroom::test
