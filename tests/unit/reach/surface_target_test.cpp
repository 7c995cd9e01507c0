// SPDX-License-Identifier: MIT
// A click on a surface: the palm lies on it, facing it, as the hand pointed.
#include <gtest/gtest.h>

#include <limits>

#include "core/editing/reach.h"
#include "core/editing/session.h"
#include "core/editing/surface_target.h"

namespace elbowroom {
namespace {

class OnASurface : public testing::Test {
 protected:
  void SetUp() override {
    Document document;
    document.scene.character = std::filesystem::path(ELBOWROOM_DEMO_DIR) / "mannequin.glb";
    document.scene.clip = "Walk";
    auto opened = open_session(document);
    ASSERT_TRUE(opened.ok()) << opened.error().message();
    session_ = std::make_unique<Session>(std::move(*opened));
    world_state_at(session_->scene.world, kTime, states_);
  }
  const Mat4& end(const LimbModel& limb) const {
    return states_.front().world_from_joint[static_cast<std::size_t>(limb.limb.end)];
  }
  static constexpr double kTime = 0.4, kClearance = 0.005;
  std::unique_ptr<Session> session_;
  std::vector<ActorState> states_;
};

TEST_F(OnASurface, ThePalmFacesIt) {
  for (const LimbModel& limb : session_->limbs) {
    ASSERT_TRUE(limb.grasp.ok()) << limb.grasp.error().message();
    const GraspPlace now = grasp_place(*limb.grasp, end(limb));
    for (const Vec3& normal : {Vec3(0, 1, 0), Vec3(0, 0, -1), glm::normalize(Vec3(1, 2, -3)),
                               now.orientation * Vec3(1, 0, 0), now.orientation * Vec3(-1, 0, 0)}) {
      const Vec3 place(0.3, 1.1, 0.4);
      const auto targets =
          surface_targets(limb, end(limb), {place, normal}, kClearance, 0.2, kTime);
      ASSERT_GT(targets.size(), 4u);
      const Vec3 x_now = now.orientation * Vec3(1, 0, 0);
      double before = 2;
      for (std::size_t i = 0; i + 1 < targets.size(); ++i) {
        const HandTarget& target = targets[i];
        EXPECT_TRUE(target.grasp);
        EXPECT_EQ(target.time, kTime);
        ASSERT_TRUE(target.orientation.has_value());
        const Vec3 y = *target.orientation * Vec3(0, 1, 0), x = *target.orientation * Vec3(1, 0, 0);
        EXPECT_LT(glm::length(y + normal), 1e-9);
        const Vec3 off = target.position - place;
        EXPECT_GT(glm::dot(off, normal), kClearance);
        EXPECT_LT(glm::length(off - normal * glm::dot(off, normal)), 1e-12);
        // As near as may be to where the hand points, the first one of all.
        EXPECT_LT(glm::dot(x, x_now), before + 1e-9);
        before = glm::dot(x, x_now);
      }
      EXPECT_FALSE(targets.back().grasp);
      EXPECT_FALSE(targets.back().orientation.has_value());
      EXPECT_LT(glm::distance(targets.back().position, place + normal * 0.2), 1e-12);
    }
  }
}

TEST_F(OnASurface, WristTargetLeadsThePalmThere) {
  // What the palm does now, asked for as a target, is the wrist as it is.
  for (std::size_t i = 0; i < session_->limbs.size(); ++i) {
    const LimbModel& limb = session_->limbs[i];
    const int parent =
        session_->scene.model().skeleton.joints[static_cast<std::size_t>(limb.limb.root)].parent;
    const auto ik =
        LimbIk::build(limb, session_->scene.model().skeleton, states_.front().pose,
                      states_.front().world_from_joint[static_cast<std::size_t>(parent)],
                      limb_state(limb, states_.front().pose).residual);
    ASSERT_TRUE(ik.ok());
    const GraspPlace now = grasp_place(*limb.grasp, end(limb));
    HandTarget target{kTime, now.position, std::nullopt, true};
    for (const bool oriented : {false, true}) {
      if (oriented) target.orientation = now.orientation;
      const auto wrist = wrist_target(*ik, end(limb), target);
      ASSERT_TRUE(wrist.ok()) << wrist.error().message();
      EXPECT_LT(glm::distance(wrist->position, Vec3(end(limb)[3])), 1e-12);
      ASSERT_TRUE(wrist->orientation.has_value());
      EXPECT_LT(angle_between(*wrist->orientation, rotation_of(end(limb))), 1e-7);
    }
    LimbModel without = limb;
    without.grasp = Error{"no palm", "", ""};
    const auto blind =
        LimbIk::build(without, session_->scene.model().skeleton, states_.front().pose,
                      states_.front().world_from_joint[static_cast<std::size_t>(parent)],
                      limb_state(limb, states_.front().pose).residual);
    ASSERT_TRUE(blind.ok());
    EXPECT_FALSE(wrist_target(*blind, end(limb), target).ok());
  }
}

TEST_F(OnASurface, WithoutAPalmOrANormalTheWristStaysOff) {
  LimbModel limb = session_->limbs.front();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(surface_targets(limb, end(limb), {Vec3(0), Vec3(0)}, 0.01, 0.2, kTime).size(), 1u);
  EXPECT_EQ(surface_targets(limb, end(limb), {Vec3(0), Vec3(nan)}, 0.01, 0.2, kTime).size(), 1u);
  limb.grasp = Error{"none", "", ""};
  const auto targets = surface_targets(limb, end(limb), {Vec3(0), Vec3(0, 1, 0)}, 0.01, 0.2, kTime);
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_FALSE(targets.front().grasp);
}

}  // namespace
}  // namespace elbowroom
