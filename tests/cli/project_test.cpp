// SPDX-License-Identifier: MIT
// What a project's tasks mean to `solve`: limbs by any name, contacts over all of them.
#include <cstring>
#include <map>

#include "assets/demo.h"
#include "tests/cli/program.h"
#include "tests/support/cli_scene.h"
#include "tests/support/simple_glb.h"

namespace elbowroom::test {
namespace {

nlohmann::json task(const std::string& name, const std::string& limb) {
  return {{"kind", "correct"}, {"name", name}, {"limb", limb}};
}

nlohmann::json demo_project(const nlohmann::json& tasks) {
  return {{"version", 1},
          {"scene",
           {{"character", kMannequin},
            {"clip", demo::kDemoClip},
            {"obstacles", {kDemo / "posts.glb"}},
            {"attachments",
             {{{"file", kDemo / demo::kUmbrellaFile},
               {"joint", demo::kAttachJoint},
               {"translation", {demo::kGripX, demo::kGripY, demo::kGripZ}}}}}}},
          {"tasks", tasks}};
}

TEST(Limb, IsNamedByItsJointsToo) {
  const Folder folder;
  const auto result = run_program(kProgram, {"correct", "--character", kMannequin, "--clip", "Walk",
                                             "--limb", "RightUpperArm..RightHand", "-o",
                                             folder / "out.glb", "--report", folder / "r.json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto samples = samples_dir();
  const auto fox = samples / "humanoids/khronos/Fox.glb";
  if (samples.empty() || !std::filesystem::exists(fox)) GTEST_SKIP() << samples_missing();
  const auto leg =
      run_program(kProgram, {"correct", "--character", fox, "--limb",
                             "b_LeftLeg01_015..b_LeftFoot01_017", "-o", folder / "fox.glb"});
  EXPECT_EQ(leg.exit_code, 0) << leg.err;
}

// Windows where nothing collides: nothing is planned, and all contacts are there afterwards.
TEST(Solve, LooksAtAllTasksLimbsOnceBeforeAndOnceAfter) {
  const Folder folder;
  auto elsewhere = task("arm", "RightUpperArm..RightHand");
  elsewhere["window"] = {0.0, 0.05};
  std::ofstream(folder / "p.elbow")
      << demo_project(
             {elsewhere, task("other arm", "LeftUpperArm..LeftHand"), task("leg", "left_leg")})
             .dump();
  const auto solved = run_program(kProgram, {"solve", folder / "p.elbow", "-o", folder / "out.glb",
                                             "--report", folder / "r.json"});
  ASSERT_EQ(solved.exit_code, 0) << solved.err;
  run_program(kProgram, {"check", folder / "p.elbow", "--report", folder / "check.json"});
  const auto report = read_json(folder / "r.json"), check = read_json(folder / "check.json");
  nlohmann::json expected = nlohmann::json::array();
  for (const auto& contact : check["collisions_before"])
    if (contact["limb"] != "right_leg") expected.push_back(contact);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(report["collisions_before"], expected);
  EXPECT_EQ(report["collisions_after"], expected);
  EXPECT_EQ(report["other_contacts"], check["other_contacts"]);
}

// Another way than the one that the task's own seed gives, accepted: it is what comes out, byte for
// byte. Asked to, `solve` plans anew and takes its own; unasked, and saying so, where something has
// come in the way.
TEST(Solve, DeliversTheWayThatWasAccepted) {
  const Folder folder;
  const double time = 0.55;
  const judge::File walk = judge::load(kMannequin);
  const auto place = [](const judge::File& file, const std::string& clip, double t) {
    const auto state = judge::state_at(file, &file.animation(clip), t);
    return glm::dvec3(state.world[static_cast<std::size_t>(file.node("LeftHand"))][3]);
  };
  const glm::dvec3 target = place(walk, "Walk", time) + glm::dvec3(0.05, 0.2, 0.1);
  const auto reach = [&](const std::string& name, const std::string& elbow) {
    const auto run = run_program(
        kProgram,
        {"reach", "--character", kMannequin, "--clip", "Walk", "--limb", "left_arm", "--target",
         std::to_string(target.x) + "," + std::to_string(target.y) + "," + std::to_string(target.z),
         "--at", std::to_string(time), "--sample", "Elbow, flexion=" + elbow, "-o",
         folder / (name + ".glb"), "--save-project", folder / (name + ".elbow")});
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  };
  reach("own", "0:140");
  reach("other", "80:120");
  ASSERT_TRUE(bytes_of(folder / "own.glb") != bytes_of(folder / "other.glb"));
  auto project = read_json(folder / "own.elbow");
  project["corrections"] = read_json(folder / "other.elbow")["corrections"];
  ASSERT_EQ(project["corrections"].size(), 1u);
  // As the other way of several is written: with the task's wishes and a seed of its own.
  project["corrections"][0]["made_with"] =
      read_json(folder / "own.elbow")["corrections"][0]["made_with"];
  project["corrections"][0]["made_with"]["seed"] = 7920;
  project["corrections"][0]["name"] = "Up there";
  ASSERT_EQ(project["corrections"][0]["task"], project["tasks"][0]["name"]);
  const auto solve = [&](const std::vector<std::string>& more = {}) {
    std::ofstream(folder / "p.elbow") << project.dump();
    std::vector<std::string> call = {"solve",    folder / "p.elbow", "-o", folder / "out.glb",
                                     "--report", folder / "r.json"};
    call.insert(call.end(), more.begin(), more.end());
    const auto run = run_program(kProgram, call);
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
    return run;
  };
  EXPECT_NE(solve().out.find("as accepted, verified"), std::string::npos);
  EXPECT_TRUE(bytes_of(folder / "out.glb") == bytes_of(folder / "other.glb"));
  auto report = read_json(folder / "r.json");
  ASSERT_EQ(report["corrections"].size(), 1u);
  EXPECT_EQ(report["status"], "corrected");
  EXPECT_TRUE(report["corrections"][0]["accepted"].get<bool>());
  EXPECT_TRUE(report["corrections"][0]["cost"].is_null());
  EXPECT_TRUE(report["warnings"].empty()) << report["warnings"];

  // What looks at the source clip says that it does.
  const auto checked =
      run_program(kProgram, {"check", folder / "p.elbow", "--report", folder / "check.json"});
  EXPECT_NE(checked.err.find("1 correction is not looked at"), std::string::npos) << checked.err;
  EXPECT_EQ(read_json(folder / "check.json")["warnings"].size(), 1u);

  solve({"--anew"});
  EXPECT_TRUE(bytes_of(folder / "out.glb") == bytes_of(folder / "own.glb"));
  EXPECT_FALSE(read_json(folder / "r.json")["corrections"][0]["accepted"].get<bool>());

  const glm::vec3 passed(place(judge::load(folder / "other.glb"), "Walk (corrected)", time + 0.3));
  ASSERT_TRUE(write_simple_glb(folder / "thing.glb", "thing",
                               box(passed - glm::vec3(0.01f), passed + glm::vec3(0.01f))));
  project["scene"]["obstacles"] = {folder / "thing.glb"};
  const auto anew = solve();
  EXPECT_NE(anew.err.find("\"Up there\" is planned anew"), std::string::npos) << anew.err;
  EXPECT_NE(anew.err.find("thing"), std::string::npos) << anew.err;
  report = read_json(folder / "r.json");
  ASSERT_EQ(report["corrections"].size(), 1u);
  EXPECT_FALSE(report["corrections"][0]["accepted"].get<bool>());
  EXPECT_EQ(report["warnings"].size(), 1u);
  EXPECT_TRUE(bytes_of(folder / "out.glb") != bytes_of(folder / "other.glb"));
}

TEST(Solve, LimbsThatShareJointsAreToldOf) {
  const Folder folder;
  std::ofstream(folder / "p.elbow") << demo_project({task("arm", "RightUpperArm..RightHand"),
                                                     task("more", "RightShoulder..RightHand")})
                                           .dump();
  const auto solved =
      run_program(kProgram, {"solve", folder / "p.elbow", "-o", folder / "out.glb"});
  EXPECT_EQ(solved.exit_code, 2) << solved.err;
  EXPECT_NE(solved.err.find("share joints"), std::string::npos) << solved.err;
}

// The mannequin with some joints renamed.
void write_renamed(const std::filesystem::path& file,
                   const std::map<std::string, std::string>& names) {
  std::ifstream in(kMannequin, std::ios::binary);
  const std::string glb{std::istreambuf_iterator<char>(in), {}};
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  auto json = nlohmann::ordered_json::parse(glb.substr(20, length));
  for (auto& node : json["nodes"])
    if (const auto found = names.find(node.value("name", std::string())); found != names.end())
      node["name"] = found->second;
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string made = glb.substr(0, 20) + text + glb.substr(20 + length);
  const auto size = static_cast<std::uint32_t>(made.size()),
             json_size = static_cast<std::uint32_t>(text.size());
  std::memcpy(made.data() + 8, &size, 4);
  std::memcpy(made.data() + 12, &json_size, 4);
  std::ofstream(file, std::ios::binary) << made;
}

TEST(Attach, WarnsWhereSeveralJointsHaveTheName) {
  const Folder folder;
  write_renamed(folder / "twins.glb", {{"LeftHand", "Hand"}, {"RightHand", "Hand"}});
  // Far from the figure, so that there is nothing to look at closely.
  ASSERT_TRUE(write_simple_glb(folder / "prop.glb", "prop", box({5, 5, 5}, {5.1f, 5.1f, 5.1f})));
  const auto result =
      run_program(kProgram, {"check", "--character", folder / "twins.glb", "--clip", "Walk",
                             "--attach", (folder / "prop.glb").string() + "@Hand"});
  EXPECT_NE(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find("2 joints are named Hand"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace elbowroom::test
