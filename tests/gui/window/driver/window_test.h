// SPDX-License-Identifier: MIT
// What the tests of the window share: skipping where nothing can be driven, the demo on the screen,
// and holding an exported file against the judge by the project that it came from.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "assets/demo.h"
#include "tests/gui/window/driver/driven_editor.h"
#include "tests/support/cli_scene.h"

namespace elbowroom::test {

inline const std::filesystem::path kDemo = ELBOWROOM_DEMO_DIR;
inline constexpr double kScanSeconds = 90;  // that looking for contacts may take on a busy machine
inline constexpr double kPlanSeconds = 90;

// Skips where something is missing.
class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = missing_packages(); !missing.empty()) GTEST_SKIP() << missing;
  }
  void TearDown() override {
    if (HasFailure() && editor_) {
      editor_->picture(std::string("failed_") +
                       testing::UnitTest::GetInstance()->current_test_info()->name());
      std::printf("%s\n", editor_->said().c_str());
      for (const auto& widget : editor_->widgets())
        std::printf("  %s [%s] %s\n", widget.path.c_str(), widget.kind.c_str(),
                    widget.value.c_str());
    }
  }
  DrivenEditor& editor() {
    if (!editor_) editor_ = std::make_unique<DrivenEditor>(folder_.path());
    return *editor_;
  }
  // Types a path over the one that a file dialog proposes, and takes it.
  void take_path(const std::filesystem::path& path) {
    ASSERT_TRUE(editor().wait_for("Path"));
    editor().type(path.string());
    ASSERT_TRUE(editor().wait([&] { return editor().value("Path") == path.string(); }))
        << editor().value("Path");
    editor().key("Return");
  }
  // Answers the question whether to save changes, if it is asked.
  void discard_if_asked() {
    for (const auto& widget : editor().widgets())
      if (widget.kind == "button" && widget.path.find("Save changes") == 0 &&
          widget.path.find("/Discard") != std::string::npos) {
        editor().click(widget.middle());
        return;
      }
  }
  std::string news() { return editor().value("Status/News"); }

  const Folder folder_;
  std::unique_ptr<DrivenEditor> editor_;
};

// What the saved project says was delivered: the demo with its corrections. Its limbs by name.
inline Delivered delivered_by(const std::filesystem::path& project,
                              const std::filesystem::path& output) {
  Delivered delivered;
  delivered.source = kDemo / demo::kMannequinFile;
  delivered.output = output;
  const auto model = read_gltf(delivered.source);
  EXPECT_TRUE(model.ok());
  if (!model.ok()) return delivered;
  delivered.source_animation = std::to_string((*model)->find_clip(demo::kDemoClip));
  delivered.animation = std::to_string((*model)->clips.size());
  delivered.obstacles = {kDemo / demo::kPostsFile};
  delivered.attachments = {{kDemo / demo::kUmbrellaFile,
                            demo::kAttachJoint,
                            {demo::kGripX, demo::kGripY, demo::kGripZ},
                            {1, 0, 0, 0}}};
  const auto findings = find_limbs(**model, (*model)->characters.at(0));
  const auto saved = read_json(project);
  EXPECT_TRUE(saved.contains("corrections")) << saved;
  for (const auto& correction : saved.value("corrections", nlohmann::json::array())) {
    if (correction.value("muted", false)) continue;
    Delivered::Window window;
    window.begin = correction["window"][0];
    window.end = correction["window"][1];
    for (const Limb& limb : findings.limbs) {
      if (limb.name != correction["limb"]) continue;
      for (const int joint : limb.joints)
        window.limb_joints.push_back(
            (*model)->skeleton.joints[static_cast<std::size_t>(joint)].name);
    }
    EXPECT_FALSE(window.limb_joints.empty());
    if (window.limb_joints.empty()) continue;
    window.limb_root = window.limb_joints.front();
    delivered.windows.push_back(window);
  }
  return delivered;
}

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace elbowroom::test
