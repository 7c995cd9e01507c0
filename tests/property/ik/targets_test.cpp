// SPDX-License-Identifier: MIT
// [SKF07 5] on real characters, arms and legs: targets that postures within limits reach are
// reached, limits and obstacles kept, and what is not solved no scan of the swivel solves.
#include <gtest/gtest.h>

#include "tests/property/ik/targets.h"
#include "tests/support/samples.h"

namespace elbowroom {
namespace {

constexpr int kTargets = 250;  // for each limb; the long tier has 100,000 for each rig

void expect_good(const test::TargetCounts& counts, const std::string& name) {
  std::printf("%-40s %s\n", name.c_str(), test::summary(counts).c_str());
  std::fflush(stdout);
  EXPECT_EQ(counts.problems(), 0) << name << ", " << counts.first_problem;
}

class IkOnSample : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(IkOnSample, ReachesWhatCanBeReached) {
  const auto rig = test::read_rig(GetParam());
  if (rig.limbs.empty()) GTEST_SKIP() << "no limbs are found";
  expect_good(test::try_targets(rig, kTargets, 1), GetParam().filename().string());
}

INSTANTIATE_TEST_SUITE_P(Humanoids, IkOnSample, testing::ValuesIn(test::sample_humanoids()),
                         [](const auto& info) { return test::file_test_name(info); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(IkOnSample);

TEST(IkOnSamples, AreManyRigs) {
  if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
  EXPECT_GE(test::sample_humanoids().size(), 14u);
}

TEST(IkOnSamples, IsTheSameMirroredScaledAndTurned) {
  if (test::samples_dir().empty()) GTEST_SKIP() << test::samples_missing();
  auto rig = test::read_rig(test::samples_dir() / "humanoids/kaykit/Knight.glb");
  ASSERT_FALSE(rig.limbs.empty());
  Mat4 mirrored(1.0), scaled(100.0),
      turned = glm::mat4_cast(glm::angleAxis(2.1, glm::normalize(Vec3(1, 2, -0.5))));
  mirrored[0][0] = -1;
  scaled[3] = glm::dvec4(1000, -50, 3, 1);
  for (const Mat4& placed : {mirrored, scaled, turned, turned * mirrored * scaled}) {
    rig.world_from_file = placed;
    expect_good(test::try_targets(rig, kTargets, 2), "Knight.glb, placed anew");
  }
}

}  // namespace
}  // namespace elbowroom
