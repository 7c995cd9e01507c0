// SPDX-License-Identifier: MIT
// Limbs and swing limits that the document sets are those of the session, and so of planning and of
// inverse kinematics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/anatomy/limits.h"
#include "core/editing/plan_window.h"
#include "core/editing/session.h"
#include "core/editing/target_posture.h"
#include "core/editing/window_problem.h"
#include "tests/support/walking.h"

namespace elbowroom {
namespace {

Document walking() { return test::walking(ELBOWROOM_DEMO_DIR); }

bool warned(const Session& session, const std::string& words) {
  return std::any_of(session.warnings.begin(), session.warnings.end(),
                     [&](const auto& warning) { return warning.find(words) != std::string::npos; });
}

const LimbModel* limb_of(const Session& session, const std::string& name) {
  for (const LimbModel& limb : session.limbs)
    if (limb.limb.name == name) return &limb;
  return nullptr;
}

// A square about a place that holds zero too.
SwingPolygon about(double up, double forward, double half) {
  const double low_up = std::min(up - half, -0.2), low_forward = std::min(forward - half, -0.2);
  const double high_up = std::max(up + half, 0.2), high_forward = std::max(forward + half, 0.2);
  return {{low_up, low_forward},
          {high_up, low_forward},
          {high_up, high_forward},
          {low_up, high_forward}};
}

TEST(LimbsByHand, ASwingLimitIsTheSessionsAndWhatCannotBeIsWarnedOf) {
  Document document = walking();
  document.swing_limits["left_arm"][0] = about(0, 0, 0.9);
  document.swing_limits["left_arm"][1] = about(0, 0, 0.9);  // an elbow has no swing
  document.swing_limits["right_leg"][2] = about(0, 0, 0.3);
  const auto session = open_session(document);
  ASSERT_TRUE(session.ok());
  const LimbModel& arm = *limb_of(*session, "left_arm");
  ASSERT_EQ(arm.space.polygons.size(), 1u);
  EXPECT_EQ(arm.space.polygons[0].first, 0);
  EXPECT_NEAR(arm.space.dofs[0].upper, 0.9, 1e-12);
  EXPECT_TRUE(warned(*session, "left_arm is passed over")) << "the elbow's";
  EXPECT_EQ(limb_of(*session, "right_leg")->space.polygons.size(), 1u);
  EXPECT_TRUE(limb_of(*session, "right_arm")->space.polygons.empty());
  // What the limbs had before is kept beside, in the same order.
  ASSERT_EQ(session->own_limits.size(), session->limbs.size());
  for (std::size_t i = 0; i < session->limbs.size(); ++i) {
    EXPECT_TRUE(session->own_limits[i].polygons.empty());
    EXPECT_EQ(session->own_limits[i].count(), session->limbs[i].dof_count());
  }
  // The same without reading the files again, and without the limits.
  const Session without = refit_project_session(*session, walking());
  EXPECT_TRUE(limb_of(without, "left_arm")->space.polygons.empty());
  EXPECT_EQ(limb_of(without, "left_arm")->space.ellipses.size(),
            session->own_limits[0].ellipses.size());
  const Session with = refit_project_session(without, document);
  EXPECT_EQ(limb_of(with, "left_arm")->space.polygons[0].corners, arm.space.polygons[0].corners);
}

TEST(LimbsByHand, PlansKeepTheSwingLimit) {
  const auto plain = open_session(walking());
  ASSERT_TRUE(plain.ok());
  const LimbModel& arm = *limb_of(*plain, "left_arm");
  auto scene = contacts_of(*plain);
  ASSERT_TRUE(scene.ok());
  const auto index = limbs_named(*plain, "left_arm")->front();
  const double begin = 0.25, end = 1.0;
  // What the clip does at both ends, with a little room.
  const WindowProblem free = window_problem(*scene, plain->clip(), index, begin, end, {});
  double up = 0, down = 0, back = 0, on = 0;
  for (const PostureAt& posture : {free.postures.front(), free.postures.back()}) {
    up = std::max(up, posture.state.q[0]);
    down = std::min(down, posture.state.q[0]);
    on = std::max(on, posture.state.q[1]);
    back = std::min(back, posture.state.q[1]);
  }
  const double room = 0.15;
  Document document = walking();
  document.swing_limits["left_arm"][0] = {{down - room, back - room},
                                          {up + room, back - room},
                                          {up + room, on + room},
                                          {down - room, on + room}};
  const auto session = open_session(document);
  ASSERT_TRUE(session.ok());
  auto bounded = contacts_of(*session);
  ASSERT_TRUE(bounded.ok());
  WindowProblem problem = window_problem(*bounded, session->clip(), index, begin, end, {});
  ASSERT_EQ(problem.space.polygons.size(), 1u);
  EXPECT_TRUE(problem.limits_widened.empty());
  const PolygonLimit limit = problem.space.polygons[0];
  EXPECT_LT(limit.gauge(up, on), 1.0);
  const DofSpace space = problem.space;
  const WindowPlan plan = plan_window(std::move(problem), {}, {}, {});
  ASSERT_TRUE(plan.correction.has_value()) << plan.report.reason;
  int keys = 0;
  for (const JointKeys& joint : plan.correction->joints) {
    if (joint.node != arm.limb.root) continue;
    for (std::size_t i = 0; i < joint.keys.times.size(); ++i) {
      double q[3];
      Quat residual;
      decompose(arm.joints[0], joint.keys.values[i], q, residual);
      EXPECT_LE(limit.gauge(q[0], q[1]), 1.0 + 1e-4) << "at " << joint.keys.times[i];
      ++keys;
    }
  }
  EXPECT_GT(keys, 5);
}

TEST(LimbsByHand, InverseKinematicsKeepsTheSwingLimit) {
  Document document = walking();
  const auto plain = open_session(document);
  ASSERT_TRUE(plain.ok());
  const auto index = limbs_named(*plain, "left_arm")->front();
  // Where the wrist is with the arm raised by as much as its own limit allows, and half of that.
  const auto solve = [&](const Session& session, double up) {
    auto scene = contacts_of(session);
    EXPECT_TRUE(scene.ok());
    const LimbModel& arm = session.limbs[static_cast<std::size_t>(index)];
    const auto ik =
        limb_ik_at(*scene, index, 0.5, {Quat(1, 0, 0, 0), Quat(1, 0, 0, 0), Quat(1, 0, 0, 0)});
    EXPECT_TRUE(ik.ok());
    Dofs raised;
    raised.count = arm.dof_count();
    raised[0] = up;
    raised[3] = 0.6;
    IkTarget target;
    target.position = ik->points(raised).end;
    return search_swivel(*ik, target);
  };
  EXPECT_TRUE(solve(*plain, 1.5).solved());
  EXPECT_TRUE(solve(*plain, 0.1).solved());
  document.swing_limits["left_arm"][0] = {{0.4, 0}, {0, 1.2}, {-1.2, 0}, {0, -1.2}};
  const auto bounded = open_session(document);
  ASSERT_TRUE(bounded.ok());
  const IkResult high = solve(*bounded, 1.5);
  EXPECT_FALSE(high.solved());
  EXPECT_EQ(high.status, IkStatus::at_limit);
  EXPECT_TRUE(solve(*bounded, 0.1).solved());
}

TEST(LimbsByHand, ALimbCanBeNone) {
  Document document = walking();
  document.limbs["left_leg"] = {};
  const auto session = open_session(document);
  ASSERT_TRUE(session.ok());
  EXPECT_EQ(limb_of(*session, "left_leg"), nullptr);
  EXPECT_EQ(session->limbs.size(), open_session(walking())->limbs.size() - 1);
  EXPECT_TRUE(warned(*session, "left_leg not found: it was said by hand"));
  EXPECT_FALSE(limbs_named(*session, "left_leg").ok());
  // The others are what they were: found by the whole figure.
  const auto plain = open_session(walking());
  const LimbModel &mine = *limb_of(*session, "right_leg"), &theirs = *limb_of(*plain, "right_leg");
  EXPECT_EQ(mine.limb.root, theirs.limb.root);
  EXPECT_EQ(mine.limb.end, theirs.limb.end);
}

TEST(LimbsByHand, OneThatSharesJointsGivesWayWithAWarning) {
  Document document = walking();
  document.limbs["left_arm"] = {"RightShoulder", "", "RightHand"};
  const auto session = open_session(document);
  ASSERT_TRUE(session.ok());
  EXPECT_EQ(limb_of(*session, "right_arm"), nullptr);
  EXPECT_TRUE(warned(*session, "right_arm gives way to left_arm"));
}

}  // namespace
}  // namespace elbowroom
