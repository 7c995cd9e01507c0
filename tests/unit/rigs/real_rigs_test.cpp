// SPDX-License-Identifier: MIT
// The limbs of rigs that exist: by what their joints are called, and by their shape alone.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/rigs/real_skeletons.h"
#include "tests/unit/rigs/skeleton_text.h"

namespace elbowroom::test {
namespace {

std::string place_name(const MadeRig& rig, int joint) {
  return joint < 0 ? "none" : rig.row_names[static_cast<std::size_t>(joint)];
}

void expect_limb(const MadeRig& rig, const LimbFindings& findings, LimbKind kind,
                 const std::array<const char*, 3>& names) {
  SCOPED_TRACE(limb_id(kind));
  const Limb* limb = nullptr;
  for (const Limb& found : findings.limbs) {
    if (found.kind == kind) limb = &found;
  }
  if (names[0] == nullptr) {
    EXPECT_EQ(limb, nullptr) << (limb == nullptr ? "" : limb->why);
    return;
  }
  ASSERT_NE(limb, nullptr);
  const bool left = kind == LimbKind::left_arm || kind == LimbKind::left_leg;
  EXPECT_EQ(place_name(rig, limb->root), sided(names[0], left)) << limb->why;
  EXPECT_EQ(place_name(rig, limb->middle), sided(names[1], left)) << limb->why;
  EXPECT_EQ(place_name(rig, limb->end), sided(names[2], left)) << limb->why;
  const auto fitted = fit_limb_model(rig.model, rig.character(), *limb, findings);
  EXPECT_TRUE(fitted.ok()) << fitted.error().message();
}

void expect_limbs(const MadeRig& rig, const RealSkeleton& skeleton) {
  const LimbFindings findings = find_limbs(rig.model, rig.character());
  for (const LimbKind kind : {LimbKind::left_arm, LimbKind::right_arm})
    expect_limb(rig, findings, kind, skeleton.arm);
  for (const LimbKind kind : {LimbKind::left_leg, LimbKind::right_leg})
    expect_limb(rig, findings, kind, skeleton.leg);
}

std::vector<Placement> placements() {
  return {{},
          {Vec3(100), Quat(1, 0, 0, 0), true},
          {Vec3(0.01), glm::angleAxis(2.0, glm::normalize(Vec3(0.05, 1, -0.1))), false},
          {Vec3(1.1, 1, 0.95), Quat(1, 0, 0, 0), false}};
}

TEST(RealRigs, LimbsOfSkeletons) {
  for (const RealSkeleton& skeleton : real_skeletons()) {
    for (const Placement& placement : placements()) {
      SCOPED_TRACE(skeleton.name);
      const MadeRig rig = rig_of(read_skeleton(skeleton.text), placement);
      expect_limbs(rig, skeleton);
      const LimbFindings findings = find_limbs(rig.model, rig.character());
      for (const Limb& limb : findings.limbs)
        EXPECT_EQ(limb.why.rfind("names: ", 0), 0u) << limb.why;
      const std::size_t not_found = 4 - findings.limbs.size();
      EXPECT_EQ(findings.warnings.size(), not_found);
      const auto followed = std::count_if(findings.limbs.begin(), findings.limbs.end(),
                                          [](const Limb& limb) { return !limb.following.empty(); });
      EXPECT_EQ(static_cast<std::size_t>(followed), skeleton.followed);
    }
  }
}

TEST(RealRigs, LimbsOfSkeletonsWithoutNames) {
  for (const RealSkeleton& skeleton : real_skeletons()) {
    SCOPED_TRACE(skeleton.name);
    expect_limbs(rig_of(read_skeleton(skeleton.text), {}, true), skeleton);
  }
}

TEST(RealRigs, WhereSkeletonsLook) {
  for (const RealSkeleton& skeleton : real_skeletons()) {
    SCOPED_TRACE(skeleton.name);
    if (skeleton.forward == Vec3(0.0)) continue;
    for (const bool nameless : {false, true}) {
      const MadeRig rig = rig_of(read_skeleton(skeleton.text), {}, nameless);
      const LimbFindings findings = find_limbs(rig.model, rig.character());
      const BodyAxes axes = body_axes(rig.model, rig.character(), findings);
      EXPECT_NEAR(glm::dot(axes.forward, skeleton.forward), 1, 1e-6);
      for (const std::string& warning : findings.warnings)
        EXPECT_EQ(warning.find("swapped"), std::string::npos) << warning;
    }
  }
}

// A body with these names and nothing that would tell the limbs by shape: arms and legs that stop
// at their ends, no clavicles where the convention has none.
std::vector<WrittenJoint> body_of(const JointNames& names) {
  const std::string root = names.hips;
  std::string text = root + " = 0 0.98 0\n " + names.chest + " = 0 0.34 -0.02\n  Head = 0 0.26 0\n";
  const auto chain = [&](std::size_t depth,
                         std::vector<std::pair<const char*, const char*>> joints) {
    for (const auto& [name, offset] : joints) {
      if (*name == 0) continue;
      text += std::string(depth, ' ') + name + " = " + offset + "\n";
      ++depth;
    }
    return depth;
  };
  const char* shoulder = *names.clavicle == 0 ? "0.18 0.11 0.01" : "0.15 0 -0.01";
  const std::size_t hand = chain(2, {{names.clavicle, "0.03 0.11 0.02"},
                                     {names.upper, shoulder},
                                     {names.fore, "0.28 0 -0.01"},
                                     {names.hand, "0.25 0 0.01"}});
  chain(hand, {{names.thumb, "0.025 -0.01 0.03"}});
  chain(hand, {{names.finger, "0.09 0 0.015"}});
  chain(1, {{names.thigh, "0.1 -0.05 0"},
            {names.shin, "0 -0.44 0.02"},
            {names.foot, "0 -0.41 -0.04"},
            {names.toe, "0 -0.06 0.13"}});
  return read_skeleton(text);
}

TEST(RealRigs, LimbsByWhatJointsAreCalled) {
  for (const JointNames& names : real_names()) {
    SCOPED_TRACE(std::string(names.convention) + " (" + names.source + ")");
    const MadeRig rig = rig_of(body_of(names));
    const RealSkeleton expected = {names.convention,
                                   {names.upper, names.fore, names.hand},
                                   {names.thigh, names.shin, names.foot},
                                   ""};
    expect_limbs(rig, expected);
    const LimbFindings findings = find_limbs(rig.model, rig.character());
    for (const Limb& limb : findings.limbs)
      EXPECT_EQ(limb.why.rfind("names: ", 0), 0u) << limb.name << ": " << limb.why;
    for (const std::string& warning : findings.warnings) ADD_FAILURE() << warning;
  }
}

// Rigify hangs the chain of an arm's DEF bones from the ORG shoulder, but a finger's from the ORG
// palm: turning the arm leaves the fingers behind, and so does turning the ORG arm the arm's skin.
TEST(RealRigs, FingersThatHangElsewhereAreWarnedOf) {
  const MadeRig rig = rig_of(read_skeleton(R"(
root = 0 0 0 -
 ORG-spine = 0 1 0 -
  DEF-spine = 0 0 0
   DEF-spine.003 = 0 0.3 0
  ORG-spine.003 = 0 0.3 0 -
   ORG-shoulder.{L|R} = 0.02 0.1 0.02 -
    DEF-shoulder.{L|R} = 0 0 0
    DEF-upper_arm.{L|R} = 0.15 0 -0.02
     DEF-upper_arm.{L|R}.001 = 0.14 0 -0.01
      DEF-forearm.{L|R} = 0.14 0 -0.01
       DEF-forearm.{L|R}.001 = 0.12 0 0.01
        DEF-hand.{L|R} = 0.12 0 0.01
    ORG-upper_arm.{L|R} = 0.15 0 -0.02 -
     ORG-forearm.{L|R} = 0.28 0 -0.02 -
      ORG-hand.{L|R} = 0.24 0 0.02 -
       ORG-palm.01.{L|R} = 0.03 0 0.02 -
        DEF-palm.01.{L|R} = 0 0 0
        DEF-f_index.01.{L|R} = 0.05 0 0.01
         DEF-f_index.02.{L|R} = 0.04 0 0
        DEF-thumb.01.{L|R} = -0.02 -0.01 0.02
  DEF-thigh.{L|R} = 0.1 -0.03 0
   DEF-thigh.{L|R}.001 = 0 -0.22 0.01
    DEF-shin.{L|R} = 0 -0.22 0.01
     DEF-shin.{L|R}.001 = 0 -0.21 -0.02
      DEF-foot.{L|R} = 0 -0.21 -0.02
       DEF-toe.{L|R} = 0 -0.06 0.12
)"));
  const LimbFindings findings = find_limbs(rig.model, rig.character());
  expect_limb(rig, findings, LimbKind::left_arm,
              {"DEF-upper_arm.{L|R}", "DEF-forearm.{L|R}", "DEF-hand.{L|R}"});
  expect_limb(rig, findings, LimbKind::right_leg,
              {"DEF-thigh.{L|R}", "DEF-shin.{L|R}", "DEF-foot.{L|R}"});
  EXPECT_EQ(findings.warnings, std::vector<std::string>());
  for (const Limb& limb : findings.limbs) {
    if (!limb.is_arm()) {
      EXPECT_TRUE(limb.following.empty()) << limb.name;
      continue;
    }
    ASSERT_EQ(limb.following.size(), 3u) << limb.why;
    for (const FollowingJoint& own : limb.following) EXPECT_EQ(own.serves, limb.end);
    EXPECT_NE(limb.why.find("which hangs from 'ORG-palm.01."), std::string::npos) << limb.why;
  }
}

// A garment's own skeleton, joint on joint with the body's, follows joint by joint.
TEST(RealRigs, AGarmentsSkeletonFollows) {
  const RealSkeleton skeleton = real_skeletons().front();
  std::vector<WrittenJoint> joints = read_skeleton(skeleton.text);
  const auto count = static_cast<int>(joints.size());
  for (int i = 0; i < count; ++i) {
    WrittenJoint joint = joints[static_cast<std::size_t>(i)];
    joint.parent = joint.parent < 0 ? 0 : joint.parent + count;
    joint.name = "shirt " + std::to_string(i);
    joints.push_back(joint);
  }
  const MadeRig rig = rig_of(joints);
  const LimbFindings findings = find_limbs(rig.model, rig.character());
  ASSERT_EQ(findings.limbs.size(), 4u);
  EXPECT_EQ(findings.warnings, std::vector<std::string>());
  for (const Limb& limb : findings.limbs) {
    for (const int joint : {limb.root, limb.middle, limb.end}) {
      // The body's own come first; the copy of joint j is j + count.
      EXPECT_NE(std::find(limb.following.begin(), limb.following.end(),
                          FollowingJoint{joint + count, joint}),
                limb.following.end())
          << limb.name << " " << joint << ": " << limb.why;
    }
  }
}

// Prefixes that mean parts of a body, or that would make helpers of all joints; joints' paths.
TEST(RealRigs, PrefixesAndPaths) {
  for (const char* prefix :
       {"FootSoldier_", "Target_", "rp_nathan_animated_003_walking_", "Hand_Painted_Knight.",
        "Armature/Root/Hand_Rig/", "shoulder-cannon ", "proxy:", "mixamorig12:"}) {
    SCOPED_TRACE(prefix);
    const std::string p = prefix;
    const std::string text = p + "pelvis = 0 1 0\n " + p + "spine = 0 0.3 0\n  " + p +
                             "head = 0 0.3 0\n  " + p + "upperarm_{l|r} = 0.2 0.1 0\n   " + p +
                             "lowerarm_{l|r} = 0.28 0 -0.02\n    " + p +
                             "hand_{l|r} = 0.25 0 0.02\n " + p + "thigh_{l|r} = 0.1 -0.05 0\n  " +
                             p + "calf_{l|r} = 0 -0.42 0.02\n   " + p +
                             "foot_{l|r} = 0 -0.4 -0.02\n    " + p + "ball_{l|r} = 0 -0.08 0.1\n";
    const MadeRig rig = rig_of(read_skeleton(text));
    const std::array<std::string, 6> names = {p + "upperarm_{l|r}", p + "lowerarm_{l|r}",
                                              p + "hand_{l|r}",     p + "thigh_{l|r}",
                                              p + "calf_{l|r}",     p + "foot_{l|r}"};
    expect_limbs(rig, {prefix,
                       {names[0].c_str(), names[1].c_str(), names[2].c_str()},
                       {names[3].c_str(), names[4].c_str(), names[5].c_str()},
                       ""});
    for (const Limb& limb : find_limbs(rig.model, rig.character()).limbs)
      EXPECT_EQ(limb.why.rfind("names: ", 0), 0u) << limb.name << ": " << limb.why;
  }
}

}  // namespace
}  // namespace elbowroom::test
