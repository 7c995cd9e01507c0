// SPDX-License-Identifier: MIT
// What names say, and limbs found under the naming habits of common rigs.
#include "core/anatomy/limb_names.h"

#include <gtest/gtest.h>

#include "tests/unit/anatomy/synthetic_body.h"

namespace elbowroom {
namespace {

using test::BodyOptions;
using test::SideNames;

TEST(BoneNames, AreReadWhateverTheHabit) {
  struct Case {
    const char* name;
    BonePart part;
    BoneSide side;
  };
  const BoneSide l = BoneSide::left, r = BoneSide::right;
  const Case cases[] = {
      {"leftUpperArm", BonePart::upper_arm, l},
      {"mixamorig:LeftArm", BonePart::arm, l},
      {"mixamorigLeftForeArm", BonePart::forearm, l},
      {"mixamorig_RightUpLeg_062", BonePart::thigh, r},
      {"mixamorig:RightLeg", BonePart::leg, r},
      {"upperarm_l", BonePart::upper_arm, l},
      {"calf_r", BonePart::shin, r},
      {"DEF-upper_arm.L", BonePart::upper_arm, l},
      {"DEF-upper_arm.L.001", BonePart::upper_arm, l},
      {"DEF-shin.R", BonePart::shin, r},
      {"upper_armL", BonePart::upper_arm, l},
      {"upperarml", BonePart::upper_arm, l},
      {"CC_Base_L_Upperarm", BonePart::upper_arm, l},
      {"CC_Base_R_Calf", BonePart::shin, r},
      {"Bip01 L UpperArm", BonePart::upper_arm, l},
      {"Bip001_R_Thigh_05", BonePart::thigh, r},
      {"J_Bip_L_LowerLeg", BonePart::shin, l},
      {"b_RightForeArm_07", BonePart::forearm, r},
      {"lShldrBend", BonePart::shoulder, l},
      {"rThighBend", BonePart::thigh, r},
      {"LeftCollar", BonePart::clavicle, l},
      {"LeftElbow", BonePart::forearm, l},
      {"RightAnkle", BonePart::foot, r},
      {"RightHip", BonePart::hip, r},
      {"LEFT_FOREARM", BonePart::forearm, l},
      {"lefthand", BonePart::hand, l},
      {"lthigh", BonePart::thigh, l},
      {"Skeleton_arm_joint_L__4_", BonePart::arm, l},
      {"leg_joint_R_5", BonePart::leg, r},
      {"upper_arm.r_Armature", BonePart::upper_arm, r},
      {"LeftHandIndex1", BonePart::finger, l},
      {"mixamorig:LeftToeBase", BonePart::toe, l},
      {"Hips", BonePart::none, BoneSide::none},
      {"HairBun_R", BonePart::none, r},
      {"Charm", BonePart::none, BoneSide::none},
      {"Armature", BonePart::none, BoneSide::none},
      {"", BonePart::none, BoneSide::none},
      {":", BonePart::none, BoneSide::none},
      {"lhumerus", BonePart::upper_arm, l},
      {"rradius", BonePart::forearm, r},
      {"lfemur", BonePart::thigh, l},
      {"rtibia", BonePart::shin, r},
      {"LHipJoint", BonePart::hip, l},
      {"ORG-forearm.L", BonePart::forearm, l},
      {"arm_stretch.l", BonePart::arm, l},
      {"mixamorig%3ALeftForeArm", BonePart::forearm, l},
      {"upper%5Farm%2El", BonePart::upper_arm, l},
      {"Bip01FBXASC032LFBXASC032UpperArm", BonePart::upper_arm, l},
      {"bip01lupperarm", BonePart::upper_arm, l},
      {"ccbaserforearm", BonePart::forearm, r},
      {"defupperarml001", BonePart::upper_arm, l},
      {"左腕", BonePart::upper_arm, l},
      {"左ひじ", BonePart::forearm, l},
      {"右手首", BonePart::hand, r},
      {"左足", BonePart::thigh, l},
      {"右ひざ", BonePart::shin, r},
      {"左足首", BonePart::foot, l},
      {"左足首D", BonePart::foot, l},
      {"右つま先", BonePart::toe, r},
      {"左親指０", BonePart::finger, l},
      {"右肩", BonePart::shoulder, r},
      {"左大腿", BonePart::thigh, l},
      {"右小腿", BonePart::shin, r},
      {"Oberschenkel.L", BonePart::thigh, l},
      {"Unterarm_rechts", BonePart::forearm, r},
      {"Fuß links", BonePart::foot, l},
      {"avant-bras gauche", BonePart::forearm, l},
      {"cuisse.R", BonePart::thigh, r},
      {"antebrazo_izquierdo", BonePart::forearm, l},
  };
  for (const Case& c : cases) {
    const BoneName read = read_bone_name(c.name);
    EXPECT_EQ(read.part, c.part) << c.name;
    EXPECT_EQ(read.side, c.side) << c.name;
    EXPECT_FALSE(read.helper) << c.name;
  }
}

TEST(BoneNames, HelpersAreToldApart) {
  for (const char* name : {"upperarm_twist_01_l",
                           "CC_Base_L_ForearmTwist01",
                           "CC_Base_L_ElbowShareBone",
                           "handIK.l",
                           "IK-foot.l",
                           "kneeIK.r",
                           "LeftFootCtrl",
                           "control-heel-roll.l",
                           "PoleTarget.L",
                           "PT.L",
                           "r-LEGCONTROL",
                           "l-ARMORIENT",
                           "handslot.l",
                           "LeftForeArmRoll",
                           "MCH-upper_arm.L",
                           "LeftArm_$AssimpFbx$_Rotation",
                           "左足ＩＫ",
                           "左腕捩",
                           "右手捩1",
                           "腰キャンセル左",
                           "L_UpperarmTwist01",
                           "lForearmTwist"}) {
    EXPECT_TRUE(read_bone_name(name).helper) << name;
  }
}

TEST(BoneNames, HostileNamesAreHarmless) {
  EXPECT_EQ(read_bone_name(std::string(100000, 'l')).part, BonePart::none);
  EXPECT_EQ(read_bone_name(std::string(10000, 'A')).part, BonePart::none);
  EXPECT_EQ(read_bone_name("\xff\xfe\x80_L").side, BoneSide::left);
  std::string arms;
  for (int i = 0; i < 1000; ++i) arms += "arm";
  read_bone_name(arms);
}

TEST(BoneNames, AWordThatAllShareSaysNothing) {
  const std::set<std::string> common =
      common_words({"hero_hips", "hero_arm_l", "hero_arm_r", "hero_leg_l", "hero_leg_r", "sword"});
  EXPECT_EQ(common.count("hero"), 1u);
  EXPECT_EQ(common.count("sword"), 0u);
  EXPECT_TRUE(read_bone_name("hero_arm_l", common).unknown.empty());
}

SideNames sided(const std::string& before, const std::string& after,
                const std::array<const char*, 10>& parts) {
  SideNames names;
  for (std::size_t i = 0; i < parts.size(); ++i) names[i] = before + parts[i] + after;
  return names;
}

struct Habit {
  const char* name;
  SideNames left, right;
};

std::vector<Habit> habits() {
  const std::array<const char*, 10> mixamo = {"Shoulder",   "Arm",        "ForeArm", "Hand",
                                              "HandIndex1", "HandThumb1", "UpLeg",   "Leg",
                                              "Foot",       "ToeBase"};
  const std::array<const char*, 10> vrm = {"Shoulder",      "UpperArm",      "LowerArm", "Hand",
                                           "IndexProximal", "ThumbProximal", "UpperLeg", "LowerLeg",
                                           "Foot",          "Toes"};
  const std::array<const char*, 10> rigify = {"shoulder",   "upper_arm", "forearm", "hand",
                                              "f_index.01", "thumb.01",  "thigh",   "shin",
                                              "foot",       "toe"};
  const std::array<const char*, 10> cc = {"Clavicle", "Upperarm", "Forearm", "Hand", "Index1",
                                          "Thumb1",   "Thigh",    "Calf",    "Foot", "ToeBase"};
  const std::array<const char*, 10> biped = {"Clavicle", "UpperArm", "Forearm", "Hand", "Finger1",
                                             "Finger0",  "Thigh",    "Calf",    "Foot", "Toe0"};
  const std::array<const char*, 10> daz = {"Collar", "ShldrBend", "ForearmBend", "Hand", "Index1",
                                           "Thumb1", "ThighBend", "Shin",        "Foot", "Toe"};
  const std::array<const char*, 10> biovision = {"Collar", "Shoulder", "Elbow", "Wrist", "Finger",
                                                 "Thumb",  "Hip",      "Knee",  "Ankle", "Toe"};
  const std::array<const char*, 10> numbered = {
      "shoulder_joint_", "arm_joint_1_", "arm_joint_2_", "arm_joint_3_", "finger_1_",
      "finger_2_",       "leg_joint_1_", "leg_joint_2_", "leg_joint_3_", "leg_joint_4_"};
  return {
      {"mixamo", sided("mixamorig:Left", "", mixamo), sided("mixamorig:Right", "", mixamo)},
      {"mixamo, colon lost", sided("mixamorigLeft", "", mixamo),
       sided("mixamorigRight", "", mixamo)},
      {"mixamo, numbered by an exporter", sided("mixamorig_Left", "_062", mixamo),
       sided("mixamorig_Right", "_063", mixamo)},
      {"vrm", sided("left", "", vrm), sided("right", "", vrm)},
      {"vroid", sided("J_Bip_L_", "", vrm), sided("J_Bip_R_", "", vrm)},
      {"rigify", sided("DEF-", ".L", rigify), sided("DEF-", ".R", rigify)},
      {"rigify, dots lost", sided("DEF-", "L", rigify), sided("DEF-", "R", rigify)},
      {"cc", sided("CC_Base_L_", "", cc), sided("CC_Base_R_", "", cc)},
      {"3ds max", sided("Bip01 L ", "", biped), sided("Bip01 R ", "", biped)},
      {"daz", sided("l", "", daz), sided("r", "", daz)},
      {"biovision", sided("Left", "", biovision), sided("Right", "", biovision)},
      {"numbered", sided("", "L", numbered), sided("", "R", numbered)},
      {"an artist's own prefix", sided("hero_L_", "", cc), sided("hero_R_", "", cc)},
      {"no sides", sided("", "", cc), sided("", ".001", cc)},
      {"capitals",
       sided("LEFT_", "",
             {"CLAVICLE", "UPPERARM", "FOREARM", "HAND", "INDEX", "THUMB", "THIGH", "SHIN", "FOOT",
              "TOE"}),
       sided("RIGHT_", "",
             {"CLAVICLE", "UPPERARM", "FOREARM", "HAND", "INDEX", "THUMB", "THIGH", "SHIN", "FOOT",
              "TOE"})},
  };
}

TEST(FindLimbs, UnderEveryHabit) {
  for (const Habit& habit : habits()) {
    BodyOptions options;
    options.left = habit.left;
    options.right = habit.right;
    options.axes_seed = 3;
    const test::Body body = test::make_body(options);
    const LimbFindings findings = find_limbs(body.model, body.character());
    ASSERT_EQ(findings.limbs.size(), 4u)
        << habit.name << ": "
        << (findings.warnings.empty() ? std::string() : findings.warnings.front());
    EXPECT_TRUE(findings.warnings.empty()) << habit.name << ": " << findings.warnings.front();
    for (const Limb& limb : findings.limbs) {
      const auto& joints = limb.is_left() ? body.left : body.right;
      EXPECT_EQ(limb.root, joints[limb.is_arm() ? test::kUpperArm : test::kThigh]) << habit.name;
      EXPECT_EQ(limb.middle, joints[limb.is_arm() ? test::kForearm : test::kShin]) << habit.name;
      EXPECT_EQ(limb.end, joints[limb.is_arm() ? test::kHand : test::kFoot]) << habit.name;
    }
  }
}

TEST(FindLimbs, TwistJointsBetweenAreDriven) {
  for (const char* twist : {"upperarm_twist_01_l", "DEF-upper_arm.L.001"}) {
    BodyOptions options;
    options.left_twist = twist;
    if (twist[0] == 'D') options.left[test::kUpperArm] = "DEF-upper_arm.L";
    const test::Body body = test::make_body(options);
    const LimbModel arm = test::fit(body, LimbKind::left_arm);
    EXPECT_EQ(arm.limb.root, body.left[test::kUpperArm]);
    EXPECT_EQ(arm.limb.joints,
              (std::vector<int>{body.left[test::kUpperArm], body.left_twist,
                                body.left[test::kForearm], body.left[test::kHand]}));
    ASSERT_EQ(arm.driven.size(), 1u);
    EXPECT_EQ(arm.driven[0].joint, body.left_twist);
    EXPECT_EQ(arm.driven[0].serves, body.left[test::kUpperArm]);
    EXPECT_NE(arm.limb.why.find(twist), std::string::npos);
  }
}

TEST(FindLimbs, WhatNamesMissIsFoundByShape) {
  BodyOptions options;
  options.left[test::kHand] = "blob";
  options.left[test::kIndex] = options.left[test::kThumb] = "blob";
  options.right[test::kShin] = "gizmo";
  options.left[test::kThigh] = options.left[test::kShin] = options.left[test::kFoot] = "thing";
  const test::Body body = test::make_body(options);
  const LimbFindings findings = find_limbs(body.model, body.character());
  ASSERT_EQ(findings.limbs.size(), 4u);
  EXPECT_TRUE(findings.warnings.empty()) << findings.warnings.front();
  for (const Limb& limb : findings.limbs) {
    const auto& joints = limb.is_left() ? body.left : body.right;
    EXPECT_EQ(limb.root, joints[limb.is_arm() ? test::kUpperArm : test::kThigh]);
    EXPECT_EQ(limb.middle, joints[limb.is_arm() ? test::kForearm : test::kShin]);
    EXPECT_EQ(limb.end, joints[limb.is_arm() ? test::kHand : test::kFoot]);
    // A hand without a name is still the forearm's end.
    EXPECT_EQ(limb.why.find("shape") != std::string::npos, !limb.is_arm()) << limb.why;
    if (limb.kind == LimbKind::left_arm) {
      EXPECT_NE(limb.why.find("nearest to one"), std::string::npos);
    }
  }
}

TEST(FindLimbs, SwappedSidesAreNoticedAndKeptAsNamed) {
  BodyOptions options;
  std::swap(options.left, options.right);
  const test::Body body = test::make_body(options);
  const LimbFindings findings = find_limbs(body.model, body.character());
  ASSERT_EQ(findings.limbs.size(), 4u);
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_NE(findings.warnings[0].find("swapped"), std::string::npos);
  const BodyAxes axes = body_axes(body.model, body.character(), findings);
  EXPECT_NEAR(axes.forward.z, 1, 1e-12);
  EXPECT_NEAR(axes.left.x, 1, 1e-12);
}

TEST(LimbByName, KindsAndChains) {
  const test::Body body = test::make_body({});
  const Character& character = body.character();
  EXPECT_EQ(limb_by_name(body.model, character, "right_leg")->root, body.right[test::kThigh]);
  // A chain that is a limb found is that limb.
  EXPECT_EQ(limb_by_name(body.model, character, "upperarm_l..hand_l")->kind, LimbKind::left_arm);
  const auto spine = limb_by_name(body.model, character, "pelvis..hand_l");
  ASSERT_TRUE(spine) << spine.error().message();
  EXPECT_EQ(spine->kind, LimbKind::chain);
  EXPECT_EQ(spine->joints.front(), body.hips);
  EXPECT_EQ(spine->joints.back(), body.left[test::kHand]);
  EXPECT_NE(spine->middle, spine->root);
  EXPECT_NE(spine->middle, spine->end);
  const LimbFindings findings = find_limbs(body.model, character);
  EXPECT_TRUE(fit_limb_model(body.model, character, *spine, findings));
}

TEST(LimbByName, ErrorsSayWhatThereIs) {
  const test::Body body = test::make_body({});
  const Character& character = body.character();
  for (const char* name : {"third_arm", "", "..", "upperarm_l..", "nobody..hand_l",
                           "hand_l..upperarm_l", "upperarm_l..upperarm_l", "upperarm_l..lowerarm_l",
                           "upperarm_l..hand_r", "999999999999..hand_l"}) {
    const auto limb = limb_by_name(body.model, character, name);
    ASSERT_FALSE(limb) << name;
    EXPECT_FALSE(limb.error().what.empty());
    EXPECT_FALSE(limb.error().remedy.empty()) << name;
    EXPECT_NE(limb.error().message().find("synthetic.glb"), std::string::npos);
  }
  EXPECT_NE(limb_by_name(body.model, character, "third_arm").error().message().find("left_arm"),
            std::string::npos);
  EXPECT_NE(
      limb_by_name(body.model, character, "UPPERARM..hand_l").error().message().find("upperarm_l"),
      std::string::npos);
}

}  // namespace
}  // namespace elbowroom
