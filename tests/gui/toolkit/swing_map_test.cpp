// SPDX-License-Identifier: MIT
// A swing's limit is drawn as a map; corners of a polygon are dragged, added and taken away, each
// in one edit.
#include "ui/toolkit/swing_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/gui/driver/ui_driver.h"
#include "ui/toolkit/layout.h"

namespace elbowroom {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

class SwingMapTest : public testing::Test {
 protected:
  SwingMapTest() : driver(600, 500) {
    for (int i = 0; i < 64; ++i) {
      const double angle = 2 * std::numbers::pi * i / 64;
      own.push_back({100 * kDegree * std::cos(angle), 80 * kDegree * std::sin(angle)});
    }
    clip = {{0, 0}, {0.2, 0.1}, {std::nan(""), 0}, {2.5, 0}};
    polygon = {{80 * kDegree, 0}, {0, 70 * kDegree}, {-80 * kDegree, 0}, {0, -70 * kDegree}};
    driver.show([this](Ui& ui) {
      const Panel panel(ui, "Limb", {{0, 0}, {320, 500}});
      SwingMap map;
      map.up = "up";
      map.across = "forward";
      map.own = own;
      map.clip = clip;
      map.marks = {{"ahead", {0.3, 0.5}}};
      map.value = {0.1, 0.2};
      map.polygon = polygon;
      const Edit edit = swing_map(ui, "Map", map);
      began += edit.began;
      committed += edit.committed;
      cancelled += edit.cancelled;
      if (edit || edit.cancelled) polygon = map.polygon;
    });
    driver.frame(2);
  }
  double degrees(std::size_t corner, std::size_t axis) const {
    return polygon[corner][axis] / kDegree;
  }

  UiDriver driver;
  std::vector<std::array<double, 2>> own, clip;
  SwingPolygon polygon;
  int began = 0, committed = 0, cancelled = 0;
};

TEST_F(SwingMapTest, ShowsWhereThingsAre) {
  EXPECT_EQ(driver.value("Map"), "4 corners");
  EXPECT_EQ(driver.value("Map.corner.0"), "up 80°, forward 0°");
  EXPECT_EQ(driver.value("Map.value"), "up 6°, forward 11°");
  // Up is up, across is to the right, both of one scale.
  const ImVec2 top = driver.centre("Map.corner.0"), right = driver.centre("Map.corner.1");
  const ImVec2 bottom = driver.centre("Map.corner.2"), left = driver.centre("Map.corner.3");
  EXPECT_LT(top.y, bottom.y - 50);
  EXPECT_GT(right.x, left.x + 50);
  EXPECT_NEAR((bottom.y - top.y) / 160, (right.x - left.x) / 140, 0.02);
  polygon.clear();
  driver.frame(2);
  EXPECT_EQ(driver.value("Map"), "own limit");
  EXPECT_FALSE(driver.has("Map.corner.0"));
}

TEST_F(SwingMapTest, ACornerIsDraggedInOneEdit) {
  const float per_degree =
      (driver.centre("Map.corner.2").y - driver.centre("Map.corner.0").y) / 160;
  driver.drag("Map.corner.0", {20 * per_degree, -10 * per_degree}, 10);
  EXPECT_NEAR(degrees(0, 0), 90, 1);
  EXPECT_NEAR(degrees(0, 1), 20, 1);
  EXPECT_EQ(began, 1);
  EXPECT_EQ(committed, 1);
  EXPECT_EQ(cancelled, 0);
  EXPECT_EQ(polygon.size(), 4u);
}

TEST_F(SwingMapTest, ACornerStopsWhereItWouldBeNone) {
  driver.drag("Map.corner.0", {0, 400}, 10);
  EXPECT_TRUE(make_swing_polygon(0, 1, polygon).ok());
  EXPECT_EQ(polygon.size(), 4u);
  EXPECT_GT(degrees(0, 0), 0);
  EXPECT_LT(degrees(0, 0), 5);
  EXPECT_EQ(committed, 1);
}

TEST_F(SwingMapTest, EscapePutsItBack) {
  const SwingPolygon before = polygon;
  const ImVec2 from = driver.centre("Map.corner.1");
  driver.move_to(from);
  driver.press();
  for (int i = 1; i <= 5; ++i) {
    ImGui::GetIO().MousePos = {from.x - 6.0f * static_cast<float>(i), from.y};
    driver.frame();
  }
  EXPECT_NE(polygon, before);
  driver.key(keys::kEscape);
  driver.release();
  EXPECT_EQ(polygon, before);
  EXPECT_EQ(committed, 0);
  EXPECT_EQ(cancelled, 1);
}

TEST_F(SwingMapTest, AnEdgeGivesAnotherCornerByClickAndByDrag) {
  driver.click("Map.edge.0");
  ASSERT_EQ(polygon.size(), 5u);
  EXPECT_EQ(committed, 1);
  EXPECT_TRUE(make_swing_polygon(0, 1, polygon).ok());
  driver.frame(2);
  driver.wait(1);
  driver.drag("Map.edge.2", {15, 15}, 8);
  EXPECT_EQ(polygon.size(), 6u);
  EXPECT_EQ(committed, 2);
  EXPECT_EQ(began, 1);
}

TEST_F(SwingMapTest, ARightClickTakesACornerAway) {
  driver.click("Map.edge.0");
  ASSERT_EQ(polygon.size(), 5u);
  driver.wait(1);
  driver.click("Map.corner.1", 1);
  EXPECT_EQ(polygon.size(), 4u);
  EXPECT_EQ(committed, 2);
  // Three would not go round the zero pose with room: it stays, and that is said.
  polygon = {{1, 0}, {-0.5, 0.8}, {-0.5, -0.8}};
  driver.frame(2);
  driver.wait(1);
  driver.click("Map.corner.1", 1);
  EXPECT_EQ(polygon.size(), 3u);
  EXPECT_EQ(committed, 2);
  EXPECT_FALSE(driver.ui().toasts().empty());
}

TEST_F(SwingMapTest, ArrowsMoveTheCornerThatWasClicked) {
  driver.click("Map.corner.1");
  EXPECT_EQ(committed, 0);
  driver.key(keys::kRight);
  EXPECT_NEAR(degrees(1, 1), 71, 1e-6);
  driver.key(keys::kUp, {.shift = true});
  EXPECT_NEAR(degrees(1, 0), 0.1, 1e-6);
  EXPECT_EQ(committed, 2);
  // A click elsewhere gives the keys back.
  driver.click(ImVec2{500, 450});
  driver.key(keys::kRight);
  EXPECT_EQ(committed, 2);
}

TEST_F(SwingMapTest, StandsWhatIsNoPlace) {
  own = {{std::nan(""), 0}, {INFINITY, 1}, {1e300, -1e300}};
  polygon.clear();
  driver.frame(3);
  EXPECT_TRUE(driver.has("Map"));
  own.clear();
  clip.clear();
  driver.frame(3);
  EXPECT_TRUE(driver.has("Map"));
}

}  // namespace
}  // namespace elbowroom
