// SPDX-License-Identifier: MIT
// Limbs by the names they are asked for, and several tasks as one.
#include "core/editing/session.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/editing/solve_task.h"
#include "core/editing/unique_names.h"
#include "core/editing/window_problem.h"
#include "tests/support/walking.h"

namespace elbowroom {
namespace {

Document walking() { return test::walking(ELBOWROOM_DEMO_DIR); }

Task correct_task(const std::string& limb) {
  Task task;
  task.name = "correct " + limb;
  task.limb = limb;
  return task;
}

TEST(Session, KnowsAFoundLimbByItsJoints) {
  const auto plain = open_session(walking());
  ASSERT_TRUE(plain.ok());
  const std::vector<std::string> names = {
      "LeftUpperArm..LeftHand", "auto", "RightUpperLeg..RightFoot",
      "LeftUpperArm..LeftHand", "",     "right_arm"};
  const auto session = open_session(walking(), names);
  ASSERT_TRUE(session.ok()) << session.error().message();
  // They are the limbs that there are anyway, in the same order.
  ASSERT_EQ(session->limbs.size(), plain->limbs.size());
  for (std::size_t i = 0; i < plain->limbs.size(); ++i)
    EXPECT_EQ(session->limbs[i].limb.name, plain->limbs[i].limb.name);
  EXPECT_EQ(*limbs_named(*session, "LeftUpperArm..LeftHand"), *limbs_named(*plain, "left_arm"));
  EXPECT_EQ(*limbs_named(*session, "RightUpperLeg..RightFoot"), *limbs_named(*plain, "right_leg"));
  EXPECT_FALSE(limbs_named(*plain, "LeftUpperArm..LeftHand").ok());
}

TEST(Session, FitsEveryLimbThatIsAskedFor) {
  const auto session =
      open_session(walking(), {"LeftShoulder..LeftHand", "RightShoulder..RightHand"});
  ASSERT_TRUE(session.ok()) << session.error().message();
  for (const char* name : {"LeftShoulder..LeftHand", "RightShoulder..RightHand"}) {
    const auto limbs = limbs_named(*session, name);
    ASSERT_TRUE(limbs.ok()) << name;
    ASSERT_EQ(limbs->size(), 1u);
    EXPECT_EQ(session->limbs[static_cast<std::size_t>(limbs->front())].limb.name, name);
  }
  EXPECT_FALSE(limbs_named(*session, "left_arm").ok());  // has given way
  EXPECT_FALSE(open_session(walking(), {"LeftUpperArm..LeftHand", "LeftShoulder..LeftHand"}).ok());
  EXPECT_FALSE(open_session(walking(), {"LeftUpperArm..Nothing"}).ok());

  Document project = walking();
  project.tasks = {correct_task("LeftUpperArm..LeftHand"), correct_task("LeftShoulder..LeftHand"),
                   correct_task("Nothing..LeftHand")};
  const auto opened = open_project_session(project);
  ASSERT_TRUE(opened.ok());
  EXPECT_GE(opened->warnings.size(), 2u);
}

class Tasks : public testing::Test {
 protected:
  void SetUp() override {
    auto session = open_session(walking());
    ASSERT_TRUE(session.ok());
    session_ = std::make_unique<Session>(std::move(*session));
    auto scene = contacts_of(*session_);
    ASSERT_TRUE(scene.ok());
    scene_ = std::make_unique<SceneCollision>(std::move(*scene));
  }
  std::unique_ptr<Session> session_;
  std::unique_ptr<SceneCollision> scene_;
};

TEST_F(Tasks, StoppedWhereNothingIsPlannedAreInterrupted) {
  std::stop_source stop;
  stop.request_stop();
  const auto one = solve_task(*scene_, *session_, correct_task("left_leg"), stop.get_token());
  ASSERT_TRUE(one.ok());
  EXPECT_TRUE(one->windows.empty());
  EXPECT_TRUE(one->interrupted);
  EXPECT_TRUE(one->cancelled());
  const auto two = solve_tasks(
      *scene_, *session_, {correct_task("left_leg"), correct_task("right_leg")}, stop.get_token());
  ASSERT_TRUE(two.ok());
  EXPECT_TRUE(two->cancelled());
  // Between the tasks: the first one's progress stops it.
  std::stop_source later;
  bool begun = false;
  const auto stopped =
      solve_tasks(*scene_, *session_, {correct_task("left_leg"), correct_task("right_leg")},
                  later.get_token(), [&](const Progress&) {
                    if (begun) later.request_stop();
                    begun = true;
                  });
  ASSERT_TRUE(stopped.ok());
  EXPECT_TRUE(stopped->cancelled());
  const auto done =
      solve_tasks(*scene_, *session_, {correct_task("left_leg"), correct_task("right_leg")});
  ASSERT_TRUE(done.ok());
  EXPECT_FALSE(done->cancelled());
  EXPECT_EQ(done->clip, session_->clip());
}

TEST_F(Tasks, OfNoneNothingComes) {
  const auto none = solve_tasks(*scene_, *session_, {});
  ASSERT_TRUE(none.ok());
  EXPECT_TRUE(none->all_corrected());
  EXPECT_EQ(none->clip, session_->clip());
  EXPECT_FALSE(
      solve_tasks(*scene_, *session_, {correct_task("left_leg"), correct_task("tail")}).ok());
}

TEST_F(Tasks, SamplingIntervalsReachIntoTheLimits) {
  const auto limbs = limbs_named(*session_, "left_arm");
  ASSERT_TRUE(limbs.ok());
  const auto& space = scene_->limbs()[static_cast<std::size_t>(limbs->front())].space;
  const Dof& dof = space.dofs.front();
  const auto check = [&](double lower, double upper) {
    PlanningWishes wishes;
    wishes.sampling[dof.name] = {lower, upper};
    return check_wishes(*scene_, *limbs, wishes).ok();
  };
  EXPECT_TRUE(check(dof.lower, dof.upper));
  EXPECT_TRUE(check(dof.lower - 1, dof.upper + 1));
  EXPECT_TRUE(check(dof.upper, dof.upper));
  EXPECT_FALSE(check(dof.upper + 0.01, dof.upper + 1));
  EXPECT_FALSE(check(dof.lower - 1, dof.lower - 0.01));
  EXPECT_FALSE(check(dof.upper, dof.lower));
  EXPECT_FALSE(check(std::nan(""), dof.upper));
  PlanningWishes wishes;
  wishes.sampling[dof.name] = {dof.lower - 1, dof.upper};
  EXPECT_EQ(wishes_cut(*scene_, *limbs, wishes).size(), 1u);
  wishes.sampling[dof.name] = {dof.lower, dof.upper};
  EXPECT_TRUE(wishes_cut(*scene_, *limbs, wishes).empty());
}

TEST(UniqueNames, AreOfNoTaskAndOfNoneThatWas) {
  Document document;
  EXPECT_EQ(unique_task_name(document, "a"), "a");
  document.tasks = {correct_task("x")};
  document.tasks[0].name = "a";
  EXPECT_EQ(unique_task_name(document, "a"), "a (2)");
  Correction correction;
  correction.name = "left_arm 1";
  correction.task = "a (2)";
  document.corrections = {correction};
  EXPECT_EQ(unique_task_name(document, "a"), "a (3)");
  EXPECT_EQ(unique_correction_name(document, "left_arm 1"), "left_arm 1 (2)");
  EXPECT_EQ(unique_correction_name(document, "left_arm 2"), "left_arm 2");
}

}  // namespace
}  // namespace elbowroom
