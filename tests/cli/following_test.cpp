// SPDX-License-Identifier: MIT
// Feet that hang from the rig's root, end to end: a post in the way of a running leg.
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"

namespace elbowroom::test {
namespace {

class DetachedFeet : public testing::TestWithParam<LimbKind> {};

TEST_P(DetachedFeet, StayOnTheirShins) {
  const auto samples = samples_dir();
  if (samples.empty()) GTEST_SKIP() << samples_missing();
  const auto file = samples / "humanoids/quaternius/RobotExpressive.glb";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const Folder folder;
  EXPECT_TRUE(correct_a_post(kProgram, file, {GetParam()}, folder));

  const ProgramRun run = run_program(kProgram, {"info", file, "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto info = nlohmann::json::parse(run.out);
  const std::string side = GetParam() == LimbKind::left_leg ? "L" : "R";
  const auto& leg = info["characters"][0]["limbs"][limb_id(GetParam())];
  EXPECT_EQ(leg["joints"], nlohmann::json({"UpperLeg." + side, "LowerLeg." + side, "Foot." + side,
                                           "LowerLeg." + side + "_end"}));
  for (const std::string warning : info["warnings"])
    EXPECT_EQ(warning.find("follow"), std::string::npos) << warning;
}

INSTANTIATE_TEST_SUITE_P(RobotExpressive, DetachedFeet,
                         testing::Values(LimbKind::left_leg, LimbKind::right_leg),
                         [](const auto& info) { return std::string(limb_id(info.param)); });

}  // namespace
}  // namespace elbowroom::test
