// SPDX-License-Identifier: MIT
// What the mouse does on the timeline comes out as events, each drag with one commit.
#include "ui/toolkit/timeline.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "tests/gui/driver/ui_driver.h"
#include "ui/toolkit/layout.h"
#include "ui/toolkit/timeline_layout.h"

namespace elbowroom {
namespace {

using Kind = TimelineEvent::Kind;
using Phase = TimelineEvent::Phase;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

class Timeline : public testing::Test {
 protected:
  Timeline() : driver(1200, 400) {
    model.end = 6;
    model.time = 1;
    model.rows = {{"Right arm", true, true, {{2.0, 2.5, 2.2, {0, 1, 0}}, {4, 4.4, 4.2, {}}}, {}},
                  {"Left arm", true, false, {}, {}}};
    model.window = TimelineWindow{1.5, 3, 0};
    model.marks = {{5, "grab hat"}, {5.5, "fixed", Icon::diamond, false, false}};
    model.curves = {{"after", {{0, 0.1}, {3, 0.03}, {6, 0.1}}}};
    driver.show([this](Ui& ui) {
      const Panel panel(ui, "Time", {{0, 0}, {1200, 400}}, {.padded = false, .scrolls = false});
      for (const TimelineEvent& event : timeline(ui, "timeline", model, view)) {
        events.push_back(event);
        // As an editor does: the model follows.
        if (event.kind == Kind::scrub_to) model.time = event.time;
        if (event.kind == Kind::window_changed) {
          model.window->begin = event.begin;
          model.window->end = event.end;
        }
        if (event.kind == Kind::mark_moved) {
          model.marks[static_cast<std::size_t>(event.mark)].time = event.time;
        }
      }
    });
  }
  double x_of(double t) {
    const TimelineLayout layout =
        lay_out(driver.ui(), model, view, {{0, 0}, {1200, 400}}, TimelineOptions().label_width);
    return static_cast<double>(layout.scale.x_of(t));
  }
  ImVec2 on_row(double t, const char* row) {
    return {static_cast<float>(x_of(t)), driver.centre(row).y};
  }
  int count(Kind kind, Phase phase) const {
    int n = 0;
    for (const TimelineEvent& e : events) n += e.kind == kind && e.phase == phase;
    return n;
  }

  UiDriver driver;
  TimelineModel model;
  TimelineView view;
  std::vector<TimelineEvent> events;
};

TEST_F(Timeline, ScrubsInOneEdit) {
  const float y = driver.centre("timeline.ruler").y;
  driver.drag({static_cast<float>(x_of(1)), y}, {static_cast<float>(x_of(4)), y});
  EXPECT_NEAR(model.time, 4, 0.02);
  EXPECT_EQ(count(Kind::scrub_to, Phase::began), 1);
  EXPECT_EQ(count(Kind::scrub_to, Phase::committed), 1);
  EXPECT_GT(count(Kind::scrub_to, Phase::changing), 3);
}

TEST_F(Timeline, AClickOnTheRulerGoesThereAtOnce) {
  driver.click({static_cast<float>(x_of(5)), driver.centre("timeline.ruler").y});
  EXPECT_NEAR(model.time, 5, 0.01);
  EXPECT_EQ(count(Kind::scrub_to, Phase::committed), 1);
}

TEST_F(Timeline, ScrubbingStopsAtTheClipsEnds) {
  const float y = driver.centre("timeline.ruler").y;
  driver.drag({static_cast<float>(x_of(1)), y}, {-500, y});
  EXPECT_EQ(model.time, 0);
  driver.drag({static_cast<float>(x_of(1)), y}, {5000, y});
  EXPECT_EQ(model.time, 6);
}

TEST_F(Timeline, SnapsToFrames) {
  model.snap = true;
  driver.click({static_cast<float>(x_of(3.218)), driver.centre("timeline.ruler").y});
  EXPECT_NEAR(model.time * 30, std::round(model.time * 30), 1e-9);
}

TEST_F(Timeline, EscapePutsTheScrubBack) {
  driver.move_to({static_cast<float>(x_of(4)), driver.centre("timeline.ruler").y});
  driver.press();
  EXPECT_NEAR(model.time, 4, 0.01);
  driver.key(keys::kEscape);
  EXPECT_NEAR(model.time, 1, 1e-12);
  driver.release();
  EXPECT_EQ(count(Kind::scrub_to, Phase::cancelled), 1);
  EXPECT_EQ(count(Kind::scrub_to, Phase::committed), 0);
}

TEST_F(Timeline, ABumpIsClickedEvenUnderTheWindow) {
  driver.click("timeline.row.Right arm.bump.0");
  driver.click("timeline.row.Right arm.bump.1");
  ASSERT_EQ(count(Kind::bump_clicked, Phase::committed), 2);
  EXPECT_EQ(events[0].row, 0);
  EXPECT_EQ(events[0].bump, 0);
  EXPECT_EQ(events[1].bump, 1);
  EXPECT_EQ(events.size(), 2u);
}

TEST_F(Timeline, ABumpIsDoubleClicked) {
  driver.double_click("timeline.row.Right arm.bump.1");
  EXPECT_EQ(count(Kind::bump_double_clicked, Phase::committed), 1);
}

TEST_F(Timeline, TheWindowsHandlesMoveOneEnd) {
  const ImVec2 low = driver.centre("timeline.window.low");
  driver.drag(low, {low.x + static_cast<float>(x_of(2) - x_of(1.5)), low.y});
  EXPECT_NEAR(model.window->begin, 2, 0.02);
  EXPECT_EQ(model.window->end, 3);
  driver.drag("timeline.window.high", {100, 0});
  EXPECT_GT(model.window->end, 3.3);
  EXPECT_EQ(count(Kind::window_changed, Phase::began), 2);
  EXPECT_EQ(count(Kind::window_changed, Phase::committed), 2);
}

TEST_F(Timeline, TheWindowsEndsDoNotCross) {
  driver.drag("timeline.window.low", {2000, 0});
  EXPECT_LT(model.window->begin, model.window->end);
  driver.drag("timeline.window.high", {-3000, 0});
  EXPECT_LT(model.window->begin, model.window->end);
  EXPECT_NEAR(model.window->end - model.window->begin, 1 / 30.0, 1e-6);
}

TEST_F(Timeline, TheBandMovesWholeAndStaysInTheClip) {
  driver.drag(on_row(2.8, "timeline.row.Right arm"), on_row(3.8, "timeline.row.Right arm"));
  EXPECT_NEAR(model.window->begin, 2.5, 0.02);
  EXPECT_NEAR(model.window->end - model.window->begin, 1.5, 1e-9);
  driver.drag("timeline.window.band", {3000, 0});
  EXPECT_NEAR(model.window->end, 6, 1e-9);
  EXPECT_NEAR(model.window->end - model.window->begin, 1.5, 1e-9);
}

TEST_F(Timeline, AWindowIsDrawnOnAnEmptyRow) {
  driver.drag(on_row(4, "timeline.row.Left arm"), on_row(3, "timeline.row.Left arm"));
  ASSERT_EQ(count(Kind::window_drawn, Phase::committed), 1);
  EXPECT_EQ(events.back().row, 1);
  EXPECT_NEAR(events.back().begin, 3, 0.02);
  EXPECT_NEAR(events.back().end, 4, 0.02);
}

TEST_F(Timeline, ARowIsClicked) {
  driver.click(on_row(0.5, "timeline.row.Left arm"));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::row_clicked);
  EXPECT_EQ(events[0].row, 1);
  driver.click({30, driver.centre("timeline.row.Right arm").y});  // its label
  EXPECT_EQ(events.back().row, 0);
}

TEST_F(Timeline, AMarkIsMovedOrClickedAndAFixedOneOnlyClicked) {
  driver.drag("timeline.mark.0", {-100, 0});
  EXPECT_LT(model.marks[0].time, 4.8);
  EXPECT_EQ(count(Kind::mark_moved, Phase::committed), 1);
  driver.click("timeline.mark.0");
  EXPECT_EQ(count(Kind::mark_clicked, Phase::committed), 1);
  driver.drag("timeline.mark.1", {-100, 0});
  EXPECT_EQ(model.marks[1].time, 5.5);
}

TEST_F(Timeline, TheWheelZoomsAboutThePointer) {
  const ImVec2 at{static_cast<float>(x_of(2)), driver.centre("timeline.ruler").y};
  driver.move_to(at);
  driver.wheel(5);
  EXPECT_LT(view.to - view.from, 3);
  EXPECT_NEAR(x_of(2), static_cast<double>(at.x), 1);
  driver.key(keys::kHome);
  EXPECT_EQ(view.from, view.to);  // the whole clip
  for (int i = 0; i < 200; ++i) driver.wheel(5);
  EXPECT_GE(view.to - view.from, 1.9 / 30);
  for (int i = 0; i < 200; ++i) driver.wheel(-5);
  EXPECT_LE(view.to - view.from, 9.1);
}

TEST_F(Timeline, TheMiddleButtonPans) {
  const float y = driver.centre("timeline.ruler").y;
  driver.drag({600, y}, {500, y}, 8, 2);
  EXPECT_GT(view.from, 0.3);
  EXPECT_TRUE(events.empty());
}

TEST_F(Timeline, ARowThatGoesAwayWhileDraggedTakesTheDragWithIt) {
  driver.move_to(on_row(0.5, "timeline.row.Left arm"));
  driver.press();
  driver.move_to(on_row(1.0, "timeline.row.Left arm"));
  model.rows.clear();
  model.window.reset();
  model.marks.clear();
  driver.frame(3);
  driver.release();
  EXPECT_EQ(count(Kind::window_drawn, Phase::committed), 0);
}

TEST_F(Timeline, HostileModelsAreDrawn) {
  for (const double bad : {kNone, kInfinite, -kInfinite, 1e300, -1e300}) {
    model.begin = bad;
    model.end = -bad;
    model.frame_rate = bad;
    model.time = bad;
    model.window = TimelineWindow{bad, 1, 7};
    model.rows[0].bumps = {{bad,
                            1,
                            bad,
                            {std::numeric_limits<float>::quiet_NaN(), 2, -1},
                            std::numeric_limits<float>::quiet_NaN()},
                           {3, 2, 2, {}}};
    model.rows[0].computing = bad;
    model.marks = {{bad, "x"}};
    model.curves = {{"c", {{bad, 1}, {0, bad}, {1, 1}, {0.5, 2}}, true}};
    model.threshold = bad;
    model.key_times = {bad, 1};
    view.from = bad;
    view.to = 1;
    view.row_scroll = static_cast<float>(bad);
    driver.frame(2);
    driver.drag({400, 50}, {600, 50});
    driver.move_to({500, 12});
    driver.wheel(3);
    for (const TimelineEvent& event : events) {
      EXPECT_TRUE(std::isfinite(event.time) && std::isfinite(event.begin));
    }
  }
}

TEST_F(Timeline, AHundredThousandSamplesAreDrawnInAFewMilliseconds) {
  model.curves[0].samples.clear();
  for (int i = 0; i < 100000; ++i) {
    model.curves[0].samples.push_back({6.0 * i / 100000, std::sin(i * 0.01)});
  }
  for (int i = 0; i < 20000; ++i) model.key_times.push_back(6.0 * i / 20000);
  driver.frame();
  const auto start = std::chrono::steady_clock::now();
  driver.frame(10);
  const auto taken = std::chrono::steady_clock::now() - start;
  // About 1 ms measured; ten times that is a mistake, not a busy machine.
  EXPECT_LT(std::chrono::duration<double>(taken).count() / 10, 0.02);
  EXPECT_LT(driver.draw_data()->TotalVtxCount, 60000);
}

TEST(TimelineScale, TicksAreReadableAtEveryZoom) {
  for (const bool frames : {false, true}) {
    for (double length = 0.02; length < 1e5; length *= 3) {
      const TimeScale scale{{0.37, 0.37 + length}, 0, 1000};
      const auto ticks = ticks_of(scale, 0, 30, frames, 80);
      EXPECT_LE(ticks.size(), 200u);
      double last = -1e9;
      std::string before;
      for (const Tick& tick : ticks) {
        EXPECT_GE(tick.time, 0.37 - 1e-9);
        EXPECT_LE(tick.time, 0.37 + length + 1e-9);
        if (!tick.major) continue;
        EXPECT_GE((tick.time - last) / scale.seconds_a_pixel(), 79.9);
        EXPECT_NE(tick.label, before) << length;  // enough decimals
        last = tick.time;
        before = tick.label;
      }
    }
  }
}

// In the least height everything is there whole, at every scale.
TEST(TimelineLayout, TheLeastHeightHoldsRowsMarksAndCurves) {
  for (const double scale : {0.75, 1.0, 1.25, 2.0, 3.0}) {
    UiDriver driver(1200, 900, scale);
    TimelineModel model;
    for (int rows = 1; rows <= 6; ++rows) {
      model.rows.push_back({"Limb " + std::to_string(rows)});
      const float height = driver.ui().px(least_timeline_height(rows));
      const TimelineLayout layout =
          lay_out(driver.ui(), model, {}, {{0, 0}, {1200, height}}, TimelineOptions().label_width);
      EXPECT_EQ(layout.most_scroll, 0);
      if (rows > 1) {
        EXPECT_GE(layout.rows[1].min.y - layout.rows[0].min.y,
                  driver.ui().fonts().regular->FontSize);
      }
      EXPECT_LE(layout.rows.back().max.y, layout.marks.min.y);
      EXPECT_GE(layout.marks.height(), driver.ui().fonts().regular->FontSize);
      EXPECT_GE(layout.curves.height(), driver.ui().fonts().regular->FontSize);
      EXPECT_LE(layout.curves.max.y, height);
    }
  }
}

TEST(TimelineLayout, RowsThatDoNotFitScrollByTheirBar) {
  UiDriver driver(800, 200);
  TimelineModel model;
  for (int i = 0; i < 20; ++i) model.rows.push_back({"Limb " + std::to_string(i)});
  TimelineView view;
  driver.show([&](Ui& ui) {
    const Panel panel(ui, "Time", {{0, 0}, {800, 200}}, {.padded = false, .scrolls = false});
    EXPECT_TRUE(timeline(ui, "timeline", model, view).empty()) << "scrolling is no edit";
  });
  driver.frame(2);
  const auto in_sight = [&](int row) {
    const TimelineLayout layout =
        lay_out(driver.ui(), model, view, {{0, 0}, {800, 200}}, TimelineOptions().label_width);
    const Rect& place = layout.rows[static_cast<std::size_t>(row)];
    return place.min.y >= layout.row_area.min.y && place.max.y <= layout.row_area.max.y;
  };
  EXPECT_TRUE(in_sight(0));
  EXPECT_FALSE(in_sight(19));
  driver.drag("timeline.scroll", {0, 300});
  EXPECT_TRUE(in_sight(19));
  EXPECT_FALSE(in_sight(0));
  driver.drag("timeline.scroll", {0, -300});
  EXPECT_TRUE(in_sight(0));
  driver.move_to(ImVec2{20, 60});
  for (int i = 0; i < 20; ++i) driver.wheel(-1);
  EXPECT_TRUE(in_sight(19));
}

}  // namespace
}  // namespace elbowroom
