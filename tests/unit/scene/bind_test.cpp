// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/unit/scene/figures.h"

namespace elbowroom {
namespace {

using test::add_joint;
using test::add_mesh;
using test::add_skin;

void expect_at(const Mat4& m, const Vec3& expected, double tolerance = 1e-9) {
  EXPECT_LT(glm::distance(Vec3(m[3]), expected), tolerance)
      << m[3].x << " " << m[3].y << " " << m[3].z;
}

// Hips at 1, head at 2, a hand at (1, 2, 0), all below an armature that is scaled by `unit` and
// stands at x = 5; bound like this.
Model figure(double unit = 1) {
  Model model;
  const int armature = add_joint(model, "armature", -1, {5, 0, 0});
  model.skeleton.joints[0].rest.scale = Vec3(unit);
  const int hips = add_joint(model, "hips", armature, Vec3(0, 1, 0) / unit);
  add_joint(model, "head", hips, Vec3(0, 1, 0) / unit);
  add_joint(model, "hand", hips, Vec3(1, 1, 0) / unit);
  add_joint(model, "tip", 3, Vec3(0.5, 0, 0) / unit);  // of no skin
  add_skin(model, {1, 2, 3}, armature);
  const auto u = static_cast<float>(unit);
  add_mesh(model, armature, 0, {{0, 0, 0}, {0, 2.5f / u, 0}, {1 / u, 2 / u, 0}}, {0, 1, 2});
  group_characters_and_objects(model);
  return model;
}

TEST(BindGlobals, AreTheRestPoseWhereTheyAgree) {
  for (const double unit : {1.0, 100.0, 0.01}) {
    const Model model = figure(unit);
    ASSERT_EQ(model.characters.size(), 1u);
    const auto bind = bind_globals(model, model.characters[0]);
    expect_at(bind[1], {5, 1, 0});
    expect_at(bind[2], {5, 2, 0});
    expect_at(bind[3], {6, 2, 0});
    expect_at(bind[4], {6.5, 2, 0});
    EXPECT_NEAR(model.characters[0].height, 2.5, 1e-6) << unit;
  }
}

TEST(BindGlobals, AreThereThoughTheRestPoseIsAFrameOfAClip) {
  Model model = figure();
  // The rest pose crouches, leans and lowers the arm.
  model.skeleton.joints[1].rest.translation = {0, 0.5, 0};
  model.skeleton.joints[1].rest.rotation = glm::angleAxis(0.4, Vec3(1, 0, 0));
  model.skeleton.joints[3].rest.translation = {0.2, 0.3, 0};
  const auto bind = bind_globals(model, model.characters[0]);
  expect_at(bind[1], {5, 1, 0});
  expect_at(bind[2], {5, 2, 0});
  expect_at(bind[3], {6, 2, 0});
  group_characters_and_objects(model);
  EXPECT_NEAR(model.characters[0].height, 2.5, 1e-6);
}

TEST(BindGlobals, FollowTheRootWhereTheMeshsNodeIsNonsense) {
  Model model = figure();
  model.skeleton.joints[1].rest.translation = {0, 0.5, 0};
  model.skeleton.joints[3].rest.translation = {0.2, 0.3, 0};
  // Players ignore this node, so its transform may be anything.
  const int stray = add_joint(model, "stray", -1, {0, 0, 0});
  model.skeleton.joints[static_cast<std::size_t>(stray)].rest.rotation =
      glm::angleAxis(kPi / 2, Vec3(1, 0, 0));
  link_skeleton(model.skeleton);
  model.meshes[0].node = stray;
  const auto bind = bind_globals(model, model.characters[0]);
  expect_at(bind[1], {5, 0.5, 0});
  expect_at(bind[2], {5, 1.5, 0});
  expect_at(bind[3], {6, 1.5, 0});
}

TEST(BindGlobals, AreFreeOfAQuantizedMeshsScale) {
  Model model = figure();
  const Mat4 unpack =
      glm::translate(Mat4(1.0), Vec3(-1, 0, 0)) * glm::scale(Mat4(1.0), Vec3(0.001));
  for (Mat4& m : model.skins[0].inverse_bind) m = m * unpack;
  const auto bind = bind_globals(model, model.characters[0]);
  expect_at(bind[3], {6, 2, 0});
  EXPECT_NEAR(glm::length(Vec3(bind[3][0])), 1, 1e-9);
}

TEST(BindGlobals, WithoutMatricesAreTheRestPose) {
  Model model = figure();
  for (Mat4& m : model.skins[0].inverse_bind) m = Mat4(1.0);
  const auto bind = bind_globals(model, model.characters[0]);
  expect_at(bind[3], {6, 2, 0});
  for (Mat4& m : model.skins[0].inverse_bind) m = Mat4(0.0);  // singular
  expect_at(bind_globals(model, model.characters[0])[3], {6, 2, 0});
}

TEST(BindGlobals, OfSeveralSkinsLieInOneSpace) {
  Model model = figure();
  // A second mesh, bound in a space of its own, shares the hand and adds the tip.
  const int glove = add_joint(model, "glove", -1, {-3, 0, 0});
  add_skin(model, {3, 4}, glove);
  add_mesh(model, glove, 1, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {0, 1, 0});
  group_characters_and_objects(model);
  ASSERT_EQ(model.characters.size(), 1u);
  EXPECT_EQ(model.characters[0].skins, (std::vector<int>{0, 1}));
  const auto bind = bind_globals(model, model.characters[0]);
  expect_at(bind[4], {6.5, 2, 0});
}

}  // namespace
}  // namespace elbowroom
