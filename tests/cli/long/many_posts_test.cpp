// SPDX-License-Identifier: MIT
// The main job on every animated figure there is: posts in the way of arms and legs, in several
// places of every figure's clips. Whatever the program delivers must hold before the judge; what it
// declines is counted.
#include <map>

#include "tests/support/cli_scene.h"

namespace elbowroom::test {
namespace {

const std::string kProgram = ELBOWROOM_PROGRAM;
const std::filesystem::path kDemo = ELBOWROOM_DEMO_DIR;

struct Tally {
  int tried = 0, delivered = 0, declined = 0;
  int corrections = 0, certified = 0;
  double verify_ms = 0, certify_ms = 0;
};

void tell(const std::string& name, const Tally& tally) {
  std::printf(
      "  %-28s tried %3d  delivered %3d  declined %3d  corrections %3d, certified %3d; "
      "verify %.0f ms, certify %.0f ms\n",
      name.c_str(), tally.tried, tally.delivered, tally.declined, tally.corrections,
      tally.certified, tally.verify_ms, tally.certify_ms);
  std::fflush(stdout);
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
    return;
  }
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = read_json(report_file);
  if (report["status"] == "nothing_to_correct") return;  // vertices met the post, surfaces did not
  ++tally.delivered;
  Delivered delivered;
  delivered.source = file;
  delivered.output = out;
  delivered.source_animation = std::to_string(post.clip);
  delivered.animation = std::to_string(model.clips.size());
  delivered.obstacles = {folder / "post.glb"};
  for (const auto& correction : report["corrections"]) {
    Delivered::Window window;
    window.begin = correction["window"][0];
    window.end = correction["window"][1];
    for (const int joint : limb.joints)
      window.limb_joints.push_back(model.skeleton.joints[static_cast<std::size_t>(joint)].name);
    window.limb_root = window.limb_joints.front();
    delivered.windows.push_back(window);
    ++tally.corrections;
    tally.verify_ms += correction["verify_ms"].get<double>();
    tally.certify_ms += correction["certify_ms"].get<double>();
    if (correction["certified"].get<bool>()) ++tally.certified;
    const std::string why = correction.value("not_certified", std::string());
    EXPECT_NE(correction["certified"].get<bool>(), !why.empty());
    if (!why.empty()) std::printf("  not certified: %s\n", why.c_str());
  }
  expect_delivered(delivered);
}

TEST(ManyPosts, NothingDeliveredCollides) {
  const auto samples = samples_dir();
  std::vector<std::filesystem::path> files = {kDemo / "mannequin.glb"};
  if (!samples.empty())
    for (const auto& entry : std::filesystem::recursive_directory_iterator(samples / "humanoids")) {
      const auto extension = entry.path().extension();
      if (extension == ".glb" || extension == ".gltf" || extension == ".vrm")
        files.push_back(entry.path());
    }
  std::sort(files.begin(), files.end());
  const Folder folder;
  Tally whole;
  for (const auto& file : files) {
    const auto model = read_gltf(file);
    if (!model.ok() || (*model)->characters.empty() || (*model)->clips.empty()) continue;
    const Character& figure = (*model)->characters.front();
    if (figure.triangles == 0) continue;
    const auto findings = find_limbs(**model, figure);
    Tally tally;
    for (const Limb& limb : findings.limbs)
      for (int clip = 0, used = 0;
           clip < static_cast<int>((*model)->clips.size()) && used < (limb.is_arm() ? 4 : 1);
           ++clip) {
        const auto post = post_in_the_way(**model, figure, limb, clip, static_cast<unsigned>(used));
        if (!post) continue;
        ++used;
        SCOPED_TRACE(file.filename().string() + " " + limb.name + " clip " + std::to_string(clip));
        try_post(file, **model, limb, *post, folder, tally);
      }
    tell(file.filename().string(), tally);
    whole.tried += tally.tried;
    whole.delivered += tally.delivered;
    whole.declined += tally.declined;
    whole.corrections += tally.corrections;
    whole.certified += tally.certified;
    whole.verify_ms += tally.verify_ms;
    whole.certify_ms += tally.certify_ms;
  }
  tell("all", whole);
  EXPECT_GT(whole.delivered, 0);
  EXPECT_GT(whole.certified, 0);
}

}  // namespace
}  // namespace elbowroom::test
