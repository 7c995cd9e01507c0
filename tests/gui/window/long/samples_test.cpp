// SPDX-License-Identifier: MIT
// The window on files that nobody here made: broken ones, one after the other, and characters.
#include "tests/gui/window/driver/window_test.h"

namespace elbowroom::test {
namespace {

class SampleFiles : public WindowTest {};

TEST_F(SampleFiles, Malformed) {
  const auto samples = samples_dir();
  if (samples.empty()) GTEST_SKIP() << samples_missing();
  ASSERT_TRUE(editor().start()) << editor().said();
  ASSERT_TRUE(editor().wait_for("Outliner/Left arm"));
  int tried = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(samples / "malformed")) {
    if (entry.path().extension() != ".glb" && entry.path().extension() != ".gltf") continue;
    ++tried;
    editor().key("ctrl+o");
    take_path(entry.path());
    EXPECT_TRUE(editor().settle()) << entry.path();
    discard_if_asked();  // a character opens in place of what is there, which has changed
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

void PrintTo(const Sample& one, std::ostream* out) { *out << one.file; }

class Characters : public WindowTest, public testing::WithParamInterface<Sample> {};

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

}  // namespace
}  // namespace elbowroom::test
