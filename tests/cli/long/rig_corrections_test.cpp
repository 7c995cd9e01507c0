// SPDX-License-Identifier: MIT
// The main job on every sample character there is, one line a rig: what kind it is, the limbs
// expected and found, how well their models express its clips, and posts in the way of arms and
// legs in several places of its clips, corrected and held before the judge. What the program
// declines is counted.
#include <algorithm>
#include <cstdio>

#include "tests/cli/program.h"
#include "tests/property/rigs/rig_table.h"
#include "tests/support/cli_scene.h"

namespace elbowroom::test {
namespace {

constexpr int kPostsForArm = 4, kPostsForLeg = 1;

struct Tally {
  int tried = 0, delivered = 0, declined = 0, held = 0;
  int corrections = 0, certified = 0;
};

// Whether what was delivered held before the judge; failures are added where it does not.
bool holds(const Delivered& delivered) {
  const testing::TestResult& result =
      *testing::UnitTest::GetInstance()->current_test_info()->result();
  const int before = result.total_part_count();
  expect_delivered(delivered);
  return result.total_part_count() == before;
}

void try_post(const std::filesystem::path& file, const Model& model, const Limb& limb,
              const PostProblem& post, const Folder& folder, Tally& tally) {
  ASSERT_TRUE(write_post(post, folder / "post.glb"));
  ++tally.tried;
  const auto out = folder / "out.glb", report_file = folder / "report.json";
  std::filesystem::remove(out);
  const ProgramRun run =
      run_program(kProgram, {"correct", "--character", file, "--clip", std::to_string(post.clip),
                             "--limb", limb.name, "--obstacles", folder / "post.glb", "-o", out,
                             "--report", report_file});
  if (run.exit_code == 3) {
    ++tally.declined;
    EXPECT_FALSE(std::filesystem::exists(out));
    for (const auto& correction : read_json(report_file)["corrections"])
      std::printf("    declined: %s clip %d: %s\n", limb.name.c_str(), post.clip,
                  correction.value("reason", "").c_str());
    return;
  }
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = read_json(report_file);
  // Vertices met the post, surfaces did not.
  if (report["status"] == "nothing_to_correct") {
    --tally.tried;
    return;
  }
  ++tally.delivered;
  Delivered delivered;
  delivered.source = file;
  delivered.output = out;
  delivered.source_animation = std::to_string(post.clip);
  delivered.animation = std::to_string(model.clips.size());
  delivered.obstacles = {folder / "post.glb"};
  for (const auto& correction : report["corrections"]) {
    Delivered::Window window = window_of(model, model.characters.front(), limb);
    window.begin = correction["window"][0];
    window.end = correction["window"][1];
    delivered.windows.push_back(window);
    ++tally.corrections;
    if (correction["certified"].get<bool>()) ++tally.certified;
    const std::string why = correction.value("not_certified", std::string());
    EXPECT_NE(correction["certified"].get<bool>(), !why.empty());
    if (!why.empty()) std::printf("    not certified: %s\n", why.c_str());
  }
  tally.held += holds(delivered);
}

class RigCorrections : public testing::TestWithParam<RigRow> {};

TEST_P(RigCorrections, HoldBeforeTheJudge) {
  const RigRow& row = GetParam();
  const bool own = row.file == (kDemo / "mannequin.glb").string();
  if (!own && samples_dir().empty()) GTEST_SKIP() << samples_missing();
  const auto file = samples_dir() / "humanoids" / row.file;  // the demo's is absolute
  const auto model = read_row(row);
  ASSERT_NE(model, nullptr);
  const Character& figure = model->characters.front();
  const LimbFindings findings = find_limbs(*model, figure);
  const auto expected = std::count_if(row.limbs.begin(), row.limbs.end(),
                                      [](const LimbNames& names) { return !names.empty(); });
  EXPECT_EQ(findings.limbs.size(), static_cast<std::size_t>(expected));
  const Folder folder;
  Tally tally;
  double median = 0, high = 0;
  std::string axes;
  for (const Limb& limb : findings.limbs) {
    const auto fitted = fit_limb_model(*model, figure, limb, findings);
    ASSERT_TRUE(fitted) << fitted.error().message();
    const LimbFit fit = fit_of(*model, figure, *fitted);
    for (std::size_t j = 0; j < 3; ++j) {
      median = std::max(median, fit.median[j]);
      high = std::max(high, fit.high[j]);
    }
    char text[120];
    std::snprintf(text, sizeof text, "%s%s (%.2f %.2f %.2f) by %s", axes.empty() ? "" : "; ",
                  limb.name.c_str(), fit.flexion_axis.x, fit.flexion_axis.y, fit.flexion_axis.z,
                  fitted->flexion_axis_from.c_str());
    axes += text;
    if (figure.triangles == 0) continue;
    const int most = limb.is_arm() ? kPostsForArm : kPostsForLeg;
    for (int clip = 0, used = 0; clip < static_cast<int>(model->clips.size()) && used < most;
         ++clip) {
      const auto post = post_in_the_way(*model, figure, limb, clip, static_cast<unsigned>(used));
      if (!post) continue;
      ++used;
      SCOPED_TRACE(limb.name + " clip " + std::to_string(clip));
      try_post(file, *model, limb, *post, folder, tally);
    }
  }
  std::printf(
      "%-36s %-48s limbs %zu of %td  residual at most %.1f/%.1f°  posts %d: corrected %d, of these "
      "held before the judge %d; declined %d; %d of %d corrections certified\n    bends by %s\n",
      file.filename().c_str(), row.kind.c_str(), findings.limbs.size(),
      static_cast<std::ptrdiff_t>(expected), median, high, tally.tried, tally.delivered, tally.held,
      tally.declined, tally.certified, tally.corrections, axes.empty() ? "nothing" : axes.c_str());
  EXPECT_EQ(tally.held, tally.delivered);
}

std::vector<RigRow> rows() {
  using N = LimbNames;
  std::vector<RigRow> all = rig_table();
  all.insert(all.begin(), {(kDemo / "mannequin.glb").string(),
                           "the demo's",
                           {N{"LeftUpperArm"}, N{"RightUpperArm"}, N{"LeftLeg"}, N{"RightLeg"}}});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, RigCorrections, testing::ValuesIn(rows()),
                         [](const auto& info) { return test_name(info.param); });

}  // namespace
}  // namespace elbowroom::test
