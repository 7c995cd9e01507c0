// SPDX-License-Identifier: MIT
// How deep two surfaces are in each other, and the quicker question whether it is more than that.
#include "core/collision/contact_depth.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

// A rigid body of one shape, placed where its actor stands.
CollisionBody body_of(const std::shared_ptr<const Model>& model, const Mat4& place) {
  World world;
  Actor one = actor("thing.glb", model);
  one.world_from_file = place;
  world.actors.push_back(one);
  std::vector<ActorState> states;
  world_state_at(world, 0, states);
  std::vector<BodyTriangle> triangles;
  int node = -1;
  for (const Mesh& mesh : model->meshes) node = std::max(node, mesh.node);
  for (std::uint32_t t = 0; t < model->meshes.front().triangles.size(); ++t)
    triangles.push_back({0, t, 0, node});
  auto body = CollisionBody::build(one, 0, false, node, triangles, states.front(), 0.2, 1e-6);
  EXPECT_TRUE(body.ok());
  body->place(states.front(), Vec3(0.0));
  return std::move(*body);
}

std::vector<std::uint16_t> all_patches(const CollisionBody& body) {
  std::vector<std::uint16_t> all;
  for (int p = 0; p < body.patch_count(); ++p) all.push_back(static_cast<std::uint16_t>(p));
  return all;
}

TEST(ContactDepth, OfASphereInABlockIsHowFarItIsIn) {
  const auto block = make_object("Block", box_shape({1.0f, 1.0f, 1.0f}));
  const auto ball = make_object("Ball", sphere_shape(0.2f, 24, 32));
  const CollisionBody a = body_of(block, Mat4(1.0));
  for (const double in : {0.01, 0.05, 0.15}) {
    const CollisionBody b = body_of(ball, glm::translate(Mat4(1.0), Vec3(1.2 - in, 0, 0)));
    EXPECT_NEAR(contact_depth(a, all_patches(a), b, all_patches(b)), in, 0.003);
  }
  const CollisionBody apart = body_of(ball, glm::translate(Mat4(1.0), Vec3(1.3, 0, 0)));
  EXPECT_EQ(contact_depth(a, all_patches(a), apart, all_patches(apart)), 0);
}

TEST(ContactDepth, DeeperThanIsTheSameQuestion) {
  Random random(3);
  const auto ball = make_object("Ball", sphere_shape(0.3f, 16, 24));
  const auto block = make_object("Block", box_shape({0.4f, 0.1f, 0.3f}));
  int deep = 0;
  for (int round = 0; round < 60; ++round) {
    Mat4 place = glm::translate(
        Mat4(1.0),
        Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4), random.uniform(-0.5, 0.5)));
    place = place * glm::mat4_cast(quat_from_rotation_vector(
                        Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2))));
    const CollisionBody a = body_of(ball, Mat4(1.0)), b = body_of(block, place);
    std::vector<std::uint16_t> of_a, of_b;
    for (const std::uint16_t p : all_patches(a))
      if (random.uniform() < 0.7) of_a.push_back(p);
    for (const std::uint16_t p : all_patches(b))
      if (random.uniform() < 0.7) of_b.push_back(p);
    const double depth = contact_depth(a, of_a, b, of_b);
    deep += depth > 0;
    for (const double limit : {0.0, 0.5 * depth, depth * (1 - 1e-9), depth, depth * (1 + 1e-9),
                               2 * depth, random.uniform(0, 0.3)})
      EXPECT_EQ(deeper_than(limit, a, of_a, b, of_b), depth > limit) << round << " " << limit;
  }
  EXPECT_GT(deep, 20);
}

}  // namespace
}  // namespace elbowroom::test
