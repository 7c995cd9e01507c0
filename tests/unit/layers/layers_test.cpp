// SPDX-License-Identifier: MIT
// The arrow app → ui → render → core has one direction, the judge shares nothing with what it
// judges, and every source file names its licence.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = ELBOWROOM_SOURCE_DIR;

struct Include {
  std::string file;  // relative to the root
  std::string name;
};

bool is_source(const fs::path& file) {
  return file.extension() == ".h" || file.extension() == ".cpp";
}

std::vector<fs::path> sources(const std::string& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(kRoot / folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
    if (entry.is_regular_file() && is_source(entry.path())) files.push_back(entry.path());
  return files;
}

std::vector<Include> includes(const std::string& folder) {
  std::vector<Include> found;
  for (const auto& file : sources(folder)) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
      const auto at = line.find("#include");
      if (at == std::string::npos || line.find_first_not_of(" \t") != at) continue;
      const auto open = line.find_first_of("<\"", at);
      const auto close = line.find_first_of(">\"", open + 1);
      if (open != std::string::npos && close != std::string::npos)
        found.push_back(
            {fs::relative(file, kRoot).string(), line.substr(open + 1, close - open - 1)});
    }
  }
  return found;
}

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

void expect_no_include(const std::string& folder, const std::vector<std::string>& forbidden) {
  const auto all = includes(folder);
  EXPECT_FALSE(all.empty()) << folder << " has no includes: is it there?";
  for (const auto& include : all)
    for (const auto& prefix : forbidden)
      EXPECT_FALSE(begins(include.name, prefix)) << include.file << " includes " << include.name;
}

TEST(Layers, CoreKnowsNoWindowAndNoPicture) {
  expect_no_include("core", {"GL/", "GLES", "GLFW/", "epoxy/", "imgui", "EGL/", "render/", "ui/",
                             "app/", "assets/", "tests/"});
}

TEST(Layers, RenderKnowsNoWindow) {
  expect_no_include("render", {"GLFW/", "imgui", "ui/", "app/", "tests/"});
}

TEST(Layers, PanelsKnowNoWindow) {
  expect_no_include("ui", {"GLFW/", "GL/", "epoxy/", "EGL/", "backends/", "app/", "tests/"});
}

TEST(Layers, TheToolkitKnowsNothingOfTheEditor) {
  expect_no_include(
      "ui/toolkit",
      {"core/animation", "core/anatomy", "core/collision", "core/editing", "core/ik", "core/io",
       "core/planning", "core/scene", "render/", "ui/panels", "ui/editor", "ui/commands"});
}

TEST(Layers, ThePlannerKnowsNoCharacter) {
  expect_no_include("core/planning", {"core/animation", "core/scene", "core/anatomy",
                                      "core/collision", "core/editing", "core/io"});
}

TEST(Layers, TheJudgeSharesNothingWithTheCore) {
  for (const auto& include : includes("tests/judge")) {
    if (include.file.find("/test/") != std::string::npos) continue;  // tests of the judge itself
    for (const char* prefix : {"core/", "render/", "app/", "tests/support/"})
      EXPECT_FALSE(begins(include.name, prefix)) << include.file << " includes " << include.name;
  }
}

// Two types of one name in one namespace are one to the linker, which keeps whichever destructor it
// met first; no compiler says so.
TEST(Layers, OneNameIsOneType) {
  std::map<std::string, std::string> file_of;
  const std::regex type("(struct|class) (\\w+)( final)?( : [^{]*)? \\{.*");
  for (const char* folder : {"core", "render", "ui", "app", "assets"})
    for (const auto& file : sources(folder)) {
      std::ifstream in(file);
      const std::string name = fs::relative(file, kRoot).string();
      std::string inner;  // of namespace elbowroom
      bool unnamed = false;
      std::smatch match;
      for (std::string line; std::getline(in, line);) {
        if (line == "namespace {") unnamed = true;
        if (line == "}  // namespace") unnamed = false;
        if (begins(line, "namespace ") && line.back() == '{' && !unnamed)
          inner = line == "namespace elbowroom {" ? "" : line;
        if (unnamed || !std::regex_match(line, match, type)) continue;
        const auto [at, fresh] = file_of.try_emplace(inner + match[2].str(), name);
        EXPECT_TRUE(fresh || at->second == name)
            << match[2] << " is defined in " << at->second << " and in " << name;
      }
    }
  EXPECT_GT(file_of.size(), 200u);
}

TEST(Layers, EverySourceNamesItsLicence) {
  for (const char* folder : {"core", "render", "ui", "app", "assets", "tests"})
    for (const auto& file : sources(folder)) {
      std::ifstream in(file);
      std::string first;
      std::getline(in, first);
      EXPECT_EQ(first, "// SPDX-License-Identifier: MIT") << fs::relative(file, kRoot);
    }
}

}  // namespace
