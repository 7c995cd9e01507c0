// SPDX-License-Identifier: MIT
// Skeletons that exist, by the names, parents and rest offsets of their joints (sources at each;
// facts alone, put into our own form and rounded; for what a line means see skeleton_text.h).
#include "tests/unit/rigs/real_skeletons.h"

namespace elbowroom::test {

std::vector<RealSkeleton> real_skeletons() {
  std::vector<RealSkeleton> all = recorded_skeletons();

  // Blender 3.4, rigify/metarigs/Basic/basic_human.py: places of the bones' heads.
  all.push_back({"Rigify, basic human",
                 {"upper_arm.{L|R}", "forearm.{L|R}", "hand.{L|R}"},
                 {"thigh.{L|R}", "shin.{L|R}", "foot.{L|R}"},
                 R"(
spine = 0 1.01 -0.055
 spine.001 = 0 0.147 0.038
  spine.002 = 0 0.136 0.017
   spine.003 = 0 0.173 -0.005
    spine.004 = 0 0.192 -0.006
     spine.005 = 0 0.062 0.024
      spine.006 = 0 0.062 0.012
    shoulder.{L|R} = 0.018 0.139 0.074
     upper_arm.{L|R} = 0.177 -0.02 -0.095
      forearm.{L|R} = 0.247 -0.135 -0.062
       hand.{L|R} = 0.217 -0.143 0.039
    breast.{L|R} = 0.118 -0.006 -0.043
 pelvis.{L|R} = 0 0 0
 thigh.{L|R} = 0.098 0.062 0.043
  shin.{L|R} = 0 -0.535 0.041
   foot.{L|R} = 0 -0.452 -0.045
    toe.{L|R} = 0 -0.069 0.11
    heel.02.{L|R} = -0.038 -0.085 -0.03
)"});

  // Blender 3.4, rigify/metarigs/human.py, without the face.
  all.push_back({"Rigify, human",
                 {"upper_arm.{L|R}", "forearm.{L|R}", "hand.{L|R}"},
                 {"thigh.{L|R}", "shin.{L|R}", "foot.{L|R}"},
                 R"(
spine = 0 1.01 -0.055
 spine.001 = 0 0.147 0.038
  spine.002 = 0 0.136 0.017
   spine.003 = 0 0.173 -0.005
    spine.004 = 0 0.192 -0.006
     spine.005 = 0 0.062 0.024
      spine.006 = 0 0.062 0.012
    shoulder.{L|R} = 0.018 0.139 0.074
     upper_arm.{L|R} = 0.177 -0.02 -0.095
      forearm.{L|R} = 0.247 -0.135 -0.062
       hand.{L|R} = 0.217 -0.143 0.039
        palm.01.{L|R} = 0.033 -0.018 0.027
         f_index.01.{L|R} = 0.054 -0.04 0.017
          f_index.02.{L|R} = 0.025 -0.037 0.004
           f_index.03.{L|R} = 0.012 -0.025 0.002
         thumb.01.{L|R} = -0.022 -0.014 0.001
          thumb.02.{L|R} = 0.015 -0.033 0.02
           thumb.03.{L|R} = 0.02 -0.026 0.007
        palm.02.{L|R} = 0.038 -0.018 0.01
         f_middle.01.{L|R} = 0.055 -0.039 0.011
          f_middle.02.{L|R} = 0.024 -0.043 0.004
           f_middle.03.{L|R} = 0.009 -0.031 0.002
        palm.03.{L|R} = 0.037 -0.019 -0.005
         f_ring.01.{L|R} = 0.058 -0.039 0.002
          f_ring.02.{L|R} = 0.017 -0.041 0.002
           f_ring.03.{L|R} = 0.008 -0.031 0.001
        palm.04.{L|R} = 0.033 -0.019 -0.02
         f_pinky.01.{L|R} = 0.06 -0.044 -0.007
          f_pinky.02.{L|R} = 0.006 -0.027 0
           f_pinky.03.{L|R} = 0.003 -0.022 -0.001
    breast.{L|R} = 0.118 -0.006 -0.043
 pelvis.{L|R} = 0 0 0
 thigh.{L|R} = 0.098 0.062 0.043
  shin.{L|R} = 0 -0.535 0.041
   foot.{L|R} = 0 -0.452 -0.045
    toe.{L|R} = 0 -0.069 0.11
    heel.02.{L|R} = -0.038 -0.085 -0.03
)"});

  // MotionCaptureROM.ase among assimp's test models: a recorded pose, umlauts lost.
  all.push_back({"3ds Max Biped, German",
                 {"Bip01 {L|R} Oberarm", "Bip01 {L|R} Unterarm", "Bip01 {L|R} Hand"},
                 {"Bip01 {L|R} Oberschenkel", "Bip01 {L|R} Unterschenkel", "Bip01 {L|R} Fu_"},
                 R"(
Bip01 = 0.32 34.08 -19.5
 Bip01 Schritte = 0 -32.19 0
 Bip01 Becken = 0 0 0
  Bip01 Wirbels_ule = 0 1.46 0
   Bip01 Wirbels_ule1 = 0 5.42 0.01
    Bip01 Wirbels_ule2 = 0.68 8.1 -0.39
     Bip01 Hals = 0.02 8.14 -0.16
      Bip01 Kopf = 0.01 1.96 -0.04
       Bip01 KopfNub = -0.97 9.58 1.79
      Bip01 L Schl_sselbein = 1.11 -0.01 -0.19
       Bip01 L Oberarm = 5.68 1.4 -0.01
        Bip01 L Unterarm = 9.95 -2.28 -5.72
         Bip01 L Hand = 9.77 -0.75 2.82
          Bip01 L Finger0 = 3.94 0.35 1.54
           Bip01 L Finger0Nub = 0.99 0.09 0.39
      Bip01 R Schl_sselbein = -1.11 0.01 0.19
       Bip01 R Oberarm = -5.83 0.42 0.3
        Bip01 R Unterarm = -10.96 -1.95 -3.59
         Bip01 R Hand = -9.98 0.23 2.06
          Bip01 R Finger0 = -3.74 0.79 1.84
           Bip01 R Finger0Nub = -0.94 0.2 0.46
   Bip01 {L|R} Oberschenkel = 5.04 -1.46 -0.15
    Bip01 {L|R} Unterschenkel = 2.83 -14.99 3.68
     Bip01 {L|R} Fu_ = -1.02 -12.79 -4.24
      Bip01 {L|R} Zeh0 = 2.1 -4.67 4.66
       Bip01 {L|R} Zeh0Nub = 1.11 -0.18 2.46
)"});

  // a monster of a public Roblox game: thigh_twist above thigh_stretch, a third arm on its head.
  all.push_back({"Auto-Rig Pro with first halves called twists",
                 {"c_arm_twist_offset.{l|r}", "forearm_stretch.{l|r}", "hand.{l|r}"},
                 {"thigh_twist.{l|r}", "leg_stretch.{l|r}", "foot.{l|r}"},
                 R"(
root.x = 0 2.29 0
 spine_01.x = 0 0 0
  spine_02.x = 0 0.55 0
   Neck = 0 0.39 0
    Head = 0 0.18 0
     Arm.C = 0 2.31 0.07
      Elbow.C = 0 2.23 0
       Hand.C = 0 2.45 0
        thumb.C = 0.95 0.5 0
        Index.C = 0.67 1.66 0
        Middle.C = 0.02 1.96 0
        Ring.C = -0.63 1.64 0
     Lid = 0 2.04 -1.3
   shoulder.{l|r} = 0.077 0.435 0
    c_arm_twist_offset.{l|r} = 0.499 -0.282 0
     arm_stretch.{l|r} = 0.5 0 0
      forearm_stretch.{l|r} = 0.5 0 0
       forearm_twist.{l|r} = 0.68 0 0
        hand.{l|r} = 0.68 0 0
         Fingers.{l|r} = 1.6 -0.02 0.04
 thigh_twist.{l|r} = 0.3 -0.23 -0.07
  thigh_stretch.{l|r} = 0 -0.475 0.003
   leg_stretch.{l|r} = 0 -0.475 0.003
    leg_twist.{l|r} = 0 -0.468 -0.003
     foot.{l|r} = 0 -0.468 -0.003
      toes_01.{l|r} = 0.066 0 0.183
)"});

  all.push_back(unreal_skeleton());
  // the SMD of a character of Sleeping Dogs, from a forum's archive: an A-pose, twist joints
  // beside the upper arms, joints that were left at the origin.
  all.push_back({"Valve Biped",
                 {"ValveBiped.Bip01_{L|R}_UpperArm", "ValveBiped.Bip01_{L|R}_Forearm",
                  "ValveBiped.Bip01_{L|R}_Hand"},
                 {"ValveBiped.Bip01_{L|R}_Thigh", "ValveBiped.Bip01_{L|R}_Calf",
                  "ValveBiped.Bip01_{L|R}_Foot"},
                 R"(
ValveBiped.Bip01 = 0 0.962 0
 ValveBiped.Bip01_Pelvis = 0 0 0
  ValveBiped.Direction = 0 -0.962 0
   ValveBiped.Sync01 = 0 0 0
  ValveBiped.Balance = 0 0.059 -0.02
   ValveBiped.Bip01_Spine = 0 0 0
    ValveBiped.Bip01_Spine1 = 0 0.117 0
     ValveBiped.Bip01_Spine2 = 0 0.117 0
      ValveBiped.Bip01_Spine3 = 0 0.117 0
       ValveBiped.Bip01_Neck = 0 0.124 -0.019
        ValveBiped.Bip01_Head = 0 0.072 0.02
        ValveBiped.Bip01_{L|R}_Clavicle = 0.036 -0.04 0.01
         ValveBiped.Bip01_{L|R}_UpperArm = 0.156 -0.016 -0.021
          ValveBiped.Bip01_{L|R}_Forearm = 0.186 -0.178 0.037
           ValveBiped.Bip01_{L|R}_Hand = 0.171 -0.166 0.072
            ValveBiped.Bip01_{L|R}_Finger0 = 0.017 -0.01 0.035
             ValveBiped.Bip01_{L|R}_Finger01 = 0.014 -0.021 0.03
            ValveBiped.Bip01_{L|R}_Finger1 = 0.076 -0.058 0.045
            ValveBiped.Bip01_{L|R}_Finger2 = 0.077 -0.068 0.022
            ValveBiped.Bip01_{L|R}_Prop = 0 0 0
          ValveBiped.Bip01_{L|R}_ForeTwist = 0.186 -0.178 0.037
         ValveBiped.Bip01_{L|R}UpArmTwist = 0.156 -0.016 -0.021
  ValveBiped.Bip01_{L|R}_Thigh = 0.087 0 0
   ValveBiped.Bip01_{L|R}_Calf = 0.024 -0.431 -0.035
    ValveBiped.Bip01_{L|R}_Foot = 0.023 -0.429 -0.035
     ValveBiped.Bip01_{L|R}_Toe0 = 0.03 -0.095 0.125
 ValveBiped.{l|r}_upperarm_twist = 0 0 0
 ValveBiped.{l|r}_shoulder_joint = 0 0 0
)",
                 Vec3(0, 0, 1),
                 2});

  // A VRM 0 file made from a MikuMikuDance model, as a chat program's rules for it list its bones:
  // faces -z, legs are the D bones, below a knee hangs a copy of the leg. Where the hips' own
  // offsets are not told they are ours.
  all.push_back({"VRM from MikuMikuDance",
                 {"joint_{Left|Right}Arm", "joint_{Left|Right}Elbow", "joint_{Left|Right}Wrist"},
                 {"joint_{Left|Right}HipD", "joint_{Left|Right}KneeD", "joint_{Left|Right}FootD"},
                 R"(
joint_HipMaster = 0 1.03 0.01
 !joint_HipMasterTip = 0 -0.12 0 -
 joint_Torso = 0 0 0
  joint_Torso1 = 0 0.11 -0.01
  joint_Torso2 = 0 0.2 -0.02
   joint_Neck = 0 0.24 0.02
    joint_Head = 0 0.08 -0.02
   joint_{Left|Right}Shoulder = -0.03 0.17 0.06
    !joint_{Left|Right}ShoulderC = -0.08 0 0 -
    joint_{Left|Right}Arm = -0.08 0 0
     joint_{Left|Right}ArmTwist = -0.14 -0.01 0
     joint_{Left|Right}ArmTwist1 = -0.08 0 0
     joint_{Left|Right}ArmTwist2 = -0.13 -0.01 0
     joint_{Left|Right}ArmTwist3 = -0.18 -0.01 0
     joint_{Left|Right}Elbow = -0.24 -0.01 0
      joint_{Left|Right}Wrist = -0.24 0 0
       joint_{Left|Right}Thumb0 = 0.01 0 0
       joint_{Left|Right}Index1 = -0.06 -0.01 -0.03
        joint_{Left|Right}Index2 = -0.03 0 0
       joint_{Left|Right}Middle1 = -0.06 -0.01 -0.02
        joint_{Left|Right}Middle2 = -0.04 0 0
       joint_{Left|Right}Ring1 = -0.06 -0.01 0
        joint_{Left|Right}Ring2 = -0.03 0 0
       !joint_{Left|Right}Thumb0M = -0.01 -0.01 -0.02
        joint_{Left|Right}Thumb1 = -0.01 -0.01 -0.02
 joint_{Left|Right}HipD = -0.09 -0.1 0.01
  joint_{Left|Right}KneeD = 0 -0.43 0.01
   !joint_{Left|Right}Hip = 0 0.43 -0.01 -
    !joint_{Left|Right}Knee = -0.01 -0.43 0.02 -
     !joint_{Left|Right}Foot = -0.01 -0.41 0.05 -
   joint_{Left|Right}FootD = 0.01 -0.41 0.05
    joint_{hidari|migi}ashisakiEX = 0 -0.08 -0.12
)",
                 Vec3(0, 0, -1)});

  // Second Life, avatar_skeleton.xml of its viewers: collision volumes, which clothes are skinned
  // to, bear the names of limbs beside the joints; turned to y up and +z forward.
  all.push_back({"Second Life",
                 {"mShoulder{Left|Right}", "mElbow{Left|Right}", "mWrist{Left|Right}"},
                 {"mHip{Left|Right}", "mKnee{Left|Right}", "mAnkle{Left|Right}"},
                 R"(
mPelvis = 0 1.067 0
 PELVIS = 0 -0.02 -0.01
 mTorso = 0 0.084 0
  BELLY = 0 0.04 0.028
  mChest = 0 0.205 -0.015
   CHEST = 0 0.07 0.028
   mNeck = 0 0.251 -0.01
    NECK = 0 0.02 0
    mHead = 0 0.076 0
     HEAD = 0 0.07 0.02
     mSkull = 0 0.079 0
     mEye{Left|Right} = 0.036 0.079 0.098
   mCollarLeft = 0.085 0.165 -0.021
    L_CLAVICLE = 0 0.02 0.02
    mShoulderLeft = 0.079 0 0
     L_UPPER_ARM = 0.12 0.01 0
     mElbowLeft = 0.248 0 0
      L_LOWER_ARM = 0.1 0 0
      mWristLeft = 0.205 0 0
       L_HAND = 0.05 0 0.01
   mCollarRight = -0.085 0.165 -0.021
    R_CLAVICLE = 0 0.02 0.02
    mShoulderRight = -0.079 0 0
     R_UPPER_ARM = -0.12 0.01 0
     mElbowRight = -0.248 0 0
      R_LOWER_ARM = -0.1 0 0
      mWristRight = -0.205 0 0
       R_HAND = -0.05 0 0.01
 mHipRight = -0.129 -0.041 0.034
  R_UPPER_LEG = 0.05 -0.22 -0.02
  mKneeRight = 0.049 -0.491 -0.001
   R_LOWER_LEG = 0 -0.2 -0.02
   mAnkleRight = 0 -0.468 -0.029
    R_FOOT = 0 -0.041 0.077
    mFootRight = 0 -0.061 0.112
     mToeRight = 0 0 0.109
 mHipLeft = 0.127 -0.041 0.034
  L_UPPER_LEG = -0.05 -0.22 -0.02
  mKneeLeft = -0.046 -0.491 -0.001
   L_LOWER_LEG = 0 -0.2 -0.02
   mAnkleLeft = 0.001 -0.468 -0.029
    L_FOOT = 0 -0.041 0.077
    mFootLeft = 0 -0.061 0.112
     mToeLeft = 0 0 0.109
)"});

  // BabylonJS/Assets, meshes/Yeti/Unity/YetiUnity.gltf: faces -z, bound asymmetrically, its forearm
  // is a twist joint below the elbow.
  all.push_back({"Yeti",
                 {"Yeti_{Left|Right}Arm", "Yeti_{Left|Right}Elbow", "Yeti_{Left|Right}Wrist"},
                 {"Yeti_{Left|Right}Leg", "Yeti_{Left|Right}Knee", "Yeti_{Left|Right}Ankle"},
                 R"(
Yeti_Hips = 0 0.0876 0
 Yeti_Spine1 = 0 0.0167 -0.003
  Yeti_Spine2 = 0 0.0303 -0.0039
   Yeti_Spine3 = 0 0.0251 -0.0019
    Yeti_Spine4 = 0 0.026 -0.0007
     Yeti_Spine5 = 0 0.0237 0.0004
      Yeti_Spine6 = 0 0.0235 0.0012
       Yeti_Neck = 0 0.0418 -0.0006
        Yeti_Head = 0 0.0462 -0.0019
         Yeti_{Left|Right}Ear = -0.0587 0.0153 0.0368
       Yeti_LeftClavicle = -0.0243 0.0037 0.0108
        Yeti_LeftArm = -0.0611 0.0093 0.0271
         Yeti_LeftElbow = -0.045 -0.058 0.0126
          Yeti_LeftForearm = -0.0099 -0.0231 -0.0322
           Yeti_LeftWrist = -0.0092 -0.0223 -0.0317
            Yeti_LeftThumb1 = 0.0118 -0.0055 -0.0311
            Yeti_LeftIndex1 = -0.0109 -0.0088 -0.0452
            Yeti_LeftMiddle1 = -0.0254 -0.0207 -0.0323
            Yeti_LeftPinky1 = -0.0323 -0.0301 -0.0117
       Yeti_RightClavicle = 0.0243 0.0037 0.0108
        Yeti_RightArm = 0.0611 0.0093 0.0271
         Yeti_RightElbow = 0.042 -0.0573 0.0225
          Yeti_RightForearm = 0.0174 -0.0343 -0.0136
           Yeti_RightWrist = 0.0169 -0.0335 -0.0133
            Yeti_RightThumb1 = -0.0194 -0.0179 -0.0209
            Yeti_RightIndex1 = -0.0036 -0.0339 -0.0341
            Yeti_RightMiddle1 = 0.013 -0.0406 -0.0174
            Yeti_RightPinky1 = 0.0235 -0.0389 0.0047
 Yeti_{Left|Right}Leg = -0.0489 -0.012 0
  Yeti_{Left|Right}Knee = -0.0052 -0.0306 -0.0056
   Yeti_{Left|Right}Ankle = 0.0041 -0.023 0.0145
)",
                 Vec3(0, 0, -1)});

  // cioddi/desktophero_django_docker, the lower half of a figure: "#left arm" and the like are
  // places to put things.
  all.push_back({"half a figure with attachment points",
                 {},
                 {"{left|right} thigh", "{left|right} shin", "{left|right} foot"},
                 R"(
pelvis = 0 -0.656 0.221
 {left|right} thigh = 0.582 0.16 -0.258
  {left|right} shin = 0.19 -1.489 0.242
   {left|right} foot = 0.333 -1.811 -0.536
    {left|right} foot arch = 0.075 -0.226 0.237
     #{left|right} foot = 0.051 0.059 0.309 -
     {left|right} foot toes = 0.017 -0.105 0.199
      @{left|right} foot toes = 0.057 -0.029 0.446 -
     @{left|right} foot arch = 0.017 -0.105 0.199 -
    @{left|right} foot = 0.075 -0.226 0.237 -
   #{left|right} ankle = 0.312 -1.692 -0.455 -
   #{left|right} knee = 0.075 -0.258 0.222 -
   @{left|right} shin = 0.314 -1.681 -0.5 -
  #{left|right} hip = 0.246 0.104 0.308 -
  @{left|right} thigh = 0.19 -1.489 0.242 -
 {left|right} butt = 0.566 0.533 -0.673
  @{left|right} butt = -0.213 -0.578 0.002 -
 #tail = 0 0.625 -0.679 -
 torso bottom = 0 0.534 -0.298
  torso middle = 0 0.345 0.089
   torso top = 0 0.598 0
    {left|right} breast = 0.454 0.116 0.483
     #chest {left|right} = 0 0.403 0.002 -
    #neck = 0 1.187 -0.079 -
    #{left|right} arm = 0.859 0.934 -0.354 -
    #{left|right} shoulder = 0.849 1.117 -0.336 -
    #{left|right} shoulder blade upper = 0.587 0.77 -0.986 -
    #{left|right} armpit = 0.762 0.534 -0.478 -
  #{left|right} hip.001 = 0.712 0.09 0.136 -
)"});

  return all;
}

}  // namespace elbowroom::test
