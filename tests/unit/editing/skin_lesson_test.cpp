// SPDX-License-Identifier: MIT
// The ways in which a window is looked at, and what is learnt from motions that touch.
#include "core/editing/skin_lesson.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "assets/demo.h"
#include "core/editing/planning_views.h"
#include "core/editing/session.h"
#include "core/planning/curve_energy.h"
#include "tests/support/walking.h"

namespace elbowroom {
namespace {

TEST(PlanningViews, BeginAsAskedAndEndWithHardlyAnyRoom) {
  const double clearance = 0.005, touching = 2e-5;
  const auto views = planning_views(clearance, touching, 1.75, false);
  ASSERT_GT(views.size(), 3u);
  EXPECT_FALSE(views.front().on_skin);
  EXPECT_EQ(views.front().clearance, clearance);
  EXPECT_EQ(views.front().body_clearance, clearance);
  EXPECT_EQ(views.front().margin, 0);
  EXPECT_GT(views.front().lessons, 0);
  EXPECT_TRUE(views.back().on_skin);
  EXPECT_TRUE(views.back().as_verified) << "what is found last should hold";
  EXPECT_LT(views.back().clearance, 0.1 * clearance);
  for (const PlanningView& view : views) {
    EXPECT_GE(view.clearance, touching) << view.text();
    EXPECT_GE(view.body_clearance, touching) << view.text();
    EXPECT_TRUE(view.pair_margins.empty());
    EXPECT_GT(view.ways, 0);
    EXPECT_GT(view.seeds_in_vain, 0);
    EXPECT_GT(view.effort, 0);
    EXPECT_TRUE(view.moments.empty());
    EXPECT_TRUE(!view.on_skin || view.lessons > 0) << "any look at the skin may miss a moment";
  }
  EXPECT_EQ(planning_views(clearance, touching, 1.75, true).front().near_share, 0)
      << "the animator's intervals alone say where to search first";
}

TEST(SkinLesson, NothingLearntTeachesNothing) {
  SkinLesson lesson;
  EXPECT_EQ(lesson.size(), 0u);
  for (const PlanningView& view : planning_views(0.005, 2e-5, 1.75, false)) {
    EXPECT_TRUE(lesson.taught(view).pair_margins.empty());
    EXPECT_TRUE(lesson.taught(view).moments.empty());
  }
}

TEST(SkinLesson, MomentsAreOfTheSkinAlone) {
  SkinLesson lesson;
  lesson.learn(1.5);
  const std::size_t once = lesson.size();
  EXPECT_GT(once, 0u);
  lesson.learn(0.25);
  EXPECT_GT(lesson.size(), once);
  for (const PlanningView& view : planning_views(0.005, 2e-5, 1.75, false)) {
    const PlanningView taught = lesson.taught(view);
    EXPECT_TRUE(taught.pair_margins.empty());
    if (!view.on_skin) {
      EXPECT_TRUE(taught.moments.empty()) << "rigid parts touch elsewhere";
      continue;
    }
    EXPECT_TRUE(taught.as_verified) << "what touched was judged so";
    EXPECT_NE(taught.text(), view.text());
    for (const double t : {1.5, 0.25})
      EXPECT_TRUE(std::find(taught.moments.begin(), taught.moments.end(), t) !=
                  taught.moments.end());
    EXPECT_EQ(taught.clearance, view.clearance);
    EXPECT_EQ(taught.body_clearance, view.body_clearance);
  }
}

// The demo's clip itself, as if it were planned: its umbrella runs into a post.
TEST(SkinLesson, PairsThatTouchGetMarginsThatWouldHaveRefusedTheMotion) {
  Document document = test::walking(ELBOWROOM_DEMO_DIR);
  document.scene.clip = demo::kDemoClip;
  document.scene.obstacles = {std::filesystem::path(ELBOWROOM_DEMO_DIR) / demo::kPostsFile};
  AttachedFile umbrella;
  umbrella.file = std::filesystem::path(ELBOWROOM_DEMO_DIR) / demo::kUmbrellaFile;
  umbrella.joint = demo::kAttachJoint;
  umbrella.joint_from_object.translation = {demo::kGripX, demo::kGripY, demo::kGripZ};
  document.scene.attachments = {umbrella};
  const auto session = open_session(document);
  ASSERT_TRUE(session.ok());
  auto scene = contacts_of(*session);
  ASSERT_TRUE(scene.ok());
  const int limb = limbs_named(*session, "right_arm")->front();
  const double begin = 1.375, end = 2.25;
  WindowProblem problem = window_problem(*scene, session->clip(), limb, begin, end, {});
  std::vector<double> breakpoints;
  for (int i = 0; i <= 30; ++i) breakpoints.push_back(begin + (end - begin) * i / 30);
  WindowMotion motion;
  Curve curve;
  curve.knots = clamped_knots(breakpoints);
  curve.control = smoothing_spline(
      curve.knots, [&](double t) { return problem.reference_at(t); }, problem.space.count(), 1e-3);
  curve.control.front() = problem.postures.front().state.q;
  curve.control.back() = problem.postures.back().state.q;
  motion.curves.push_back(curve);
  motion.until.push_back(end);
  const auto keyed = key_motion(problem, motion);
  ASSERT_TRUE(keyed.ok()) << keyed.error().message();
  const auto seen = contacts_at_a_glance(problem, *keyed, {});
  ASSERT_FALSE(seen.empty());
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end(),
                             [](const auto& a, const auto& b) { return a.time < b.time; }));
  EXPECT_EQ(scene->world().actors[static_cast<std::size_t>(scene->actor())].clip, session->clip())
      << "the scene plays what it played";

  WindowReport report;
  const PlanningView view = planning_views(0.005, 2e-5, scene->height(), false).front();
  PlanningWorld world(problem, view);
  SkinLesson lesson;
  lesson.learn(problem, world, motion, *keyed, {});
  EXPECT_EQ(lesson.size(), 0u) << "nobody has planned in that world";
  world.part(0);
  lesson.learn(problem, world, motion, *keyed, {});
  ASSERT_GT(lesson.size(), 0u);
  const SeenContact first = verify_keys(problem, *keyed, 1, {}, {}, report);
  EXPECT_FALSE(first.none());
  EXPECT_NE(first.text.find(" with "), std::string::npos) << first.text;
  EXPECT_EQ(first.time, seen.front().time) << "both begin with the same glance";
  EXPECT_TRUE(touches_at_a_glance(problem, *keyed, {}));
  const PlanningView taught = lesson.taught(view);
  for (const auto& pair : taught.pair_margins) {
    EXPECT_GT(pair.margin, 0);
    EXPECT_LE(pair.margin, 0.05 * scene->height());
    EXPECT_TRUE(std::any_of(seen.begin(), seen.end(),
                            [&](const GlancedContact& contact) {
                              return contact.part_a == pair.part_a && contact.part_b == pair.part_b;
                            }))
        << pair.part_a << " with " << pair.part_b;
    EXPECT_NE(taught.text().find(pair.part_a + " and " + pair.part_b), std::string::npos);
  }
  PlanningWorld again(problem, taught);
  for (const GlancedContact& contact : seen)
    EXPECT_FALSE(again.part(0).valid({motion.at(contact.time).value(contact.time), contact.time}))
        << contact.time;
  // What is learnt twice adds up: the first margin was not enough.
  const PlanningView twice = lesson.taught(taught);
  ASSERT_EQ(twice.pair_margins.size(), taught.pair_margins.size());
  EXPECT_GT(twice.pair_margins.front().margin, taught.pair_margins.front().margin);
}

}  // namespace
}  // namespace elbowroom
