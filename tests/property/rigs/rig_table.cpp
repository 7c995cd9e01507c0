// SPDX-License-Identifier: MIT
#include "tests/property/rigs/rig_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_clip.h"
#include "core/io/gltf_reader.h"
#include "tests/support/samples.h"

namespace elbowroom::test {

namespace {

constexpr double kDegree = kPi / 180;

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

Vec3 flexion_axis(const Model& model, const Character& character, const LimbModel& limb) {
  const JointModel& middle = limb.joints[1];
  const int parent = model.skeleton.joints[static_cast<std::size_t>(middle.joint)].parent;
  const Mat3 world_from_parent(bind_globals(model, character)[static_cast<std::size_t>(parent)]);
  return glm::normalize(world_from_parent * (middle.parent_from_zero * Vec3(0, 0, 1)));
}

}  // namespace

std::vector<RigRow> rig_table() {
  using N = LimbNames;
  const std::array<N, 4> kaykit = {
      N{"upperarm.l", "lowerarm.l", "wrist.l"}, N{"upperarm.r", "lowerarm.r", "wrist.r"},
      N{"upperleg.l", "lowerleg.l", "foot.l"}, N{"upperleg.r", "lowerleg.r", "foot.r"}};
  const std::array<N, 4> cesium = {
      N{"Skeleton_arm_joint_L__4_", "Skeleton_arm_joint_L__3_", "Skeleton_arm_joint_L__2_"},
      N{"Skeleton_arm_joint_R", "Skeleton_arm_joint_R__2_", "Skeleton_arm_joint_R__3_"},
      N{"leg_joint_L_1", "leg_joint_L_2", "leg_joint_L_3"},
      N{"leg_joint_R_1", "leg_joint_R_2", "leg_joint_R_3"}};
  return {
      {"khronos/CesiumMan.glb", "numbered, Z-up under turned nodes", cesium},
      {"compressed_by_tool/CesiumMan_quantized.glb", "numbered, quantized", cesium},
      {"khronos/RiggedFigure.glb",
       "numbered",
       {N{"arm_joint_L_1", "arm_joint_L_2", "arm_joint_L_3"},
        N{"arm_joint_R_1", "arm_joint_R_2", "arm_joint_R_3"},
        N{"leg_joint_L_1", "leg_joint_L_2", "leg_joint_L_3"},
        N{"leg_joint_R_1", "leg_joint_R_2", "leg_joint_R_3"}}},
      {"kaykit/Knight.glb", "KayKit, IK controls as joints", kaykit},
      {"kaykit_manny/manny_med_mod.gltf", "KayKit, no clips", kaykit},
      {"kaykit_manny/Med_General.glb", "KayKit, no figure", kaykit},
      {"kaykit_manny/Med_MovementBasic.glb", "KayKit, no figure", kaykit},
      // Feet hang from the root, as the targets of an IK that was baked; the shin ends in a leaf.
      // The wrist is three palm bones in one place, of which the first with fingers stands for it.
      {"quaternius/RobotExpressive.glb",
       "Blender, x100, feet elsewhere, no wrist",
       {N{"UpperArm.L", "LowerArm.L", "Palm2.L"}, N{"UpperArm.R", "LowerArm.R", "Palm2.R"},
        N{"UpperLeg.L", "LowerLeg.L", "LowerLeg.L_end"},
        N{"UpperLeg.R", "LowerLeg.R", "LowerLeg.R_end"}}},
      {"quaternius/Cyberpunk_Character.glb",
       "Blender, x100, feet elsewhere, weapon in the skin",
       {N{"UpperArm.L", "LowerArm.L", "Hand.L"}, N{"UpperArm.R", "LowerArm.R", "Hand.R"},
        N{"UpperLeg.L", "LowerLeg.L", "LowerLeg.L_end"},
        N{"UpperLeg.R", "LowerLeg.R", "LowerLeg.R_end"}}},
      {"quaternius/Men_Worker.glb",
       "Blender, x100, fingers",
       {N{"UpperArm.L", "LowerArm.L", "Hand.L"}, N{"UpperArm.R", "LowerArm.R", "Hand.R"},
        N{"UpperLeg.L", "LowerLeg.L", "Foot.L"}, N{"UpperLeg.R", "LowerLeg.R", "Foot.R"}}},
      {"kenney/character_medium.gltf",
       "Unity's names, foot controls as joints",
       {N{"LeftArm", "LeftForeArm", "LeftHand"}, N{"RightArm", "RightForeArm", "RightHand"},
        N{"LeftUpLeg", "LeftLeg", "LeftFoot"}, N{"RightUpLeg", "RightLeg", "RightFoot"}}},
      {"vrm/Godette_vrm_v4.vrm",
       "VRM 0.x",
       {N{"upper_arm.l_Armature", "lowerarm.l_Armature", "hand.l_Armature"},
        N{"upper_arm.r_Armature", "lowerarm.r_Armature", "hand.r_Armature"},
        N{"thigh.l_Armature", "shin.l_Armature", "foot.l_Armature"},
        N{"thigh.r_Armature", "shin.r_Armature", "foot.r_Armature"}}},
      // No joint below its forearms. Seen from the front its left is what is named so.
      {"godot/platformer_player.glb",
       "an artist's, no hands, controls as joints",
       {N{}, N{}, N{"l-thigh", "l-leg", "l-foot"}, N{"r-thigh", "r-leg", "r-foot"}},
       true},
      // Four feet: the fore legs count as arms. Its hind legs have a hock, so which three of their
      // four joints are meant the names alone tell.
      {"khronos/Fox.glb",
       "an animal",
       {N{"b_LeftUpperArm_09", "b_LeftForeArm_010", "b_LeftHand_011"},
        N{"b_RightUpperArm_06", "b_RightForeArm_07", "b_RightHand_08"},
        N{"b_LeftLeg01_015", "b_LeftLeg02_016", "b_LeftFoot01_017"},
        N{"b_RightLeg01_019", "b_RightLeg02_020", "b_RightFoot01_021"}}},
      // No bodies at all: a hand, a cylinder.
      {"hands/LeftHandHumanoid.gltf", "a hand", {}},
      {"khronos/RiggedSimple.gltf", "two joints", {}},
  };
}

std::shared_ptr<const Model> read_row(const RigRow& row) {
  ReadOptions options;
  options.images = false;
  const auto model = read_gltf(samples_dir() / "humanoids" / row.file, options);
  if (!model) {
    ADD_FAILURE() << model.error().message();
    return nullptr;
  }
  if ((*model)->characters.empty()) {
    ADD_FAILURE() << row.file << " holds no character";
    return nullptr;
  }
  return *model;
}

std::string test_name(const RigRow& row) {
  std::string text;
  for (const char c : row.file.substr(row.file.rfind('/') + 1))
    text += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return text;
}

std::vector<std::pair<const Clip*, double>> moments_of(const Model& model, const LimbModel& limb) {
  std::vector<std::pair<const Clip*, double>> moments;
  for (const Clip& clip : model.clips) {
    const int count = 1 + static_cast<int>(clip.duration() * 30);
    for (int i = 0; i <= count; ++i)
      moments.emplace_back(&clip, clip.begin + clip.duration() * i / count);
    for (const JointModel& joint : limb.joints) {
      const int channel = clip.find_channel(joint.joint, Path::rotation);
      if (channel < 0) continue;
      for (const float t : clip.channels[static_cast<std::size_t>(channel)].times)
        moments.emplace_back(&clip, static_cast<double>(t));
    }
  }
  return moments;
}

LimbFit fit_of(const Model& model, const Character& character, const LimbModel& limb) {
  LimbFit fit;
  std::array<std::vector<double>, 3> residuals;
  for (const auto& [clip, t] : moments_of(model, limb)) {
    const LimbState state = limb_state_at(limb, model, *clip, t);
    for (std::size_t j = 0; j < 3; ++j)
      residuals[j].push_back(glm::length(rotation_vector_from_quat(state.residual[j])) / kDegree);
  }
  fit.frames = residuals[0].size();
  for (std::size_t j = 0; j < 3; ++j) {
    fit.median[j] = percentile(residuals[j], 0.5);
    fit.high[j] = percentile(residuals[j], 0.99);
  }
  fit.flexion_axis = flexion_axis(model, character, limb);
  return fit;
}

}  // namespace elbowroom::test
