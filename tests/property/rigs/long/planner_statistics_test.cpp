// SPDX-License-Identifier: MIT
// Size, placement and mirroring don't matter to the planner: the same character and post, scaled,
// turned, shifted and mirrored, are solved as often, proven as often, and at the same cost in the
// median. Randomness is the same but for rounding, which soon tells paths apart; so over 100 seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "core/anatomy/limb_model.h"
#include "core/collision/scene_collision.h"
#include "core/editing/correct.h"
#include "core/editing/plan_window.h"
#include "core/io/gltf_reader.h"
#include "tests/property/rigs/changed_rigs.h"
#include "tests/support/folder.h"
#include "tests/support/post_in_the_way.h"
#include "tests/support/samples.h"

namespace elbowroom::test {
namespace {

constexpr int kSeeds = 100;
constexpr int kSpread = 5;  // of 100, between two runs of the same problem
constexpr double kCostShare = 0.05;

struct Statistics {
  int solved = 0, certified = 0;
  std::vector<double> costs;
  double median() const {
    if (costs.empty()) return 0;
    std::vector<double> sorted = costs;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2),
                     sorted.end());
    return sorted[sorted.size() / 2];
  }
};

struct Scene {
  std::shared_ptr<const Model> figure, post;
  std::shared_ptr<const Clip> clip;
  std::optional<SceneCollision> collision;
  int limb = -1;
};

Scene scene_of(const Model& figure, const Model& post, int clip, const std::string& limb) {
  Scene scene;
  scene.figure = std::make_shared<const Model>(figure);
  scene.post = std::make_shared<const Model>(post);
  scene.clip = std::make_shared<const Clip>(figure.clips[static_cast<std::size_t>(clip)]);
  const Character& character = scene.figure->characters.front();
  const LimbFindings found = find_limbs(*scene.figure, character);
  std::vector<LimbModel> limbs;
  for (const Limb& each : found.limbs) {
    auto fitted = fit_limb_model(*scene.figure, character, each, found);
    if (!fitted) continue;
    if (each.name == limb) scene.limb = static_cast<int>(limbs.size());
    limbs.push_back(std::move(*fitted));
  }
  World world;
  world.actors.push_back({"figure", scene.figure, scene.clip, {}, Mat4(1.0)});
  world.actors.push_back({"post", scene.post, nullptr, {}, Mat4(1.0)});
  CollisionSettings settings;
  settings.height = body_height(*scene.figure, character, found);
  auto built = SceneCollision::build(std::move(world), 0, 0, std::move(limbs), scene.clip->begin,
                                     scene.clip->end, settings);
  if (built) scene.collision.emplace(std::move(*built));
  return scene;
}

Statistics plan_often(Scene& scene, const Interval& window) {
  Statistics statistics;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    PlanningWishes wishes;
    wishes.seed = static_cast<std::uint64_t>(seed);
    const WindowPlan plan = plan_window(*scene.collision, scene.clip, scene.limb, window.lower,
                                        window.upper, wishes, {}, {}, Effort::brief);
    if (!plan.correction) continue;
    ++statistics.solved;
    statistics.certified += plan.report.certified;
    statistics.costs.push_back(plan.report.cost);
  }
  return statistics;
}

class PlannerStatistics : public testing::TestWithParam<const char*> {};

TEST_P(PlannerStatistics, DontDependOnSizeOrPlacement) {
  if (samples_dir().empty()) GTEST_SKIP() << samples_missing();
  const std::filesystem::path file = samples_dir() / "humanoids" / GetParam();
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  ReadOptions options;
  options.images = false;
  const auto figure = read_gltf(file, options);
  ASSERT_TRUE(figure.ok());
  const Character& character = (*figure)->characters.front();
  std::optional<PostProblem> problem;
  std::string limb;
  for (const Limb& each : find_limbs(**figure, character).limbs) {
    if (!each.is_arm()) continue;
    problem = post_in_the_way(**figure, character, each, -1);
    limb = each.name;
    if (problem) break;
  }
  ASSERT_TRUE(problem) << "no post can be put in the way of an arm";
  const Folder folder;
  ASSERT_TRUE(write_post(*problem, folder / "post.glb"));
  const auto post = read_gltf(folder / "post.glb");
  ASSERT_TRUE(post.ok());

  Scene plain = scene_of(**figure, **post, problem->clip, limb);
  ASSERT_TRUE(plain.collision);
  std::vector<ContactInterval> contacts;
  look_at_contacts(*plain.collision, {plain.limb}, contacts, nullptr);
  const double clearance = plain.collision->settings().clearance * plain.collision->height();
  const auto windows = propose_windows(*plain.collision, plain.limb, contacts, clearance);
  ASSERT_FALSE(windows.empty());
  ASSERT_TRUE(windows.front().blocked.empty());
  const Interval window{windows.front().begin, windows.front().end};
  const Statistics here = plan_often(plain, window);
  const auto print = [&](const char* guise, const Statistics& s) {
    std::printf("  %-28s %-24s solved %3d  certified %3d  median cost %.5f\n", GetParam(), guise,
                s.solved, s.certified, s.median());
    std::fflush(stdout);
  };
  print("as it is", here);
  EXPECT_GE(here.solved, 90);

  struct Guise {
    const char* name;
    Model figure, post;
  };
  std::vector<Guise> guises;
  for (const double factor : {0.01, 100.0})
    guises.push_back(
        {factor < 1 ? "x0.01" : "x100", scaled(**figure, factor), scaled(**post, factor)});
  const auto place = [&](const char* name, const Transform& placement) {
    guises.push_back({name, placed(**figure, placement), placed(**post, placement)});
  };
  Transform placement;
  placement.rotation = glm::angleAxis(0.6, Vec3(0, 1, 0));
  placement.translation = Vec3(3, -2, 5) * character.height;
  place("turned about up, shifted", placement);
  placement.rotation = glm::angleAxis(2.2, glm::normalize(Vec3(1, 2, -0.5)));
  place("turned over, shifted", placement);
  placement = {};
  placement.scale = Vec3(-1, 1, 1);
  place("mirrored", placement);
  for (const Guise& guise : guises) {
    SCOPED_TRACE(guise.name);
    Scene scene = scene_of(guise.figure, guise.post, problem->clip, limb);
    ASSERT_TRUE(scene.collision);
    ASSERT_GE(scene.limb, 0);
    const Statistics there = plan_often(scene, window);
    print(guise.name, there);
    EXPECT_LE(std::abs(there.solved - here.solved), kSpread);
    EXPECT_LE(std::abs(there.certified - here.certified), kSpread);
    EXPECT_NEAR(there.median(), here.median(), kCostShare * here.median());
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, PlannerStatistics,
                         testing::Values("khronos/RiggedFigure.glb", "khronos/CesiumMan.glb",
                                         "quaternius/RobotExpressive.glb"),
                         [](const auto& info) {
                           return std::filesystem::path(info.param).stem().string();
                         });

}  // namespace
}  // namespace elbowroom::test
