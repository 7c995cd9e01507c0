// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/unit/scene/figures.h"

namespace elbowroom {
namespace {

using test::add_joint;
using test::add_mesh;
using test::add_skin;
using test::globals_at;

void expect_at(const Vec3& p, const Vec3& expected, double tolerance = 1e-12) {
  EXPECT_LT(glm::distance(p, expected), tolerance)
      << p.x << " " << p.y << " " << p.z << " instead of " << expected.x << " " << expected.y << " "
      << expected.z;
}

// An upper bone from the origin to (1, 0, 0) and a lower one beyond.
Model two_bones() {
  Model model;
  add_joint(model, "upper", -1, {0, 0, 0});
  add_joint(model, "lower", 0, {1, 0, 0});
  add_skin(model, {0, 1});
  return model;
}

TEST(Deform, BentElbowByHand) {
  Model model = two_bones();
  add_mesh(model, 0, 0, {{0.5f, 0, 0}, {1.5f, 0, 0}, {2, 0.5f, 0}}, {0, 1, 1});
  Pose pose = rest_pose(model.skeleton);
  pose.local[1].rotation = glm::angleAxis(kPi / 2, Vec3(0, 0, 1));
  std::vector<Vec3> out;
  deform(model, model.meshes[0], pose, globals_at(model, pose), out);
  ASSERT_EQ(out.size(), 3u);
  expect_at(out[0], {0.5, 0, 0});
  expect_at(out[1], {1, 0.5, 0});
  expect_at(out[2], {0.5, 1, 0});
}

TEST(Deform, BlendsLinearly) {
  Model model = two_bones();
  const int mesh = add_mesh(model, 0, 0, {{1.5f, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {0, 0, 0});
  // A quarter follows the upper bone, three quarters the lower one.
  model.meshes[0].influences = {{0, 0, 0.25f}, {1, 1, 0.75f}, {0, 0, 1}, {0, 0, 1}};
  model.meshes[0].influence_begin = {0, 2, 3, 4};
  Pose pose = rest_pose(model.skeleton);
  pose.local[1].rotation = glm::angleAxis(kPi / 2, Vec3(0, 0, 1));
  std::vector<Vec3> out;
  deform(model, model.meshes[static_cast<std::size_t>(mesh)], pose, globals_at(model, pose), out);
  expect_at(out[0], {0.25 * 1.5 + 0.75 * 1.0, 0.75 * 0.5, 0});
}

TEST(Deform, ManyInfluencesOnOneVertex) {
  Model model;
  std::vector<int> joints;
  for (int i = 0; i < 9; ++i) joints.push_back(add_joint(model, "", -1, {0, 0, 0}));
  add_skin(model, joints);
  add_mesh(model, 0, 0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {0, 0, 0});
  auto& mesh = model.meshes[0];
  mesh.influences.clear();
  for (int i = 0; i < 9; ++i) mesh.influences.push_back({i, i, 1.0f / 9});
  mesh.influences.push_back({0, 0, 1});
  mesh.influences.push_back({0, 0, 1});
  mesh.influence_begin = {0, 9, 10, 11};
  Pose pose = rest_pose(model.skeleton);
  double sum = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    pose.local[i].translation.x = static_cast<double>(i * i);
    sum += static_cast<double>(i * i);
  }
  std::vector<Vec3> out;
  deform(model, mesh, pose, globals_at(model, pose), out);
  expect_at(out[0], {sum / 9, 0, 0});
}

TEST(Deform, FarFromTheOriginWeightsDontPull) {
  Model model = two_bones();
  add_mesh(model, 0, 0, {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {0, 0, 0});
  // float32 thirds sum to 1 - 3e-8 or so, which 10 km out would be a third of a millimetre.
  model.meshes[0].influences = {{0, 0, 0.1f}, {1, 1, 0.7f}, {0, 0, 0.2f}, {0, 0, 1}, {0, 0, 1}};
  model.meshes[0].influence_begin = {0, 3, 4, 5};
  Pose pose = rest_pose(model.skeleton);
  pose.local[0].translation = {10000, 0, 0};
  std::vector<Vec3> out;
  deform(model, model.meshes[0], pose, globals_at(model, pose), out);
  expect_at(out[0], {10001, 0, 0}, 1e-8);
}

TEST(Deform, TheSkinnedNodesOwnTransformCountsForNothing) {
  Model model = two_bones();
  const int node = add_joint(model, "mesh", -1, {7, 8, 9});
  link_skeleton(model.skeleton);
  add_mesh(model, node, 0, {{0.5f, 0, 0}, {1.5f, 0, 0}, {2, 0.5f, 0}}, {0, 1, 1});
  const Pose pose = rest_pose(model.skeleton);
  std::vector<Vec3> out;
  deform(model, model.meshes[0], pose, globals_at(model, pose), out);
  expect_at(out[0], {0.5, 0, 0});
}

TEST(Deform, InverseBindMatricesMayCarryScale) {
  // As a quantized mesh has it: integers, and the unit in the matrices.
  Model model = two_bones();
  for (Mat4& m : model.skins[0].inverse_bind) m = m * glm::scale(Mat4(1.0), Vec3(0.01));
  add_mesh(model, 0, 0, {{50, 0, 0}, {150, 0, 0}, {200, 50, 0}}, {0, 1, 1});
  const Pose pose = rest_pose(model.skeleton);
  std::vector<Vec3> out;
  deform(model, model.meshes[0], pose, globals_at(model, pose), out);
  expect_at(out[2], {2, 0.5, 0});
}

TEST(Deform, UnderMirroredAndUnevenScale) {
  Model model;
  add_joint(model, "armature", -1, {0, 0, 0});
  model.skeleton.joints[0].rest.scale = {-1, 2, 1};
  add_joint(model, "upper", 0, {0, 0, 0});
  add_joint(model, "lower", 1, {1, 0, 0});
  add_skin(model, {1, 2}, 0);
  add_mesh(model, 0, 0, {{0.5f, 0, 0}, {1.5f, 0, 0}, {2, 0.5f, 0}}, {0, 1, 1});
  Pose pose = rest_pose(model.skeleton);
  pose.local[2].rotation = glm::angleAxis(kPi / 2, Vec3(0, 0, 1));
  std::vector<Vec3> out;
  deform(model, model.meshes[0], pose, globals_at(model, pose), out);
  expect_at(out[1], {-1, 2 * 0.5, 0});
  expect_at(out[2], {-0.5, 2 * 1.0, 0});
}

TEST(Deform, RigidMeshFollowsItsNode) {
  Model model = two_bones();
  const int sword = add_joint(model, "sword", 1, {0, 0, 1});
  link_skeleton(model.skeleton);
  add_mesh(model, sword, -1, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  Pose pose = rest_pose(model.skeleton);
  pose.local[1].rotation = glm::angleAxis(kPi / 2, Vec3(0, 0, 1));
  std::vector<Vec3> out;
  deform(model, model.meshes[0], pose, globals_at(model, pose), out);
  expect_at(out[0], {1, 1, 1});
  expect_at(out[1], {0, 0, 1});
}

TEST(Deform, MorphsBeforeItSkins) {
  Model model = two_bones();
  add_mesh(model, 0, 0, {{1.5f, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 0, 0});
  Mesh& mesh = model.meshes[0];
  mesh.morphs.resize(2);
  mesh.morphs[0].offsets = {{0.5f, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  // The second target moves no position.
  mesh.morph_weights = {1, 1};
  Pose pose = rest_pose(model.skeleton);
  pose.local[1].rotation = glm::angleAxis(kPi / 2, Vec3(0, 0, 1));
  std::vector<Vec3> out;
  deform(model, mesh, pose, globals_at(model, pose), out);
  expect_at(out[0], {1, 1, 0});  // the mesh's own weight
  pose.morph_weights[0] = {0.5, 3};
  deform(model, mesh, pose, globals_at(model, pose), out);
  expect_at(out[0], {1, 0.75, 0});  // the pose's
  pose.morph_weights[0] = {-1};
  deform(model, mesh, pose, globals_at(model, pose), out);
  expect_at(out[0], {1, 0, 0});
}

}  // namespace
}  // namespace elbowroom
