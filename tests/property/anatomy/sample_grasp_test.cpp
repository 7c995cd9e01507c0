// SPDX-License-Identifier: MIT
// Palms and soles of real characters: left and right are mirror images, palms face where the bind
// pose has them face, the origin lies on the skin, size and placement don't matter.
#include <gtest/gtest.h>
#include <ostream>

#include <algorithm>
#include <cstdio>
#include <string>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/limb_model.h"
#include "core/io/gltf_reader.h"
#include "tests/support/samples.h"

namespace elbowroom {
namespace {

struct Case {
  std::string file;
  // Where palms face as bound, written down from looking at them, parts of (down, forward, inward).
  Vec3 palm;
  double apart;          // of left and right, × the hand's length
  double turned;         // of left and right, degrees
  bool has_feet = true;  // their legs don't end in what nothing follows
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.file; }

std::vector<Case> cases() {
  return {
      {"humanoids/quaternius/RobotExpressive.glb", {0, 1, 0}, 0.02, 2, false},
      {"humanoids/quaternius/Men_Worker.glb", {1, 0, 0}, 0.02, 2},
      // The right hand has a weapon skinned to it, in pieces; those near the hand pass for it.
      {"humanoids/quaternius/Cyberpunk_Character.glb", {1, 0, 0}, 0.15, 40, false},
      {"humanoids/kenney/character_medium.gltf", {1, 0, 0}, 0.02, 2},
      {"humanoids/kaykit/Knight.glb", {1, 0, 0}, 0.02, 2},
      {"humanoids/kaykit_manny/manny_med_mod.gltf", {1, 0, 0}, 0.02, 2},
      {"humanoids/khronos/CesiumMan.glb", {1, 0, 0}, 0.1, 15},
      {"humanoids/khronos/RiggedFigure.glb", {1, 0, 0}, 0.1, 15},
      {"humanoids/godot/platformer_player.glb", {1, 0, 0}, 0.02, 2},
  };
}

// A limb's grasp frame at the bind pose, in the body's axes.
struct Seen {
  bool found = false;
  Vec3 place{0.0}, x{0.0}, y{0.0};  // outward, up, forward; place from the end joint
  double length = 0;                // of the lower bone
};

class GraspOnSamples : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
    ReadOptions options;
    options.images = false;
    const auto model = read_gltf(test::samples_dir() / GetParam().file, options);
    ASSERT_TRUE(model.ok()) << model.error().message();
    model_ = *model;
  }

  Seen seen(LimbKind kind) const {
    Seen result;
    const Character& character = model_->characters.front();
    const LimbFindings findings = find_limbs(*model_, character);
    const BodyAxes body = body_axes(*model_, character, findings);
    for (const Limb& limb : findings.limbs) {
      if (limb.kind != kind) continue;
      const auto fitted = fit_limb_model(*model_, character, limb, findings);
      if (!fitted || !fitted->grasp) {
        const bool leg = kind == LimbKind::left_leg || kind == LimbKind::right_leg;
        EXPECT_TRUE(leg && !GetParam().has_feet)
            << (fitted ? fitted->grasp.error() : fitted.error()).message();
        return result;
      }
      const auto globals = bind_globals(*model_, character);
      const Mat4& end = globals[static_cast<std::size_t>(limb.end)];
      const GraspPlace place = grasp_place(*fitted->grasp, end);
      const Vec3 root = origin(globals, limb.root);
      Vec3 centre(0.0);
      for (const Limb& other : findings.limbs) centre += origin(globals, other.root);
      centre /= static_cast<double>(findings.limbs.size());
      const double side = glm::dot(root - centre, body.left) >= 0 ? 1 : -1;
      const auto in_body = [&](const Vec3& v) {
        return Vec3(side * glm::dot(v, body.left), glm::dot(v, body.up), glm::dot(v, body.forward));
      };
      result.found = true;
      result.length = glm::distance(origin(globals, limb.end), origin(globals, limb.middle));
      result.place = in_body(place.position - Vec3(end[3])) / result.length;
      result.x = in_body(place.orientation * Vec3(1, 0, 0));
      result.y = in_body(place.orientation * Vec3(0, 1, 0));
      std::printf(
          "  %-10s place %6.3f %6.3f %6.3f  x %5.2f %5.2f %5.2f  y %5.2f %5.2f %5.2f  "
          "beyond %.3f  %s\n",
          limb.name.c_str(), result.place.x, result.place.y, result.place.z, result.x.x, result.x.y,
          result.x.z, result.y.x, result.y.y, result.y.z, place.beyond / result.length,
          fitted->grasp->from.c_str());
    }
    return result;
  }

  std::shared_ptr<const Model> model_;
};

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * 180 / kPi;
}

TEST_P(GraspOnSamples, LeftAndRightAreMirrorImages) {
  for (const auto& [left_kind, right_kind] : {std::pair(LimbKind::left_arm, LimbKind::right_arm),
                                              std::pair(LimbKind::left_leg, LimbKind::right_leg)}) {
    const Seen left = seen(left_kind), right = seen(right_kind);
    ASSERT_EQ(left.found, right.found);
    if (!left.found) continue;
    EXPECT_LT(glm::distance(left.place, right.place), GetParam().apart);
    EXPECT_LT(degrees_between(left.x, right.x), GetParam().turned);
    EXPECT_LT(degrees_between(left.y, right.y), GetParam().turned);
  }
}

TEST_P(GraspOnSamples, PalmsFaceWhereTheyAreSeenToAndSolesDown) {
  for (const LimbKind kind : {LimbKind::left_arm, LimbKind::right_arm}) {
    const Seen arm = seen(kind);
    if (!arm.found) continue;
    const Vec3 wanted =
        glm::normalize(Vec3(-GetParam().palm.z, -GetParam().palm.x, GetParam().palm.y));
    EXPECT_LT(degrees_between(arm.y, wanted), 40) << static_cast<int>(kind);
    // On the palm's side of the wrist, and out along the hand.
    EXPECT_GT(glm::dot(arm.place, arm.x), 0);
  }
  for (const LimbKind kind : {LimbKind::left_leg, LimbKind::right_leg}) {
    const Seen leg = seen(kind);
    if (!leg.found) continue;
    EXPECT_LT(degrees_between(leg.y, Vec3(0, -1, 0)), 15);
    EXPECT_GT(leg.x.z, 0.7) << "toes point forward";
    EXPECT_LT(leg.place.y, 0) << "the sole is below the ankle";
  }
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  std::string text;
  for (const char c : std::filesystem::path(info.param.file).stem().string())
    text += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return text;
}

INSTANTIATE_TEST_SUITE_P(Humanoids, GraspOnSamples, testing::ValuesIn(cases()), case_name);

}  // namespace
}  // namespace elbowroom
