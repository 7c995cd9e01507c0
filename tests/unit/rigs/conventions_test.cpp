// SPDX-License-Identifier: MIT
// The same limbs under every tool's names and under none, bound in a T-pose, an A-pose or neither,
// in any unit, turned and mirrored.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/rigs/rig_maker.h"

namespace elbowroom::test {
namespace {

constexpr double kDegree = kPi / 180;

struct Case {
  const char* name;
  Stance stance;
  Placement placement;
  bool mirrored = false;
};

std::vector<Convention> all_conventions() {
  std::vector<Convention> all = conventions();
  for (const Convention& convention : real_conventions()) all.push_back(convention);
  return all;
}

std::vector<Case> cases() {
  std::vector<Case> all(9);
  all[0].name = "T-pose";
  all[1] = {"A-pose", {45 * kDegree, 5 * kDegree, 0}, {}};
  all[2] = {"arms hanging", {80 * kDegree, 15 * kDegree, 0}, {}};
  all[3] = {"in a stride, elbows bent", {60 * kDegree, 70 * kDegree, 25 * kDegree}, {}};
  all[4] = {"centimetres, Z-up under a turned node", {}, {Vec3(100), Quat(1, 0, 0, 0), true}};
  all[5] = {"thousandths", {40 * kDegree, 0, 0}, {Vec3(0.001), Quat(1, 0, 0, 0), false}};
  all[6] = {"facing -x", {}, {Vec3(1), glm::angleAxis(-kPi / 2, Vec3(0, 1, 0)), false}};
  all[7] = {"turned away and leaning",
            {},
            {Vec3(1), glm::angleAxis(2.5, glm::normalize(Vec3(0.1, 1, 0.15))), false}};
  all[8] = {"not uniform above", {45 * kDegree, 0, 0}, {Vec3(1.2, 1, 0.9), Quat(1, 0, 0, 0)}};
  return all;
}

void expect_limbs(const Convention& convention, const MadeRig& rig, bool mirrored) {
  const LimbFindings findings = find_limbs(rig.model, rig.character());
  for (const std::string& warning : findings.warnings) ADD_FAILURE() << warning;
  ASSERT_EQ(findings.limbs.size(), 4u);
  for (const Limb& limb : findings.limbs) {
    const auto& names = limb.is_arm() ? convention.arm : convention.leg;
    const bool left = limb.is_left() != mirrored;
    const auto name = [&](int joint) { return rig.row_names[static_cast<std::size_t>(joint)]; };
    EXPECT_EQ(name(limb.root), name(rig.joint(names[0], left))) << limb.name << ": " << limb.why;
    EXPECT_EQ(name(limb.middle), name(rig.joint(names[1], left))) << limb.name;
    EXPECT_EQ(name(limb.end), name(rig.joint(names[2], left))) << limb.name;
    const auto fitted = fit_limb_model(rig.model, rig.character(), limb, findings);
    ASSERT_TRUE(fitted) << fitted.error().message();
    std::vector<std::string> driven, expected;
    for (const DrivenJoint& joint : fitted->driven) driven.push_back(name(joint.joint));
    for (const char* row : limb.is_arm() ? convention.arm_driven : convention.leg_driven)
      expected.push_back(name(rig.joint(row, left)));
    std::sort(driven.begin(), driven.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(driven, expected) << limb.name;
  }
}

TEST(RigHabits, LimbsByName) {
  for (const Convention& convention : all_conventions()) {
    for (const Case& c : cases()) {
      SCOPED_TRACE(std::string(convention.name) + ", " + c.name);
      expect_limbs(convention, make_rig(convention, c.stance, c.placement), false);
    }
  }
}

TEST(RigHabits, TheSameLimbsWithoutNames) {
  for (const Convention& convention : all_conventions()) {
    for (const Case& c : cases()) {
      SCOPED_TRACE(std::string(convention.name) + ", " + c.name);
      expect_limbs(convention, make_rig(convention, c.stance, c.placement, true), false);
    }
  }
}

// Low-poly figures have no fingers and no toes: nothing then says where an arm ends but its bones.
TEST(RigHabits, TheSameLimbsWithoutNamesFingersAndToes) {
  for (Convention convention : all_conventions()) {
    if (convention.in_pieces) continue;
    std::erase_if(convention.rows, [](const Row& row) {
      const std::string place = row.place;
      return std::any_of(place.begin(), place.end(), [](char c) { return c == '1' || c == '2'; })
                 ? place.rfind("spine", 0) != 0 && place.rfind("hair", 0) != 0 &&
                       place.rfind("skirt", 0) != 0
                 : place == "thumb3" || place == "index3" || place == "middle3" ||
                       place == "ball" || place == "toe" || place == "heel";
    });
    for (const Case& c : cases()) {
      SCOPED_TRACE(std::string(convention.name) + ", " + c.name);
      const MadeRig rig = make_rig(convention, c.stance, c.placement, true);
      const LimbFindings findings = find_limbs(rig.model, rig.character());
      ASSERT_EQ(findings.limbs.size(), 4u);
      for (const Limb& limb : findings.limbs) {
        // Without feet little tells which way the figure looks; the chains are what is asked here.
        const auto& names = limb.is_arm() ? convention.arm : convention.leg;
        const bool left = limb.root == rig.joint(names[0], true);
        EXPECT_EQ(limb.root, rig.joint(names[0], left)) << limb.why;
        EXPECT_EQ(limb.middle, rig.joint(names[1], left)) << limb.why;
        EXPECT_EQ(limb.end, rig.joint(names[2], left)) << limb.why;
      }
    }
  }
}

TEST(RigHabits, AMirrorMakesTheOtherSide) {
  for (const Convention& convention : all_conventions()) {
    SCOPED_TRACE(convention.name);
    // Without names the left limb is on the body's left, which is the other one under a mirror.
    expect_limbs(
        convention,
        make_rig(convention, {45 * kDegree, 0, 0}, {Vec3(-1, 1, 1), Quat(1, 0, 0, 0)}, true), true);
  }
}

TEST(RigHabits, NamesAndNoNamesGiveTheSameModels) {
  for (const Convention& convention : all_conventions()) {
    const MadeRig named = make_rig(convention), nameless = make_rig(convention, {}, {}, true);
    const LimbFindings a = find_limbs(named.model, named.character());
    const LimbFindings b = find_limbs(nameless.model, nameless.character());
    ASSERT_EQ(a.limbs.size(), b.limbs.size()) << convention.name;
    for (std::size_t i = 0; i < a.limbs.size(); ++i) {
      SCOPED_TRACE(std::string(convention.name) + " " + a.limbs[i].name);
      const auto x = fit_limb_model(named.model, named.character(), a.limbs[i], a);
      const auto y = fit_limb_model(nameless.model, nameless.character(), b.limbs[i], b);
      ASSERT_TRUE(x.ok() && y.ok());
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(x->joints[k].joint, y->joints[k].joint);
        EXPECT_EQ(x->joints[k].parent_from_zero, y->joints[k].parent_from_zero);
        EXPECT_EQ(x->joints[k].joint_from_anatomy, y->joints[k].joint_from_anatomy);
        EXPECT_EQ(x->joints[k].side, y->joints[k].side);
      }
    }
  }
}

// Figures that are no humans, or only half of one: what is not there is not made up.
TEST(RigHabits, WhatIsNoLimbIsNotFoundAndSaysWhy) {
  const Convention hand = {"a hand",
                           {{"a", "", "wrist"},
                            {"b", "a", "thumb1"},
                            {"c", "b", "thumb2"},
                            {"d", "c", "thumb3"},
                            {"e", "a", "index1"},
                            {"f", "e", "index2"},
                            {"g", "f", "index3"},
                            {"h", "a", "middle1"},
                            {"i", "h", "middle2"},
                            {"j", "i", "middle3"}},
                           {},
                           {}};
  const Convention snake = {"a snake",
                            {{"a", "", "hips"},
                             {"b", "a", "spine1"},
                             {"c", "b", "spine2"},
                             {"d", "c", "chest"},
                             {"e", "d", "neck"},
                             {"f", "e", "head"}},
                            {},
                            {}};
  const Convention one = {"a joint", {{"a", "", "hips"}}, {}, {}};
  for (const Convention& convention : {hand, snake, one}) {
    const MadeRig rig = make_rig(convention);
    const LimbFindings findings = find_limbs(rig.model, rig.character());
    EXPECT_TRUE(findings.limbs.empty()) << convention.name << ": " << findings.limbs.front().why;
    ASSERT_EQ(findings.warnings.size(), 4u);
    for (const std::string& warning : findings.warnings) {
      EXPECT_NE(warning.find(" not found: "), std::string::npos);
      EXPECT_NE(warning.find("by shape: "), std::string::npos) << warning;
    }
  }
}

TEST(RigHabits, TheFilesOwnBonesComeFirst) {
  const Convention convention = conventions().front();
  MadeRig rig = make_rig(convention);
  const auto bone = [&](const char* name, const char* row, bool left) {
    rig.model.human_bones.push_back({name, rig.joint(row, left)});
  };
  // The file says another thing than the names: a limb that ends at the fingers.
  bone("leftUpperArm", "{Left|Right}Shoulder", true);
  bone("leftLowerArm", "{Left|Right}ForeArm", true);
  bone("leftHand", "{Left|Right}HandIndex1", true);
  // And nonsense: a chain upside down.
  bone("rightUpperArm", "{Left|Right}Hand", false);
  bone("rightLowerArm", "{Left|Right}ForeArm", false);
  bone("rightHand", "{Left|Right}Arm", false);
  const LimbFindings findings = find_limbs(rig.model, rig.character());
  ASSERT_EQ(findings.limbs.size(), 4u);
  EXPECT_EQ(findings.limbs[0].root, rig.joint("{Left|Right}Shoulder", true));
  EXPECT_EQ(findings.limbs[0].end, rig.joint("{Left|Right}HandIndex1", true));
  EXPECT_NE(findings.limbs[0].why.find("humanoid bones"), std::string::npos);
  EXPECT_EQ(findings.limbs[1].root, rig.joint("{Left|Right}Arm", false));
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_EQ(findings.warnings[0].rfind("right_arm: the file's own", 0), 0u);
}

TEST(RigHabits, OverridesComeBeforeAll) {
  const Convention convention = conventions().front();
  const MadeRig rig = make_rig(convention);
  const LimbOverrides overrides = {{"left_arm", {"LeftShoulder", "", "LeftHand"}},
                                   {"right_leg", {"RightUpLeg", "RightFoot", "RightToeBase"}},
                                   {"tail", {"Hips", "", "Head"}},
                                   {"right_arm", {"RightArm", "", "Nobody"}}};
  const LimbFindings findings = find_limbs(rig.model, rig.character(), overrides);
  ASSERT_EQ(findings.limbs.size(), 5u);
  EXPECT_EQ(findings.limbs[0].root, rig.joint("LeftShoulder", true));
  EXPECT_EQ(findings.limbs[0].kind, LimbKind::left_arm);
  EXPECT_EQ(findings.limbs[3].middle, rig.joint("RightFoot", true));
  EXPECT_EQ(findings.limbs[4].name, "tail");
  EXPECT_EQ(findings.limbs[4].kind, LimbKind::chain);
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_NE(findings.warnings[0].find("Nobody"), std::string::npos);
  EXPECT_EQ(findings.limbs[1].root, rig.joint("RightArm", true)) << "found as if not set";
  const auto tail = limb_by_name(rig.model, rig.character(), "tail", overrides);
  ASSERT_TRUE(tail.ok());
  EXPECT_TRUE(fit_limb_model(rig.model, rig.character(), *tail, findings).ok());
}

}  // namespace
}  // namespace elbowroom::test
