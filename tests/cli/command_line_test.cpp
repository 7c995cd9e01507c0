// SPDX-License-Identifier: MIT
// Commands, exit codes and reports as a script sees them.
#include <algorithm>
#include <set>

#include "assets/demo.h"
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"
#include "tests/support/simple_glb.h"

namespace elbowroom::test {
namespace {

// What stands in a folder, so that "nothing is written" can be seen.
std::set<std::string> listing(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename());
  return names;
}

TEST(Info, SaysWhatIsThereAsJson) {
  const auto info = run({"info", kMannequin, "--json"});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  const auto json = nlohmann::json::parse(info.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_EQ(json["file"], kMannequin);
  ASSERT_EQ(json["characters"].size(), 1u);
  const auto& character = json["characters"][0];
  EXPECT_GT(character["joints"], 20);
  EXPECT_GE(character["triangles"], 8000);
  EXPECT_LE(character["triangles"], 20000);
  EXPECT_NEAR(character["height"].get<double>(), 1.75, 0.02);
  for (const char* limb : {"left_arm", "right_arm", "left_leg", "right_leg"}) {
    ASSERT_TRUE(character["limbs"].contains(limb));
    EXPECT_EQ(character["limbs"][limb]["joints"].size(), 3u);
    EXPECT_FALSE(character["limbs"][limb]["why"].get<std::string>().empty());
  }
  EXPECT_EQ(json["clips"].size(), 3u);
  EXPECT_GT(json["clips"][0]["duration"], 0.5);
  EXPECT_TRUE(json["objects"].is_array());
  EXPECT_TRUE(json["warnings"].is_array());
}

// A task of another clip is no business of this one: not even its limb is looked for.
TEST(Solve, PassesOverTasksOfOtherClips) {
  const Folder folder;
  nlohmann::json project;
  project["version"] = 1;
  project["scene"] = {{"character", kMannequin}, {"clip", "0"}};
  project["tasks"][0] = {
      {"kind", "correct"}, {"name", "elsewhere"}, {"clip", "1"}, {"limb", "no_such_limb"}};
  std::ofstream(folder / "p.elbow") << project;
  const auto out = folder / "out.glb";
  const auto passed = run({"solve", folder / "p.elbow", "-o", out});
  EXPECT_EQ(passed.exit_code, 0) << passed.out << passed.err;
  EXPECT_NE(passed.err.find("of other clips passed over"), std::string::npos) << passed.err;
  EXPECT_TRUE(bytes_of(out) == bytes_of(kMannequin));
  // Of this clip, or of any, it counts.
  for (const char* clip : {"0", ""}) {
    project["tasks"][0]["clip"] = clip;
    std::ofstream(folder / "p.elbow") << project;
    EXPECT_EQ(run({"solve", folder / "p.elbow", "-o", out}).exit_code, 2) << clip;
  }
}

TEST(Info, SaysWhatAProjectSetsByHand) {
  const Folder folder;
  const nlohmann::json project = {
      {"version", 1},
      {"scene", {{"character", kMannequin}}},
      {"limbs",
       {{"left_arm", {"LeftShoulder", "LeftHand"}}, {"right_leg", {"Nobody", "RightFoot"}}}}};
  std::ofstream(folder / "p.elbow") << project.dump();
  const auto info = run({"info", folder / "p.elbow", "--json"});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  const auto json = nlohmann::json::parse(info.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  const auto& limbs = json["characters"][0]["limbs"];
  EXPECT_EQ(limbs["left_arm"]["root"], "LeftShoulder");
  // What can't be is said, and found as if it had not been set.
  EXPECT_EQ(limbs["right_leg"]["root"], "RightUpperLeg");
  EXPECT_TRUE(std::any_of(json["warnings"].begin(), json["warnings"].end(), [](const auto& text) {
    return text.template get<std::string>().find("Nobody") != std::string::npos;
  }));
}

TEST(Usage, WrongUsageIsOne) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {},
           {"fly"},
           {"info"},
           {"check"},
           {"correct", "--character", kMannequin},
           {"correct", "--character", kMannequin, "-o", "x.glb", "--window", "2:1"},
           {"correct", "--character", kMannequin, "-o", "x.glb", "--alternatives", "0"},
           {"check", "--character", kMannequin, "--attach", "prop.glb"},
           {"render", "--character", kMannequin, "--times", "a", "-o", "x.png"},
           {"correct", "p.elbow", "--character", kMannequin, "-o", "x.glb"},
           {"check", "p.elbow", "--obstacles", kMannequin}})
    EXPECT_EQ(run(arguments).exit_code, 1) << (arguments.empty() ? "" : arguments[0]);
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  EXPECT_EQ(run({"correct", "--help"}).exit_code, 0);
}

// What is wrong is named with its option, and what to do about it.
TEST(Usage, NamesTheOption) {
  const auto correct = [](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"correct", "--character", kMannequin, "--clip", "Walk"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  struct Case {
    std::vector<std::string> arguments;
    std::vector<std::string> says;
  };
  const std::string wide = "--sample", flexion = "Elbow, flexion=";
  for (const Case& c : std::vector<Case>{
           {correct({"-o", "/nowhere/x.glb", "--seed", "-1"}), {"--seed", "-1"}},
           {correct({"-o", "/nowhere/x.glb", "--seed", "99999999999999999999999"}), {"--seed"}},
           {correct({"-o", "/nowhere/x.glb", "--clearance", "nan"}), {"--clearance", "nan"}},
           {correct({"-o", "/nowhere/x.glb", "--clearance", "-1"}), {"--clearance", "-1"}},
           {correct({"-o", ""}), {"-o", "name a file"}},
           {{"info", ""}, {"FILE", "name a file"}},
           {{"solve", "", "-o", "x.glb"}, {"PROJECT", "name a file"}},
           {{"render", "--character", kMannequin, "--times", "0", "-o", ""}, {"-o", "name a file"}},
           {correct({"-o", "x.glb", wide, flexion + "20:50", wide, flexion + "60:70"}),
            {"--sample", "Elbow, flexion", "once"}},
           {correct({"-o", "x.glb", "--limb", "left_arm", wide, flexion + "500:600"}),
            {"Elbow, flexion", "limits", "°"}},
           {correct({"-o", "x.glb", "--limb", "left_arm", wide, "Knee, flexion=20:50"}),
            {"Knee, flexion", "Elbow, flexion"}},
           {correct({"-o", "x.glb", "--attach", kMannequin + "@RightHand,1e300,0,0"}),
            {"--attach", "too far"}},
           {{"reach", "--character", kMannequin, "--limb", "left_arm", "--target", "1e200,0,0",
             "--at", "0.5", "-o", "x.glb"},
            {"--target", "too far"}},
           {{"reach", "--character", kMannequin, "--limb", "left_arm", "--target", "0,1,0", "--at",
             "nan", "-o", "x.glb"},
            {"--at", "nan"}}}) {
    // From a folder where nothing may come to be.
    const auto result = run(c.arguments);
    EXPECT_EQ(result.exit_code, 1) << result.err;
    for (const auto& text : c.says)
      EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists("x.glb"));
}

TEST(Usage, SamplingBeyondTheLimitsIsCutAndSaysSo) {
  const Folder folder;
  const auto result =
      run({"correct", "--character", kMannequin, "--clip", "Walk", "--limb", "left_arm", "--sample",
           "Elbow, flexion=20:500", "-o", folder / "x.glb"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("cut to the limits"), std::string::npos) << result.err;
}

TEST(BadInput, IsTwoAndNamesFileAndReason) {
  const Folder folder;
  const std::string out = folder / "out.glb", report = folder / "r.json";
  struct Case {
    std::vector<std::string> arguments;
    const char* says;
  };
  std::ofstream(folder / "text.glb") << "this is no model";
  const std::string text = folder / "text.glb";
  for (const Case& c : std::vector<Case>{
           {{"correct", "--character", "/nowhere/a.glb", "-o", out}, "/nowhere/a.glb"},
           {{"correct", "--character", text, "-o", out}, "text.glb"},
           {{"correct", "--character", kMannequin, "--clip", "Fly", "-o", out},
            "Walk between posts"},
           {{"correct", "--character", kMannequin, "--limb", "tail", "-o", out}, "left_arm"},
           {{"correct", "--character", kMannequin, "--obstacles", text, "-o", out}, "text.glb"},
           {{"correct", "--character", kDemo / "posts.glb", "-o", out}, "no character"},
           {{"correct", "--character", kMannequin, "--attach", kMannequin + "@NoJoint", "-o", out},
            "NoJoint"},
           {{"solve", folder / "none.elbow", "-o", out}, "none.elbow"}}) {
    auto arguments = c.arguments;
    arguments.insert(arguments.end(), {"--report", report});
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << c.says << result.err;
    EXPECT_NE(result.err.find(c.says), std::string::npos) << result.err;
    const auto written = read_json(report);
    EXPECT_EQ(written["status"], "bad_input");
    EXPECT_FALSE(written["error"]["what"].get<std::string>().empty());
    // A script finds every member that other reports have.
    EXPECT_TRUE(written.contains("clip") && written["clip"].is_null());
    for (const char* list : {"corrections", "collisions_before", "collisions_after",
                             "other_contacts", "allowed_contacts", "limits_widened"})
      EXPECT_TRUE(written.contains(list) && written[list].is_array()) << list;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

TEST(Check, FreeIsZeroAndContactsAreFour) {
  const Folder folder;
  const auto free =
      run({"check", "--character", kMannequin, "--clip", "Idle", "--report", folder / "free.json"});
  EXPECT_EQ(free.exit_code, 0) << free.out << free.err;
  EXPECT_EQ(read_json(folder / "free.json")["status"], "free");
  const auto hit = run({"check", "--character", kMannequin, "--clip", "Walk between posts",
                        "--obstacles", kDemo / "posts.glb", "--attach",
                        (kDemo / demo::kAttachArgument).string(), "--report", folder / "hit.json"});
  EXPECT_EQ(hit.exit_code, 4) << hit.out << hit.err;
  const auto report = read_json(folder / "hit.json");
  EXPECT_EQ(report["status"], "contacts");
  ASSERT_FALSE(report["collisions_before"].empty());
  const auto& contact = report["collisions_before"][0];
  EXPECT_EQ(contact["limb"], "right_arm");
  EXPECT_LT(contact["interval"][0], contact["interval"][1]);
  EXPECT_GT(contact["depth"], 0);
}

TEST(Correct, NothingToCorrectIsACopy) {
  const Folder folder;
  const auto result = run({"correct", "--character", kMannequin, "--clip", "Idle", "-o",
                           folder / "out.glb", "--report", folder / "r.json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(bytes_of(folder / "out.glb"), bytes_of(kMannequin));
  EXPECT_EQ(read_json(folder / "r.json")["status"], "nothing_to_correct");
}

// A wall through the shoulder for the whole clip: no motion of the arm gets out of it.
TEST(Correct, NoMotionIsThreeAndWritesOnlyTheReport) {
  const Folder folder;
  const auto model = read_gltf(kMannequin);
  ASSERT_TRUE(model.ok());
  ASSERT_TRUE(write_simple_glb(folder / "wall.glb", "wall",
                               box({-3.0f, 0.9f, -3.0f}, {-0.15f, 1.6f, 9.0f})));
  const auto result = run({"correct", "--character", kMannequin, "--clip", "Walk", "--obstacles",
                           folder / "wall.glb", "--limb", "right_arm", "-o", folder / "out.glb",
                           "--report", folder / "r.json"});
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
  EXPECT_EQ(listing(folder.path()), (std::set<std::string>{"r.json", "wall.glb"}));
  const auto report = read_json(folder / "r.json");
  EXPECT_EQ(report["status"], "failed");
  ASSERT_FALSE(report["corrections"].empty());
  EXPECT_TRUE(report["corrections"][0]["blocked_by"].is_string());
}

TEST(Correct, InterruptedIs130AndLeavesNoHalfFile) {
  const Folder folder;
  const auto result =
      run({"correct", "--character", kMannequin, "--clip", "Walk between posts", "--obstacles",
           kDemo / "posts.glb", "--attach", (kDemo / demo::kAttachArgument).string(),
           "--alternatives", "64", "-o", folder / "out.glb"},
          3000);
  EXPECT_EQ(result.exit_code, 130) << result.out << result.err;
  EXPECT_TRUE(listing(folder.path()).empty());
}

TEST(Correct, SameSeedGivesTheSameBytesAndAProjectSolvesToThem) {
  const Folder folder;
  // The scene beside the project, so that its relative paths are seen to work.
  for (const char* file : {demo::kMannequinFile, demo::kUmbrellaFile, demo::kPostsFile})
    std::filesystem::copy_file(kDemo / file, folder / file);
  const std::string attach = (folder / demo::kAttachArgument).string();
  const std::vector<std::string> scene = {
      "--character", folder / demo::kMannequinFile, "--clip",   demo::kDemoClip,
      "--obstacles", folder / demo::kPostsFile,     "--attach", attach};
  const auto correct = [&](const std::string& out, const std::string& seed) {
    std::vector<std::string> arguments = {"correct"};
    arguments.insert(arguments.end(), scene.begin(), scene.end());
    arguments.insert(arguments.end(), {"--limb", "right_arm", "--seed", seed, "-o", folder / out,
                                       "--save-project", folder / (out + ".elbow")});
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  };
  correct("a.glb", "7");
  correct("b.glb", "7");
  correct("c.glb", "8");
  EXPECT_EQ(bytes_of(folder / "a.glb"), bytes_of(folder / "b.glb"));
  EXPECT_NE(bytes_of(folder / "a.glb"), bytes_of(folder / "c.glb"));
  const auto solved =
      run({"solve", folder / "a.glb.elbow", "-o", folder / "d.glb", "--report", folder / "d.json"});
  EXPECT_EQ(solved.exit_code, 0) << solved.out << solved.err;
  EXPECT_EQ(bytes_of(folder / "a.glb"), bytes_of(folder / "d.glb"));
  const auto anew = run({"solve", folder / "a.glb.elbow", "--anew", "-o", folder / "f.glb"});
  EXPECT_EQ(anew.exit_code, 0) << anew.out << anew.err;
  EXPECT_EQ(bytes_of(folder / "a.glb"), bytes_of(folder / "f.glb"));
  // A correction is its task's: muted, the task is passed over.
  auto project = read_json(folder / "a.glb.elbow");
  ASSERT_EQ(project["tasks"].size(), 1u);
  ASSERT_FALSE(project["corrections"].empty());
  for (auto& correction : project["corrections"]) {
    EXPECT_EQ(correction["task"], project["tasks"][0]["name"]);
    correction["muted"] = true;
  }
  std::ofstream(folder / "muted.elbow") << project.dump();
  EXPECT_EQ(run({"solve", folder / "muted.elbow", "-o", folder / "m.glb"}).exit_code, 0);
  EXPECT_EQ(bytes_of(folder / "m.glb"), bytes_of(folder / demo::kMannequinFile));

  // On a project a task is done on top of its corrections: here there is nothing left to do.
  const auto more = run({"correct", folder / "a.glb.elbow", "-o", folder / "e.glb", "--report",
                         folder / "e.json", "--save-project", folder / "e.elbow"});
  EXPECT_EQ(more.exit_code, 0) << more.out << more.err;
  EXPECT_EQ(read_json(folder / "e.json")["status"], "nothing_to_correct");
  EXPECT_TRUE(read_json(folder / "e.json")["collisions_before"].empty());
  EXPECT_EQ(bytes_of(folder / "e.glb"), bytes_of(folder / "a.glb"));
  EXPECT_EQ(read_json(folder / "e.elbow")["corrections"],
            read_json(folder / "a.glb.elbow")["corrections"]);
  const auto checked = run({"check", folder / "a.glb.elbow"});
  EXPECT_EQ(checked.exit_code, 4) << checked.out << checked.err;
}

TEST(Render, MakesAFilmstripWithoutADisplay) {
  const Folder folder;
  const auto result =
      run({"render", "--character", kMannequin, "--clip", "Walk", "--times", "0,0.3,0.6", "--width",
           "120", "--height", "160", "-o", folder / "strip.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(bytes_of(folder / "strip.png").substr(1, 3), "PNG");
}

}  // namespace
}  // namespace elbowroom::test
