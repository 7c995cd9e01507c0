// SPDX-License-Identifier: MIT
// Names that nobody would give, and several figures in one file.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>

#include "core/anatomy/limb_names.h"
#include "tests/unit/rigs/real_skeletons.h"
#include "tests/unit/rigs/skeleton_text.h"

namespace elbowroom::test {
namespace {

// A body of `count` joints as a chain of fans, each named by `name`.
MadeRig named_crowd(int count, int fan, const std::function<std::string(int)>& name) {
  std::vector<WrittenJoint> joints;
  for (int i = 0; i < count; ++i) {
    WrittenJoint joint;
    joint.name = name(i);
    joint.parent = i == 0 ? -1 : (i - 1) / fan;
    joint.place = Vec3(0.31 * ((i * 7) % 11 - 5), 0.1 * (i % 17), 0.07 * ((i * 3) % 5 - 2));
    joints.push_back(joint);
  }
  return rig_of(joints);
}

void expect_an_answer(const MadeRig& rig) {
  const auto start = std::chrono::steady_clock::now();
  const LimbFindings findings = find_limbs(rig.model, rig.character());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 5) << "on a busy machine; some tens of milliseconds on a free one";
  std::size_t not_found = 0;
  for (const std::string& warning : findings.warnings)
    not_found += warning.find(" not found: ") != std::string::npos;
  EXPECT_EQ(findings.limbs.size() + not_found, 4u);
  for (const Limb& limb : findings.limbs) {
    EXPECT_TRUE(rig.model.skeleton.is_within(limb.middle, limb.root));
    EXPECT_TRUE(rig.model.skeleton.is_within(limb.end, limb.middle));
    const auto fitted = fit_limb_model(rig.model, rig.character(), limb, findings);
    EXPECT_TRUE(fitted.ok() || !fitted.error().what.empty());
  }
}

TEST(HostileNames, CrowdsAreAnsweredSoon) {
  const std::vector<std::pair<const char*, std::function<std::string(int)>>> crowds = {
      {"one name for all", [](int) { return "LeftArm"; }},
      {"no names", [](int) { return ""; }},
      {"shoulders alone", [](int) { return "L_Shoulder"; }},
      {"every part in turn",
       [](int i) {
         const char* parts[] = {"LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand",
                                "LeftUpLeg",    "LeftLeg", "LeftFoot"};
         return std::string(parts[i % 7]);
       }},
      {"parts upside down",
       [](int i) {
         const char* parts[] = {"hand_l", "lowerarm_l", "upperarm_l", "arm_end_l"};
         return std::string(parts[i % 4]);
       }},
      {"numbered arms", [](int i) { return "arm_L_" + std::to_string(i); }},
      {"twists above twists", [](int i) { return i % 2 == 0 ? "arm_twist_l" : "forearm_twist_l"; }},
      {"separators", [](int i) { return std::string(static_cast<std::size_t>(i % 9), '_'); }},
      {"broken bytes",
       [](int i) { return "\xff\xe5\xb7" + std::to_string(i) + "%zz%FBXASC0\x80"; }},
      {"half of a word", [](int) { return std::string("\xe5\xb7\xa6\xe8\x85", 5); }},
      {"one long name", [](int i) { return i == 1 ? std::string(1u << 20, 'L') : "x"; }},
      {"many capitals", [](int) { return std::string(400, 'A') + "l"; }}};
  for (const auto& [what, name] : crowds) {
    for (const int fan : {1, 2, 40}) {
      SCOPED_TRACE(std::string(what) + ", fans of " + std::to_string(fan));
      expect_an_answer(named_crowd(3000, fan, name));
    }
  }
}

TEST(HostileNames, ReadInTimeInProportionToTheirLength) {
  const std::string ten = "LeftUpLegArmHand";
  std::string longer;
  for (int i = 0; i < 20000; ++i) longer += ten;
  const auto start = std::chrono::steady_clock::now();
  read_bone_name(longer);
  read_bone_name(std::string(1u << 20, 'l'));
  read_bone_name(std::string(300, 'l') + "\xe5\xb7\xa6");
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 3);
}

// Every joint has a name that another has too: the same figure twice in one skeleton.
TEST(HostileNames, TheSameNamesTwiceInOneFigure) {
  const RealSkeleton skeleton = real_skeletons().front();
  std::vector<WrittenJoint> joints = read_skeleton(skeleton.text);
  const auto count = static_cast<int>(joints.size());
  for (int i = 0; i < count; ++i) {
    WrittenJoint joint = joints[static_cast<std::size_t>(i)];
    joint.parent = joint.parent < 0 ? 0 : joint.parent + count;
    joint.place.z -= 200;
    joint.carries = Carries::nothing;  // a control rig under the deforming one's names
    joints.push_back(joint);
  }
  const MadeRig rig = rig_of(joints);
  const LimbFindings findings = find_limbs(rig.model, rig.character());
  ASSERT_EQ(findings.limbs.size(), 4u);
  for (const Limb& limb : findings.limbs) {
    EXPECT_LE(limb.root, count) << "of the joints that move skin: " << limb.why;
    EXPECT_LE(limb.end, count) << limb.why;
  }
}

// Two figures in one file, with the same names: each has its own limbs.
TEST(HostileNames, SeveralFiguresInOneFile) {
  const RealSkeleton skeleton = real_skeletons().front();
  std::vector<WrittenJoint> joints = read_skeleton(skeleton.text);
  const auto count = static_cast<int>(joints.size());
  for (int i = 0; i < count; ++i) {
    WrittenJoint joint = joints[static_cast<std::size_t>(i)];
    joint.parent = joint.parent < 0 ? -1 : joint.parent + count;
    joint.place.x += 300;
    joints.push_back(joint);
  }
  MadeRig rig = rig_of(joints);
  Character second = rig.model.characters[0], first = second;
  std::erase_if(first.joints, [&](int joint) { return joint > count; });
  std::erase_if(second.joints, [&](int joint) { return joint <= count; });
  for (const Character& character : {first, second}) {
    const LimbFindings findings = find_limbs(rig.model, character);
    ASSERT_EQ(findings.limbs.size(), 4u);
    for (const Limb& limb : findings.limbs) {
      for (const int joint : limb.joints)
        EXPECT_EQ(joint > count, character.joints.front() > count) << limb.why;
    }
  }
}

}  // namespace
}  // namespace elbowroom::test
