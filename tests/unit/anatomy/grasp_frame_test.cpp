// SPDX-License-Identifier: MIT
// The palm's frame on a body of known shape: T-pose, palms down, thumbs forward.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/anatomy/bind_geometry.h"
#include "tests/unit/anatomy/synthetic_body.h"

namespace elbowroom {
namespace {

using test::Body;
using test::BodyOptions;

// A slab that follows a joint: the hand of which is known where its palm is. World of the bind
// pose, before the root node's own placement.
void add_slab(Body& body, int joint, const Vec3& lower, const Vec3& upper, const Mat4& placement) {
  Mesh mesh;
  mesh.name = "slab";
  mesh.node = 0;
  mesh.skin = 0;
  Model& model = body.model;
  const Skin& skin = model.skins[0];
  const auto slot = static_cast<std::int32_t>(
      std::find(skin.joints.begin(), skin.joints.end(), joint) - skin.joints.begin());
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1) != 0 ? upper.x : lower.x, (corner & 2) != 0 ? upper.y : lower.y,
                 (corner & 4) != 0 ? upper.z : lower.z);
    mesh.positions.emplace_back(glm::vec3(Vec3(placement * glm::dvec4(p, 1))));
    mesh.influence_begin.push_back(static_cast<std::uint32_t>(corner));
    mesh.influences.push_back({joint, slot, 1.0f});
  }
  mesh.influence_begin.push_back(8);
  for (const auto& [a, b, c, d] :
       {std::array{0, 1, 3, 2}, std::array{4, 6, 7, 5}, std::array{0, 4, 5, 1},
        std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 5, 7, 3}}) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  }
  model.characters[0].meshes.push_back(static_cast<int>(model.meshes.size()));
  model.meshes.push_back(mesh);
}

// Hands 2 cm thick about the bones, feet with their soles on the ground.
void add_hands_and_feet(Body& body) {
  std::vector<Mat4> globals;
  compute_globals(body.model.skeleton, rest_pose(body.model.skeleton), Mat4(1.0), globals);
  const Mat4 placement = globals[0];
  for (const double side : {1.0, -1.0}) {
    const auto& joints = side > 0 ? body.left : body.right;
    const auto x = [&](double a, double b) { return std::minmax({side * a, side * b}); };
    const auto hand = x(0.70, 0.84), foot = x(0.06, 0.14);
    add_slab(body, joints[test::kHand], Vec3(hand.first, 1.44, -0.04),
             Vec3(hand.second, 1.46, 0.04), placement);
    add_slab(body, joints[test::kFoot], Vec3(foot.first, 0, -0.08), Vec3(foot.second, 0.1, 0.2),
             placement);
  }
}

struct World {
  GraspPlace place;
  Vec3 x, y;
};

World world_of(const Body& body, LimbKind kind) {
  const LimbModel limb = test::fit(body, kind);
  if (!limb.grasp) {
    ADD_FAILURE() << limb.grasp.error().message();
    return {};
  }
  std::vector<Mat4> globals;
  compute_globals(body.model.skeleton, rest_pose(body.model.skeleton), Mat4(1.0), globals);
  World world;
  world.place = grasp_place(*limb.grasp, globals[static_cast<std::size_t>(limb.limb.end)]);
  world.x = world.place.orientation * Vec3(1, 0, 0);
  world.y = world.place.orientation * Vec3(0, 1, 0);
  return world;
}

std::vector<BodyOptions> bodies() {
  std::vector<BodyOptions> all(6);
  all[1].axes_seed = 7;
  all[2].axes_seed = 8;
  all[2].root_scale = Vec3(100);
  all[3].axes_seed = 9;
  all[3].root_scale = Vec3(0.01);
  all[3].yaw = 2;
  all[4].axes_seed = 10;
  all[4].root_scale = Vec3(-1, 1, 1);  // left becomes right
  all[5].left = {"LeftShoulder",   "LeftArm",   "LeftForeArm", "LeftHand", "LeftHandIndex1",
                 "LeftHandThumb1", "LeftUpLeg", "LeftLeg",     "LeftFoot", "LeftToeBase"};
  all[5].right = {"RightShoulder",   "RightArm",   "RightForeArm", "RightHand", "RightHandIndex1",
                  "RightHandThumb1", "RightUpLeg", "RightLeg",     "RightFoot", "RightToeBase"};
  return all;
}

TEST(GraspFrame, ThePalmIsWhereTheSlabsLowerFaceIs) {
  for (const BodyOptions& options : bodies()) {
    Body body = test::make_body(options);
    add_hands_and_feet(body);
    std::vector<Mat4> globals;
    compute_globals(body.model.skeleton, rest_pose(body.model.skeleton), Mat4(1.0), globals);
    const Mat3 root(globals[0]);
    const double size = std::abs(options.root_scale.y);
    for (const double side : {1.0, -1.0}) {
      const World palm = world_of(body, side > 0 ? LimbKind::left_arm : LimbKind::right_arm);
      // Index root at (0.8, 1.45, -0.01) from the wrist at (0.71, 1.45, 0): half way, and down.
      const Vec3 wanted = root * Vec3(side * 0.755, 1.44, -0.005);
      EXPECT_LT(glm::distance(palm.place.position, wanted), 1e-3 * size);
      EXPECT_GT(glm::dot(palm.y, glm::normalize(root * Vec3(0, -1, 0))), 0.99);
      EXPECT_GT(glm::dot(palm.x, glm::normalize(root * Vec3(side, 0, 0))), 0.99);
      EXPECT_LT(palm.place.beyond, 2e-3 * size);

      const World sole = world_of(body, side > 0 ? LimbKind::left_leg : LimbKind::right_leg);
      EXPECT_LT(glm::distance(sole.place.position, root * Vec3(side * 0.1, 0, 0.05)), 1e-3 * size);
      EXPECT_GT(glm::dot(sole.y, glm::normalize(root * Vec3(0, -1, 0))), 0.999);
      EXPECT_GT(glm::dot(sole.x, glm::normalize(root * Vec3(0, 0, 1))), 0.99);
    }
  }
}

TEST(GraspFrame, WithoutFingerJointsTheSkinAndTheElbowTell) {
  BodyOptions options;
  options.axes_seed = 3;
  // Names that say nothing of fingers; one joint beyond the wrist and one beside it.
  options.left[test::kIndex] = "knob_l";
  options.left[test::kThumb] = "peg_l";
  Body body = test::make_body(options);
  add_hands_and_feet(body);
  const World palm = world_of(body, LimbKind::left_arm);
  EXPECT_GT(palm.y.y, -1.01);
  EXPECT_LT(palm.y.y, -0.9);
  EXPECT_GT(palm.x.x, 0.8);
  EXPECT_NEAR(palm.place.position.y, 1.44, 0.01);
}

TEST(GraspFrame, WithoutSkinAShareOfTheLengthIsTaken) {
  const Body body = test::make_body({});
  const World palm = world_of(body, LimbKind::left_arm);
  EXPECT_LT(palm.y.y, -0.99);
  EXPECT_LT(palm.place.position.y, 1.45 - 0.005);
  EXPECT_GT(palm.place.position.y, 1.45 - 0.03);
  EXPECT_EQ(palm.place.beyond, 0);
}

TEST(GraspFrame, EndForGraspIsTheInverseOfGraspPlace) {
  Random random(5);
  for (const Vec3 scale : {Vec3(1), Vec3(100), Vec3(-0.3), Vec3(-2, 2, 2)}) {
    BodyOptions options;
    options.axes_seed = 11;
    options.root_scale = scale;
    Body body = test::make_body(options);
    add_hands_and_feet(body);
    const LimbModel limb = test::fit(body, LimbKind::right_arm);
    ASSERT_TRUE(limb.grasp.ok()) << limb.grasp.error().message();
    const auto end = static_cast<std::size_t>(limb.limb.end);
    Pose pose = rest_pose(body.model.skeleton);
    std::vector<Mat4> rest, posed;
    compute_globals(body.model.skeleton, pose, Mat4(1.0), rest);
    for (int i = 0; i < 50; ++i) {
      for (const JointModel& joint : limb.joints)
        pose.local[static_cast<std::size_t>(joint.joint)].rotation = quat_from_rotation_vector(
            Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)));
      compute_globals(body.model.skeleton, pose, Mat4(1.0), posed);
      const GraspPlace place = grasp_place(*limb.grasp, posed[end]);
      const EndPlacement back =
          end_for_grasp(*limb.grasp, rest[end], place.position, place.orientation);
      EXPECT_LT(glm::distance(back.position, Vec3(posed[end][3])), 1e-9 * glm::length(scale));
      EXPECT_LT(angle_between(back.rotation, rotation_of(posed[end])), 1e-9);
    }
  }
}

TEST(GraspFrame, SaysWhyItCannotBeTold) {
  Body body = test::make_body({});
  const LimbModel limb = test::fit(body, LimbKind::left_arm);
  BoundFigure figure = bound_figure(body.model, body.character());
  GraspEvidence evidence{figure, limb.limb};
  figure.globals[static_cast<std::size_t>(limb.limb.end)] =
      Mat4(std::numeric_limits<double>::quiet_NaN());
  const auto broken = fit_grasp_frame(evidence);
  ASSERT_FALSE(broken.ok());
  EXPECT_NE(broken.error().what.find("palm"), std::string::npos);
  // A joint with nothing beyond it.
  figure.globals = bind_globals(body.model, body.character());
  Limb stump = limb.limb;
  stump.end = body.left[test::kIndex];
  const GraspEvidence bare{figure, stump};
  EXPECT_FALSE(fit_grasp_frame(bare).ok());
}

}  // namespace
}  // namespace elbowroom
