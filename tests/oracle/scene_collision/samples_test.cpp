// SPDX-License-Identifier: MIT
// Real characters with a post in an arm's way: what the scene says of every instant against a judge
// that reads, samples and skins by itself and lets FCL and CGAL decide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/collision/scene_collision.h"
#include "core/io/gltf_reader.h"
#include "tests/judge/judge.h"
#include "tests/support/post_in_the_way.h"
#include "tests/support/samples.h"

namespace elbowroom::test {
namespace {

class SampleFigures : public ::testing::TestWithParam<const char*> {};

TEST_P(SampleFigures, ContactsWithAPostAreTheJudges) {
  if (samples_dir().empty()) GTEST_SKIP() << samples_missing();
  const auto file = samples_dir() / GetParam();
  auto read = read_gltf(file);
  ASSERT_TRUE(read.ok()) << read.error().message();
  const auto model = *read;
  ASSERT_FALSE(model->characters.empty());
  std::size_t c = 0;
  for (std::size_t i = 1; i < model->characters.size(); ++i)
    if (model->characters[i].triangles > model->characters[c].triangles) c = i;
  const Character& character = model->characters[c];
  const LimbFindings findings = find_limbs(*model, character);

  int looked_at = 0;
  for (const Limb& limb : findings.limbs) {
    if (!limb.is_arm()) continue;
    const auto problem = post_in_the_way(*model, character, limb, -1);
    if (!problem) continue;
    auto fitted = fit_limb_model(*model, character, limb, findings);
    ASSERT_TRUE(fitted.ok()) << fitted.error().message();
    const auto post_file = std::filesystem::path(::testing::TempDir()) /
                           (file.stem().string() + "_" + limb.name + "_post.glb");
    ASSERT_TRUE(write_post(*problem, post_file));
    auto post = read_gltf(post_file);
    ASSERT_TRUE(post.ok()) << post.error().message();

    const Clip& clip = model->clips[static_cast<std::size_t>(problem->clip)];
    World world;
    world.actors.resize(2);
    world.actors[0].name = "figure.glb";
    world.actors[0].model = model;
    world.actors[0].clip = {model, &clip};
    world.actors[1].name = "post.glb";
    world.actors[1].model = *post;
    auto scene =
        SceneCollision::build(world, 0, static_cast<int>(c), {*fitted}, clip.begin, clip.end, {});
    ASSERT_TRUE(scene.ok()) << scene.error().message();

    judge::CollisionQuery query;
    query.character = file;
    query.animation = std::to_string(problem->clip);
    query.limb_roots = {model->skeleton.joints[static_cast<std::size_t>(limb.root)].name};
    query.obstacles = {post_file};
    query.check_body = false;
    query.max_hits = 100000;
    const double from = std::max(clip.begin, problem->hit_begin - 0.3);
    const double to = std::min(clip.end, problem->hit_end + 0.3);
    const int samples = std::clamp(static_cast<int>((to - from) * 240), 10, 300);
    for (int i = 0; i <= samples; ++i) query.times.push_back(from + (to - from) * i / samples);
    const judge::CollisionReport report = judge::count_intersecting_samples(query);
    EXPECT_EQ(report.fcl_disagreements, 0);
    std::set<double> judged;
    for (const judge::Hit& hit : report.hits) judged.insert(hit.time);

    const auto intervals = scene->scan(clip.begin, clip.end, 120, 0, false);
    const auto on_post = [](const std::string& part) { return part.rfind("post.glb/", 0) == 0; };
    int hits = 0, free = 0;
    std::vector<ContactSample> contacts;
    for (const double t : query.times) {
      scene->contacts_at(t, 0, false, contacts);
      const bool now = std::any_of(contacts.begin(), contacts.end(),
                                   [&](const auto& contact) { return on_post(contact.part_b); });
      EXPECT_EQ(now, judged.contains(t)) << limb.name << " at " << t;
      const bool in_interval =
          std::any_of(intervals.begin(), intervals.end(), [&](const auto& interval) {
            return on_post(interval.deepest.part_b) && interval.begin <= t && t <= interval.end;
          });
      EXPECT_EQ(in_interval, judged.contains(t)) << limb.name << " at " << t;
      ++(now ? hits : free);
    }
    EXPECT_GT(hits, 0);
    EXPECT_GT(free, 0);
    std::printf("%s %s: %d samples in contact, %d free, as judged\n", GetParam(), limb.name.c_str(),
                hits, free);
    ++looked_at;
  }
  EXPECT_GT(looked_at, 0);
}

// What the source clip does with the character's own body is natural at any instant, sampled or
// not.
TEST_P(SampleFigures, TheClipItselfHasNoForbiddenSelfContact) {
  if (samples_dir().empty()) GTEST_SKIP() << samples_missing();
  auto read = read_gltf(samples_dir() / GetParam());
  ASSERT_TRUE(read.ok()) << read.error().message();
  const auto model = *read;
  const Character& character = model->characters[0];
  const LimbFindings findings = find_limbs(*model, character);
  std::vector<LimbModel> limbs;
  for (const Limb& limb : findings.limbs)
    if (auto fitted = fit_limb_model(*model, character, limb, findings)) limbs.push_back(*fitted);
  ASSERT_FALSE(limbs.empty());
  const Clip& clip = model->clips.front();
  World world;
  world.actors.resize(1);
  world.actors[0].model = model;
  world.actors[0].clip = {model, &clip};
  const double end = std::min(clip.end, clip.begin + 1.5);
  auto scene = SceneCollision::build(world, 0, 0, limbs, clip.begin, end, {});
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  const double touching = scene->settings().epsilon * scene->height();
  // A copy of the clip is no longer the source by identity: every contact has to be excused.
  scene->set_clip(std::make_shared<Clip>(clip));
  for (int i = 0; i <= 60; ++i) {
    const double t = clip.begin + (end - clip.begin) * (i + 0.37) / 61;
    for (int l = 0; l < static_cast<int>(limbs.size()); ++l) {
      std::vector<ContactSample> contacts;
      scene->contacts_at(t, l, false, contacts);
      EXPECT_TRUE(contacts.empty())
          << contacts[0].part_a << " with " << contacts[0].part_b << " at " << t;
      EXPECT_FALSE(scene->limb_in_contact(t, l, touching));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Samples, SampleFigures,
    ::testing::Values("humanoids/khronos/CesiumMan.glb", "humanoids/khronos/RiggedFigure.glb",
                      "humanoids/kaykit/Knight.glb", "humanoids/quaternius/RobotExpressive.glb"),
    [](const auto& info) { return std::filesystem::path(info.param).stem().string(); });

}  // namespace
}  // namespace elbowroom::test
