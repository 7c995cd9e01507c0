// SPDX-License-Identifier: MIT
// Several ways around, and what would do where there is none.
#include "assets/demo.h"
#include "core/animation/skeleton.h"
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"
#include "tests/support/simple_glb.h"

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
  const auto found = read_json(report_file)["corrections"][0];
  EXPECT_GT(found["planned_clearance"].get<double>(), 0);
  EXPECT_GE(found["scene_clearance"].get<double>(), found["min_clearance"].get<double>());
  // It is the window that would have been chosen.
  auto chosen = demo_call(out, report_file);
  chosen.insert(chosen.end(), {"--limb", "right_arm"});
  EXPECT_EQ(run_program(kProgram, chosen).exit_code, 0);
  const auto window = read_json(report_file)["corrections"][0]["window"];
  EXPECT_NEAR(begin, window[0].get<double>(), 1e-6);
  EXPECT_NEAR(end, window[1].get<double>(), 1e-6);
}

// Advice that can be followed: where no window has a free end, none is asked for.
TEST(Suggestions, WhereTheLimbTouchesAllTheTimeNoOtherWindowIsAskedFor) {
  const Folder folder;
  const auto slab = folder / "slab.glb", report_file = folder / "report.json";
  ASSERT_TRUE(write_simple_glb(slab, "slab", box({-3, 0.9f, -3}, {3, 0.95f, 3})));
  for (const std::vector<std::string>& window :
       {std::vector<std::string>{}, std::vector<std::string>{"--window", "0.4:0.6"}}) {
    std::vector<std::string> call = {"correct",  "--character", kMannequin,         "--clip",
                                     "0",        "--limb",      "right_arm",        "--obstacles",
                                     slab,       "-o",          folder / "out.glb", "--report",
                                     report_file};
    call.insert(call.end(), window.begin(), window.end());
    const ProgramRun failed = run_program(kProgram, call);
    EXPECT_EQ(failed.exit_code, 3) << failed.err;
    const auto correction = read_json(report_file)["corrections"][0];
    const std::string reason = correction["reason"];
    EXPECT_NE(reason.find("from where the clip begins to where it ends"), std::string::npos)
        << reason;
    EXPECT_EQ(reason.find("choose a window"), std::string::npos) << reason;
    EXPECT_NE(correction["blocked_by"].dump().find("slab"), std::string::npos);
  }
}

TEST(Alternatives, FewerThanAskedForIsSaid) {
  const Folder folder;
  const auto report_file = folder / "report.json";
  auto arguments = demo_call(folder / "out.glb", report_file);
  arguments.insert(arguments.end(), {"--limb", "right_arm", "--alternatives", "9"});
  const ProgramRun run = run_program(kProgram, arguments);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = read_json(report_file);
  const std::size_t found =
      1 + report["corrections"][0].value("alternatives", nlohmann::json::array()).size();
  const std::string said = std::to_string(found) + " of 9 ways";
  EXPECT_EQ(report["warnings"].dump().find(said) != std::string::npos, found < 9)
      << report["warnings"];
  EXPECT_EQ(run.err.find(said) != std::string::npos, found < 9) << run.err;
}

}  // namespace
}  // namespace elbowroom::test
