// SPDX-License-Identifier: MIT
// The humanoid bones of VRM files, and what hostile ones do to them: nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/io/gltf_reader.h"

namespace elbowroom {
namespace {

class Humanoid : public testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() /
            (std::string("elbowroom_humanoid_") +
             testing::UnitTest::GetInstance()->current_test_info()->name() + ".gltf");
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::shared_ptr<const Model> read(const std::string& extensions) {
    std::ofstream(file_) << R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
      "nodes": [{"name": "a", "children": [1]}, {"name": "b", "children": [2]}, {"name": "c"}],
      "extensions": )" << extensions
                         << "}";
    const auto model = read_gltf(file_);
    EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().message());
    return model.ok() ? *model : nullptr;
  }

  std::filesystem::path file_;
};

TEST_F(Humanoid, BonesOfBothVersions) {
  const auto one = read(R"({"VRMC_vrm": {"specVersion": "1.0", "humanoid": {"humanBones":
      {"leftUpperArm": {"node": 0}, "leftHand": {"node": 2}}}}})");
  ASSERT_NE(one, nullptr);
  ASSERT_EQ(one->human_bones.size(), 2u);
  const auto zero = read(R"({"VRM": {"humanoid": {"humanBones":
      [{"bone": "leftUpperArm", "node": 0, "useDefaultValues": true},
       {"bone": "leftHand", "node": 2}]}}})");
  ASSERT_NE(zero, nullptr);
  ASSERT_EQ(zero->human_bones.size(), 2u);
  for (const auto& model : {one, zero}) {
    for (const HumanBone& bone : model->human_bones)
      EXPECT_EQ(bone.node, bone.bone == "leftHand" ? 2 : 0);
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
  }
}

TEST_F(Humanoid, NonsenseCostsTheBoneAndGivesOneWarning) {
  for (const char* extensions :
       {R"({"VRMC_vrm": {"humanoid": {"humanBones": {"hips": {"node": 1}, "head": {"node": 3},
           "spine": {"node": -1}, "chest": {"node": 1e300}, "neck": {}, "jaw": 5,
           "leftEye": {"node": "1"}, "rightEye": {"node": 1.5}}}}})",
        R"({"VRM": {"humanoid": {"humanBones": [{"bone": "hips", "node": 1}, {"node": 1},
           {"bone": 7, "node": 1}, 3, null, [], {"bone": "head", "node": 18446744073709551615}]}}})"}) {
    const auto model = read(extensions);
    ASSERT_NE(model, nullptr);
    ASSERT_EQ(model->human_bones.size(), 1u) << extensions;
    EXPECT_EQ(model->human_bones[0].bone, "hips");
    EXPECT_EQ(model->human_bones[0].node, 1);
    EXPECT_EQ(model->warnings.size(), 1u);
  }
  for (const char* extensions :
       {"{}", "5", "[]", R"({"VRM": 5})", R"({"VRM": {"humanoid": []}})",
        R"({"VRMC_vrm": {"humanoid": {"humanBones": "no"}}})", R"({"VRMC_vrm": null})"}) {
    const auto model = read(extensions);
    ASSERT_NE(model, nullptr) << extensions;
    EXPECT_TRUE(model->human_bones.empty());
  }
}

TEST_F(Humanoid, ManyBonesAreBounded) {
  std::string bones = R"({"VRM": {"humanoid": {"humanBones": [)";
  for (int i = 0; i < 20000; ++i)
    bones += std::string(i ? "," : "") + R"({"bone": "b)" + std::to_string(i) + R"(", "node": 1})";
  const auto model = read(bones + "]}}}");
  ASSERT_NE(model, nullptr);
  EXPECT_LE(model->human_bones.size(), 256u);
  EXPECT_EQ(model->warnings.size(), 1u);
}

}  // namespace
}  // namespace elbowroom
