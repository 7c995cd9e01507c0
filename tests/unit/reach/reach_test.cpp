// SPDX-License-Identifier: MIT
// [SKF07 6.2]: two plans that meet in a posture of the IK, on the demo's walk and on a sample rig.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/editing/reach.h"
#include "core/editing/solve_task.h"
#include "tests/support/samples.h"

namespace elbowroom {
namespace {

struct Stage {
  Session session;
  SceneCollision scene;
};

std::unique_ptr<Stage> stage_of(const std::filesystem::path& file, const std::string& clip) {
  Document document;
  document.scene.character = file;
  document.scene.clip = clip;
  auto session = open_session(document);
  if (!session) {
    ADD_FAILURE() << session.error().message();
    return nullptr;
  }
  auto scene = contacts_of(*session);
  if (!scene) {
    ADD_FAILURE() << scene.error().message();
    return nullptr;
  }
  return std::make_unique<Stage>(Stage{std::move(*session), std::move(*scene)});
}

int limb_index(const Stage& stage, const std::string& name) {
  const auto limbs = limbs_named(stage.session, name);
  return limbs ? limbs->front() : -1;
}

// World placement of the limb's end in a clip at a time, by the world itself.
Mat4 end_at(const Stage& stage, const std::shared_ptr<const Clip>& clip, int limb, double t) {
  World world = stage.scene.world();
  world.actors.front().clip = clip;
  std::vector<ActorState> states;
  world_state_at(world, t, states);
  const int end = stage.scene.limbs()[static_cast<std::size_t>(limb)].limb.end;
  return states.front().world_from_joint[static_cast<std::size_t>(end)];
}

double limb_length(const Stage& stage, int limb) {
  const auto ik =
      limb_ik_at(stage.scene, limb, 0, {Quat(1, 0, 0, 0), Quat(1, 0, 0, 0), Quat(1, 0, 0, 0)});
  return ik ? ik->length() : 0;
}

Task reach_task(const std::string& limb, double time, const Vec3& position) {
  Task task;
  task.kind = TaskKind::reach;
  task.name = "reach";
  task.limb = limb;
  HandTarget target;
  target.time = time;
  target.position = position;
  task.target = target;
  return task;
}

// The outcome's clip at the target's time, its key there, and its movement about it.
void expect_reached(const Stage& stage, int limb, const Task& task,
                    const CorrectionOutcome& outcome) {
  ASSERT_EQ(outcome.windows.size(), 1u);
  const WindowReport& window = outcome.windows.front();
  ASSERT_EQ(window.status, CorrectionStatus::corrected) << window.reason << window.blocked_by;
  ASSERT_EQ(outcome.corrections.size(), 1u);
  const auto t_b = static_cast<float>(task.target->time);
  EXPECT_LT(window.begin, t_b);
  EXPECT_GT(window.end, t_b);
  for (const JointKeys& joint : outcome.corrections.front().joints)
    EXPECT_EQ(std::count(joint.keys.times.begin(), joint.keys.times.end(), t_b), 1);

  const double length = limb_length(stage, limb);
  const Mat4 end = end_at(stage, outcome.clip, limb, static_cast<double>(t_b));
  const double off = glm::distance(Vec3(end[3]), task.target->position) / length;
  EXPECT_LT(off, 1e-5);
  if (task.target->orientation) {
    EXPECT_LT(angle_between(rotation_of(end), glm::normalize(*task.target->orientation)), 1e-4);
  }
  // Held still there: within the frames around, farther by the square of time only.
  const double h = 0.008;
  for (const double side : {-h, h}) {
    const Mat4 near = end_at(stage, outcome.clip, limb, static_cast<double>(t_b) + side);
    EXPECT_LT(glm::distance(Vec3(near[3]), task.target->position), 0.02 * length);
  }
  std::printf("  %.3f of [%.3f, %.3f] s, off by %.1e of the length, peak %.2f rad/s, %.0f ms\n",
              static_cast<double>(t_b), window.begin, window.end, off, window.peak_speed,
              window.total_ms);
}

class OnTheDemo : public testing::Test {
 protected:
  void SetUp() override {
    stage_ = stage_of(std::filesystem::path(ELBOWROOM_DEMO_DIR) / "mannequin.glb", "Walk");
    ASSERT_NE(stage_, nullptr);
    limb_ = limb_index(*stage_, "left_arm");
    ASSERT_GE(limb_, 0);
    source_ = stage_->session.clip();
  }
  std::unique_ptr<Stage> stage_;
  int limb_ = -1;
  std::shared_ptr<const Clip> source_;
};

TEST_F(OnTheDemo, TwoPlansMeetInThePostureAndAPlannedArmReachesAgain) {
  const Mat4 hand = end_at(*stage_, source_, limb_, 0.35);
  Task task = reach_task("left_arm", 0.35, Vec3(hand[3]) + Vec3(0.05, 0.12, 0.08));
  task.target->orientation = quat_from_rotation_vector({0.1, 0.2, -0.1}) * rotation_of(hand);
  task.window = Interval{0.02, 0.7};
  const auto first = solve_task(stage_->scene, stage_->session, task);
  ASSERT_TRUE(first.ok()) << first.error().message();
  expect_reached(*stage_, limb_, task, *first);
  EXPECT_EQ(stage_->scene.world().actors.front().clip, first->clip);

  // The later window overlaps the first one's: on top of it, the arm leaves it as it is at 0.35 s.
  const Mat4 later = end_at(*stage_, first->clip, limb_, 0.75);
  Task again = reach_task("left_arm", 0.75, Vec3(later[3]) + Vec3(0.08, 0.05, 0.0));
  again.window = Interval{0.5, 1.0};
  const auto second = reach(stage_->scene, limb_, again);
  ASSERT_TRUE(second.ok()) << second.error().message();
  expect_reached(*stage_, limb_, again, *second);
  EXPECT_LT(
      glm::distance(Vec3(end_at(*stage_, second->clip, limb_, 0.35)[3]), task.target->position),
      1e-5 * limb_length(*stage_, limb_));
}

TEST_F(OnTheDemo, WithoutAWindowOneIsChosen) {
  const Mat4 hand = end_at(*stage_, source_, limb_, 0.55);
  const Task task = reach_task("left_arm", 0.55, Vec3(hand[3]) + Vec3(0.1, 0.1, 0.1));
  const auto outcome = reach(stage_->scene, limb_, task);
  ASSERT_TRUE(outcome.ok()) << outcome.error().message();
  expect_reached(*stage_, limb_, task, *outcome);
}

// Too little time in the window that was given: the one that would be chosen is tried.
TEST_F(OnTheDemo, AWindowThatDoesIsSuggested) {
  const Mat4 hand = end_at(*stage_, source_, limb_, 0.55);
  Task task = reach_task("left_arm", 0.55, Vec3(hand[3]) + Vec3(0.1, 0.3, 0.15));
  task.window = Interval{0.52, 0.58};
  const auto hurried = reach(stage_->scene, limb_, task);
  ASSERT_TRUE(hurried.ok()) << hurried.error().message();
  ASSERT_EQ(hurried->windows[0].status, CorrectionStatus::failed);
  EXPECT_FALSE(hurried->windows[0].out_of_reach);
  ASSERT_EQ(hurried->windows[0].suggestions.size(), 1u);
  const Suggestion& other = hurried->windows[0].suggestions.front();
  ASSERT_TRUE(other.works) << other.text();
  task.window = other.window;
  stage_->scene.set_clip(source_);
  const auto outcome = reach(stage_->scene, limb_, task);
  ASSERT_TRUE(outcome.ok()) << outcome.error().message();
  expect_reached(*stage_, limb_, task, *outcome);
}

TEST_F(OnTheDemo, FailureSaysWhy) {
  const auto ik =
      limb_ik_at(stage_->scene, limb_, 0.5, {Quat(1, 0, 0, 0), Quat(1, 0, 0, 0), Quat(1, 0, 0, 0)});
  ASSERT_TRUE(ik.ok());
  const Vec3 shoulder = ik->points(ik->current()).root;
  const auto far = reach(stage_->scene, limb_,
                         reach_task("left_arm", 0.5, shoulder + Vec3(ik->length() + 0.25, 0, 0)));
  ASSERT_TRUE(far.ok());
  ASSERT_EQ(far->windows.size(), 1u);
  EXPECT_EQ(far->windows[0].status, CorrectionStatus::failed);
  EXPECT_NE(far->windows[0].reason.find("out of reach by 25"), std::string::npos)
      << far->windows[0].reason;
  EXPECT_TRUE(far->windows[0].out_of_reach);
  EXPECT_EQ(far->clip, source_);
  EXPECT_TRUE(far->corrections.empty());

  // The hand the other way round.
  const Mat4 hand = end_at(*stage_, source_, limb_, 0.5);
  Task twisted = reach_task("left_arm", 0.5, Vec3(hand[3]));
  twisted.target->orientation = rotation_of(hand) * quat_from_rotation_vector({0, 2.8, 0});
  const auto limit = reach(stage_->scene, limb_, twisted);
  ASSERT_TRUE(limit.ok());
  EXPECT_EQ(limit->windows[0].status, CorrectionStatus::failed);
  EXPECT_NE(limit->windows[0].reason.find("beyond the limit of"), std::string::npos)
      << limit->windows[0].reason;

  // In the middle of the own trunk.
  const auto inside =
      reach(stage_->scene, limb_, reach_task("left_arm", 0.5, shoulder + Vec3(-0.18, -0.2, 0)));
  ASSERT_TRUE(inside.ok());
  EXPECT_EQ(inside->windows[0].status, CorrectionStatus::failed);
  EXPECT_FALSE(inside->windows[0].reason.empty());
  std::printf("  %s; %s\n", inside->windows[0].reason.c_str(),
              inside->windows[0].blocked_by.c_str());
}

TEST_F(OnTheDemo, WrongTasksAreErrors) {
  const Task good = reach_task("left_arm", 0.5, Vec3(0.3, 1.2, 0.3));
  const auto refused = [&](const Task& task, int limb) {
    return !reach(stage_->scene, limb, task).ok();
  };
  Task task = good;
  task.target.reset();
  EXPECT_TRUE(refused(task, limb_));
  for (const double time : {-1.0, 0.0, 1.1, 9.0, std::numeric_limits<double>::quiet_NaN()}) {
    task = good;
    task.target->time = time;
    EXPECT_TRUE(refused(task, limb_)) << time;
  }
  task = good;
  task.target->position.x = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(refused(task, limb_));
  task = good;
  task.target->orientation = Quat(0, 0, 0, 0);
  EXPECT_TRUE(refused(task, limb_));
  task = good;
  task.window = Interval{0.6, 0.9};
  EXPECT_TRUE(refused(task, limb_));
  task = good;
  task.wishes.sampling["Tail, wag"] = {0, 1};
  EXPECT_TRUE(refused(task, limb_));
  EXPECT_TRUE(refused(good, -1));
  EXPECT_TRUE(refused(good, 99));
  task = good;
  task.limb = "auto";
  EXPECT_FALSE(solve_task(stage_->scene, stage_->session, task).ok());
}

TEST_F(OnTheDemo, StopsWhenAskedTo) {
  std::stop_source source;
  source.request_stop();
  const auto outcome = reach(stage_->scene, limb_, reach_task("left_arm", 0.5, Vec3(0.3, 1.2, 0.3)),
                             source.get_token());
  ASSERT_TRUE(outcome.ok());
  EXPECT_TRUE(outcome->cancelled());
  EXPECT_EQ(stage_->scene.world().actors.front().clip, source_);
}

TEST(OnASample, AnArmReachesAside) {
  const auto samples = test::samples_dir();
  if (samples.empty()) GTEST_SKIP() << test::samples_missing();
  const auto stage = stage_of(samples / "humanoids/khronos/CesiumMan.glb", "0");
  ASSERT_NE(stage, nullptr);
  const int limb = limb_index(*stage, "right_arm");
  ASSERT_GE(limb, 0);
  const auto& clip = stage->session.clip();
  const double t = 0.5 * (clip->begin + clip->end);
  const double length = limb_length(*stage, limb);
  const Task task =
      reach_task("right_arm", t, Vec3(end_at(*stage, clip, limb, t)[3]) + Vec3(0, 0.1, 0) * length);
  const auto outcome = reach(stage->scene, limb, task);
  ASSERT_TRUE(outcome.ok()) << outcome.error().message();
  expect_reached(*stage, limb, task, *outcome);
}

}  // namespace
}  // namespace elbowroom
