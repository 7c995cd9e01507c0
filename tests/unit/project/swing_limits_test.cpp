// SPDX-License-Identifier: MIT
// Limbs and swing limits set by hand in the project file: they come back, unknown keys beside them
// survive, what is no polygon is refused with its place and a remedy.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/io/project_file.h"

namespace elbowroom {
namespace {

class SwingLimitsInProjects : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("elbowroom_swings_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    document_.scene.character = folder_ / "ada.glb";
    document_.swing_limits["right_arm"][0] = {{-0.9, -1.2}, {1.1, -1.0 / 3.0}, {0.4, 1.3}};
    document_.swing_limits["right_arm"][2] = {{0.5, 0.5}, {-0.5, 0.5}, {-0.5, -0.5}, {0.5, -0.5}};
    document_.swing_limits["tail"][0] = {{1, 0}, {-1, 1}, {-1, -1}};
    document_.limbs["left_leg"] = {};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path file() const { return folder_ / "p.elbow"; }
  nlohmann::json saved() {
    std::ifstream in(file());
    return nlohmann::json::parse(in);
  }
  void put(const std::string& text) { std::ofstream(file()) << text; }

  std::filesystem::path folder_;
  Document document_;
};

TEST_F(SwingLimitsInProjects, ComeBackToTheBit) {
  ASSERT_TRUE(write_project(file(), document_).ok());
  EXPECT_EQ(saved()["limbs"]["left_leg"], "none");
  EXPECT_EQ(saved()["swing_limits"]["right_arm"]["root"][1][1], -1.0 / 3.0);
  EXPECT_FALSE(saved()["swing_limits"]["right_arm"].contains("middle"));
  const auto read = read_project(file());
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->swing_limits, document_.swing_limits);
  EXPECT_EQ(read->limbs, document_.limbs);
  // The other way round it is the same polygon, put right.
  auto root = saved();
  auto& corners = root["swing_limits"]["right_arm"]["root"];
  std::swap(corners[1], corners[2]);
  put(root.dump());
  const auto turned = read_project(file());
  ASSERT_TRUE(turned.ok()) << turned.error().message();
  EXPECT_EQ(turned->swing_limits, document_.swing_limits);
}

TEST_F(SwingLimitsInProjects, UnknownKeysSurviveAndWhatIsTakenAwayStaysAway) {
  ASSERT_TRUE(write_project(file(), document_).ok());
  auto root = saved();
  root["swing_limits"]["right_arm"]["drawn_by"] = "Ada";
  root["swing_limits"]["left_arm"]["twist_cone"] = {1, 2};
  put(root.dump());
  auto read = read_project(file());
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->swing_limits, document_.swing_limits);
  read->swing_limits.erase("tail");
  read->swing_limits["right_arm"][0].clear();
  read->limbs.clear();
  ASSERT_TRUE(write_project(file(), *read).ok());
  EXPECT_EQ(saved()["swing_limits"]["right_arm"]["drawn_by"], "Ada");
  EXPECT_EQ(saved()["swing_limits"]["left_arm"]["twist_cone"], nlohmann::json({1, 2}));
  EXPECT_FALSE(saved()["swing_limits"]["right_arm"].contains("root"));
  EXPECT_TRUE(saved()["swing_limits"]["right_arm"].contains("end"));
  EXPECT_FALSE(saved()["swing_limits"].contains("tail"));
  const auto again = read_project(file());
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->swing_limits, read->swing_limits);
  EXPECT_TRUE(again->limbs.empty());
}

TEST_F(SwingLimitsInProjects, WhatIsNoPolygonIsRefusedWithPlaceAndRemedy) {
  std::string many = "[";
  for (int i = 0; i < 2000; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 2000;
    many += (i > 0 ? ",[" : "[") + std::to_string(std::cos(angle)) + "," +
            std::to_string(std::sin(angle)) + "]";
  }
  many += "]";
  const std::string cases[] = {
      "[]",
      "[[1, 0], [-1, 0]]",                       // two corners
      "[[1, 0], [-1, 1], [-1, null]]",           // no number
      "[[1, 0], [-1, 1], [-1]]",                 // half a corner
      "[[1, 1], [2, 1], [2, 2]]",                // without the zero pose
      "[[0, 0], [1, 0], [0, 1]]",                // the zero pose on its border
      "[[1, 0], [0.1, 0.1], [0, 1], [-1, -1]]",  // not convex
      "[[1, 0], [-0.8, 0.6], [0.3, -0.95], [0.3, 0.95], [-0.8, -0.6]]",  // a star
      "[[3.2, 0], [0, 1], [-1, -1]]",                                    // half a turn away
      "[[1e308, 0], [0, 1e308], [-1e308, -1e308]]",                      // huge
      "[[1, 0], [1, 0], [1, 0]]",                                        // no area
      many,
      "7",
      "{\"corners\": []}",
  };
  for (const std::string& polygon : cases) {
    put(R"({"version": 1, "scene": {"character": "a.glb"}, "swing_limits": {"left_arm": {"end": )" +
        polygon + "}}}");
    const auto read = read_project(file());
    ASSERT_FALSE(read.ok()) << polygon.substr(0, 80);
    EXPECT_NE(read.error().where.find("p.elbow at /swing_limits/left_arm/end"), std::string::npos)
        << read.error().message();
    EXPECT_FALSE(read.error().what.empty());
    EXPECT_FALSE(read.error().remedy.empty());
  }
  for (const char* limits : {"[]", R"({"left_arm": [[1, 0], [-1, 1], [-1, -1]]})", "3"}) {
    put(std::string(R"({"version": 1, "scene": {"character": "a.glb"}, "swing_limits": )") +
        limits + "}");
    const auto read = read_project(file());
    ASSERT_FALSE(read.ok()) << limits;
    EXPECT_NE(read.error().where.find("/swing_limits"), std::string::npos);
  }
  // Numbers that are none are no JSON.
  for (const char* number : {"NaN", "1e999", "-Infinity"}) {
    put(std::string(R"({"version": 1, "scene": {"character": "a.glb"}, "swing_limits": )") +
        R"({"left_arm": {"end": [[)" + number + ", 0], [0, 1], [-1, -1]]}}}");
    EXPECT_FALSE(read_project(file()).ok()) << number;
  }
}

}  // namespace
}  // namespace elbowroom
