// SPDX-License-Identifier: MIT
// Rigs that exist: what their joints are called and which hangs from which, as public lists of
// their bones have it (named at each). Names and parents are theirs, the body they stand in is
// ours.
#include "tests/unit/rigs/rig_maker.h"

namespace elbowroom::test {
namespace {

// The trunk that most have, under their own names.
void trunk(std::vector<Row>& rows, const char* hips, const char* spine, const char* chest,
           const char* head) {
  rows.push_back({hips, "", "hips"});
  rows.push_back({spine, hips, "spine1"});
  rows.push_back({chest, spine, "chest"});
  rows.push_back({head, chest, "head"});
}

Convention on_trunk(const char* name, std::array<const char*, 4> trunk_names,
                    const std::vector<Row>& limbs, std::array<const char*, 3> arm,
                    std::array<const char*, 3> leg, std::vector<const char*> arm_driven = {},
                    std::vector<const char*> leg_driven = {}) {
  Convention convention;
  convention.name = name;
  trunk(convention.rows, trunk_names[0], trunk_names[1], trunk_names[2], trunk_names[3]);
  convention.rows.insert(convention.rows.end(), limbs.begin(), limbs.end());
  convention.arm = arm;
  convention.leg = leg;
  convention.arm_driven = arm_driven;
  convention.leg_driven = leg_driven;
  return convention;
}

void of_games(std::vector<Convention>& all) {
  // Half-Life: bone lists of its models in public modding tools. "Arm" is the clavicle.
  all.push_back(on_trunk("Half-Life", {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine3", "Bip01 Head"},
                         {{"Bip01 {L|R} Arm", "Bip01 Spine3", "clavicle"},
                          {"Bip01 {L|R} Arm1", "Bip01 {L|R} Arm", "shoulder"},
                          {"Bip01 {L|R} Arm2", "Bip01 {L|R} Arm1", "elbow"},
                          {"Bip01 {L|R} Hand", "Bip01 {L|R} Arm2", "wrist"},
                          {"Bip01 {L|R} Finger0", "Bip01 {L|R} Hand", "thumb1"},
                          {"Bip01 {L|R} Finger1", "Bip01 {L|R} Hand", "index1"},
                          {"Bip01 {L|R} Finger11", "Bip01 {L|R} Finger1", "index2"},
                          {"Bip01 {L|R} Leg", "Bip01 Pelvis", "hip"},
                          {"Bip01 {L|R} Leg1", "Bip01 {L|R} Leg", "knee"},
                          {"Bip01 {L|R} Foot", "Bip01 {L|R} Leg1", "ankle"},
                          {"Bip01 {L|R} Toe0", "Bip01 {L|R} Foot", "ball"}},
                         {"Bip01 {L|R} Arm1", "Bip01 {L|R} Arm2", "Bip01 {L|R} Hand"},
                         {"Bip01 {L|R} Leg", "Bip01 {L|R} Leg1", "Bip01 {L|R} Foot"}));

  // Source 2 (s&box's citizen): arm_upper_L_twist0 and hold_L, as its animation tools list them.
  all.push_back(on_trunk("Source 2", {"pelvis", "spine_0", "spine_2", "head"},
                         {{"clavicle_{L|R}", "spine_2", "clavicle"},
                          {"arm_upper_{L|R}", "clavicle_{L|R}", "shoulder"},
                          {"arm_lower_{L|R}", "arm_upper_{L|R}", "elbow"},
                          {"arm_lower_{L|R}_twist0", "arm_lower_{L|R}", "fore_third"},
                          {"arm_lower_{L|R}_twist1", "arm_lower_{L|R}", "fore_two"},
                          {"arm_upper_{L|R}_twist0", "arm_upper_{L|R}", "upper_third"},
                          {"arm_upper_{L|R}_twist1", "arm_upper_{L|R}", "upper_two"},
                          {"hand_{L|R}", "arm_lower_{L|R}", "wrist"},
                          {"hold_{L|R}", "hand_{L|R}", "palm", kNone},
                          {"finger_index_0_{L|R}", "hand_{L|R}", "index1"},
                          {"finger_middle_0_{L|R}", "hand_{L|R}", "middle1"},
                          {"finger_thumb_0_{L|R}", "hand_{L|R}", "thumb1"},
                          {"leg_upper_{L|R}", "pelvis", "hip"},
                          {"leg_lower_{L|R}", "leg_upper_{L|R}", "knee"},
                          {"ankle_{L|R}", "leg_lower_{L|R}", "ankle"},
                          {"ball_{L|R}", "ankle_{L|R}", "ball"},
                          {"hand_{L|R}_IK_target", "", "wrist", kNone},
                          {"foot_{L|R}_IK_target", "", "ankle", kNone}},
                         {"arm_upper_{L|R}", "arm_lower_{L|R}", "hand_{L|R}"},
                         {"leg_upper_{L|R}", "leg_lower_{L|R}", "ankle_{L|R}"},
                         {"arm_lower_{L|R}_twist0", "arm_lower_{L|R}_twist1",
                          "arm_upper_{L|R}_twist0", "arm_upper_{L|R}_twist1"}));

  // Skyrim with XP32's nodes between: NPC and CME ones in one place, as a public Blender importer
  // lists them with their parents.
  all.push_back(on_trunk(
      "Skyrim, XP32",
      {"NPC Pelvis [Pelv]", "NPC Spine [Spn0]", "CME Spine2 [Spn2]", "NPC Head [Head]"},
      {{"NPC {L|R} Clavicle [{L|R}Clv]", "CME Spine2 [Spn2]", "clavicle"},
       {"CME {L|R} Clavicle [{L|R}Clv]", "NPC {L|R} Clavicle [{L|R}Clv]", "clavicle", kNone},
       {"NPC {L|R} UpperArm [{L|R}Uar]", "CME {L|R} Clavicle [{L|R}Clv]", "shoulder"},
       {"CME {L|R} UpperArm [{L|R}Uar]", "NPC {L|R} UpperArm [{L|R}Uar]", "shoulder", kNone},
       {"NPC {L|R} UpperarmTwist1 [{L|R}Ut1]", "NPC {L|R} UpperArm [{L|R}Uar]", "upper_third"},
       {"NPC {L|R} UpperarmTwist2 [{L|R}Ut2]", "NPC {L|R} UpperarmTwist1 [{L|R}Ut1]", "upper_two"},
       {"NPC {L|R} Forearm [{L|R}Lar]", "CME {L|R} UpperArm [{L|R}Uar]", "elbow"},
       {"NPC {L|R} Hand [{L|R}Hnd]", "NPC {L|R} Forearm [{L|R}Lar]", "wrist"},
       {"NPC {L|R} Finger00 [{L|R}F00]", "NPC {L|R} Hand [{L|R}Hnd]", "thumb1"},
       {"NPC {L|R} Finger10 [{L|R}F10]", "NPC {L|R} Hand [{L|R}Hnd]", "index1"},
       {"NPC {L|R} Finger20 [{L|R}F20]", "NPC {L|R} Hand [{L|R}Hnd]", "middle1"},
       {"NPC {L|R} Thigh [{L|R}Thg]", "NPC Pelvis [Pelv]", "hip"},
       {"NPC {L|R} Calf [{L|R}Clf]", "NPC {L|R} Thigh [{L|R}Thg]", "knee"},
       {"NPC {L|R} Foot [{L|R}ft ]", "NPC {L|R} Calf [{L|R}Clf]", "ankle"},
       {"NPC {L|R} Toe0 [{L|R}Toe]", "NPC {L|R} Foot [{L|R}ft ]", "ball"}},
      {"NPC {L|R} UpperArm [{L|R}Uar]", "NPC {L|R} Forearm [{L|R}Lar]",
       "NPC {L|R} Hand [{L|R}Hnd]"},
      {"NPC {L|R} Thigh [{L|R}Thg]", "NPC {L|R} Calf [{L|R}Clf]", "NPC {L|R} Foot [{L|R}ft ]"},
      {"CME {L|R} UpperArm [{L|R}Uar]", "NPC {L|R} UpperarmTwist1 [{L|R}Ut1]"}));

  // Fallout 4: three forearms in a row, as the same importer and public plugins list them.
  all.push_back(on_trunk("Fallout 4", {"Pelvis", "SPINE1", "Chest", "Head"},
                         {{"{L|R}Arm_Collarbone", "Chest", "clavicle"},
                          {"{L|R}Arm_UpperArm", "{L|R}Arm_Collarbone", "shoulder"},
                          {"{L|R}Arm_UpperTwist1", "{L|R}Arm_UpperArm", "upper_mid"},
                          {"{L|R}Arm_ForeArm1", "{L|R}Arm_UpperArm", "elbow"},
                          {"{L|R}Arm_ForeArm2", "{L|R}Arm_ForeArm1", "fore_third"},
                          {"{L|R}Arm_ForeArm3", "{L|R}Arm_ForeArm2", "fore_two"},
                          {"{L|R}Arm_Hand", "{L|R}Arm_ForeArm3", "wrist"},
                          {"{L|R}Arm_Finger11", "{L|R}Arm_Hand", "thumb1"},
                          {"{L|R}Arm_Finger21", "{L|R}Arm_Hand", "index1"},
                          {"{L|R}Arm_Finger31", "{L|R}Arm_Hand", "middle1"},
                          {"{L|R}Leg_Thigh", "Pelvis", "hip"},
                          {"{L|R}Leg_Calf", "{L|R}Leg_Thigh", "knee"},
                          {"{L|R}Leg_Foot", "{L|R}Leg_Calf", "ankle"},
                          {"{L|R}Leg_Toe1", "{L|R}Leg_Foot", "ball"}},
                         {"{L|R}Arm_UpperArm", "{L|R}Arm_ForeArm1", "{L|R}Arm_Hand"},
                         {"{L|R}Leg_Thigh", "{L|R}Leg_Calf", "{L|R}Leg_Foot"},
                         {"{L|R}Arm_ForeArm2", "{L|R}Arm_ForeArm3", "{L|R}Arm_UpperTwist1"}));

  // Breath of the Wild: Elbow and Knee are helpers, as the skeleton in the BetterVR mod has them.
  all.push_back(on_trunk("numbered arms with helpers called elbow and knee",
                         {"Skl_Root", "Spine_1", "Spine_2", "Head"},
                         {{"Clavicle_{L|R}", "Spine_2", "clavicle"},
                          {"Clavicle_Assist_{L|R}", "Spine_2", "clavicle"},
                          {"Arm_1_{L|R}", "Clavicle_{L|R}", "shoulder"},
                          {"Arm_1_Assist_{L|R}", "Arm_1_{L|R}", "upper_third"},
                          {"Arm_2_{L|R}", "Arm_1_{L|R}", "elbow"},
                          {"Elbow_{L|R}", "Arm_2_{L|R}", "elbow_back"},
                          {"Wrist_Assist_{L|R}", "Arm_2_{L|R}", "fore_two"},
                          {"Wrist_{L|R}", "Arm_2_{L|R}", "wrist"},
                          {"Weapon_{L|R}", "Wrist_{L|R}", "palm", kNone},
                          {"Leg_1_{L|R}", "Skl_Root", "hip"},
                          {"Knee_{L|R}", "Leg_1_{L|R}", "knee_front"},
                          {"Leg_2_{L|R}", "Leg_1_{L|R}", "knee"},
                          {"Ankle_{L|R}", "Leg_2_{L|R}", "ankle"},
                          {"Toe_{L|R}", "Ankle_{L|R}", "ball"}},
                         {"Arm_1_{L|R}", "Arm_2_{L|R}", "Wrist_{L|R}"},
                         {"Leg_1_{L|R}", "Leg_2_{L|R}", "Ankle_{L|R}"},
                         {"Arm_1_Assist_{L|R}", "Wrist_Assist_{L|R}"}));

  // Grand Theft Auto V: roll bones and elbows beside, IK and PH ones, as public mods list them.
  all.push_back(on_trunk("RAGE", {"SKEL_Pelvis", "SKEL_Spine0", "SKEL_Spine3", "SKEL_Head"},
                         {{"SKEL_{L|R}_Clavicle", "SKEL_Spine3", "clavicle"},
                          {"SKEL_{L|R}_UpperArm", "SKEL_{L|R}_Clavicle", "shoulder"},
                          {"RB_{L|R}_ArmRoll", "SKEL_{L|R}_UpperArm", "upper_mid"},
                          {"SKEL_{L|R}_Forearm", "SKEL_{L|R}_UpperArm", "elbow"},
                          {"RB_{L|R}_ForeArmRoll", "SKEL_{L|R}_Forearm", "fore_mid"},
                          {"MH_{L|R}_Elbow", "RB_{L|R}_ForeArmRoll", "elbow"},
                          {"SKEL_{L|R}_Hand", "SKEL_{L|R}_Forearm", "wrist"},
                          {"SKEL_{L|R}_Finger00", "SKEL_{L|R}_Hand", "thumb1"},
                          {"SKEL_{L|R}_Finger10", "SKEL_{L|R}_Hand", "index1"},
                          {"SKEL_{L|R}_Finger20", "SKEL_{L|R}_Hand", "middle1"},
                          {"PH_{L|R}_Hand", "SKEL_{L|R}_Hand", "palm", kNone},
                          {"IK_{L|R}_Hand", "SKEL_{L|R}_Hand", "palm", kNone},
                          {"SKEL_{L|R}_Thigh", "SKEL_Pelvis", "hip"},
                          {"RB_{L|R}_ThighRoll", "SKEL_{L|R}_Thigh", "thigh_mid"},
                          {"SKEL_{L|R}_Calf", "SKEL_{L|R}_Thigh", "knee"},
                          {"MH_{L|R}_Knee", "SKEL_{L|R}_Calf", "knee_front"},
                          {"SKEL_{L|R}_Foot", "SKEL_{L|R}_Calf", "ankle"},
                          {"PH_{L|R}_Foot", "SKEL_{L|R}_Foot", "ball", kNone},
                          {"SKEL_{L|R}_Toe0", "SKEL_{L|R}_Foot", "ball"}},
                         {"SKEL_{L|R}_UpperArm", "SKEL_{L|R}_Forearm", "SKEL_{L|R}_Hand"},
                         {"SKEL_{L|R}_Thigh", "SKEL_{L|R}_Calf", "SKEL_{L|R}_Foot"},
                         {"RB_{L|R}_ArmRoll", "RB_{L|R}_ForeArmRoll"}, {"RB_{L|R}_ThighRoll"}));

  // KayKit: wrist and hand in a row, IK and control bones among the joints; and as three.js has
  // them, without the dots (bone lists in public game repositories).
  for (const bool dots : {true, false}) {
    const auto sided_by = [&](const char* with, const char* without) {
      return dots ? with : without;
    };
    const char* upper = sided_by("upperarm.{l|r}", "upperarm{l|r}");
    const char* lower = sided_by("lowerarm.{l|r}", "lowerarm{l|r}");
    const char* wrist = sided_by("wrist.{l|r}", "wrist{l|r}");
    const char* hand = sided_by("hand.{l|r}", "hand{l|r}");
    const char* thigh = sided_by("upperleg.{l|r}", "upperleg{l|r}");
    const char* shin = sided_by("lowerleg.{l|r}", "lowerleg{l|r}");
    const char* foot = sided_by("foot.{l|r}", "foot{l|r}");
    all.push_back(
        on_trunk(dots ? "KayKit" : "KayKit in three.js", {"hips", "spine", "chest", "head"},
                 {{upper, "chest", "shoulder"},
                  {lower, upper, "elbow"},
                  {wrist, lower, "wrist"},
                  {hand, wrist, "palm"},
                  {sided_by("handslot.{l|r}", "handslot{l|r}"), hand, "index1", kNone},
                  {thigh, "hips", "hip"},
                  {shin, thigh, "knee"},
                  {foot, shin, "ankle"},
                  {sided_by("toes.{l|r}", "toes{l|r}"), foot, "ball"},
                  {sided_by("kneeIK.{l|r}", "kneeIK{l|r}"), "", "knee_pole", kNone},
                  {sided_by("elbowIK.{l|r}", "elbowIK{l|r}"), "", "pole", kNone},
                  {sided_by("handIK.{l|r}", "handIK{l|r}"), "", "wrist", kNone},
                  {sided_by("control-toe-roll.{l|r}", "control-toe-roll{l|r}"), "", "toe", kNone},
                  {sided_by("control-foot-roll.{l|r}", "control-foot-roll{l|r}"),
                   sided_by("control-toe-roll.{l|r}", "control-toe-roll{l|r}"), "heel", kNone},
                  {sided_by("heelIK.{l|r}", "heelIK{l|r}"),
                   sided_by("control-foot-roll.{l|r}", "control-foot-roll{l|r}"), "ankle", kNone},
                  {sided_by("IK-foot.{l|r}", "IK-foot{l|r}"),
                   sided_by("control-foot-roll.{l|r}", "control-foot-roll{l|r}"), "ankle", kNone}},
                 {upper, lower, wrist}, {thigh, shin, foot}));
  }
}

void of_tools(std::vector<Convention>& all) {
  // mGear's numbered joints with twist ones among them and two in the elbow: public maps between it
  // and Rigify.
  all.push_back(
      on_trunk("mGear", {"spine_C0_0_jnt", "spine_C0_1_jnt", "spine_C0_3_jnt", "neck_C0_head_jnt"},
               {{"shoulder_{L|R}0_shoulder_jnt", "spine_C0_3_jnt", "clavicle"},
                {"arm_{L|R}0_0_jnt", "shoulder_{L|R}0_shoulder_jnt", "shoulder"},
                {"arm_{L|R}0_1_jnt", "arm_{L|R}0_0_jnt", "upper_mid"},
                {"arm_{L|R}0_2_jnt", "arm_{L|R}0_1_jnt", "elbow"},
                {"arm_{L|R}0_3_jnt", "arm_{L|R}0_2_jnt", "fore_mid"},
                {"arm_{L|R}0_end_jnt", "arm_{L|R}0_3_jnt", "wrist"},
                {"thumb_{L|R}0_0_jnt", "arm_{L|R}0_end_jnt", "thumb1"},
                {"finger_{L|R}0_0_jnt", "arm_{L|R}0_end_jnt", "index1"},
                {"finger_{L|R}1_0_jnt", "arm_{L|R}0_end_jnt", "middle1"},
                {"leg_{L|R}0_0_jnt", "spine_C0_0_jnt", "hip"},
                {"leg_{L|R}0_1_jnt", "leg_{L|R}0_0_jnt", "thigh_mid"},
                {"leg_{L|R}0_2_jnt", "leg_{L|R}0_1_jnt", "knee"},
                {"leg_{L|R}0_3_jnt", "leg_{L|R}0_2_jnt", "shin_mid"},
                {"leg_{L|R}0_end_jnt", "leg_{L|R}0_3_jnt", "ankle"},
                {"foot_{L|R}0_0_jnt", "leg_{L|R}0_end_jnt", "ball"}},
               {"arm_{L|R}0_0_jnt", "arm_{L|R}0_2_jnt", "arm_{L|R}0_end_jnt"},
               {"leg_{L|R}0_0_jnt", "leg_{L|R}0_2_jnt", "leg_{L|R}0_end_jnt"},
               {"arm_{L|R}0_1_jnt", "arm_{L|R}0_3_jnt"}, {"leg_{L|R}0_1_jnt", "leg_{L|R}0_3_jnt"}));

  // Advanced Skeleton: shoulders and hips in parts, as a public Unreal plugin lists it with
  // parents.
  all.push_back(on_trunk(
      "Advanced Skeleton", {"Root_M", "RootPart1_M", "Chest_M", "Head_M"},
      {{"Scapula_{L|R}", "Chest_M", "clavicle"},
       {"Shoulder_{L|R}", "Scapula_{L|R}", "shoulder"},
       {"ShoulderPart1_{L|R}", "Shoulder_{L|R}", "upper_third"},
       {"ShoulderPart2_{L|R}", "ShoulderPart1_{L|R}", "upper_two"},
       {"Elbow_{L|R}", "ShoulderPart2_{L|R}", "elbow"},
       {"ElbowPart1_{L|R}", "Elbow_{L|R}", "fore_third"},
       {"ElbowPart2_{L|R}", "ElbowPart1_{L|R}", "fore_two"},
       {"Wrist_{L|R}", "ElbowPart2_{L|R}", "wrist"},
       {"ThumbFinger1_{L|R}", "Wrist_{L|R}", "thumb1"},
       {"IndexFinger1_{L|R}", "Wrist_{L|R}", "index1"},
       {"MiddleFinger1_{L|R}", "Wrist_{L|R}", "middle1"},
       {"Hip_{L|R}", "Root_M", "hip"},
       {"HipPart1_{L|R}", "Hip_{L|R}", "thigh_third"},
       {"HipPart2_{L|R}", "HipPart1_{L|R}", "thigh_two"},
       {"Knee_{L|R}", "HipPart2_{L|R}", "knee"},
       {"KneePart1_{L|R}", "Knee_{L|R}", "shin_third"},
       {"KneePart2_{L|R}", "KneePart1_{L|R}", "shin_two"},
       {"Ankle_{L|R}", "KneePart2_{L|R}", "ankle"},
       {"Toes_{L|R}", "Ankle_{L|R}", "ball"}},
      {"Shoulder_{L|R}", "Elbow_{L|R}", "Wrist_{L|R}"}, {"Hip_{L|R}", "Knee_{L|R}", "Ankle_{L|R}"},
      {"ShoulderPart1_{L|R}", "ShoulderPart2_{L|R}", "ElbowPart1_{L|R}", "ElbowPart2_{L|R}"},
      {"HipPart1_{L|R}", "HipPart2_{L|R}", "KneePart1_{L|R}", "KneePart2_{L|R}"}));

  all.back().in_pieces = true;

  // MakeHuman's default rig: every bone in two, as a public simulator's documentation has it.
  all.push_back(on_trunk("MakeHuman", {"root", "spine05", "spine01", "head"},
                         {{"clavicle.{L|R}", "spine01", "clavicle"},
                          {"shoulder01.{L|R}", "clavicle.{L|R}", "clavicle"},
                          {"upperarm01.{L|R}", "shoulder01.{L|R}", "shoulder"},
                          {"upperarm02.{L|R}", "upperarm01.{L|R}", "upper_mid"},
                          {"lowerarm01.{L|R}", "upperarm02.{L|R}", "elbow"},
                          {"lowerarm02.{L|R}", "lowerarm01.{L|R}", "fore_mid"},
                          {"wrist.{L|R}", "lowerarm02.{L|R}", "wrist"},
                          {"metacarpal1.{L|R}", "wrist.{L|R}", "palm"},
                          {"finger2-1.{L|R}", "metacarpal1.{L|R}", "index1"},
                          {"finger1-1.{L|R}", "wrist.{L|R}", "thumb1"},
                          {"pelvis.{L|R}", "root", "hip_helper"},
                          {"upperleg01.{L|R}", "pelvis.{L|R}", "hip"},
                          {"upperleg02.{L|R}", "upperleg01.{L|R}", "thigh_mid"},
                          {"lowerleg01.{L|R}", "upperleg02.{L|R}", "knee"},
                          {"lowerleg02.{L|R}", "lowerleg01.{L|R}", "shin_mid"},
                          {"foot.{L|R}", "lowerleg02.{L|R}", "ankle"},
                          {"toe1-1.{L|R}", "foot.{L|R}", "ball"}},
                         {"upperarm01.{L|R}", "lowerarm01.{L|R}", "wrist.{L|R}"},
                         {"upperleg01.{L|R}", "lowerleg01.{L|R}", "foot.{L|R}"},
                         {"upperarm02.{L|R}", "lowerarm02.{L|R}"},
                         {"upperleg02.{L|R}", "lowerleg02.{L|R}"}));

  // Auto-Rig Pro as it exports for humanoids: the twist joints beside, controls apart (public bone
  // maps of it).
  all.push_back(on_trunk("Auto-Rig Pro", {"root.x", "spine_01.x", "spine_03.x", "head.x"},
                         {{"shoulder.{l|r}", "spine_03.x", "clavicle"},
                          {"arm_stretch.{l|r}", "shoulder.{l|r}", "shoulder"},
                          {"arm_twist.{l|r}", "arm_stretch.{l|r}", "upper_mid"},
                          {"forearm_stretch.{l|r}", "arm_stretch.{l|r}", "elbow"},
                          {"forearm_twist.{l|r}", "forearm_stretch.{l|r}", "fore_mid"},
                          {"hand.{l|r}", "forearm_stretch.{l|r}", "wrist"},
                          {"c_thumb1.{l|r}", "hand.{l|r}", "thumb1"},
                          {"c_index1.{l|r}", "hand.{l|r}", "index1"},
                          {"c_middle1.{l|r}", "hand.{l|r}", "middle1"},
                          {"thigh_stretch.{l|r}", "root.x", "hip"},
                          {"thigh_twist.{l|r}", "thigh_stretch.{l|r}", "thigh_mid"},
                          {"leg_stretch.{l|r}", "thigh_stretch.{l|r}", "knee"},
                          {"leg_twist.{l|r}", "leg_stretch.{l|r}", "shin_mid"},
                          {"foot.{l|r}", "leg_stretch.{l|r}", "ankle"},
                          {"toes_01.{l|r}", "foot.{l|r}", "ball"},
                          {"c_arms_pole.{l|r}", "", "pole", kNone},
                          {"c_hand_fk.{l|r}", "", "wrist", kNone}},
                         {"arm_stretch.{l|r}", "forearm_stretch.{l|r}", "hand.{l|r}"},
                         {"thigh_stretch.{l|r}", "leg_stretch.{l|r}", "foot.{l|r}"},
                         {"arm_twist.{l|r}", "forearm_twist.{l|r}"},
                         {"thigh_twist.{l|r}", "leg_twist.{l|r}"}));

  // Genesis 9, as a public exporter maps it to Unreal.
  all.push_back(on_trunk("DAZ Genesis 9", {"hip", "spine1", "spine4", "head"},
                         {{"{l|r}_shoulder", "spine4", "clavicle"},
                          {"{l|r}_upperarm", "{l|r}_shoulder", "shoulder"},
                          {"{l|r}_upperarmtwist1", "{l|r}_upperarm", "upper_third"},
                          {"{l|r}_upperarmtwist2", "{l|r}_upperarm", "upper_two"},
                          {"{l|r}_forearm", "{l|r}_upperarm", "elbow"},
                          {"{l|r}_forearmtwist1", "{l|r}_forearm", "fore_third"},
                          {"{l|r}_forearmtwist2", "{l|r}_forearm", "fore_two"},
                          {"{l|r}_hand", "{l|r}_forearm", "wrist"},
                          {"{l|r}_thumb1", "{l|r}_hand", "thumb1"},
                          {"{l|r}_index1", "{l|r}_hand", "index1"},
                          {"{l|r}_mid1", "{l|r}_hand", "middle1"},
                          {"{l|r}_thigh", "hip", "hip"},
                          {"{l|r}_thightwist1", "{l|r}_thigh", "thigh_third"},
                          {"{l|r}_shin", "{l|r}_thigh", "knee"},
                          {"{l|r}_foot", "{l|r}_shin", "ankle"},
                          {"{l|r}_toes", "{l|r}_foot", "ball"}},
                         {"{l|r}_upperarm", "{l|r}_forearm", "{l|r}_hand"},
                         {"{l|r}_thigh", "{l|r}_shin", "{l|r}_foot"},
                         {"{l|r}_upperarmtwist1", "{l|r}_upperarmtwist2", "{l|r}_forearmtwist1",
                          "{l|r}_forearmtwist2"},
                         {"{l|r}_thightwist1"}));

  // HumanIK's roll and leaf joints (MakeHuman's target rigs and public retargeting maps).
  all.push_back(on_trunk(
      "HumanIK", {"Character1_Hips", "Character1_Spine", "Character1_Spine2", "Character1_Head"},
      {{"Character1_{Left|Right}Shoulder", "Character1_Spine2", "clavicle"},
       {"Character1_{Left|Right}Arm", "Character1_{Left|Right}Shoulder", "shoulder"},
       {"Character1_{Left|Right}ArmRoll", "Character1_{Left|Right}Arm", "upper_mid"},
       {"Character1_{Left|Right}ForeArm", "Character1_{Left|Right}ArmRoll", "elbow"},
       {"Character1_{Left|Right}ForeArmRoll", "Character1_{Left|Right}ForeArm", "fore_mid"},
       {"Character1_{Left|Right}Hand", "Character1_{Left|Right}ForeArmRoll", "wrist"},
       {"Character1_{Left|Right}HandThumb1", "Character1_{Left|Right}Hand", "thumb1"},
       {"Character1_{Left|Right}HandIndex1", "Character1_{Left|Right}Hand", "index1"},
       {"Character1_{Left|Right}HandMiddle1", "Character1_{Left|Right}Hand", "middle1"},
       {"Character1_{Left|Right}UpLeg", "Character1_Hips", "hip"},
       {"Character1_{Left|Right}UpLegRoll", "Character1_{Left|Right}UpLeg", "thigh_mid"},
       {"Character1_{Left|Right}Leg", "Character1_{Left|Right}UpLegRoll", "knee"},
       {"Character1_{Left|Right}LegRoll", "Character1_{Left|Right}Leg", "shin_mid"},
       {"Character1_{Left|Right}Foot", "Character1_{Left|Right}LegRoll", "ankle"},
       {"Character1_{Left|Right}ToeBase", "Character1_{Left|Right}Foot", "ball"}},
      {"Character1_{Left|Right}Arm", "Character1_{Left|Right}ForeArm",
       "Character1_{Left|Right}Hand"},
      {"Character1_{Left|Right}UpLeg", "Character1_{Left|Right}Leg", "Character1_{Left|Right}Foot"},
      {"Character1_{Left|Right}ArmRoll", "Character1_{Left|Right}ForeArmRoll"},
      {"Character1_{Left|Right}UpLegRoll", "Character1_{Left|Right}LegRoll"}));

  // VRoid Studio: J_Sec for what swings, J_Adj for eyes (public maps to Mixamo and Unity).
  all.push_back(on_trunk("VRoid",
                         {"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_UpperChest", "J_Bip_C_Head"},
                         {{"J_Adj_{L|R}_FaceEye", "J_Bip_C_Head", "eye"},
                          {"J_Sec_{L|R}_Bust1", "J_Bip_C_UpperChest", "breast"},
                          {"J_Bip_{L|R}_Shoulder", "J_Bip_C_UpperChest", "clavicle"},
                          {"J_Bip_{L|R}_UpperArm", "J_Bip_{L|R}_Shoulder", "shoulder"},
                          {"J_Bip_{L|R}_LowerArm", "J_Bip_{L|R}_UpperArm", "elbow"},
                          {"J_Bip_{L|R}_Hand", "J_Bip_{L|R}_LowerArm", "wrist"},
                          {"J_Bip_{L|R}_Thumb1", "J_Bip_{L|R}_Hand", "thumb1"},
                          {"J_Bip_{L|R}_Index1", "J_Bip_{L|R}_Hand", "index1"},
                          {"J_Bip_{L|R}_Middle1", "J_Bip_{L|R}_Hand", "middle1"},
                          {"J_Bip_{L|R}_UpperLeg", "J_Bip_C_Hips", "hip"},
                          {"J_Bip_{L|R}_LowerLeg", "J_Bip_{L|R}_UpperLeg", "knee"},
                          {"J_Bip_{L|R}_Foot", "J_Bip_{L|R}_LowerLeg", "ankle"},
                          {"J_Bip_{L|R}_ToeBase", "J_Bip_{L|R}_Foot", "ball"},
                          {"J_Sec_{L|R}_SkirtFront1", "J_Bip_C_Hips", "skirt1"},
                          {"J_Sec_{L|R}_SkirtFront2", "J_Sec_{L|R}_SkirtFront1", "skirt2"}},
                         {"J_Bip_{L|R}_UpperArm", "J_Bip_{L|R}_LowerArm", "J_Bip_{L|R}_Hand"},
                         {"J_Bip_{L|R}_UpperLeg", "J_Bip_{L|R}_LowerLeg", "J_Bip_{L|R}_Foot"}));
}

}  // namespace

std::vector<Convention> real_conventions() {
  std::vector<Convention> all;
  of_games(all);
  of_tools(all);
  return all;
}

}  // namespace elbowroom::test
