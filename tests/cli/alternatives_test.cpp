// SPDX-License-Identifier: MIT
// Several ways around, and what would do where there is none.
#include "assets/demo.h"
#include "core/animation/skeleton.h"
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"

namespace elbowroom::test {
namespace {

constexpr double kClearlyOther = 3 * kPi / 180;  // radians, of some joint at some time

std::vector<std::string> demo_call(const std::filesystem::path& out,
                                   const std::filesystem::path& report) {
  return {"correct",
          "--character",
          kDemo / "mannequin.glb",
          "--clip",
          demo::kDemoClip,
          "--obstacles",
          kDemo / "posts.glb",
          "--attach",
          (kDemo / demo::kAttachArgument).string(),
          "-o",
          out,
          "--report",
          report};
}

judge::Attached umbrella() {
  return {kDemo / demo::kUmbrellaFile,
          demo::kAttachJoint,
          {demo::kGripX, demo::kGripY, demo::kGripZ},
          {1, 0, 0, 0}};
}

void judge_file(const std::filesystem::path& file, const nlohmann::json& correction,
                const Model& model, int clip) {
  const Character& figure = model.characters.at(0);
  Delivered delivered;
  delivered.source = kDemo / "mannequin.glb";
  delivered.output = file;
  delivered.source_animation = std::to_string(clip);
  delivered.animation = std::to_string(model.clips.size());
  delivered.obstacles = {kDemo / "posts.glb"};
  delivered.attachments = {umbrella()};
  delivered.random_times = 200;
  Delivered::Window window;
  window.begin = correction["window"][0];
  window.end = correction["window"][1];
  for (const Limb& limb : find_limbs(model, figure).limbs)
    if (limb.name == correction["limb"])
      for (const int joint : limb.joints)
        window.limb_joints.push_back(model.skeleton.joints[static_cast<std::size_t>(joint)].name);
  ASSERT_FALSE(window.limb_joints.empty());
  window.limb_root = window.limb_joints.front();
  delivered.windows.push_back(window);
  expect_delivered(delivered);
}

// The largest angle between the last animations of two files, of any joint.
double difference(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto left = read_gltf(a), right = read_gltf(b);
  if (!left.ok() || !right.ok()) return 0;
  const Clip &p = (*left)->clips.back(), &q = (*right)->clips.back();
  double most = 0;
  for (double t = p.begin; t < p.end; t += 1.0 / 60) {
    Pose one = rest_pose((*left)->skeleton), other = one;
    sample_clip(p, t, one);
    sample_clip(q, t, other);
    for (std::size_t j = 0; j < one.local.size(); ++j)
      most = std::max(most, angle_between(one.local[j].rotation, other.local[j].rotation));
  }
  return most;
}

TEST(Alternatives, AreOtherWaysAroundAndAllHold) {
  const Folder folder;
  const auto out = folder / "out.glb", report_file = folder / "report.json";
  auto arguments = demo_call(out, report_file);
  arguments.insert(arguments.end(), {"--alternatives", "2"});
  const ProgramRun run = run_program(kProgram, arguments);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = read_json(report_file);
  ASSERT_EQ(report["corrections"].size(), 1u);
  const auto& best = report["corrections"][0];
  const auto model = read_gltf(kDemo / "mannequin.glb");
  ASSERT_TRUE(model.ok());
  const int clip = (*model)->find_clip(demo::kDemoClip);
  judge_file(out, best, **model, clip);
  ASSERT_EQ(best["alternatives"].size(), 1u);
  const auto& other = best["alternatives"][0];
  EXPECT_GE(other["cost"].get<double>(), best["cost"].get<double>());
  const std::filesystem::path file = other["file"].get<std::string>();
  EXPECT_EQ(file, folder / "out-2.glb");
  judge_file(file, best, **model, clip);
  EXPECT_GT(difference(out, file), kClearlyOther);
}

TEST(Suggestions, AWiderWindowThatWorksIsNamed) {
  const Folder folder;
  const auto out = folder / "out.glb", report_file = folder / "report.json";
  auto arguments = demo_call(out, report_file);
  arguments.insert(arguments.end(), {"--limb", "right_arm", "--window", "1.7:1.8"});
  const ProgramRun run = run_program(kProgram, arguments);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_FALSE(std::filesystem::exists(out));
  const auto report = read_json(report_file);
  ASSERT_EQ(report["corrections"].size(), 1u);
  const auto& suggestions = report["corrections"][0]["suggestions"];
  ASSERT_FALSE(suggestions.empty());
  const auto& works = suggestions.back();
  EXPECT_EQ(works["what"], "wider_window");
  EXPECT_TRUE(works["works"].get<bool>());
  // And it does.
  const double begin = works["window"][0], end = works["window"][1];
  EXPECT_LT(begin, 1.7);
  EXPECT_GT(end, 1.8);
  auto again = demo_call(out, report_file);
  again.insert(again.end(), {"--limb", "right_arm", "--window",
                             std::to_string(begin) + ":" + std::to_string(end)});
  EXPECT_EQ(run_program(kProgram, again).exit_code, 0);
}

}  // namespace
}  // namespace elbowroom::test
