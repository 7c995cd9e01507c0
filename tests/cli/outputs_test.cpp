// SPDX-License-Identifier: MIT
// What is written where: never over an input or another output, all of it or nothing but the
// report.
#include <set>

#include "assets/demo.h"
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"
#include "tests/support/simple_glb.h"

namespace elbowroom::test {
namespace {

namespace fs = std::filesystem;

// Every file of a folder, with its bytes.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[fs::relative(entry.path(), folder)] =
        entry.is_regular_file() ? bytes_of(entry.path()) : "";
  return files;
}

std::set<std::string> names(const std::map<std::string, std::string>& files) {
  std::set<std::string> all;
  for (const auto& [name, bytes] : files) all.insert(name);
  return all;
}

// A figure, an obstacle, a prop and a project of them, in a folder of their own.
class Outputs : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(kDemo / "mannequin.glb", figure_);
    fs::copy_file(kDemo / "mannequin.glb", folder_ / "walk-2.glb");
    fs::copy_file(kDemo / demo::kUmbrellaFile, prop_);
    ASSERT_TRUE(write_simple_glb(post_, "post", box({3, 0, 3}, {4, 1, 4})));
    const nlohmann::json project = {
        {"version", 1},
        {"scene", {{"character", "walk.glb"}, {"clip", "Walk"}, {"obstacles", {"post.glb"}}}},
        {"tasks",
         {{{"kind", "correct"}, {"name", "one"}, {"limb", "left_leg"}, {"alternatives", 2}}}}};
    std::ofstream(project_) << project.dump();
    before_ = contents(folder_.path());
  }
  std::vector<std::string> scene(const std::string& command,
                                 const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {command, "--character", figure_, "--clip",
                                          "Walk",  "--obstacles", post_,   "--attach"};
    arguments.push_back(prop_.string() + "@" + demo::kAttachJoint);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& says) {
    const ProgramRun result = run(arguments);
    EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_EQ(contents(folder_.path()), before_) << arguments[0] << " " << says;
  }

  Folder folder_;
  fs::path figure_ = folder_ / "walk.glb", prop_ = folder_ / "umbrella.glb",
           post_ = folder_ / "post.glb", project_ = folder_ / "p.elbow";
  std::map<std::string, std::string> before_;
};

TEST_F(Outputs, AreNeverInputs) {
  const std::string out = folder_ / "out.glb";
  for (const fs::path& input : {figure_, post_, prop_}) {
    const std::string name = input.filename();
    expect_refused(scene("check", {"--report", input}), name);
    expect_refused(scene("correct", {"-o", input}), name);
    expect_refused(scene("correct", {"-o", out, "--report", input}), name);
    expect_refused(scene("correct", {"-o", out, "--save-project", input}), name);
    expect_refused(scene("render", {"--times", "0", "-o", input}), name);
  }
  expect_refused(scene("reach", {"--limb", "left_arm", "--target", "0,1,0", "--at", "0.5", "-o",
                                 folder_ / "." / "walk.glb"}),
                 "the character");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"solve", project_, "-o", project_},
           {"solve", project_, "-o", out, "--report", project_},
           {"solve", project_, "-o", post_},
           {"solve", project_, "-o", out, "--per-file", folder_.path()},
           {"correct", project_, "-o", project_},
           {"correct", project_, "-o", out, "--report", project_},
           {"check", project_, "--report", project_},
           {"render", project_, "--times", "0", "-o", project_}})
    expect_refused(arguments, "would write over");
}

TEST_F(Outputs, OfOtherWaysAroundNeither) {
  expect_refused({"correct", "--character", folder_ / "walk-2.glb", "--clip", "Walk",
                  "--alternatives", "2", "-o", figure_},
                 "walk-2.glb");
  expect_refused({"solve", project_, "-o", folder_ / "walk.glb"}, "walk.glb");
}

TEST_F(Outputs, AreNeverEachOther) {
  const std::string out = folder_ / "out.glb";
  expect_refused(scene("correct", {"-o", out, "--report", out}), "--report");
  expect_refused(scene("correct", {"-o", out, "--report", folder_ / "x" / ".." / "out.glb"}),
                 "--report");
  expect_refused(scene("correct", {"-o", out, "--save-project", out}), "--save-project");
  expect_refused(
      scene("correct", {"-o", out, "--alternatives", "2", "--report", folder_ / "out-2.glb"}),
      "--alternatives");
  fs::create_directory(folder_ / "per");
  before_ = contents(folder_.path());
  expect_refused(
      {"solve", project_, "-o", folder_ / "per" / "walk.glb", "--per-file", folder_ / "per"},
      "--per-file");
}

TEST_F(Outputs, AreNeverTheBuffersOfAGltf) {
  // The post as text, its bytes in a file beside it.
  const std::string glb = bytes_of(post_);
  const auto length = static_cast<unsigned char>(glb[12]) | static_cast<unsigned char>(glb[13])
                                                                << 8;
  auto json = nlohmann::json::parse(glb.substr(20, static_cast<std::size_t>(length)));
  json["buffers"][0]["uri"] = "post%20data.bin";
  std::ofstream(folder_ / "post.gltf") << json.dump();
  std::ofstream(folder_ / "post data.bin", std::ios::binary)
      << glb.substr(28 + static_cast<std::size_t>(length));
  before_ = contents(folder_.path());
  expect_refused({"correct", "--character", figure_, "--obstacles", folder_ / "post.gltf", "-o",
                  folder_ / "post data.bin"},
                 "belongs to post.gltf");
}

// Nothing but the report with exit code 2, and no time lost in planning before.
TEST_F(Outputs, ThatCannotBeWrittenLeaveNothing) {
  const std::string out = folder_ / "out.glb", report = folder_ / "r.json";
  fs::create_directory(folder_ / "folder.json");
  fs::create_directory(folder_ / "out-2.glb");
  std::ofstream(folder_ / "file") << "x";
  before_ = contents(folder_.path());
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
    bool reports;
  };
  for (const Case& c : std::vector<Case>{
           {scene("correct", {"-o", out, "--report", folder_ / "no" / "r.json"}), "no/r.json",
            false},
           {scene("correct", {"-o", out, "--report", folder_ / "folder.json"}), "folder.json",
            false},
           {scene("correct", {"-o", folder_ / "no" / "o.glb", "--report", report}), "no/o.glb",
            true},
           {scene("correct",
                  {"-o", out, "--save-project", folder_ / "no" / "p", "--report", report}),
            "no/p", true},
           {scene("correct", {"-o", out, "--save-project", folder_ / "file", "--report", report}),
            "something else", true},
           {scene("correct", {"-o", out, "--alternatives", "2", "--report", report}), "out-2.glb",
            true},
           {{"solve", project_, "-o", folder_ / "o.glb", "--per-file", folder_ / "file", "--report",
             report},
            "file",
            true},
           {scene("check", {"--report", folder_ / "no" / "r.json"}), "no/r.json", false},
           {scene("render", {"--times", "0", "-o", "/dev/null"}), "/dev/null", false}}) {
    const ProgramRun result = run(c.arguments);
    EXPECT_EQ(result.exit_code, 2) << result.out << result.err;
    EXPECT_NE(result.err.find(c.says), std::string::npos) << result.err;
    // It is told of once.
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    auto after = contents(folder_.path());
    EXPECT_EQ(after.erase("r.json"), c.reports ? 1u : 0u);
    EXPECT_EQ(after, before_);
    fs::remove(report);
  }
}

TEST_F(Outputs, AllComeTogether) {
  const ProgramRun result = run({"solve", project_, "-o", folder_ / "out.gltf", "--per-file",
                                 folder_ / "new" / "per", "--report", folder_ / "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  auto expected = names(before_);
  expected.insert({"out.gltf", "out.bin", "new", "new/per", "new/per/walk.glb", "r.json"});
  EXPECT_EQ(names(contents(folder_.path())), expected);
  EXPECT_EQ(bytes_of(folder_ / "new" / "per" / "walk.glb"), bytes_of(figure_));
}

TEST_F(Outputs, AProjectMayBeSavedOverItself) {
  auto project = read_json(project_);
  project["from_the_future"] = 3;
  std::ofstream(project_) << project.dump();
  for (const fs::path& saved : {project_, folder_ / "other.elbow"}) {
    const ProgramRun result = run({"correct", project_, "--limb", "right_leg", "-o",
                                   folder_ / "out.glb", "--save-project", saved});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_json(saved)["from_the_future"], 3);
    ASSERT_GE(read_json(saved)["tasks"].size(), 2u);
    EXPECT_EQ(read_json(saved)["tasks"][1]["name"], "correct right_leg");
  }
  // The name was taken the second time.
  EXPECT_EQ(read_json(folder_ / "other.elbow")["tasks"][2]["name"], "correct right_leg (2)");
}

}  // namespace
}  // namespace elbowroom::test
