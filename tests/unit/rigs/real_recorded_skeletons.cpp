// SPDX-License-Identifier: MIT
// Skeletons of motion recordings (see real_skeletons.cpp for what is told and how).
#include "tests/unit/rigs/real_skeletons.h"

namespace elbowroom::test {

std::vector<RealSkeleton> recorded_skeletons() {
  std::vector<RealSkeleton> all;
  // Boxing_Toes.bvh among assimp's test models: collar, shoulder, elbow, wrist and hip, knee,
  // ankle.
  all.push_back({"Biovision",
                 {"{Left|Right}Shoulder", "{Left|Right}Elbow", "{Left|Right}Wrist"},
                 {"{Left|Right}Hip", "{Left|Right}Knee", "{Left|Right}Ankle"},
                 R"(
Hips = 0 0 0
 Ab = 0 8.27 0
  Chest = 0 22.42 0
   Neck = 0 22.42 0
    Head = 0 11 0
   {Left|Right}Collar = 0 22.42 0
    {Left|Right}Shoulder = 20 0 0
     {Left|Right}Elbow = 25.59 0 0
      {Left|Right}Wrist = 23.45 0 0
 {Left|Right}Hip = 12 0 0
  {Left|Right}Knee = 0 -42.22 0
   {Left|Right}Ankle = 0 -43.43 0
    {Left|Right}Toes = 0 -6.5 15
)"});

  // 01_01.bvh among assimp's test models (CMU's recordings, converted): joints in one place, no
  // offsets between shoulders, hands and fingers.
  all.push_back({"CMU",
                 {"{Left|Right}Arm", "{Left|Right}ForeArm", "{Left|Right}Hand"},
                 {"{Left|Right}UpLeg", "{Left|Right}Leg", "{Left|Right}Foot"},
                 R"(
Hips = 0 0 0
 {L|R}HipJoint = 0 0 0
  {Left|Right}UpLeg = 1.36 -1.79 0.84
   {Left|Right}Leg = 2.45 -6.73 0
    {Left|Right}Foot = 2.56 -7.04 0
     {Left|Right}ToeBase = 0.16 -0.43 2.32
 LowerBack = 0 0 0
  Spine = 0.03 2.04 -0.19
   Spine1 = 0.06 2.05 -0.04
    Neck = 0 0 0
     Neck1 = -0.05 1.75 0.17
      Head = 0.1 1.76 -0.12
    {Left|Right}Shoulder = 0 0 0
     {Left|Right}Arm = 3.36 1.2 -0.31
      {Left|Right}ForeArm = 4.98 0 0
       {Left|Right}Hand = 3.48 0 0
        {Left|Right}FingerBase = 0 0 0
         {L|R}Fingers = 0.72 0 0
        {L|R}Thumb = 0 0 0
)"});

  // the pose template of a public tool for Second Life: the sides differ a little.
  all.push_back({"Poser",
                 {"{l|r}Shldr", "{l|r}ForeArm", "{l|r}Hand"},
                 {"{l|r}Thigh", "{l|r}Shin", "{l|r}Foot"},
                 R"(
hip = 0 43.5 0
 abdomen = 0 3.42 0
  chest = 0 8.49 -0.68
   neck = 0 10.27 -0.27
    head = 0 3.15 0
   lCollar = 3.42 6.71 -0.82
    lShldr = 3.29 0 0
     lForeArm = 10.13 0 0
      lHand = 8.49 0 0
   rCollar = -3.56 6.71 -0.82
    rShldr = -3.15 0 0
     rForeArm = -10.27 0 0
      rHand = -8.35 0 0
 {l|r}Thigh = 5.34 -1.64 1.37
  {l|r}Shin = -2.05 -20.12 0
   {l|r}Foot = 0 -19.3 -1.23
)"});

  // DragonForgedTheArtist/IClone-CMU-Mocap, 002_01.bvh: legs straight along y, share and
  // twist joints, toes. Without most of its fingers and the face.
  all.push_back({"CC, as recorded",
                 {"CC_Base_{L|R}_Upperarm", "CC_Base_{L|R}_Forearm", "CC_Base_{L|R}_Hand"},
                 {"CC_Base_{L|R}_Thigh", "CC_Base_{L|R}_Calf", "CC_Base_{L|R}_Foot"},
                 R"(
RL_BoneRoot = 0 0 0
 CC_Base_Hip = 0 0 105.2
  CC_Base_Pelvis = 0 0 0
   CC_Base_{L|R}_Thigh = 9.7 -2.2 0.2
    CC_Base_{L|R}_Calf = -0.2 47.7 -0.3
     CC_Base_{L|R}_Foot = -0.3 49.8 0.3
      CC_Base_{L|R}_ToeBaseShareBone = -0.2 13.4 0.6
      CC_Base_{L|R}_ToeBase = -0.2 13.3 0.5
       CC_Base_{L|R}_BigToe1 = 3.8 2.3 0
     CC_Base_{L|R}_CalfTwist01 = 0 0 0
      CC_Base_{L|R}_CalfTwist02 = -0.2 24.9 0.2
     CC_Base_{L|R}_KneeShareBone = 0 0 0
    CC_Base_{L|R}_ThighTwist01 = 0 0 0
     CC_Base_{L|R}_ThighTwist02 = -0.1 23.8 -0.2
  CC_Base_Waist = 0 7.9 1.4
   CC_Base_Spine01 = 0 4.7 1.7
    CC_Base_Spine02 = 0 14.7 -1.9
     CC_Base_NeckTwist01 = 0 27.4 -0.1
      CC_Base_NeckTwist02 = 0 3.8 0.3
       CC_Base_Head = 0 4.1 0.4
     CC_Base_{L|R}_Clavicle = 5.6 21 0
      CC_Base_{L|R}_Upperarm = 0.4 13 0.8
       CC_Base_{L|R}_Forearm = -0.8 25.2 -0.2
        CC_Base_{L|R}_ForearmTwist01 = 0 0 0
         CC_Base_{L|R}_ForearmTwist02 = -0.3 12.8 -0.1
        CC_Base_{L|R}_ElbowShareBone = 0 0 0
        CC_Base_{L|R}_Hand = -0.7 25.7 -0.3
         CC_Base_{L|R}_Mid1 = -0.9 11.3 2.3
         CC_Base_{L|R}_Index1 = -1.2 11 5.2
         CC_Base_{L|R}_Ring1 = 0 11.3 0
         CC_Base_{L|R}_Pinky1 = 1.1 10.7 -2
         CC_Base_{L|R}_Thumb1 = 0.8 5 5.2
       CC_Base_{L|R}_UpperarmTwist01 = 0 0 0
        CC_Base_{L|R}_UpperarmTwist02 = -0.5 12.6 -0.1
)",
                 Vec3(0.0)});

  // makehumancommunity/makehuman, walks/walk1.bvh: a helper "__UpLeg_L" above each thigh, fingers
  // that begin in one place; z up.
  all.push_back({"MakeHuman, as recorded",
                 {"UpArm_{L|R}", "LoArm_{L|R}", "Hand_{L|R}"},
                 {"UpLeg_{L|R}", "LoLeg_{L|R}", "Foot_{L|R}"},
                 R"(
Root = 0 1.24 9.56
 Spine1 = 0 -0.34 0.42
  Spine2 = 0 0.2 1.01
   Spine3 = 0 0.37 1.22
    Neck = 0 -0.27 1.97
     Head = 0 -0.01 1.07
    __Clavicle_{L|R} = 0 -0.27 1.97
     Clavicle_{L|R} = 0.25 -0.59 -0.68
      UpArm_{L|R} = 1.47 0.54 -0.01
       LoArm_{L|R} = 1.97 0.16 -0.19
        Hand_{L|R} = 2.38 -0.23 -0.08
         __Thumb1_{L|R} = 1.01 -0.18 0.06
          Thumb1_{L|R} = -0.74 -0.07 -0.14
         __Index1_{L|R} = 1.01 -0.18 0.06
          Index1_{L|R} = -0.02 -0.19 -0.03
         Middle1_{L|R} = 1.01 -0.18 0.06
         __Ring1_{L|R} = 1.01 -0.18 0.06
          Ring1_{L|R} = -0.01 0.22 -0.04
         __Pinky1_{L|R} = 1.01 -0.18 0.06
          Pinky1_{L|R} = -0.01 0.41 -0.12
 Hips = 0 -0.34 0.42
  __UpLeg_{L|R} = 0 0.02 -0.79
   UpLeg_{L|R} = 1.02 -0.05 -0.19
    LoLeg_{L|R} = -0.12 0.26 -4.26
     Foot_{L|R} = -0.22 0.08 -3.91
      Toe_{L|R} = 0.02 -1.13 -0.64
)",
                 Vec3(0, -1, 0)});

  // pirouette.bvh of three.js' examples: a short joint before each thigh.
  all.push_back({"Poser with buttocks",
                 {"{l|r}Shldr", "{l|r}ForeArm", "{l|r}Hand"},
                 {"{l|r}Thigh", "{l|r}Shin", "{l|r}Foot"},
                 R"(
hip = 0 0 0
 abdomen = 0 20.69 -0.73
  chest = 0 11.7 -0.49
   neck = 0 22.19 -2.19
    head = -0.24 7.07 1.22
   {l|r}Collar = 2.68 19.26 -4.88
    {l|r}Shldr = 8.78 -1.95 1.46
     {l|r}ForeArm = 28.17 -1.71 0.49
      {l|r}Hand = 22.59 0.77 7.07
       {l|r}Thumb1 = 1.22 -0.49 3.41
       {l|r}Index1 = 7.76 0.94 5.61
       {l|r}Mid1 = 8.25 1.18 3.41
       {l|r}Ring1 = 8.83 0.55 1.52
       {l|r}Pinky1 = 8.27 -0.05 -0.46
 {l|r}Buttock = 8.78 4.35 1.22
  {l|r}Thigh = 0 -1.71 -2.19
   {l|r}Shin = 0 -36.82 0.73
    {l|r}Foot = -0.73 -45.11 -5.12
)"});
  return all;
}

}  // namespace elbowroom::test
