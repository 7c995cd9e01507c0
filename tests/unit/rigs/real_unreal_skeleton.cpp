// SPDX-License-Identifier: MIT
// A MetaHuman's body (see real_skeletons.cpp for what is told and how).
#include "tests/unit/rigs/real_skeletons.h"

namespace elbowroom::test {

RealSkeleton unreal_skeleton() {
  // names and parents as a public DAZ to Unreal exporter lists them, in a body of ours:
  // twist, corrective and muscle joints, IK bones.
  return {"MetaHuman",
          {"upperarm_{l|r}", "lowerarm_{l|r}", "hand_{l|r}"},
          {"thigh_{l|r}", "calf_{l|r}", "foot_{l|r}"},
          R"(
root = 0 0 0 -
 pelvis = 0 0.98 0
  spine_01 = 0 0.04 -0.01
   spine_02 = 0 0.08 0
    spine_03 = 0 0.1 0
     spine_04 = 0 0.1 0
      spine_05 = 0 0.08 0
       neck_01 = 0 0.12 0
        neck_02 = 0 0.04 0.01
         head = 0 0.04 0.01
       clavicle_{l|r} = 0.02 0.05 0.03
        clavicle_out_{l|r} = 0.12 0.02 -0.02
        clavicle_scap_{l|r} = 0.08 -0.03 -0.1
        upperarm_{l|r} = 0.16 0 -0.03
         lowerarm_{l|r} = 0.28 0 -0.01
          hand_{l|r} = 0.25 0 0.01
           wrist_inner_{l|r} = 0 0 0.04
           wrist_outer_{l|r} = 0 0 -0.04
           index_metacarpal_{l|r} = 0.03 0 0.019
            index_01_{l|r} = 0.06 0 0.006
             index_02_{l|r} = 0.04 -0.002 0
              index_03_{l|r} = 0.025 -0.003 0
           middle_metacarpal_{l|r} = 0.03 0 0.005
            middle_01_{l|r} = 0.065 0 -0.003
             middle_02_{l|r} = 0.04 -0.002 0
              middle_03_{l|r} = 0.025 -0.003 0
           ring_metacarpal_{l|r} = 0.03 0 -0.008
            ring_01_{l|r} = 0.06 0 -0.012
             ring_02_{l|r} = 0.04 -0.002 0
              ring_03_{l|r} = 0.025 -0.003 0
           pinky_metacarpal_{l|r} = 0.03 0 -0.019
            pinky_01_{l|r} = 0.05 0 -0.019
             pinky_02_{l|r} = 0.04 -0.002 0
              pinky_03_{l|r} = 0.025 -0.003 0
           thumb_01_{l|r} = 0.025 -0.01 0.03
            thumb_02_{l|r} = 0.03 -0.005 0.025
             thumb_03_{l|r} = 0.02 -0.005 0.015
           weapon_{l|r} = 0.05 -0.02 0.01 -
          lowerarm_twist_02_{l|r} = 0.082 0 0.003
          lowerarm_twist_01_{l|r} = 0.165 0 0.007
          lowerarm_correctiveRoot_{l|r} = 0 0 0 -
           lowerarm_bck_{l|r} = 0 0 -0.05
           lowerarm_fwd_{l|r} = 0 0 0.05
           lowerarm_in_{l|r} = 0 -0.05 0
           lowerarm_out_{l|r} = 0 0.05 0
         upperarm_twist_01_{l|r} = 0.092 0 -0.003
          upperarm_twistCor_01_{l|r} = 0 0 0
         upperarm_twist_02_{l|r} = 0.185 0 -0.007
          upperarm_twistCor_02_{l|r} = 0 0 0
          upperarm_bicep_{l|r} = -0.025 0 0.057
          upperarm_tricep_{l|r} = -0.025 0 -0.043
         upperarm_correctiveRoot_{l|r} = 0 0 0 -
          upperarm_bck_{l|r} = 0 0 -0.05
          upperarm_fwd_{l|r} = 0 0 0.05
          upperarm_in_{l|r} = 0 -0.05 0
          upperarm_out_{l|r} = 0 0.05 0
       clavicle_pec_{l|r} = 0.1 -0.02 0.09
       spine_04_latissimus_{l|r} = 0.14 -0.08 -0.07
  thigh_{l|r} = 0.1 -0.05 0
   calf_{l|r} = 0 -0.44 0.02
    foot_{l|r} = 0 -0.41 -0.04
     ball_{l|r} = 0 -0.06 0.13
     ankle_fwd_{l|r} = 0 0 0.05
     ankle_bck_{l|r} = 0 0 -0.04
    calf_twist_02_{l|r} = 0 -0.135 -0.013
     calf_twistCor_02_{l|r} = 0 0 0
    calf_twist_01_{l|r} = 0 -0.271 -0.026
    calf_correctiveRoot_{l|r} = 0 0 0 -
     calf_kneeBack_{l|r} = 0 0 -0.07
     calf_knee_{l|r} = 0 0 0.05
   thigh_twist_01_{l|r} = 0 -0.145 0.007
    thigh_twistCor_01_{l|r} = 0 0 0
   thigh_twist_02_{l|r} = 0 -0.29 0.013
    thigh_twistCor_02_{l|r} = 0 0 0
   thigh_correctiveRoot_{l|r} = 0 0 0 -
    thigh_bck_{l|r} = 0 0 -0.05
    thigh_fwd_{l|r} = 0 0 0.05
    thigh_in_{l|r} = -0.05 0 0
    thigh_out_{l|r} = 0.05 0 0
    thigh_bck_lwr_{l|r} = 0 -0.33 -0.06
    thigh_fwd_lwr_{l|r} = 0 -0.33 0.07
 ik_foot_root = 0 0 0 -
  ik_foot_{l|r} = 0.1 0.08 -0.02 -
 ik_hand_root = 0 0 0 -
  ik_hand_gun = -0.71 1.43 -0.01 -
 interaction = 0 0 0 -
 center_of_mass = 0 0 0 -
  ik_hand_l = 1.42 0 0 -
  ik_hand_r = 0 0 0 -
)"};
}

}  // namespace elbowroom::test
