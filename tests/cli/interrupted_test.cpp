// SPDX-License-Identifier: MIT
// SIGINT at any time: a run is interrupted and leaves nothing but its report, or it is done.
#include <map>

#include "assets/demo.h"
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"

namespace elbowroom::test {
namespace {

namespace fs = std::filesystem;

// Runs what writes out.glb and r.json into the folder, and requires one of the two outcomes.
// `signals`: how many, `apart_ms` from each other. True if it was interrupted.
bool interrupt(const Folder& folder, std::vector<std::string> arguments, int after_ms,
               int signals = 1, int apart_ms = 0) {
  for (const auto& entry : fs::directory_iterator(folder.path())) fs::remove_all(entry.path());
  arguments.insert(arguments.end(), {"-o", folder / "out.glb", "--report", folder / "r.json"});
  const ProgramRun run = run_program(kProgram, arguments, after_ms, signals, apart_ms);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    names.insert(entry.path().filename());
  const std::set<std::string> all = {"out.glb", "r.json"};
  if (run.exit_code == 0) {
    EXPECT_EQ(names, all) << after_ms;
    EXPECT_NE(read_json(folder / "r.json")["status"], "interrupted");
    return false;
  }
  EXPECT_EQ(run.exit_code, 130) << after_ms << " ms: " << run.out << run.err;
  names.erase("r.json");
  EXPECT_TRUE(names.empty()) << after_ms << " ms: " << testing::PrintToString(names);
  if (fs::exists(folder / "r.json")) {
    const auto report = read_json(folder / "r.json");
    EXPECT_EQ(report.value("status", std::string()), "interrupted");
    EXPECT_TRUE(report["collisions_before"].is_array());
  }
  return true;
}

long milliseconds_of(const std::vector<std::string>& arguments, const fs::path& out) {
  auto whole = arguments;
  whole.insert(whole.end(), {"-o", out});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run_program(kProgram, whole).exit_code, 0);
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() -
                                                               begin)
      .count();
}

// Most of the time goes into looking for contacts, of which there are none: no window is there to
// be cancelled.
TEST(Interrupted, WhereNoWindowIsPlanned) {
  const Folder folder;
  const std::vector<std::string> call = {"correct", "--character", kMannequin, "--clip",
                                         "Walk",    "--limb",      "left_leg"};
  const long whole = milliseconds_of(call, folder / "out.glb");
  int interrupted = 0;
  for (const double share : {0.05, 0.5, 0.85})
    interrupted += interrupt(folder, call, std::max(1, static_cast<int>(share * whole)));
  EXPECT_GT(interrupted, 0);
}

TEST(Interrupted, BetweenTheTasksOfAProject) {
  const Folder folder, inputs("inputs");
  const nlohmann::json project = {
      {"version", 1},
      {"scene", {{"character", kMannequin}, {"clip", "Walk"}}},
      {"tasks",
       {{{"kind", "correct"}, {"name", "one"}, {"limb", "left_leg"}},
        {{"kind", "correct"}, {"name", "two"}, {"limb", "right_leg"}}}}};
  std::ofstream(inputs / "p.elbow") << project.dump();
  const std::vector<std::string> call = {"solve", inputs / "p.elbow"};
  const long whole = milliseconds_of(call, folder / "out.glb");
  int interrupted = 0;
  for (const double share : {0.3, 0.6})
    interrupted += interrupt(folder, call, std::max(1, static_cast<int>(share * whole)));
  EXPECT_GT(interrupted, 0);
}

// The second one ends the program at once, but not while it writes.
TEST(Interrupted, TwiceLeavesNoTemporaryFiles) {
  const Folder folder;
  const std::vector<std::string> call = {"correct", "--character", kMannequin, "--clip",
                                         "Walk",    "--limb",      "left_leg"};
  const long whole = milliseconds_of(call, folder / "out.glb");
  for (const auto& [share, apart] : {std::pair(0.5, 20), {0.9, 1}, {0.95, 5}})
    interrupt(folder, call, std::max(1, static_cast<int>(share * whole)), 3, apart);
}

}  // namespace
}  // namespace elbowroom::test
