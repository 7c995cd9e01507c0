// SPDX-License-Identifier: MIT
// Files that are broken, files that are no scene, characters of all kinds, and leaving.
#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

class Files : public WindowTest {
 protected:
  // A note that something went wrong, in the window.
  bool told_of_error() {
    for (const auto& widget : editor().widgets())
      if (widget.kind == "toast" || widget.kind == "error") return true;
    return false;
  }
  // Opens by the dialog and expects an error, with what was open left as it was.
  void expect_refused(const std::filesystem::path& file) {
    editor().key("ctrl+o");
    take_path(file);
    EXPECT_TRUE(editor().wait([&] { return told_of_error(); })) << file << " is taken silently";
    EXPECT_TRUE(editor().running()) << file;
    EXPECT_EQ(editor().value("Menu/Document").substr(0, 9), "mannequin") << file;
    EXPECT_TRUE(editor().find("Outliner/Left arm")) << file;
    // It stays until it is clicked; the next one is to be seen for itself.
    for (int tries = 0; tries < 5 && told_of_error(); ++tries) {
      for (const auto& widget : editor().widgets())
        if (widget.kind == "toast") {
          editor().click(widget.middle());
          break;
        }
      editor().wait([&] { return !told_of_error(); }, 2);
    }
    ASSERT_FALSE(told_of_error());
  }
};

TEST_F(Files, WhatCannotBeReadIsToldAndLeavesTheDocument) {
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/Left arm"));
  const std::string whole = bytes_of(kDemo / demo::kMannequinFile);
  std::ofstream(folder_ / "no_gltf.glb") << "this is no glTF";
  std::ofstream(folder_ / "cut.glb", std::ios::binary) << whole.substr(0, whole.size() / 3);
  std::ofstream(folder_ / "broken.elbow") << "{\"version\": 1, \"scene\": ";
  std::ofstream(folder_ / "empty.gltf") << "";
  for (const char* name : {"no_gltf.glb", "cut.glb", "broken.elbow", "empty.gltf"})
    expect_refused(folder_ / name);
  editor().picture("refused");

  // Leaving with something unsaved asks first.
  ASSERT_TRUE(editor().click("Outliner/Left arm"));
  editor().key("t");
  ASSERT_TRUE(editor().wait_for("Hand target"));
  editor().key("ctrl+q");
  ASSERT_TRUE(editor().wait_for_words("Save changes"));
  editor().picture("unsaved");
  EXPECT_TRUE(editor().running());
  editor().key("Escape");
  ASSERT_TRUE(editor().wait([&] { return !editor().shows("Save changes"); }));
  EXPECT_TRUE(editor().find("Hand target"));
  editor().key("ctrl+q");
  ASSERT_TRUE(editor().wait_for_words("Save changes"));
  for (const auto& widget : editor().widgets())
    if (widget.kind == "button" && widget.path.find("/Discard") != std::string::npos) {
      editor().click(widget.middle());
      break;
    }
  EXPECT_EQ(editor().ended(), 0);
}

TEST_F(Files, MalformedSamples) {
  const auto samples = samples_dir();
  if (samples.empty()) GTEST_SKIP() << samples_missing();
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/Left arm"));
  int tried = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(samples / "malformed")) {
    if (entry.path().extension() != ".glb" && entry.path().extension() != ".gltf") continue;
    if (++tried > 4) break;
    editor().key("ctrl+o");
    take_path(entry.path());
    EXPECT_TRUE(editor().settle()) << entry.path();
    ASSERT_TRUE(editor().running()) << entry.path();
    editor().key("ctrl+o");
    ASSERT_TRUE(editor().wait_for("Path")) << entry.path() << " leaves the window deaf";
    editor().key("Escape");
    ASSERT_TRUE(editor().wait([&] { return !editor().find("Path"); }));
  }
  EXPECT_GT(tried, 0);
}

struct Sample {
  const char* name;
  const char* file;
};

class Characters : public Files, public testing::WithParamInterface<Sample> {};

TEST_P(Characters, Open) {
  const auto samples = samples_dir();
  if (samples.empty()) GTEST_SKIP() << samples_missing();
  const auto file = samples / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << GetParam().file;
  const auto model = read_gltf(file);
  ASSERT_TRUE(model.ok());
  const auto findings = find_limbs(**model, (*model)->characters.at(0));
  ASSERT_TRUE(editor().start({file.string()})) << editor().said();
  ASSERT_TRUE(editor().wait_for("Viewport/Picture"));
  EXPECT_EQ(editor().value("Menu/Document"), file.stem().string());
  for (const char* limb : {"Left arm", "Right arm", "Left leg", "Right leg"}) {
    std::string id = limb;
    std::replace(id.begin(), id.end(), ' ', '_');
    id[0] = static_cast<char>(id[0] + 'a' - 'A');
    const bool known = std::any_of(findings.limbs.begin(), findings.limbs.end(),
                                   [&](const Limb& own) { return own.name == id; });
    EXPECT_EQ(editor().find("Outliner/" + std::string(limb)).has_value(), known) << limb;
  }
  editor().key("space");
  EXPECT_TRUE(
      editor().wait([&] { return std::atof(editor().value("Timeline/Time").c_str()) > 0.1; }));
  editor().key("space");
  EXPECT_TRUE(editor().settle());
  editor().picture(std::string("sample_") + GetParam().name);
  editor().key("ctrl+q");
  EXPECT_EQ(editor().ended(), 0);
}

INSTANTIATE_TEST_SUITE_P(Samples, Characters,
                         testing::Values(Sample{"CesiumMan", "humanoids/khronos/CesiumMan.glb"},
                                         Sample{"Knight", "humanoids/kaykit/Knight.glb"},
                                         Sample{"RobotExpressive",
                                                "humanoids/quaternius/RobotExpressive.glb"}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(Files, AnObjectAloneIsToldToBeNoCharacter) {
  ASSERT_TRUE(editor().start({(kDemo / demo::kPostsFile).string()})) << editor().said();
  EXPECT_TRUE(editor().wait_for_words("no character")) << editor().said();
  editor().picture("object_alone");
  EXPECT_TRUE(editor().running());
  editor().key("ctrl+q");
  EXPECT_EQ(editor().ended(), 0);
}

}  // namespace
}  // namespace elbowroom::test
