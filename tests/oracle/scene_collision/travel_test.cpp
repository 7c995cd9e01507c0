// SPDX-License-Identifier: MIT
// Travel bounds of real characters in their own clips, against their skin at random times; the skin
// is deform()'s, which poses and blends every vertex anew.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/io/gltf_reader.h"
#include "tests/support/figure_travel.h"
#include "tests/support/samples.h"

namespace elbowroom::test {
namespace {

class SampleTravel : public ::testing::TestWithParam<const char*> {};

TEST_P(SampleTravel, IsBounded) {
  if (samples_dir().empty()) GTEST_SKIP() << samples_missing();
  auto read = read_gltf(samples_dir() / GetParam());
  ASSERT_TRUE(read.ok()) << read.error().message();
  const auto model = *read;
  const Character& character = model->characters.at(0);
  const LimbFindings findings = find_limbs(*model, character);
  std::vector<LimbModel> limbs;
  for (const Limb& limb : findings.limbs)
    if (auto fitted = fit_limb_model(*model, character, limb, findings)) limbs.push_back(*fitted);
  ASSERT_FALSE(limbs.empty());
  Random random(23);
  Tightness world_frame, own_frame;
  for (std::size_t c = 0; c < std::min<std::size_t>(3, model->clips.size()); ++c) {
    const Clip& clip = model->clips[c];
    if (!(clip.end > clip.begin)) continue;
    World world;
    world.actors.resize(1);
    world.actors[0].model = model;
    world.actors[0].clip = {model, &clip};
    auto scene = SceneCollision::build(world, 0, 0, limbs, clip.begin, clip.begin, {});
    ASSERT_TRUE(scene.ok()) << scene.error().message();
    expect_travel_is_bounded(*scene, {}, clip.begin, clip.end, 6, random, world_frame);
    const int parent =
        model->skeleton.joints[static_cast<std::size_t>(limbs.front().limb.root)].parent;
    expect_travel_is_bounded(*scene, {0, parent}, clip.begin, clip.end, 4, random, own_frame);
  }
  std::printf(
      "  travel / bound of bodies: median %.3f in the world, %.3f in the frame above a limb; "
      "of the farthest triangle %.3f, %.3f\n",
      world_frame.median(), own_frame.median(), world_frame.median_of_most(),
      own_frame.median_of_most());
  EXPECT_GT(world_frame.median(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    Samples, SampleTravel,
    ::testing::Values("humanoids/khronos/CesiumMan.glb", "humanoids/khronos/RiggedFigure.glb",
                      "humanoids/kaykit/Knight.glb", "humanoids/quaternius/RobotExpressive.glb",
                      "humanoids/godot/platformer_player.glb"),
    [](const auto& info) { return std::filesystem::path(info.param).stem().string(); });

}  // namespace
}  // namespace elbowroom::test
