// SPDX-License-Identifier: MIT
// Pieces that tests of the program share: a folder of their own, JSON files, correct-and-judge.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/anatomy/limb.h"
#include "core/io/gltf_reader.h"
#include "tests/support/folder.h"
#include "tests/support/judge_correction.h"
#include "tests/support/post_in_the_way.h"
#include "tests/support/run_program.h"
#include "tests/support/samples.h"

namespace elbowroom::test {

inline nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in, nullptr, false);
}

// Runs `correct`, requires that it succeeds, and holds what it delivered against the judge.
struct CorrectCall {
  std::string program;
  std::filesystem::path character;
  int clip = 0;
  std::vector<std::filesystem::path> obstacles;
  std::vector<judge::Attached> attachments;
  std::string limb = "auto";
  int random_times = 1000;
};

inline void correct_and_judge(const CorrectCall& call, const Folder& folder) {
  const auto out = folder / ("out" + call.character.extension().string());
  const auto report_file = folder / "report.json";
  std::vector<std::string> arguments = {
      "correct",  "--character", call.character, "--clip", std::to_string(call.clip),
      "--limb",   call.limb,     "-o",           out,      "--report",
      report_file};
  for (const auto& file : call.obstacles) {
    arguments.push_back("--obstacles");
    arguments.push_back(file);
  }
  for (const auto& attached : call.attachments) {
    arguments.push_back("--attach");
    arguments.push_back(
        attached.file.string() + "@" + attached.joint + "," + std::to_string(attached.offset.x) +
        "," + std::to_string(attached.offset.y) + "," + std::to_string(attached.offset.z));
  }
  const ProgramRun run = run_program(call.program, arguments);
  const auto report = read_json(report_file);
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err
                              << report.value("corrections", nlohmann::json());
  ASSERT_FALSE(report.is_discarded());
  EXPECT_EQ(report["status"], "corrected");
  EXPECT_FALSE(report["collisions_before"].empty());
  EXPECT_TRUE(report["collisions_after"].empty()) << report["collisions_after"];
  ASSERT_FALSE(report["corrections"].empty());

  const auto model = read_gltf(call.character);
  ASSERT_TRUE(model.ok());
  const auto findings = find_limbs(**model, (*model)->characters.at(0));
  Delivered delivered;
  delivered.source = call.character;
  delivered.output = out;
  delivered.source_animation = std::to_string(call.clip);
  delivered.animation = std::to_string((*model)->clips.size());
  delivered.obstacles = call.obstacles;
  delivered.attachments = call.attachments;
  delivered.random_times = call.random_times;
  for (const auto& correction : report["corrections"]) {
    Delivered::Window window;
    for (const Limb& limb : findings.limbs)
      if (limb.name == correction["limb"])
        window = window_of(**model, (*model)->characters.at(0), limb);
    window.begin = correction["window"][0];
    window.end = correction["window"][1];
    ASSERT_FALSE(window.limb_joints.empty());
    delivered.windows.push_back(window);
    std::printf(
        "  %s %s [%.3f, %.3f] clearance %.4g deviation %.3f rad peak %.2f rad/s "
        "plan %.1f smooth %.1f verify %.1f certify %.1f total %.1f ms, %d attempts, %s%s\n",
        call.character.filename().c_str(), correction["limb"].get<std::string>().c_str(),
        window.begin, window.end, correction["min_clearance"].get<double>(),
        correction["deviation_from_clip"].get<double>(), correction["peak_speed"].get<double>(),
        correction["plan_ms"].get<double>(), correction["smooth_ms"].get<double>(),
        correction["verify_ms"].get<double>(), correction["certify_ms"].get<double>(),
        correction["total_ms"].get<double>(), static_cast<int>(correction["attempts"].size()),
        correction["certified"].get<bool>() ? "certified" : "NOT CERTIFIED: ",
        correction.value("not_certified", std::string()).c_str());
    // A motion that is not proven has to say what stood in the way of a proof.
    EXPECT_NE(correction["certified"].get<bool>(), correction.contains("not_certified"));
  }
  const int samples = expect_delivered(delivered);
  std::printf("  judged at %d times\n", samples);
}

// Writes a post in the way of the character's arm and corrects it. False if no clip of the file
// allows such a post.
inline bool correct_a_post(const std::string& program, const std::filesystem::path& character,
                           const std::vector<LimbKind>& kinds, const Folder& folder,
                           unsigned variant = 0, int random_times = 1000) {
  const auto model = read_gltf(character);
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().message());
  if (!model.ok()) return false;
  const Character& figure = (*model)->characters.at(0);
  const auto findings = find_limbs(**model, figure);
  for (const Limb& limb : findings.limbs) {
    if (std::find(kinds.begin(), kinds.end(), limb.kind) == kinds.end()) continue;
    const auto post = post_in_the_way(**model, figure, limb, -1, variant);
    if (!post) continue;
    std::printf("  %s: clip %d \"%s\", post at (%.3f, %.3f), hit %.3f - %.3f s, depth %.3g\n",
                character.filename().c_str(), post->clip,
                (*model)->clips[static_cast<std::size_t>(post->clip)].name.c_str(), post->x,
                post->z, post->hit_begin, post->hit_end, post->depth);
    EXPECT_TRUE(write_post(*post, folder / "post.glb"));
    CorrectCall call;
    call.program = program;
    call.character = character;
    call.clip = post->clip;
    call.obstacles = {folder / "post.glb"};
    call.limb = limb.name;
    call.random_times = random_times;
    correct_and_judge(call, folder);
    return true;
  }
  return false;
}

}  // namespace elbowroom::test
