// SPDX-License-Identifier: MIT
// 100,000 targets for each sample rig, arms and legs, with obstacles and tight limits among them.
#include <gtest/gtest.h>

#include "tests/property/ik/targets.h"
#include "tests/support/samples.h"

namespace elbowroom {
namespace {

class ManyTargets : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ManyTargets, AreReachedIfAnythingReachesThem) {
  const auto rig = test::read_rig(GetParam());
  if (rig.limbs.empty()) GTEST_SKIP() << "no limbs are found";
  const int each = 100000 / static_cast<int>(rig.limbs.size());
  const auto counts = test::try_targets(rig, each, 11);
  std::printf("%-32s %s\n", GetParam().filename().c_str(), test::summary(counts).c_str());
  EXPECT_GE(counts.targets, 90000);
  EXPECT_EQ(counts.problems(), 0) << counts.first_problem;
}

INSTANTIATE_TEST_SUITE_P(Humanoids, ManyTargets, testing::ValuesIn(test::sample_humanoids()),
                         [](const auto& info) { return test::file_test_name(info); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ManyTargets);

}  // namespace
}  // namespace elbowroom
