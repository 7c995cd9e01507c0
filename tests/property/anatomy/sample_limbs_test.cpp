// SPDX-License-Identifier: MIT
// Limbs, joint models and limits on real characters: which joints are found, that every frame of
// every clip goes into parameters and back, how small the residuals are, and flexion axes against
// ones written down by hand.
#include <gtest/gtest.h>
#include <ostream>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_clip.h"
#include "core/io/gltf_reader.h"
#include "tests/support/samples.h"

namespace elbowroom {
namespace {

constexpr double kDegree = kPi / 180.0;

std::shared_ptr<const Model> read_sample(const std::string& file) {
  ReadOptions options;
  options.images = false;
  const auto model = read_gltf(test::samples_dir() / file, options);
  if (!model) {
    ADD_FAILURE() << model.error().message();
    return nullptr;
  }
  return *model;
}

// root, middle, end of each limb; an empty list where the limb is to be absent.
using Names = std::vector<std::string>;
struct Expected {
  std::string file;
  std::array<Names, 4> limbs;  // left arm, right arm, left leg, right leg
};

void PrintTo(const Expected& one, std::ostream* out) { *out << one.file; }

std::vector<Expected> expectations() {
  const auto kaykit = [](const std::string& file) {
    return Expected{
        file,
        {Names{"upperarm.l", "lowerarm.l", "wrist.l"}, Names{"upperarm.r", "lowerarm.r", "wrist.r"},
         Names{"upperleg.l", "lowerleg.l", "foot.l"}, Names{"upperleg.r", "lowerleg.r", "foot.r"}}};
  };
  const auto cesium = [](const std::string& file) {
    return Expected{
        file,
        {Names{"Skeleton_arm_joint_L__4_", "Skeleton_arm_joint_L__3_", "Skeleton_arm_joint_L__2_"},
         Names{"Skeleton_arm_joint_R", "Skeleton_arm_joint_R__2_", "Skeleton_arm_joint_R__3_"},
         Names{"leg_joint_L_1", "leg_joint_L_2", "leg_joint_L_3"},
         Names{"leg_joint_R_1", "leg_joint_R_2", "leg_joint_R_3"}}};
  };
  return {
      cesium("humanoids/khronos/CesiumMan.glb"),
      cesium("humanoids/compressed_by_tool/CesiumMan_quantized.glb"),
      {"humanoids/khronos/RiggedFigure.glb",
       {Names{"arm_joint_L_1", "arm_joint_L_2", "arm_joint_L_3"},
        Names{"arm_joint_R_1", "arm_joint_R_2", "arm_joint_R_3"},
        Names{"leg_joint_L_1", "leg_joint_L_2", "leg_joint_L_3"},
        Names{"leg_joint_R_1", "leg_joint_R_2", "leg_joint_R_3"}}},
      // A four-footed one: its limbs are found by the same names.
      {"humanoids/khronos/Fox.glb",
       {Names{"b_LeftUpperArm_09", "b_LeftForeArm_010", "b_LeftHand_011"},
        Names{"b_RightUpperArm_06", "b_RightForeArm_07", "b_RightHand_08"},
        Names{"b_LeftLeg01_015", "b_LeftLeg02_016", "b_LeftFoot01_017"},
        Names{"b_RightLeg01_019", "b_RightLeg02_020", "b_RightFoot01_021"}}},
      kaykit("humanoids/kaykit/Knight.glb"),
      kaykit("humanoids/kaykit_manny/manny_med_mod.gltf"),
      kaykit("humanoids/kaykit_manny/Med_General.glb"),
      kaykit("humanoids/kaykit_manny/Med_MovementBasic.glb"),
      // Its feet hang from the root, as targets of an IK that was baked; the shin ends in a leaf.
      {"humanoids/quaternius/RobotExpressive.glb",
       {Names{"UpperArm.L", "LowerArm.L", "Palm2.L"}, Names{"UpperArm.R", "LowerArm.R", "Palm2.R"},
        Names{"UpperLeg.L", "LowerLeg.L", "LowerLeg.L_end"},
        Names{"UpperLeg.R", "LowerLeg.R", "LowerLeg.R_end"}}},
      {"humanoids/quaternius/Cyberpunk_Character.glb",
       {Names{"UpperArm.L", "LowerArm.L", "Hand.L"}, Names{"UpperArm.R", "LowerArm.R", "Hand.R"},
        Names{"UpperLeg.L", "LowerLeg.L", "LowerLeg.L_end"},
        Names{"UpperLeg.R", "LowerLeg.R", "LowerLeg.R_end"}}},
      {"humanoids/quaternius/Men_Worker.glb",
       {Names{"UpperArm.L", "LowerArm.L", "Hand.L"}, Names{"UpperArm.R", "LowerArm.R", "Hand.R"},
        Names{"UpperLeg.L", "LowerLeg.L", "Foot.L"}, Names{"UpperLeg.R", "LowerLeg.R", "Foot.R"}}},
      {"humanoids/kenney/character_medium.gltf",
       {Names{"LeftArm", "LeftForeArm", "LeftHand"}, Names{"RightArm", "RightForeArm", "RightHand"},
        Names{"LeftUpLeg", "LeftLeg", "LeftFoot"}, Names{"RightUpLeg", "RightLeg", "RightFoot"}}},
      // No joint below its forearms.
      {"humanoids/godot/platformer_player.glb",
       {Names{}, Names{}, Names{"l-thigh", "l-leg", "l-foot"},
        Names{"r-thigh", "r-leg", "r-foot"}}},
      {"humanoids/vrm/Godette_vrm_v4.vrm",
       {Names{"upper_arm.l_Armature", "lowerarm.l_Armature", "hand.l_Armature"},
        Names{"upper_arm.r_Armature", "lowerarm.r_Armature", "hand.r_Armature"},
        Names{"thigh.l_Armature", "shin.l_Armature", "foot.l_Armature"},
        Names{"thigh.r_Armature", "shin.r_Armature", "foot.r_Armature"}}},
      {"humanoids/hands/LeftHandHumanoid.gltf", {}},
      {"humanoids/khronos/RiggedSimple.gltf", {}},
  };
}

class OnSamples : public testing::TestWithParam<Expected> {
 protected:
  void SetUp() override {
    if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
    model_ = read_sample(GetParam().file);
    ASSERT_NE(model_, nullptr);
    ASSERT_EQ(model_->characters.size(), 1u);
    findings_ = find_limbs(*model_, character());
  }
  const Character& character() const { return model_->characters[0]; }
  const std::string& name(int joint) const {
    return model_->skeleton.joints[static_cast<std::size_t>(joint)].name;
  }

  std::shared_ptr<const Model> model_;
  LimbFindings findings_;
};

TEST_P(OnSamples, AreFoundByNameAndHierarchy) {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto kind = static_cast<LimbKind>(i);
    const Names& expected = GetParam().limbs[i];
    const auto limb = std::find_if(findings_.limbs.begin(), findings_.limbs.end(),
                                   [&](const Limb& l) { return l.kind == kind; });
    if (expected.empty()) {
      EXPECT_EQ(limb, findings_.limbs.end());
      EXPECT_TRUE(std::any_of(findings_.warnings.begin(), findings_.warnings.end(),
                              [&](const std::string& warning) {
                                return warning.rfind(std::string(limb_id(kind)) + " not found",
                                                     0) == 0;
                              }))
          << "absence needs a reason";
      continue;
    }
    ASSERT_NE(limb, findings_.limbs.end()) << limb_id(kind);
    EXPECT_EQ((Names{name(limb->root), name(limb->middle), name(limb->end)}), expected);
    EXPECT_FALSE(limb->why.empty());
    // Root to end, each below the one before.
    ASSERT_GE(limb->joints.size(), 3u);
    EXPECT_EQ(limb->joints.front(), limb->root);
    EXPECT_EQ(limb->joints.back(), limb->end);
    for (std::size_t k = 1; k < limb->joints.size(); ++k) {
      EXPECT_EQ(model_->skeleton.joints[static_cast<std::size_t>(limb->joints[k])].parent,
                limb->joints[k - 1]);
    }
    EXPECT_EQ(limb_by_name(*model_, character(), limb->name)->root, limb->root);
  }
}

TEST_P(OnSamples, LeftIsTheBodysLeftUnlessNamesAreSwapped) {
  const std::vector<Mat4> globals = bind_globals(*model_, character());
  const BodyAxes axes = body_axes(*model_, character(), findings_);
  EXPECT_NEAR(glm::dot(glm::cross(axes.left, axes.up), axes.forward), 1, 1e-12);
  const bool swapped = std::any_of(
      findings_.warnings.begin(), findings_.warnings.end(),
      [](const std::string& warning) { return warning.find("swapped") != std::string::npos; });
  // The one sample whose artist named sides as seen from the front.
  EXPECT_EQ(swapped, GetParam().file == "humanoids/godot/platformer_player.glb");
  for (const Limb& a : findings_.limbs) {
    for (const Limb& b : findings_.limbs) {
      if (a.is_arm() != b.is_arm() || !a.is_left() || b.is_left()) continue;
      const double across = glm::dot(origin(globals, a.root) - origin(globals, b.root), axes.left);
      EXPECT_EQ(across > 0, !swapped);
    }
  }
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

// Every key of the limb joints' channels, and a regular 60 Hz between.
std::vector<double> frames_of(const Clip& clip, const LimbModel& limb) {
  std::vector<double> times;
  const int count = 1 + static_cast<int>(clip.duration() * 60);
  for (int i = 0; i <= count; ++i) times.push_back(clip.begin + clip.duration() * i / count);
  for (const JointModel& joint : limb.joints) {
    const int channel = clip.find_channel(joint.joint, Path::rotation);
    if (channel < 0) continue;
    const auto& keys = clip.channels[static_cast<std::size_t>(channel)].times;
    times.insert(times.end(), keys.begin(), keys.end());
  }
  std::sort(times.begin(), times.end());
  return times;
}

TEST_P(OnSamples, EveryFrameGoesIntoParametersAndBackWithASmallResidual) {
  for (const Limb& limb : findings_.limbs) {
    const auto fitted = fit_limb_model(*model_, character(), limb, findings_);
    ASSERT_TRUE(fitted) << fitted.error().message();
    EXPECT_LE(fitted->dof_count(), kMaxDofs);
    EXPECT_FALSE(fitted->flexion_axis_from.empty());
    std::array<std::vector<double>, 3> residuals;
    double worst = 0;
    int frames = 0, outside = 0;
    for (const Clip& clip : model_->clips) {
      LimbState previous;
      bool first = true;
      for (const double t : frames_of(clip, *fitted)) {
        Pose pose = rest_pose(model_->skeleton);
        sample_clip(clip, t, pose);
        const LimbState state = limb_state(*fitted, pose, first ? nullptr : &previous);
        Pose back = pose;
        for (const JointModel& joint : fitted->joints) {
          back.local[static_cast<std::size_t>(joint.joint)].rotation = Quat(1, 0, 0, 0);
        }
        apply_limb_state(*fitted, state, back);
        for (std::size_t i = 0; i < 3; ++i) {
          const auto joint = static_cast<std::size_t>(fitted->joints[i].joint);
          worst = std::max(worst,
                           angle_between(pose.local[joint].rotation, back.local[joint].rotation));
          residuals[i].push_back(glm::length(rotation_vector_from_quat(state.residual[i])));
        }
        // The same from the clip alone.
        const LimbState again =
            limb_state_at(*fitted, *model_, clip, t, first ? nullptr : &previous);
        for (int k = 0; k < state.q.count; ++k) EXPECT_EQ(again.q[k], state.q[k]);
        // Every frame can be brought within limits by widening them.
        if (!fitted->space.within_limits(state.q)) {
          DofSpace wide = fitted->space;
          EXPECT_FALSE(wide.widen_to(state.q).empty());
          EXPECT_TRUE(wide.within_limits(state.q));
          ++outside;
        }
        ++frames;
        previous = state;
        first = false;
      }
    }
    EXPECT_LT(worst, 1e-5);
    if (frames == 0) continue;
    std::printf("%-48s %-9s", GetParam().file.c_str(), limb.name.c_str());
    for (std::size_t i = 0; i < 3; ++i) {
      const double median = percentile(residuals[i], 0.5), high = percentile(residuals[i], 0.99);
      EXPECT_LE(median, 5 * kDegree) << limb.name << " joint " << i;
      EXPECT_LE(high, 15 * kDegree) << limb.name << " joint " << i;
      constexpr std::array kNames = {"ball", "hinge", "swing", "fixed"};
      std::printf("  %5s %4.1f %4.1f", kNames[static_cast<std::size_t>(fitted->joints[i].kind)],
                  median / kDegree, high / kDegree);
    }
    std::printf("  back %.0e  outside limits %d of %d\n", worst, outside, frames);
  }
}

TEST_P(OnSamples, ClipsAreContinuousInParameters) {
  // Slerp between keys turns a joint at a bounded rate; numbers that jump would show as faster
  // ones.
  for (const Limb& limb : findings_.limbs) {
    const auto fitted = fit_limb_model(*model_, character(), limb, findings_);
    ASSERT_TRUE(fitted);
    for (const Clip& clip : model_->clips) {
      const std::vector<double> steps = step_times(clip);
      LimbState previous = limb_state_at(*fitted, *model_, clip, clip.begin);
      for (double t = clip.begin + 1e-3; t < clip.end; t += 1e-3) {
        const LimbState state = limb_state_at(*fitted, *model_, clip, t, &previous);
        const bool stepped = std::any_of(steps.begin(), steps.end(), [&](double step) {
          return step > t - 2e-3 && step < t + 1e-3;
        });
        for (std::size_t i = 0; i < 3 && !stepped; ++i) {
          const JointModel& joint = fitted->joints[i];
          for (int k = joint.first_dof; k < joint.first_dof + joint.dof_count(); ++k) {
            EXPECT_LT(std::abs(state.q[k] - previous.q[k]), 0.5)
                << limb.name << " " << fitted->space.dofs[static_cast<std::size_t>(k)].name
                << " at " << t << " of " << clip.name;
          }
        }
        previous = state;
      }
    }
  }
}

std::string test_name(const testing::TestParamInfo<Expected>& info) {
  std::string text;
  for (const char c : info.param.file.substr(info.param.file.rfind('/') + 1)) {
    text += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  }
  return text;
}

INSTANTIATE_TEST_SUITE_P(Humanoids, OnSamples, testing::ValuesIn(expectations()), test_name);

// Flexion axes at the bind pose, world space; flexion is right-handed about them.
struct HandWritten {
  std::string file;
  LimbKind limb;
  Vec3 axis;
};

TEST(SampleFlexionAxes, AreThoseWrittenDownByHand) {
  if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
  const Vec3 up(0, 1, 0), down(0, -1, 0), left(1, 0, 0);
  const std::string knight = "humanoids/kaykit/Knight.glb";
  const std::string worker = "humanoids/quaternius/Men_Worker.glb";
  const std::string robot = "humanoids/quaternius/RobotExpressive.glb";
  const std::string cesium = "humanoids/khronos/CesiumMan.glb";
  const std::string figure = "humanoids/khronos/RiggedFigure.glb";
  const std::string fox = "humanoids/khronos/Fox.glb";
  const std::vector<HandWritten> written = {
      // The Knight, facing +z, is bound with level arms along x and elbows 1.4 cm behind the line
      // from shoulder to wrist: they bend in the horizontal plane, the hand to the front, which on
      // the left (+x towards +z) turns about down, on the right about up. Hip, knee and ankle stand
      // in one plane across x, the knee before the others: shins fold back about +x.
      {knight, LimbKind::left_arm, down},
      {knight, LimbKind::right_arm, up},
      {knight, LimbKind::left_leg, left},
      {knight, LimbKind::right_leg, left},
      // The Worker likewise: level arms, forearms turned 8° to the front; legs in planes across x.
      {worker, LimbKind::left_arm, down},
      {worker, LimbKind::right_arm, up},
      {worker, LimbKind::left_leg, left},
      {worker, LimbKind::right_leg, left},
      // RobotExpressive: a T-pose too, legs in planes across x (x = 0.63 all the way down).
      {robot, LimbKind::left_arm, down},
      {robot, LimbKind::right_arm, up},
      {robot, LimbKind::left_leg, left},
      {robot, LimbKind::right_leg, left},
      // CesiumMan is bound with arms sloping down and elbows bent by 29°. Left shoulder
      // (0.096, 1.074, -0.004), elbow (0.312, 0.964, -0.016), wrist (0.455, 0.875, 0.066): the
      // cross
      // product of the bones (0.216, -0.110, -0.012) and (0.143, -0.089, 0.082) is
      // (-0.01009, -0.01943, -0.00349). The right arm is its mirror image (an axis keeps x and
      // turns
      // y and z). Legs: hip (0.073, 0.614, 0.024), knee (0.082, 0.352, 0.068), ankle
      // (0.083, 0.086, -0.005) give (0.03083, 0.00070, -0.00213).
      {cesium, LimbKind::left_arm, Vec3(-0.01009, -0.01943, -0.00349)},
      {cesium, LimbKind::right_arm, Vec3(-0.01009, 0.01943, 0.00349)},
      {cesium, LimbKind::left_leg, Vec3(0.03083, 0.00070, -0.00213)},
      {cesium, LimbKind::right_leg, Vec3(0.03083, -0.00070, 0.00213)},
      // RiggedFigure, much the same figure: bones (0.218, -0.110, -0.013) and
      // (0.141, -0.082, 0.088); legs (0.009, -0.260, 0.057) and (0.001, -0.269, -0.060).
      {figure, LimbKind::left_arm, Vec3(-0.01075, -0.02102, -0.00237)},
      {figure, LimbKind::right_arm, Vec3(-0.01075, 0.02102, 0.00237)},
      {figure, LimbKind::left_leg, Vec3(0.03093, 0.00060, -0.00216)},
      {figure, LimbKind::right_leg, Vec3(0.03093, -0.00060, 0.00216)},
      // The Fox walks along z and moves its legs in planes across x. Its hind knees stand before
      // hip
      // and hock; its forearms, bound straight down, swing the paw to the front, about -x.
      {fox, LimbKind::left_leg, left},
      {fox, LimbKind::right_leg, left},
      {fox, LimbKind::left_arm, -left},
      {fox, LimbKind::right_arm, -left},
  };
  std::map<std::string, std::shared_ptr<const Model>> models;
  for (const HandWritten& hand : written) {
    auto& model = models[hand.file];
    if (!model) model = read_sample(hand.file);
    ASSERT_NE(model, nullptr);
    const Character& character = model->characters.at(0);
    const LimbFindings findings = find_limbs(*model, character);
    const auto limb = limb_by_name(*model, character, limb_id(hand.limb));
    ASSERT_TRUE(limb) << limb.error().message();
    const auto fitted = fit_limb_model(*model, character, *limb, findings);
    ASSERT_TRUE(fitted) << fitted.error().message();
    // These samples have no mirrors: an axis goes from the parent's space as a direction.
    const JointModel& middle = fitted->joints[1];
    const int parent = model->skeleton.joints[static_cast<std::size_t>(middle.joint)].parent;
    const Mat3 world_from_parent(bind_globals(*model, character)[static_cast<std::size_t>(parent)]);
    const Vec3 axis = glm::normalize(world_from_parent * (middle.parent_from_zero * Vec3(0, 0, 1)));
    const Vec3 expected = glm::normalize(hand.axis);
    const double off =
        std::atan2(glm::length(glm::cross(axis, expected)), glm::dot(axis, expected)) / kDegree;
    EXPECT_LT(off, 5) << hand.file << " " << limb->name << ": (" << axis.x << ", " << axis.y << ", "
                      << axis.z << ") from " << fitted->flexion_axis_from;
    std::printf("%-48s %-9s flexion axis off by %.2f°\n", hand.file.c_str(), limb->name.c_str(),
                off);
  }
}

TEST(SampleLimbs, NoFileIsTooOdd) {
  // Whatever opens, however strange, has findings with reasons, and a model or an error.
  if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
  int files = 0, characters = 0, fits = 0;
  std::vector<std::filesystem::path> paths;
  for (const char* folder : {"humanoids", "features", "malformed", "props"}) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(test::samples_dir() / folder)) {
      const std::string type = entry.path().extension().string();
      if (type == ".glb" || type == ".gltf" || type == ".vrm") paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  ReadOptions options;
  options.images = false;
  for (const auto& path : paths) {
    const auto model = read_gltf(path, options);
    if (!model) continue;
    ++files;
    for (const Character& character : (*model)->characters) {
      ++characters;
      const LimbFindings findings = find_limbs(**model, character);
      EXPECT_GE(findings.limbs.size() + findings.warnings.size(), 4u) << path;
      const BodyAxes axes = body_axes(**model, character, findings);
      EXPECT_NEAR(glm::dot(glm::cross(axes.left, axes.up), axes.forward), 1, 1e-9) << path;
      for (const Limb& limb : findings.limbs) {
        const auto fitted = fit_limb_model(**model, character, limb, findings);
        EXPECT_TRUE(fitted || !fitted.error().what.empty());
        ++fits;
      }
    }
  }
  EXPECT_GT(files, 100);
  EXPECT_GT(characters, 20);
  EXPECT_GT(fits, 50);
}

TEST(SampleLimits, HoldWhatPeopleDo) {
  // The Knight's arms, animated by hand over 76 clips, never leave the default limits.
  if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
  const auto model = read_sample("humanoids/kaykit/Knight.glb");
  ASSERT_NE(model, nullptr);
  const Character& character = model->characters.at(0);
  const LimbFindings findings = find_limbs(*model, character);
  for (const char* name : {"left_arm", "right_arm"}) {
    const auto limb = limb_by_name(*model, character, name);
    ASSERT_TRUE(limb);
    const auto fitted = fit_limb_model(*model, character, *limb, findings);
    ASSERT_TRUE(fitted);
    for (const Clip& clip : model->clips) {
      for (double t = clip.begin; t <= clip.end; t += 1.0 / 30) {
        EXPECT_TRUE(fitted->space.within_limits(limb_state_at(*fitted, *model, clip, t).q));
      }
    }
  }
}

}  // namespace
}  // namespace elbowroom
