// SPDX-License-Identifier: MIT
// Rigs whose right side is the left one under a negative scale, as some tools mirror them: the same
// local transforms on both sides, the right ones below a joint that turns the axes over.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/unit/rigs/real_skeletons.h"
#include "tests/unit/rigs/skeleton_text.h"

namespace elbowroom::test {
namespace {

// The image of a left joint's name, or nothing.
std::string right_name(const std::string& name) {
  const std::size_t at = name.find(".L");
  return at == std::string::npos ? "" : name.substr(0, at) + ".R" + name.substr(at + 2);
}

// Makes each right joint the mirror image of its left one in the plane x = 0.
void mirror_by_scale(MadeRig& rig) {
  Skeleton& skeleton = rig.model.skeleton;
  std::vector<Mat4> globals;
  compute_globals(skeleton, rest_pose(skeleton), Mat4(1.0), globals);
  Mat4 mirror(1.0);
  mirror[0][0] = -1;
  for (std::size_t left = 0; left < rig.row_names.size(); ++left) {
    const std::string name = right_name(rig.row_names[left]);
    if (name.empty()) continue;
    const int right = rig.joint(name, false);
    ASSERT_GE(right, 0) << name;
    Joint& joint = skeleton.joints[static_cast<std::size_t>(right)];
    const Joint& image = skeleton.joints[left];
    const int parent = image.parent;
    if (!right_name(rig.row_names[static_cast<std::size_t>(parent)]).empty()) {
      joint.rest = image.rest;
      continue;
    }
    Mat4 local =
        glm::inverse(globals[static_cast<std::size_t>(joint.parent)]) * mirror * globals[left];
    local[0] = -local[0];  // into the scale
    joint.rest.translation = Vec3(local[3]);
    joint.rest.rotation = glm::normalize(glm::quat_cast(Mat3(local)));
    joint.rest.scale = Vec3(-1, 1, 1);
  }
  compute_globals(skeleton, rest_pose(skeleton), Mat4(1.0), globals);
  for (Skin& skin : rig.model.skins) {
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
      skin.inverse_bind[i] = glm::inverse(globals[static_cast<std::size_t>(skin.joints[i])]);
  }
}

TEST(MirroredLimbs, TheSameLocalRotationsAreTheSameNumbers) {
  for (const RealSkeleton& skeleton : real_skeletons()) {
    const std::string name = skeleton.name;
    if (name != "Rigify, human") continue;  // has fingers and toes on both sides
    SCOPED_TRACE(name);
    MadeRig rig = rig_of(read_skeleton(skeleton.text));
    mirror_by_scale(rig);
    const LimbFindings findings = find_limbs(rig.model, rig.character());
    EXPECT_TRUE(findings.warnings.empty()) << findings.warnings.front();
    ASSERT_EQ(findings.limbs.size(), 4u);
    for (const std::size_t pair : {std::size_t{0}, std::size_t{2}}) {
      const Limb &left = findings.limbs[pair], &right = findings.limbs[pair + 1];
      SCOPED_TRACE(left.name);
      EXPECT_EQ(right_name(rig.row_names[static_cast<std::size_t>(left.root)]),
                rig.row_names[static_cast<std::size_t>(right.root)]);
      const auto a = fit_limb_model(rig.model, rig.character(), left, findings);
      const auto b = fit_limb_model(rig.model, rig.character(), right, findings);
      ASSERT_TRUE(a.ok() && b.ok());
      Random random(5);
      for (int n = 0; n < 100; ++n) {
        // Any rotations of the left limb, and the same ones of the right limb.
        Pose pose = rest_pose(rig.model.skeleton);
        for (std::size_t k = 0; k < 3; ++k) {
          const auto l = static_cast<std::size_t>(a->joints[k].joint);
          const auto r = static_cast<std::size_t>(b->joints[k].joint);
          const Quat turn = glm::normalize(
              Quat(2, random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
          pose.local[l].rotation = glm::normalize(pose.local[l].rotation * turn);
          // The topmost right joint stands under the mirror, those below it in it.
          const bool below = rig.model.skeleton.joints[r].rest.scale.x > 0;
          const Quat image = below ? turn : Quat(turn.w, turn.x, -turn.y, -turn.z);
          pose.local[r].rotation = glm::normalize(pose.local[r].rotation * image);
        }
        const LimbState x = limb_state(*a, pose), y = limb_state(*b, pose);
        ASSERT_EQ(a->dof_count(), b->dof_count());
        for (int d = 0; d < a->dof_count(); ++d) EXPECT_NEAR(x.q[d], y.q[d], 1e-9) << d;
        Pose again = rest_pose(rig.model.skeleton);
        apply_limb_state(*b, y, again);
        for (std::size_t k = 0; k < 3; ++k) {
          const auto r = static_cast<std::size_t>(b->joints[k].joint);
          EXPECT_GT(std::abs(glm::dot(again.local[r].rotation, pose.local[r].rotation)), 1 - 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace elbowroom::test
