// SPDX-License-Identifier: MIT
// The project file: everything comes back, unknown keys survive, damage is named.
#include "core/io/project_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace elbowroom {
namespace {

class ProjectFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("elbowroom_project_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "props");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void put(const std::string& text) { std::ofstream(folder_ / "p.elbow") << text; }
  nlohmann::json saved() {
    std::ifstream in(folder_ / "p.elbow");
    return nlohmann::json::parse(in);
  }

  std::filesystem::path folder_;
};

Document full_document(const std::filesystem::path& folder) {
  Document document;
  document.scene.character = folder / "ada.glb";
  document.scene.clip = "Walk \xc3\xa9";
  document.scene.obstacles = {folder / "props" / "posts.glb"};
  AttachedFile attached;
  attached.file = folder / "umbrella.glb";
  attached.joint = "RightHand";
  attached.joint_from_object.translation = {0.1, 1.0 / 3.0, -2e-17};
  attached.joint_from_object.rotation = glm::normalize(Quat(0.9, 0.1, 0.2, 0.3));
  document.scene.attachments = {attached};
  document.limbs = {{"left_arm", {"Shoulder", "", "Wrist"}}, {"tail", {"T1", "T3 \xc3\xa9", "T6"}}};
  Task task;
  task.name = "past the post";
  task.limb = "right_arm";
  task.window = Interval{1.2, 2.05};
  task.wishes.seed = 18446744073709551615ull;
  task.wishes.sampling["Elbow, flexion"] = {0.5, 2.0};
  document.tasks = {task, Task{}};
  Correction correction;
  correction.name = "right_arm 1";
  correction.limb = "right_arm";
  correction.begin = 1.2f;
  correction.end = 2.05f;
  correction.muted = true;
  JointKeys keys;
  keys.joint = "RightUpperArm";
  keys.node = 7;
  keys.keys.times = {1.2f, 1.7f, 2.05f};
  keys.keys.values = {Quat(1, 0, 0, 0), glm::normalize(Quat(1, 2, 3, 4)), Quat(1, 0, 0, 0)};
  keys.keys.derivatives = {Quat(0, 1, 0, 0), Quat(0, 0.1, 0.7, 0), Quat(0, 0, 0, 1)};
  JointKeys foot = keys;
  foot.joint = "Foot.L";
  foot.node = 12;
  foot.keys.derivatives.clear();
  foot.translations = {Vec3(0.1, 0.2, 0.3), Vec3(1.0 / 3, -2e-7, 5), Vec3(0.1, 0.2, 0.3)};
  correction.joints = {keys, foot};
  document.corrections = {correction};
  return document;
}

TEST_F(ProjectFile, LimbsSetByHandAreCheckedAndCanBeTakenBack) {
  Document document = full_document(folder_);
  ASSERT_TRUE(write_project(folder_ / "p.elbow", document).ok());
  EXPECT_EQ(saved()["limbs"]["left_arm"], nlohmann::json::parse(R"(["Shoulder", "Wrist"])"));
  document.limbs.clear();
  ASSERT_TRUE(write_project(folder_ / "p.elbow", document).ok());
  const auto read = read_project(folder_ / "p.elbow");
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(read->limbs.empty());
  for (const char* limbs : {R"([])", R"({"left_arm": "A..B"})", R"({"left_arm": ["A"]})",
                            R"({"left_arm": ["A", "B", "C", "D"]})", R"({"left_arm": [1, 2]})",
                            R"({"": ["A", "B"]})", R"({"left_arm": {"from": "A"}})"}) {
    put(std::string(R"({"version": 1, "scene": {"character": "a.glb"}, "limbs": )") + limbs + "}");
    const auto damaged = read_project(folder_ / "p.elbow");
    ASSERT_FALSE(damaged.ok()) << limbs;
    EXPECT_NE(damaged.error().where.find("/limbs"), std::string::npos) << damaged.error().message();
  }
}

TEST_F(ProjectFile, EverythingComesBackToTheBit) {
  const Document document = full_document(folder_);
  ASSERT_TRUE(write_project(folder_ / "p.elbow", document).ok());
  const auto read = read_project(folder_ / "p.elbow");
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->scene.character.lexically_normal(), document.scene.character);
  EXPECT_EQ(read->scene.clip, document.scene.clip);
  EXPECT_EQ(read->limbs, document.limbs);
  EXPECT_EQ(read->scene.obstacles.at(0).lexically_normal(), document.scene.obstacles[0]);
  const auto& attached = read->scene.attachments.at(0);
  EXPECT_EQ(attached.joint, "RightHand");
  EXPECT_EQ(attached.joint_from_object.translation,
            document.scene.attachments[0].joint_from_object.translation);
  ASSERT_EQ(read->tasks.size(), 2u);
  EXPECT_EQ(read->tasks[0].wishes.seed, 18446744073709551615ull);
  EXPECT_EQ(read->tasks[0].window->upper, 2.05);
  EXPECT_EQ(read->tasks[0].wishes.sampling.at("Elbow, flexion").upper, 2.0);
  EXPECT_FALSE(read->tasks[1].window.has_value());
  const Correction& correction = read->corrections.at(0);
  EXPECT_EQ(correction.begin, 1.2f);
  EXPECT_TRUE(correction.muted);
  EXPECT_EQ(correction.joints.at(0).keys.times, document.corrections[0].joints[0].keys.times);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(correction.joints[0].keys.values[i],
              document.corrections[0].joints[0].keys.values[i]);
    EXPECT_EQ(correction.joints[0].keys.derivatives[i],
              document.corrections[0].joints[0].keys.derivatives[i]);
  }
}

TEST_F(ProjectFile, TasksAndCorrectionsKeepTheirClip) {
  Document document = full_document(folder_);
  document.tasks[0].clip = "Run";
  document.corrections.push_back(document.corrections[0]);
  document.corrections[0].clip = "Run";
  ASSERT_TRUE(write_project(folder_ / "p.elbow", document).ok());
  const auto read = read_project(folder_ / "p.elbow");
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->tasks, document.tasks);
  EXPECT_EQ(read->corrections, document.corrections);
  // From before they had one: corrections were of the clip that the project has chosen; what is
  // wished for is wished for any.
  auto old = saved();
  for (auto& correction : old["corrections"]) correction.erase("clip");
  for (auto& task : old["tasks"]) task.erase("clip");
  put(old.dump());
  const auto from_before = read_project(folder_ / "p.elbow");
  ASSERT_TRUE(from_before.ok());
  for (const Correction& correction : from_before->corrections)
    EXPECT_EQ(correction.clip, document.scene.clip);
  for (const Task& task : from_before->tasks) EXPECT_EQ(task.clip, "");
  for (const char* part : {"tasks", "corrections"}) {
    auto damaged = saved();
    damaged[part][0]["clip"] = 7;
    put(damaged.dump());
    const auto refused = read_project(folder_ / "p.elbow");
    ASSERT_FALSE(refused.ok()) << part;
    EXPECT_NE(refused.error().where.find("/clip"), std::string::npos);
    put(old.dump());
  }
}

TEST_F(ProjectFile, ReachesAndTheDraftComeBackWhole) {
  Document document = full_document(folder_);
  Task reach;
  reach.kind = TaskKind::reach;
  reach.name = "to the shelf";
  reach.limb = "left_arm";
  HandTarget target;
  target.time = 1.0 / 3.0;
  target.position = {0.1, -2.5e-7, 1e3};
  target.orientation = glm::normalize(Quat(0.3, -0.2, 0.9, 0.1));
  reach.target = target;
  document.tasks.push_back(reach);
  document.corrections[0].task = "past the post";
  document.draft.limb = "right_leg";
  document.draft.window = Interval{0.25, 0.75};
  target.orientation.reset();
  target.grasp = true;
  document.draft.target = target;
  document.draft.wishes["right_leg"].seed = 9;
  document.draft.wishes["right_leg"].sampling["Knee, flexion"] = {0.1, 1.1};
  ASSERT_TRUE(write_project(folder_ / "p.elbow", document).ok());
  const auto read = read_project(folder_ / "p.elbow");
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->draft, document.draft);
  EXPECT_EQ(read->tasks[0], document.tasks[0]);
  EXPECT_EQ(read->tasks[1], document.tasks[1]);
  // A quaternion is made unit again when it is read: to the last bit, not beyond.
  EXPECT_EQ(read->tasks[2].target->position, reach.target->position);
  EXPECT_EQ(read->tasks[2].target->time, reach.target->time);
  EXPECT_LT(angle_between(*read->tasks[2].target->orientation, *reach.target->orientation), 1e-12);
  EXPECT_EQ(read->corrections, document.corrections);
}

TEST_F(ProjectFile, DamagedTargetsAreNamed) {
  ASSERT_TRUE(write_project(folder_ / "p.elbow", full_document(folder_)).ok());
  nlohmann::json root = saved();
  root["tasks"][0]["kind"] = "reach";  // and no target
  put(root.dump());
  auto read = read_project(folder_ / "p.elbow");
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message().find("target"), std::string::npos) << read.error().message();
  root["tasks"][0]["target"] = {{"time", 1}, {"position", {1, 2}}};
  put(root.dump());
  read = read_project(folder_ / "p.elbow");
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message().find("/tasks/0/target/position"), std::string::npos)
      << read.error().message();
}

TEST_F(ProjectFile, PathsAreRelativeToTheFile) {
  ASSERT_TRUE(write_project(folder_ / "p.elbow", full_document(folder_)).ok());
  EXPECT_EQ(saved()["scene"]["character"], "ada.glb");
  EXPECT_EQ(saved()["scene"]["obstacles"][0], "props/posts.glb");
}

TEST_F(ProjectFile, UnknownKeysSurviveASave) {
  ASSERT_TRUE(write_project(folder_ / "p.elbow", full_document(folder_)).ok());
  nlohmann::json root = saved();
  root["from_the_future"] = {1, 2, 3};
  root["scene"]["fog"] = 0.5;
  root["tasks"][0]["colour"] = "blue";
  root["corrections"][0]["weight"] = 1;
  put(root.dump());
  const auto read = read_project(folder_ / "p.elbow");
  ASSERT_TRUE(read.ok());
  ASSERT_TRUE(write_project(folder_ / "p.elbow", *read).ok());
  EXPECT_EQ(saved()["from_the_future"], nlohmann::json({1, 2, 3}));
  EXPECT_EQ(saved()["scene"]["fog"], 0.5);
  EXPECT_EQ(saved()["tasks"][0]["colour"], "blue");
  EXPECT_EQ(saved()["corrections"][0]["weight"], 1);
}

TEST_F(ProjectFile, ANewerVersionSaysSo) {
  put(R"({"version": 2, "scene": {"character": "a.glb"}})");
  const auto read = read_project(folder_ / "p.elbow");
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message().find("newer"), std::string::npos);
  EXPECT_NE(read.error().where.find("p.elbow"), std::string::npos);
  // And is not overwritten by an older program.
  EXPECT_FALSE(write_project(folder_ / "p.elbow", full_document(folder_)).ok());
  EXPECT_EQ(saved()["version"], 2);
}

TEST_F(ProjectFile, DamageIsNamedWithItsPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "no JSON"},
      {"{\n  \"version\": 1,\n  \"scene\": {},,\n}", "line 3"},
      {R"({"version": 1e999})", "too large"},
      {"[1]", "no JSON object"},
      {"{}", "no version"},
      {R"({"version": "1"})", "no version"},
      {R"({"version": 1})", "scene"},
      {R"({"version": 1, "scene": {}})", "character"},
      {R"({"version": 1, "scene": {"character": 3}})", "/scene/character"},
      {R"({"version": 1, "scene": {"character": "a"}, "tasks": [{"kind": "fly"}]})", "fly"},
      {R"({"version": 1, "scene": {"character": "a"}, "tasks": [{"kind": "correct", "window": [2, 1]}]})",
       "/tasks/0/window"},
      {R"({"version": 1, "scene": {"character": "a"}, "tasks": 5})", "/tasks"},
      {R"({"version": 1, "scene": {"character": "a"}, "tasks": [{"kind": "correct", "seed": -1}]})",
       "/tasks/0/seed"},
      {R"({"version": 1, "scene": {"character": "a"}, "tasks": [{"kind": "correct", "seed": 99999999999999999999999}]})",
       "/tasks/0/seed"},
      {R"({"version": 1, "scene": {"character": "a"}, "tasks": [{"kind": "correct", "seed": 1.5}]})",
       "/tasks/0/seed"},
      {R"({"version": 1, "scene": {"character": "a"}, "tasks": [{"kind": "reach", "target": {"time": 1, "position": [0, 1e200, 0]}}]})",
       "/tasks/0/target/position"},
      {R"({"version": 1, "scene": {"character": "a", "attachments": [{"file": "b", "joint": "c", "translation": [1e300, 0, 0]}]}})",
       "/scene/attachments/0/translation"},
      {R"({"version": 1, "scene": {"character": "a"}, "corrections": [{"limb": "x", "window": [0, 1], "joints": [{"joint": "j", "node": 1, "times": [0, 1], "rotations": [[0, 0, 0, 1]]}]}]})",
       "/corrections/0/joints/0"},
      {R"({"version": 1, "scene": {"character": "a", "attachments": [{"file": "b", "joint": "c", "rotation": [0, 0, 0, 0]}]}})",
       "/scene/attachments/0/rotation"},
  };
  for (const auto& [text, expected] : cases) {
    put(text);
    const auto read = read_project(folder_ / "p.elbow");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().message().find(expected), std::string::npos)
        << text << "\n gave: " << read.error().message();
    EXPECT_NE(read.error().where.find("p.elbow"), std::string::npos) << text;
  }
}

TEST_F(ProjectFile, AMissingFileIsAnError) {
  const auto read = read_project(folder_ / "none.elbow");
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().where.find("none.elbow"), std::string::npos);
}

}  // namespace
}  // namespace elbowroom
