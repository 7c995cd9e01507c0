// SPDX-License-Identifier: MIT
// The main job, end to end: clips that collide come out of the program free, whole and in time.
#include "assets/demo.h"
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"

namespace elbowroom::test {
namespace {

TEST(Correct, TheDemo) {
  const Folder folder;
  CorrectCall call;
  call.program = kProgram;
  call.character = kDemo / "mannequin.glb";
  const auto model = read_gltf(call.character);
  ASSERT_TRUE(model.ok());
  call.clip = (*model)->find_clip(demo::kDemoClip);
  call.obstacles = {kDemo / "posts.glb"};
  call.attachments = {{kDemo / demo::kUmbrellaFile,
                       demo::kAttachJoint,
                       {demo::kGripX, demo::kGripY, demo::kGripZ},
                       {1, 0, 0, 0}}};
  correct_and_judge(call, folder);
}

struct Sample {
  const char* name;
  const char* file;
};

void PrintTo(const Sample& one, std::ostream* out) { *out << one.file; }

class CorrectSample : public testing::TestWithParam<Sample> {};

TEST_P(CorrectSample, APostInTheArmsWay) {
  const auto samples = samples_dir();
  if (samples.empty()) GTEST_SKIP() << samples_missing();
  const auto file = samples / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << GetParam().file;
  const Folder folder;
  EXPECT_TRUE(correct_a_post(kProgram, file, {LimbKind::left_arm, LimbKind::right_arm}, folder))
      << "no clip allows a post in the way of an arm";
}

INSTANTIATE_TEST_SUITE_P(
    Humanoids, CorrectSample,
    testing::Values(Sample{"CesiumMan", "humanoids/khronos/CesiumMan.glb"},
                    Sample{"RiggedFigure", "humanoids/khronos/RiggedFigure.glb"},
                    Sample{"Knight", "humanoids/kaykit/Knight.glb"},
                    Sample{"RobotExpressive", "humanoids/quaternius/RobotExpressive.glb"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace elbowroom::test
