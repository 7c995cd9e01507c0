// SPDX-License-Identifier: MIT
// A sampling interval is changed by its handles, its bar, keys and typing; each is one edit.
#include "ui/toolkit/range_slider.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/gui/driver/ui_driver.h"
#include "ui/toolkit/layout.h"

namespace elbowroom {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

class RangeSlider : public testing::Test {
 protected:
  RangeSlider() : driver(600, 300) {
    model.limit_low = -20 * kDegree;
    model.limit_high = 170 * kDegree;
    model.low = model.default_low = 85 * kDegree;
    model.high = model.default_high = 140 * kDegree;
    model.current = 100 * kDegree;
    driver.show([this](Ui& ui) {
      const Panel panel(ui, "Limb", {{0, 0}, {400, 300}});
      const Edit edit = range_slider(ui, "Shoulder, raise", model);
      began += edit.began;
      committed += edit.committed;
      cancelled += edit.cancelled;
      changed += edit.changed;
    });
  }
  double low() const { return model.low / kDegree; }
  double high() const { return model.high / kDegree; }

  UiDriver driver;
  RangeModel model;
  int began = 0, committed = 0, cancelled = 0, changed = 0;
};

TEST_F(RangeSlider, ShowsDegrees) {
  EXPECT_EQ(driver.value("Shoulder, raise"), "85° – 140°");
  EXPECT_EQ(driver.value("Shoulder, raise.low"), "85°");
  EXPECT_EQ(changed + committed + began, 0);
}

TEST_F(RangeSlider, AHandleIsDraggedInOneEdit) {
  driver.drag("Shoulder, raise.low", {-60, 0}, 12);
  EXPECT_LT(low(), 70);
  EXPECT_NEAR(high(), 140, 1e-9);
  EXPECT_NEAR(low(), std::round(low()), 1e-9);  // whole degrees, as shown
  EXPECT_EQ(began, 1);
  EXPECT_EQ(committed, 1);
  EXPECT_GT(changed, 3);
}

TEST_F(RangeSlider, TheBarMovesBothAndKeepsTheLength) {
  driver.drag("Shoulder, raise.bar", {-70, 0});
  EXPECT_NEAR(high() - low(), 55, 1e-9);
  EXPECT_LT(high(), 120);
  EXPECT_EQ(committed, 1);
  driver.drag("Shoulder, raise.bar", {500, 0});
  EXPECT_NEAR(high(), 170, 1e-9);  // at the limit, still as long
  EXPECT_NEAR(high() - low(), 55, 1e-9);
  EXPECT_EQ(committed, 2);
}

TEST_F(RangeSlider, HandlesStopAtEachOtherAndAtTheLimits) {
  driver.drag("Shoulder, raise.low", {500, 0});
  EXPECT_NEAR(low(), 140, 1e-9);
  driver.drag("Shoulder, raise.high", {500, 0});
  EXPECT_NEAR(high(), 170, 1e-9);
  driver.drag("Shoulder, raise.low", {-800, 0});
  EXPECT_NEAR(low(), -20, 1e-9);
}

TEST_F(RangeSlider, HandlesThatMeetAtALimitComeApartAgain) {
  model.low = model.high = 170 * kDegree;
  driver.frame();
  driver.drag("Shoulder, raise.high", {-50, 0});
  EXPECT_LT(low(), 160);
  EXPECT_NEAR(high(), 170, 1e-9);
}

TEST_F(RangeSlider, EscapePutsADragBack) {
  driver.move_to("Shoulder, raise.high");
  driver.press();
  const ImVec2 at = driver.centre("Shoulder, raise.high");
  driver.move_to({at.x - 40, at.y});
  EXPECT_LT(high(), 130);
  driver.key(keys::kEscape);
  EXPECT_NEAR(high(), 140, 1e-9);
  driver.move_to({at.x - 80, at.y});
  driver.release();
  EXPECT_NEAR(high(), 140, 1e-9);
  EXPECT_EQ(cancelled, 1);
  EXPECT_EQ(committed, 0);
}

TEST_F(RangeSlider, ADoubleClickResets) {
  model.low = 0;
  model.high = 20 * kDegree;
  driver.frame();
  driver.double_click("Shoulder, raise.bar");
  EXPECT_NEAR(low(), 85, 1e-9);
  EXPECT_NEAR(high(), 140, 1e-9);
  EXPECT_EQ(committed, 1);
}

TEST_F(RangeSlider, ValuesAreTyped) {
  driver.double_click("Shoulder, raise.value");
  driver.frame(2);
  driver.type("20 – 95,5°");
  driver.key(keys::kEnter);
  EXPECT_NEAR(low(), 20, 1e-6);
  EXPECT_NEAR(high(), 95.5, 1e-6);
  EXPECT_EQ(committed, 1);
  EXPECT_EQ(driver.value("Shoulder, raise"), "20° – 96°");
}

TEST_F(RangeSlider, TypedTheWrongWayRoundOrBeyondTheLimitsIsPutRight) {
  driver.double_click("Shoulder, raise.value");
  driver.frame(2);
  driver.type("900 -900");
  driver.key(keys::kEnter);
  EXPECT_NEAR(low(), -20, 1e-6);
  EXPECT_NEAR(high(), 170, 1e-6);
}

TEST_F(RangeSlider, TypedNonsenseAndEscapeChangeNothing) {
  for (const char* text : {"soon", "12", "nan inf", "1 2 3"}) {
    driver.double_click("Shoulder, raise.value");
    driver.frame(2);
    driver.type(text);
    driver.key(keys::kEnter);
    EXPECT_NEAR(low(), 85, 1e-9) << text;
  }
  driver.double_click("Shoulder, raise.value");
  driver.frame(2);
  driver.type("1 2");
  driver.key(keys::kEscape);
  EXPECT_NEAR(low(), 85, 1e-9);
  EXPECT_EQ(committed, 0);
}

TEST_F(RangeSlider, ArrowsMoveTheHandleLastUsed) {
  driver.click("Shoulder, raise.low");
  driver.key(keys::kRight);
  EXPECT_NEAR(low(), 86, 1e-6);
  driver.key(keys::kUp);
  driver.key(keys::kLeft, {.control = true});
  EXPECT_NEAR(high(), 130, 1e-6);
  EXPECT_EQ(committed, 2);
  driver.key(keys::kHome);
  EXPECT_NEAR(low(), 85, 1e-9);
}

TEST_F(RangeSlider, SaysWhatAClickWouldDo) {
  driver.move_to("Shoulder, raise.low");
  driver.frame();
  EXPECT_NE(driver.hint().find("Drag"), std::string::npos);
  EXPECT_EQ(driver.cursor(), ImGuiMouseCursor_ResizeEW);
}

TEST(RangeModel, HostileValuesArePutRight) {
  for (const double a : {kNone, kInfinite, -kInfinite, 0.0, 5.0, -5.0, 1e300}) {
    for (const double b : {kNone, kInfinite, -2.0, 0.0, 1e300}) {
      RangeModel m;
      m.limit_low = a;
      m.limit_high = b;
      m.low = b;
      m.high = a;
      m.default_low = m.track_low = a;
      m.default_high = m.track_high = b;
      m.current = a;
      put_right(m);
      EXPECT_LE(m.limit_low, m.low);
      EXPECT_LE(m.low, m.high);
      EXPECT_LE(m.high, m.limit_high);
      EXPECT_LT(m.track_low, m.track_high);
      EXPECT_LE(m.default_low, m.default_high);
      EXPECT_TRUE(!m.current || std::isfinite(*m.current));
    }
  }
}

TEST(RangeModel, HostileValuesAreDrawn) {
  UiDriver driver(300, 200);
  RangeModel m;
  m.limit_low = m.limit_high = m.low = m.high = m.track_low = kNone;
  m.current = kInfinite;
  driver.show([&](Ui& ui) {
    const Panel panel(ui, "P", {{0, 0}, {60, 200}});
    range_slider(ui, "a", m, {.shown_per_value = kNone});
    range_slider(ui, "", m, {.decimals = -5, .key_step = kNone});
  });
  driver.drag("a", {40, 0});
  EXPECT_TRUE(std::isfinite(m.low) && std::isfinite(m.high));
}

}  // namespace
}  // namespace elbowroom
