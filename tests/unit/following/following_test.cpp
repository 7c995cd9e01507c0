// SPDX-License-Identifier: MIT
// Which joints follow a limb from elsewhere in the tree, and that they do.
#include "core/anatomy/following.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/animation/affine.h"
#include "core/base/random.h"
#include "core/collision/body_parts.h"
#include "tests/unit/following/detached_rig.h"

namespace elbowroom::test {
namespace {

Limb limb_of(const DetachedRig& rig, LimbKind kind) {
  for (const Limb& limb : find_limbs(*rig.model, rig.character()).limbs)
    if (limb.kind == kind) return limb;
  ADD_FAILURE() << limb_id(kind) << " is not found";
  return {};
}

// "Foot.L with LowerLeg_end.L", ...
std::vector<std::string> followers(const DetachedRig& rig, LimbKind kind) {
  const auto name = [&](int joint) {
    return rig.model->skeleton.joints[static_cast<std::size_t>(joint)].name;
  };
  std::vector<std::string> all;
  for (const FollowingJoint& own : limb_of(rig, kind).following)
    all.push_back(name(own.joint) + " with " + name(own.serves));
  return all;
}

using Names = std::vector<std::string>;

TEST(FollowingJoints, AreFoundByNameAndPlace) {
  for (const double scale : {1.0, 100.0}) {
    for (const bool mirrored : {false, true}) {
      SCOPED_TRACE(testing::Message() << scale << (mirrored ? " mirrored" : ""));
      const DetachedRig feet = make_detached_rig({.scale = scale, .mirrored = mirrored});
      EXPECT_EQ(followers(feet, LimbKind::left_leg), Names{"Foot.L with LowerLeg_end.L"});
      EXPECT_EQ(followers(feet, LimbKind::right_leg), Names{"Foot.R with LowerLeg_end.R"});
      EXPECT_EQ(followers(feet, LimbKind::left_arm), Names{});
      const LimbFindings findings = find_limbs(*feet.model, feet.character());
      for (const std::string& warning : findings.warnings)
        EXPECT_EQ(warning.find("follow"), std::string::npos) << warning;
      EXPECT_NE(limb_of(feet, LimbKind::left_leg)
                    .why.find("'Foot.L', which hangs from "
                              "'FootControls', with "),
                std::string::npos);
    }
  }
  const DetachedRig hands = make_detached_rig({.detached_hand = true, .twist = true});
  EXPECT_EQ(followers(hands, LimbKind::left_arm),
            (Names{"Hand.L with LowerArm_end.L", "UpperArmTwist.L with UpperArm.L"}));
  const DetachedRig garment = make_detached_rig({.garment = true, .plain = true});
  EXPECT_EQ(followers(garment, LimbKind::right_leg),
            (Names{"trousers 1.R with UpperLeg.R", "trousers 2.R with LowerLeg.R",
                   "trousers 3.R with Foot.R"}));
  EXPECT_EQ(followers(make_detached_rig({.plain = true}), LimbKind::left_leg), Names{});
}

TEST(FollowingJoints, WhatCannotFollowIsSaid) {
  for (const RigOptions& options :
       {RigOptions{.matrix_foot = true}, RigOptions{.foot_parent_scale = Vec3(1, 2, 1)}}) {
    const DetachedRig rig = make_detached_rig(options);
    EXPECT_EQ(followers(rig, LimbKind::left_leg), Names{});
    const LimbFindings findings = find_limbs(*rig.model, rig.character());
    EXPECT_EQ(std::count_if(findings.warnings.begin(), findings.warnings.end(),
                            [](const std::string& warning) {
                              return warning.rfind("left_leg: 'Foot.L'", 0) == 0 &&
                                     warning.find("will not follow it: ") != std::string::npos;
                            }),
              1);
  }
}

TEST(FollowingJoints, ChainsNamedByHandAreFollowedToo) {
  const DetachedRig rig = make_detached_rig();
  const auto leg = limb_between(*rig.model, rig.character(), "left_leg",
                                {"UpperLeg.L", "LowerLeg.L", "LowerLeg_end.L"});
  ASSERT_TRUE(leg) << leg.error().message();
  EXPECT_EQ(leg->following,
            (std::vector<FollowingJoint>{{rig.joint("Foot.L"), rig.joint("LowerLeg_end.L")}}));
}

// Hands that hang from the root go with the spine that their arms hang from.
TEST(FollowingJoints, ChainsTakeAlongWhatFollowsLimbsBelow) {
  const DetachedRig rig = make_detached_rig({.detached_hand = true, .twist = true});
  const LimbOverrides spine{{"spine", {"Hips", "Spine", "Head"}}};
  const auto set = limb_by_name(*rig.model, rig.character(), "spine", spine);
  const auto named = limb_by_name(*rig.model, rig.character(), "Hips..Head");
  const auto arm = limb_by_name(*rig.model, rig.character(), "left_arm", spine);
  ASSERT_TRUE(set) << set.error().message();
  ASSERT_TRUE(named) << named.error().message();
  ASSERT_TRUE(arm) << arm.error().message();
  for (const std::string side : {".L", ".R"})
    for (const auto& [joint, serves] :
         {std::pair("Hand", "LowerArm_end"), std::pair("Foot", "LowerLeg_end"),
          std::pair("UpperArmTwist", "UpperArm")}) {
      const FollowingJoint own{rig.joint(joint + side), rig.joint(serves + side)};
      const bool inside = rig.model->skeleton.is_within(own.joint, rig.joint("Hips"));
      for (const Limb& chain : {*set, *named})
        EXPECT_EQ(std::count(chain.following.begin(), chain.following.end(), own), inside ? 0 : 1)
            << joint << side << " and " << chain.name;
    }
  EXPECT_NE(named->why.find("with limbs that hang from it"), std::string::npos) << named->why;
  EXPECT_TRUE(arm->follows(rig.joint("Hand.L"))) << "still";
  // An arm's own hand stays on the arm's side.
  const LimbFindings findings = find_limbs(*rig.model, rig.character(), spine);
  const auto sides = limb_sides(rig.model->skeleton, findings.limbs);
  const LimbSide hand = sides[static_cast<std::size_t>(rig.joint("Hand.L"))];
  EXPECT_EQ(findings.limbs[static_cast<std::size_t>(hand.limb)].name, "left_arm");
  EXPECT_EQ(hand.segment, kEndSegment);
}

// world(f) = world(served) · clip_world(served)⁻¹ · clip_world(f), whatever is done to the limb.
TEST(FollowingJoints, KeepTheirRelation) {
  Random random(5);
  for (const double scale : {1.0, 0.01, 100.0}) {
    for (const bool mirrored : {false, true}) {
      SCOPED_TRACE(testing::Message() << scale << (mirrored ? " mirrored" : ""));
      const DetachedRig rig = make_detached_rig({.scale = scale,
                                                 .mirrored = mirrored,
                                                 .detached_hand = true,
                                                 .garment = true,
                                                 .twist = true});
      const Skeleton& skeleton = rig.model->skeleton;
      const auto clip = walk_of(rig, FootKeys::linear);
      const LimbFindings findings =
          find_limbs(*rig.model, rig.character(), {{"spine", {"Hips", "Spine", "Head"}}});
      ASSERT_EQ(findings.limbs.size(), 5u);
      for (const Limb& limb : findings.limbs) {
        ASSERT_FALSE(limb.following.empty()) << limb.name;
        const auto fitted = fit_limb_model(*rig.model, rig.character(), limb, findings);
        ASSERT_TRUE(fitted) << fitted.error().message();
        for (int trial = 0; trial < 10; ++trial) {
          Pose source = rest_pose(skeleton);
          sample_clip(*clip, random.uniform(0, 2), source);
          Pose pose = source;
          LimbState state = limb_state(*fitted, source);
          for (int d = 0; d < state.q.count; ++d) state.q[d] += random.uniform(-0.7, 0.7);
          apply_limb_state(*fitted, state, skeleton, pose);
          std::vector<Mat4> before, after;
          compute_globals(skeleton, source, Mat4(1.0), before);
          compute_globals(skeleton, pose, Mat4(1.0), after);
          for (int joint = 0; joint < skeleton.size(); ++joint) {
            const auto j = static_cast<std::size_t>(joint);
            int serves = -1;
            for (const FollowingJoint& own : limb.following)
              if (skeleton.is_within(joint, own.joint)) serves = own.serves;
            Mat4 wanted = before[j];
            if (serves >= 0)
              wanted = after[static_cast<std::size_t>(serves)] *
                       glm::inverse(before[static_cast<std::size_t>(serves)]) * before[j];
            else if (skeleton.is_within(joint, limb.root))
              continue;
            for (int c = 0; c < 4; ++c)
              EXPECT_LT(glm::length(after[j][c] - wanted[c]), 1e-9 * scale)
                  << skeleton.joints[j].name;
            EXPECT_EQ(pose.local[j].scale, source.local[j].scale);
          }
        }
      }
    }
  }
}

TEST(FollowingJoints, SpacesWithoutVolumeLeaveTheClip) {
  const Transform own{Vec3(1, 2, 3), glm::angleAxis(0.4, Vec3(0, 1, 0)), Vec3(1.0)};
  Mat4 flat(1.0), broken(1.0);
  flat[1] = glm::dvec4(0);
  broken[0][0] = std::numeric_limits<double>::quiet_NaN();
  for (const Mat4& bad : {flat, broken}) {
    EXPECT_EQ(following_local(bad, Mat4(1.0), Mat4(1.0), Mat4(1.0), own), own);
    EXPECT_EQ(following_local(Mat4(1.0), Mat4(1.0), bad, Mat4(1.0), own), own);
  }
  EXPECT_EQ(following_local(Mat4(1.0), broken, Mat4(1.0), Mat4(1.0), own), own);
}

}  // namespace
}  // namespace elbowroom::test
