// SPDX-License-Identifier: MIT
// The same scene elsewhere, larger, smaller and mirrored has the same contacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

struct Told {
  std::string part_a, part_b;
  double begin, end, depth;
};

// The lowering arm hits a post on its way and brushes the thigh at the end; everything is placed by
// `place` in its world.
std::vector<Told> contacts_of(double scale, const Mat4& place) {
  Shape shape = box_shape({0.03f, 0.03f, 0.03f});
  for (auto& p : shape.positions) p *= static_cast<float>(scale);
  const Vec3 at(0.2 + 0.6 * std::cos(0.7), 1.4 - 0.6 * std::sin(0.7), 0);
  World world = world_of(make_figure({.scale = scale}), swing_clip({0, 1}, {0, -kPi / 2}),
                         {actor("post.glb", make_object("Post", shape), at * scale)});
  for (Actor& a : world.actors) a.world_from_file = place * a.world_from_file;
  SceneCollision scene = scene_of(world);
  std::vector<Told> told;
  for (const auto& i : scene.scan(0, 1, 60, -1, true))
    if (!i.deepest.allowed || i.deepest.reason == AllowedReason::clip)
      told.push_back(
          {i.deepest.part_a, i.deepest.part_b, i.begin, i.end, i.deepest.depth / scene.height()});
  std::sort(told.begin(), told.end(), [](const Told& a, const Told& b) {
    return std::tie(a.part_a, a.part_b) < std::tie(b.part_a, b.part_b);
  });
  return told;
}

void expect_same(const std::vector<Told>& a, const std::vector<Told>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].part_a, b[i].part_a);
    EXPECT_EQ(a[i].part_b, b[i].part_b);
    EXPECT_NEAR(a[i].begin, b[i].begin, 2.1e-4);
    EXPECT_NEAR(a[i].end, b[i].end, 2.1e-4);
    EXPECT_NEAR(a[i].depth, b[i].depth, 2e-5);
  }
}

class Invariance : public ::testing::Test {
 protected:
  std::vector<Told> plain = contacts_of(1, Mat4(1.0));
};

TEST_F(Invariance, ThereIsSomethingToTell) {
  ASSERT_GE(plain.size(), 2u);
  EXPECT_TRUE(std::any_of(plain.begin(), plain.end(),
                          [](const Told& t) { return t.part_b == "post.glb/Post"; }));
  EXPECT_TRUE(std::any_of(plain.begin(), plain.end(),
                          [](const Told& t) { return t.part_b == "Ada/Hips"; }));
}

TEST_F(Invariance, AHundredKilometresAway) {
  Mat4 far(1.0);
  far[3] = glm::dvec4(1e5, -3e4, 7e4, 1);
  expect_same(plain, contacts_of(1, far));
}

TEST_F(Invariance, InCentimetresAndInHectometres) {
  expect_same(plain, contacts_of(100, Mat4(1.0)));
  expect_same(plain, contacts_of(0.01, Mat4(1.0)));
}

TEST_F(Invariance, Mirrored) {
  Mat4 mirror(1.0);
  mirror[0][0] = -1;
  expect_same(plain, contacts_of(1, mirror));
}

TEST_F(Invariance, TurnedAndScaledByItsPlacement) {
  Mat4 turned(glm::mat3_cast(quat_from_rotation_vector(Vec3(0.4, 1.1, -0.3))) * 7.0);
  turned[3] = glm::dvec4(3, 2, 1, 1);
  expect_same(plain, contacts_of(1, turned));
}

}  // namespace
}  // namespace elbowroom::test
