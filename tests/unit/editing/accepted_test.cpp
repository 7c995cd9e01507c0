// SPDX-License-Identifier: MIT
// What was accepted is what comes out, as long as it holds; what does not is planned anew and told
// of.
#include "core/editing/accepted.h"

#include <gtest/gtest.h>

#include "core/editing/plan_window.h"
#include "core/editing/reach.h"
#include "core/editing/solve_task.h"
#include "tests/support/folder.h"
#include "tests/support/simple_glb.h"
#include "tests/support/walking.h"

namespace elbowroom {
namespace {

constexpr double kBegin = 0.25, kEnd = 0.85, kMiddle = 0.55;

class AcceptedTest : public testing::Test {
 protected:
  void SetUp() override { open(test::walking(ELBOWROOM_DEMO_DIR)); }
  void open(const Document& document) {
    auto session = open_session(document);
    ASSERT_TRUE(session.ok()) << session.error().message();
    session_ = std::make_unique<Session>(std::move(*session));
    auto scene = contacts_of(*session_);
    ASSERT_TRUE(scene.ok());
    scene_ = std::make_unique<SceneCollision>(std::move(*scene));
    arm_ = limbs_named(*session_, "left_arm")->front();
  }
  const Skeleton& skeleton() const { return session_->scene.model().skeleton; }
  // A task of the window, and the way around that some seed gives: its own is not the task's.
  Task task(const std::string& limb = "left_arm") const {
    Task task;
    task.name = "past it, " + limb;
    task.limb = limb;
    task.window = Interval{as_float(kBegin), as_float(kEnd)};
    task.even_if_free = true;
    // Away from the clip, so that seeds differ.
    const auto& dof = session_->limbs[static_cast<std::size_t>(arm_)].space.dofs[0];
    task.wishes.sampling[dof.name] = {0.3 * dof.upper, 0.6 * dof.upper};
    return task;
  }
  static double as_float(double t) { return static_cast<double>(static_cast<float>(t)); }
  WindowPlan way(const Task& task, std::uint64_t seed) {
    Task other = task;
    other.wishes.seed = seed;
    const int limb = limbs_named(*session_, task.limb)->front();
    WindowPlan plan = plan_window(*scene_, clip_before_, limb, task.window->lower,
                                  task.window->upper, other.wishes, {}, {});
    EXPECT_TRUE(plan.correction.has_value()) << plan.report.reason;
    if (!plan.correction) return plan;
    plan.correction->name = "way of seed " + std::to_string(seed);
    plan.correction->task = task.name;
    return plan;
  }
  Correction accepted(const Task& task, std::uint64_t seed) {
    clip_before_ = session_->clip();
    return *way(task, seed).correction;
  }
  CorrectionOutcome solve(const std::vector<Task>& tasks,
                          const std::vector<Correction>& corrections) {
    scene_->set_clip(session_->clip());
    auto outcome = solve_over_accepted(*scene_, *session_, tasks, corrections);
    EXPECT_TRUE(outcome.ok()) << outcome.error().message();
    return outcome.ok() ? std::move(*outcome) : CorrectionOutcome{};
  }

  std::unique_ptr<Session> session_;
  std::unique_ptr<SceneCollision> scene_;
  std::shared_ptr<const Clip> clip_before_;
  int arm_ = -1;
};

bool same_keys(const CorrectionOutcome& outcome, const Correction& correction) {
  return outcome.corrections.size() == 1 && outcome.corrections.front() == correction;
}

TEST_F(AcceptedTest, ComesOutAsItIs) {
  const Task task = this->task();
  clip_before_ = session_->clip();
  const WindowPlan plan = way(task, 5);
  const Correction correction = *plan.correction;
  ASSERT_NE(correction.joints, accepted(task, task.wishes.seed).joints)
      << "the task's own seed gives another";
  const CorrectionOutcome outcome = solve({task}, {correction});
  ASSERT_TRUE(same_keys(outcome, correction));
  EXPECT_TRUE(outcome.notes.empty());
  const auto laid = lay_over(skeleton(), *session_->clip(), {correction});
  ASSERT_TRUE(laid.ok());
  ASSERT_EQ(outcome.clip->channels.size(), laid->channels.size());
  for (std::size_t i = 0; i < laid->channels.size(); ++i) {
    EXPECT_EQ(outcome.clip->channels[i].times, laid->channels[i].times);
    EXPECT_EQ(outcome.clip->channels[i].values, laid->channels[i].values);
  }
  // What is said of it is what was said of the plan.
  ASSERT_EQ(outcome.windows.size(), 1u);
  const WindowReport &now = outcome.windows.front(), &then = plan.report;
  EXPECT_TRUE(now.accepted);
  EXPECT_FALSE(then.accepted);
  EXPECT_EQ(now.status, CorrectionStatus::corrected);
  EXPECT_EQ(now.certified, then.certified);
  EXPECT_EQ(now.seed, then.seed);
  EXPECT_NEAR(now.min_clearance, then.min_clearance, 1e-9);
  EXPECT_NEAR(now.deviation_from_clip, then.deviation_from_clip, 1e-3);
  EXPECT_NEAR(now.peak_speed, then.peak_speed, 0.03 * then.peak_speed);
  EXPECT_LE(now.peak_acceleration, 1.1 * then.peak_acceleration);
  EXPECT_EQ(now.iterations, 0);
}

TEST_F(AcceptedTest, OfATaskThatAsksForSomethingElseIsPlannedAnew) {
  const Task made = task();
  const Correction correction = accepted(made, 5);
  Task other = made;
  other.window->upper = as_float(kEnd - 0.1);
  CorrectionOutcome outcome = solve({other}, {correction});
  ASSERT_EQ(outcome.corrections.size(), 1u);
  EXPECT_FALSE(outcome.windows.front().accepted);
  EXPECT_EQ(static_cast<double>(outcome.corrections.front().end), other.window->upper);
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_NE(outcome.notes.front().find("another window"), std::string::npos)
      << outcome.notes.front();
  other = made;
  other.wishes.sampling.clear();
  outcome = solve({other}, {correction});
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_NE(outcome.notes.front().find("in another way"), std::string::npos);
  EXPECT_FALSE(outcome.windows.front().accepted);
  other = made;
  other.limb = "right_arm";
  outcome = solve({other}, {correction});
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_NE(outcome.notes.front().find("another limb"), std::string::npos);
  ASSERT_EQ(outcome.corrections.size(), 1u);
  EXPECT_EQ(outcome.corrections.front().limb, "right_arm");
}

TEST_F(AcceptedTest, OfNoTaskIsKeptAndMutedOnesAreNotMadeAgain) {
  Correction correction = accepted(task(), 5);
  correction.task.clear();
  EXPECT_TRUE(same_keys(solve({}, {correction}), correction));
  correction.muted = true;
  const CorrectionOutcome none = solve({}, {correction});
  EXPECT_TRUE(none.corrections.empty());
  EXPECT_TRUE(none.windows.empty());
  EXPECT_EQ(none.clip, session_->clip());
}

TEST_F(AcceptedTest, InTheWayOfSomethingNewIsPlannedAnew) {
  const Task task = this->task();
  const Correction correction = accepted(task, 5);
  // A small box where the hand is in the middle of the way.
  const auto laid = lay_over(skeleton(), *session_->clip(), {correction});
  ASSERT_TRUE(laid.ok());
  scene_->set_clip(std::make_shared<const Clip>(*laid));
  std::vector<ActorState> states;
  world_state_at(scene_->world(), kMiddle, states);
  const int hand = session_->limbs[static_cast<std::size_t>(arm_)].limb.end;
  const Vec3 place(states[0].world_from_joint[static_cast<std::size_t>(hand)][3]);
  const test::Folder folder;
  const auto half = glm::vec3(0.01f);
  ASSERT_TRUE(test::write_simple_glb(folder / "box.glb", "box",
                                     test::box(glm::vec3(place) - half, glm::vec3(place) + half)));
  Document document = test::walking(ELBOWROOM_DEMO_DIR);
  document.scene.obstacles = {folder / "box.glb"};
  open(document);
  for (const bool with_task : {true, false}) {
    const CorrectionOutcome outcome =
        solve(with_task ? std::vector{task} : std::vector<Task>{}, {correction});
    ASSERT_EQ(outcome.notes.size(), 1u);
    EXPECT_NE(outcome.notes.front().find(correction.name), std::string::npos);
    EXPECT_NE(outcome.notes.front().find("box"), std::string::npos) << outcome.notes.front();
    ASSERT_EQ(outcome.corrections.size(), 1u) << outcome.windows.front().reason;
    EXPECT_NE(outcome.corrections.front().joints, correction.joints);
    EXPECT_FALSE(outcome.windows.front().accepted);
    EXPECT_TRUE(outcome.all_corrected());
    EXPECT_TRUE(outcome.after.empty());
  }
}

TEST_F(AcceptedTest, KeysThatDoNotFitAreDropped) {
  const Correction correction = accepted(task(), 5);
  const auto why = [&](const Correction& one) {
    scene_->set_clip(session_->clip());
    const Accepted accepted = keep_accepted(*scene_, *session_, {one}, {});
    EXPECT_TRUE(accepted.kept.empty());
    EXPECT_EQ(accepted.clip, session_->clip());
    return accepted.dropped.size() == 1 ? accepted.dropped.front().why : std::string();
  };
  Correction bad = correction;
  bad.joints[0].node = session_->limbs[static_cast<std::size_t>(arm_)].limb.end + 1;
  EXPECT_NE(why(bad).find("no joint of left_arm"), std::string::npos);
  bad.joints[0].node = 99999;
  EXPECT_NE(why(bad).find("no joint of left_arm"), std::string::npos);
  bad = correction;
  bad.joints.clear();
  EXPECT_NE(why(bad).find("no keys"), std::string::npos);
  bad = correction;
  bad.limb = "tail";
  EXPECT_NE(why(bad).find("tail"), std::string::npos);
  bad = correction;
  bad.joints[0].keys.values.front() =
      bad.joints[0].keys.values.front() * glm::angleAxis(0.01, Vec3(1, 0, 0));
  EXPECT_FALSE(why(bad).empty()) << "it does not meet the clip";
  bad = correction;
  bad.joints[0].keys.values[2] = Quat(std::nan(""), 0, 0, 0);
  EXPECT_FALSE(why(bad).empty());
  // Through the body, half-way.
  bad = correction;
  for (std::size_t i = 0; i < bad.joints[0].keys.values.size(); ++i) {
    const double u =
        static_cast<double>(i) / static_cast<double>(bad.joints[0].keys.values.size() - 1);
    bad.joints[0].keys.values[i] =
        glm::angleAxis(4 * std::sin(kPi * u), Vec3(0, 1, 0)) * bad.joints[0].keys.values[i];
    bad.joints[0].keys.derivatives.clear();
  }
  EXPECT_NE(why(bad).find(" at "), std::string::npos);
}

TEST_F(AcceptedTest, ThatReachesHoldsWhileItIsAtItsTarget) {
  Task task;
  task.kind = TaskKind::reach;
  task.name = "reach";
  task.limb = "left_arm";
  scene_->set_clip(session_->clip());
  std::vector<ActorState> states;
  world_state_at(scene_->world(), kMiddle, states);
  const int hand = session_->limbs[static_cast<std::size_t>(arm_)].limb.end;
  task.target = HandTarget{
      kMiddle,
      Vec3(states[0].world_from_joint[static_cast<std::size_t>(hand)][3]) + Vec3(0.05, 0.1, 0.1),
      std::nullopt, false};
  const auto plan = plan_reach(*scene_, arm_, task);
  ASSERT_TRUE(plan.ok());
  ASSERT_TRUE(plan->correction.has_value()) << plan->report.reason;
  EXPECT_TRUE(same_keys(solve({task}, {*plan->correction}), *plan->correction));
  Task elsewhere = task;
  elsewhere.target->position.y += 0.01;
  const CorrectionOutcome outcome = solve({elsewhere}, {*plan->correction});
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_NE(outcome.notes.front().find("0.01 from its target"), std::string::npos)
      << outcome.notes.front();
  ASSERT_EQ(outcome.corrections.size(), 1u);
  EXPECT_NE(outcome.corrections.front().joints, plan->correction->joints);
}

TEST_F(AcceptedTest, OnesAreJudgedTogetherInWhateverOrder) {
  const Task left = task(), right = task("right_arm");
  const Correction first = accepted(left, 3);
  const auto laid = lay_over(skeleton(), *session_->clip(), {first});
  ASSERT_TRUE(laid.ok());
  clip_before_ = std::make_shared<const Clip>(*laid);
  const Correction second = *way(right, 4).correction;
  for (const bool turned : {false, true}) {
    const std::vector<Correction> both =
        turned ? std::vector{second, first} : std::vector{first, second};
    const CorrectionOutcome outcome = solve({left, right}, both);
    EXPECT_EQ(outcome.corrections, both);
    EXPECT_TRUE(outcome.notes.empty());
  }
  // A task without any is done on top.
  const CorrectionOutcome outcome = solve({right, left}, {first});
  ASSERT_EQ(outcome.corrections.size(), 2u);
  EXPECT_EQ(outcome.corrections[0], first);
  EXPECT_EQ(outcome.corrections[1].limb, "right_arm");
  EXPECT_TRUE(outcome.windows[0].accepted);
  EXPECT_FALSE(outcome.windows[1].accepted);
}

TEST_F(AcceptedTest, StoppedIsInterrupted) {
  const Task task = this->task();
  const Correction correction = accepted(task, 5);
  scene_->set_clip(session_->clip());
  std::stop_source stop;
  bool begun = false;
  const auto outcome = solve_over_accepted(
      *scene_, *session_, {task}, {correction}, stop.get_token(), [&](const Progress& progress) {
        begun = begun || progress.phase.find(correction.name) != std::string::npos;
        if (begun) stop.request_stop();
      });
  ASSERT_TRUE(outcome.ok());
  EXPECT_TRUE(begun);
  EXPECT_TRUE(outcome->cancelled());
  EXPECT_TRUE(outcome->corrections.empty());
}

}  // namespace
}  // namespace elbowroom
