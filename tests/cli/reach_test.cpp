// SPDX-License-Identifier: MIT
// A target on the command line: the delivered file has the wrist there at the time, and all that a
// correction promises besides, by the judge's own reading.
#include "assets/demo.h"
#include "core/anatomy/limb_model.h"
#include "core/io/gltf_reader.h"
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"

namespace elbowroom::test {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

TEST(Reach, TheDemosHandAtATime) {
  const Folder folder;
  const std::string character = kDemo / "mannequin.glb";
  const double time = 1.37;
  const auto source = judge::load(character);
  const auto& animation = source.animation(demo::kDemoClip);
  const int hand = source.node("LeftHand"), elbow = source.node("LeftLowerArm"),
            shoulder = source.node("LeftUpperArm");
  const auto before = judge::state_at(source, &animation, time);
  const auto place = [](const judge::State& state, int node) {
    return glm::dvec3(state.world[static_cast<std::size_t>(node)][3]);
  };
  const double length = glm::distance(place(before, shoulder), place(before, elbow)) +
                        glm::distance(place(before, elbow), place(before, hand));
  const glm::dvec3 target = place(before, hand) + glm::dvec3(0.06, 0.18, 0.1);
  const glm::dquat turned =
      glm::angleAxis(0.3, glm::dvec3(0, 1, 0)) *
      glm::normalize(glm::quat_cast(glm::dmat3(before.world[static_cast<std::size_t>(hand)])));

  const auto out = folder / "out.glb", report_file = folder / "report.json";
  const ProgramRun run =
      run_program(kProgram, {"reach", "--character", character, "--clip", demo::kDemoClip,
                             "--obstacles", kDemo / "posts.glb", "--limb", "left_arm", "--target",
                             number(target.x) + "," + number(target.y) + "," + number(target.z) +
                                 "," + number(turned.x) + "," + number(turned.y) + "," +
                                 number(turned.z) + "," + number(turned.w),
                             "--at", number(time), "-o", out, "--report", report_file});
  const auto report = read_json(report_file);
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err << report;
  ASSERT_EQ(report["corrections"].size(), 1u);

  const auto result = judge::load(out);
  const std::string name = std::to_string(source.animations.size());
  const auto after = judge::state_at(result, &result.animation(name), time);
  const double off = glm::distance(place(after, hand), target) / length;
  const double off_angle = judge::angle(
      glm::normalize(glm::quat_cast(glm::dmat3(after.world[static_cast<std::size_t>(hand)]))),
      turned);
  std::printf("  the wrist is off by %.2e of the arm's length, by %.2e rad\n", off, off_angle);
  EXPECT_LT(off, 1e-5);
  EXPECT_LT(off_angle, 1e-4);

  Delivered delivered;
  delivered.source = character;
  delivered.output = out;
  delivered.source_animation = demo::kDemoClip;
  delivered.animation = name;
  delivered.obstacles = {kDemo / "posts.glb"};
  delivered.random_times = 200;
  Delivered::Window window;
  window.begin = report["corrections"][0]["window"][0];
  window.end = report["corrections"][0]["window"][1];
  window.limb_root = "LeftUpperArm";
  window.limb_joints = {"LeftUpperArm", "LeftLowerArm", "LeftHand"};
  EXPECT_LT(window.begin, time);
  EXPECT_GT(window.end, time);
  delivered.windows = {window};
  EXPECT_GT(expect_delivered(delivered), 300);
}

// The palm in the wrist's own axes; where it is in the file is the judge's to say.
GraspFrame palm_of(const std::string& file, LimbKind kind) {
  const auto model = read_gltf(file);
  if (!model) return {};
  const Character& character = (*model)->characters.front();
  const LimbFindings findings = find_limbs(**model, character);
  for (const Limb& limb : findings.limbs) {
    if (limb.kind != kind) continue;
    const auto fitted = fit_limb_model(**model, character, limb, findings);
    if (fitted && fitted->grasp) return *fitted->grasp;
  }
  ADD_FAILURE() << "no palm";
  return {};
}

TEST(Reach, ThePalmOfAGraspAndWithoutAnOrientationTheClips) {
  const Folder folder;
  const std::string character = kDemo / "mannequin.glb";
  const double time = 0.5;
  const auto source = judge::load(character);
  const auto& animation = source.animation(demo::kWalkClip);
  const auto hand = static_cast<std::size_t>(source.node("LeftHand"));
  const auto before = judge::state_at(source, &animation, time);
  const auto place = [](const judge::State& state, std::size_t node) {
    return glm::dvec3(state.world[node][3]);
  };
  const auto elbow = static_cast<std::size_t>(source.node("LeftLowerArm"));
  const auto shoulder = static_cast<std::size_t>(source.node("LeftUpperArm"));
  const double length = glm::distance(place(before, shoulder), place(before, elbow)) +
                        glm::distance(place(before, elbow), place(before, hand));
  const GraspFrame palm = palm_of(character, LimbKind::left_arm);
  const auto palm_point = [&](const judge::State& state) {
    return glm::dvec3(state.world[hand] * glm::dvec4(palm.origin, 1));
  };
  const auto palm_axes = [&](const judge::State& state) {
    const glm::dmat3 world(state.world[hand]);
    const glm::dvec3 x = glm::normalize(world * palm.x), y = glm::normalize(world * palm.y);
    const glm::dvec3 z = glm::normalize(glm::cross(x, y));
    return glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)));
  };
  // The palm is a hand's breadth from the wrist at most, and not at it.
  const double off_wrist = glm::distance(palm_point(before), place(before, hand)) / length;
  EXPECT_GT(off_wrist, 0.03);
  EXPECT_LT(off_wrist, 0.3);

  const glm::dvec3 target = palm_point(before) + glm::dvec3(0.04, 0.1, 0.06);
  const glm::dquat turned = glm::angleAxis(0.2, glm::dvec3(0, 1, 0)) * palm_axes(before);
  for (const bool oriented : {true, false}) {
    const auto out = folder / "out.glb", report_file = folder / "report.json";
    std::string text = number(target.x) + "," + number(target.y) + "," + number(target.z);
    if (oriented)
      text += "," + number(turned.x) + "," + number(turned.y) + "," + number(turned.z) + "," +
              number(turned.w);
    const ProgramRun run =
        run_program(kProgram, {"reach", "--character", character, "--clip", demo::kWalkClip,
                               "--limb", "left_arm", "--target", text, "--grasp", "--at",
                               number(time), "-o", out, "--report", report_file});
    ASSERT_EQ(run.exit_code, 0) << run.out << run.err << read_json(report_file)["corrections"];
    const auto result = judge::load(out);
    const auto after =
        judge::state_at(result, &result.animation(std::to_string(source.animations.size())), time);
    const double off = glm::distance(palm_point(after), target) / length;
    const double off_angle = judge::angle(palm_axes(after), oriented ? turned : palm_axes(before));
    std::printf("  the palm is off by %.2e of the arm's length, by %.2e rad\n", off, off_angle);
    EXPECT_LT(off, 1e-5);
    EXPECT_LT(off_angle, 1e-4);
  }
}

TEST(Reach, WhatCannotBeReachedWritesAReportAlone) {
  const Folder folder;
  const auto out = folder / "out.glb", report_file = folder / "report.json";
  const ProgramRun run =
      run_program(kProgram, {"reach", "--character", kDemo / "mannequin.glb", "--clip",
                             demo::kWalkClip, "--limb", "left_arm", "--target", "0,9,0", "--at",
                             "0.5", "-o", out, "--report", report_file});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_FALSE(std::filesystem::exists(out));
  const auto report = read_json(report_file);
  EXPECT_EQ(report["status"], "failed");
  EXPECT_NE(report["corrections"][0]["reason"].get<std::string>().find("out of reach"),
            std::string::npos);
}

TEST(Reach, WrongUsageIsOne) {
  const std::string character = kDemo / "mannequin.glb";
  const auto code = [&](const std::string& limb, const std::string& target, const std::string& at) {
    return run_program(kProgram, {"reach", "--character", character, "--limb", limb, "--target",
                                  target, "--at", at, "-o", "/nowhere/out.glb"})
        .exit_code;
  };
  EXPECT_EQ(code("left_arm", "1,2", "0.5"), 1);
  EXPECT_EQ(code("left_arm", "1,2,nan", "0.5"), 1);
  EXPECT_EQ(code("left_arm", "1,2,3,0,0,0,0", "0.5"), 1);
  EXPECT_EQ(code("left_arm", "1,2,3", "soon"), 1);
  EXPECT_EQ(code("auto", "1,2,3", "0.5"), 1);
  EXPECT_EQ(code("third_arm", "1,2,3", "0.5"), 2);
  EXPECT_EQ(code("left_arm", "1,2,3", "99"), 2);
}

}  // namespace
}  // namespace elbowroom::test
