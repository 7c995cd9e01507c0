// SPDX-License-Identifier: MIT
// The skin as the planner sees it: at which times it is looked at.
#include "core/editing/skin_planning_space.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/editing/session.h"
#include "core/editing/window_motion.h"
#include "core/planning/interpolation.h"
#include "tests/support/folder.h"
#include "tests/support/simple_glb.h"
#include "tests/support/walking.h"

namespace elbowroom {
namespace {

constexpr double kBegin = 0.3, kEnd = 0.8, kMet = 0.5;  // s
constexpr double kSpeed = 200;                          // units/s: 0.8 of them between two looks

PlanningView skin(std::vector<double> moments) {
  PlanningView view;
  view.on_skin = true;
  view.clearance = view.body_clearance = 1e-4;
  view.moments = std::move(moments);
  return view;
}

// The demo's figure walking, and a block that flies through its right hand.
struct Flight {
  test::Folder folder;
  Result<Session> session = Error{"not opened", "", ""};
  Result<SceneCollision> scene = Error{"not built", "", ""};
  int limb = -1;

  void open(const Vec3* met) {
    Document document = test::walking(ELBOWROOM_DEMO_DIR);
    if (met) {
      const Vec3 from = *met - Vec3(0, 0, kSpeed * kMet);
      const auto block = folder / "block.glb";
      ASSERT_TRUE(test::write_simple_glb(
          block, "block", test::box(glm::vec3(from - Vec3(0.02)), glm::vec3(from + Vec3(0.02))),
          glm::vec3(0, 0, static_cast<float>(kSpeed)), 1.0f));
      document.scene.obstacles = {block};
    }
    session = open_session(document);
    ASSERT_TRUE(session.ok()) << session.error().message();
    scene = contacts_of(*session);
    ASSERT_TRUE(scene.ok()) << scene.error().message();
    limb = limbs_named(*session, "right_arm")->front();
  }
  WindowProblem problem() {
    return window_problem(*scene, session->clip(), limb, kBegin, kEnd, {});
  }
};

TEST(SkinPlanningSpace, LooksAtMomentsThatItsSamplesPassOver) {
  Flight alone;
  alone.open(nullptr);
  if (HasFatalFailure()) return;
  std::vector<Vec3> points;
  {
    WindowProblem problem = alone.problem();
    PlanningWorld world(problem, skin({}));
    world.part(0).metric_points({problem.reference_at(kMet), kMet}, points);
  }
  const Vec3 wrist = points[1];  // after the elbow
  Flight flight;
  flight.open(&wrist);
  if (HasFatalFailure()) return;
  WindowProblem problem = flight.problem();
  const auto along_clip = [&](double t) { return Configuration{problem.reference_at(t), t}; };
  PlanningWorld samples(problem, skin({}));
  ASSERT_FALSE(samples.part(0).valid(along_clip(kMet)));
  // The block comes and goes between two looks of these edges.
  const Configuration from = along_clip(kMet - 0.5 / 240), to = along_clip(kMet + 0.5 / 240);
  ASSERT_TRUE(samples.part(0).valid(from));
  ASSERT_TRUE(samples.part(0).valid(to));
  CheckCounters counters;
  EXPECT_TRUE(interpolation_free(samples.part(0), {0.5, 1.0 / 240}, from, to, {}, counters));
  EXPECT_TRUE(samples.part(0).step_times().empty());

  PlanningWorld looks(problem, skin({kBegin - 1, kMet, kBegin, kEnd, kEnd + 1, kMet}));
  const std::vector<double> inside = {kMet};
  EXPECT_EQ(looks.part(0).step_times(), inside) << "once, and those inside the window";
  EXPECT_FALSE(interpolation_free(looks.part(0), {0.5, 1.0 / 240}, from, to, {}, counters));
}

}  // namespace
}  // namespace elbowroom
