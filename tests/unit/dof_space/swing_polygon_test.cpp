// SPDX-License-Identifier: MIT
// Swing polygons stay polygons, whatever is done to their corners.
#include "core/base/swing_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace elbowroom {
namespace {

SwingPolygon ring(int corners, double up, double across) {
  SwingPolygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / corners;
    polygon.push_back({up * std::cos(angle), across * std::sin(angle)});
  }
  return polygon;
}

TEST(SwingPolygons, AreBelowHalfATurn) {
  EXPECT_TRUE(make_swing_polygon(0, 1, ring(8, 2, 1)).ok());
  const auto far = make_swing_polygon(0, 1, ring(8, 3.2, 1));
  ASSERT_FALSE(far.ok());
  EXPECT_FALSE(far.error().remedy.empty());
  SwingPolygon bad = ring(8, 2, 1);
  bad[3][1] = std::nan("");
  EXPECT_FALSE(make_swing_polygon(0, 1, bad).ok());
  bad[3][1] = INFINITY;
  EXPECT_FALSE(make_swing_polygon(0, 1, bad).ok());
}

TEST(SwingPolygons, ACornerGoesWhereItIsWanted) {
  const SwingPolygon square = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  const SwingPolygon moved = with_corner_moved(square, 0, {1.5, 1.2});
  EXPECT_EQ(moved[0][0], 1.5);
  EXPECT_EQ(moved[0][1], 1.2);
  EXPECT_EQ(moved[1], square[1]);
  // Into the others it stops where it would be no corner: on the line between its neighbours.
  const SwingPolygon pushed = with_corner_moved(square, 0, {-1, -1});
  EXPECT_TRUE(make_swing_polygon(0, 1, pushed).ok());
  EXPECT_NEAR(pushed[0][0] + pushed[0][1], 0, 0.1);
  EXPECT_GT(pushed[0][0] + pushed[0][1], 0);
  // Half a turn is out of reach, and it goes on along that border.
  const SwingPolygon far = with_corner_moved(square, 0, {50, 40});
  EXPECT_LT(std::hypot(far[0][0], far[0][1]), 3.14159);
  EXPECT_GT(std::hypot(far[0][0], far[0][1]), 1.5);
  // What is no place changes nothing.
  EXPECT_EQ(with_corner_moved(square, 0, {std::nan(""), 0}), square);
  EXPECT_EQ(with_corner_moved(square, 4, {1, 1}), square);
  EXPECT_EQ(with_corner_moved(square, -1, {1, 1}), square);
  EXPECT_EQ(with_corner_moved({}, 0, {1, 1}), SwingPolygon{});
}

TEST(SwingPolygons, CornersAreAddedAndTakenAway) {
  const SwingPolygon square = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  const SwingPolygon more = with_corner_added(square, 0, {0, 1.4});
  ASSERT_EQ(more.size(), 5u);
  EXPECT_EQ(more[1][1], 1.4);
  // On the edge itself it would be none: a little outside.
  const SwingPolygon on_edge = with_corner_added(square, 3, {1, 0});
  ASSERT_EQ(on_edge.size(), 5u);
  EXPECT_GT(on_edge[4][0], 1.0);
  EXPECT_LT(on_edge[4][0], 1.05);
  EXPECT_EQ(with_corner_removed(more, 1), square);
  EXPECT_EQ(with_corner_removed({{1, 0}, {-1, 1}, {-1, -1}}, 0).size(), 3u);
  // Three are left that do not go round the zero pose: the corner stays.
  const SwingPolygon thin = {{0.2, 1}, {0.1, -1}, {-1, -1}, {-1, 1}};
  EXPECT_EQ(with_corner_removed(with_corner_removed(thin, 3), 2).size(), 3u);
  EXPECT_EQ(with_corner_added(square, 7, {0, 0}), square);
}

TEST(SwingPolygons, TurnCounterClockwiseWithTheirFirstCornerFirst) {
  const SwingPolygon clockwise = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
  EXPECT_EQ(counter_clockwise(clockwise), (SwingPolygon{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}));
  EXPECT_EQ(counter_clockwise(counter_clockwise(clockwise)), counter_clockwise(clockwise));
  EXPECT_EQ(counter_clockwise({}), SwingPolygon{});
}

// However corners are dragged about: it stays a limit with as many corners, and the corner is as
// near to where it is wanted as any other place that would do.
TEST(SwingPolygons, StayPolygonsUnderThousandsOfEdits) {
  Random random(77);
  SwingPolygon polygon = ring(7, 1.6, 1.9);
  int compared = 0;
  for (int n = 0; n < 20000; ++n) {
    const int corner =
        static_cast<int>(random.uniform(0, static_cast<double>(polygon.size()) - 1e-9));
    const std::array<double, 2> wanted = {random.uniform(-4, 4), random.uniform(-4, 4)};
    const double choice = random.uniform();
    SwingPolygon next = choice < 0.8 ? with_corner_moved(polygon, corner, wanted)
                        : choice < 0.9 && polygon.size() < 20
                            ? with_corner_added(polygon, corner, wanted)
                            : with_corner_removed(polygon, corner);
    const auto limit = make_swing_polygon(0, 1, next);
    ASSERT_TRUE(limit.ok()) << limit.error().message() << " after " << n;
    ASSERT_EQ(limit->corners.size(), next.size()) << "a corner on an edge, after " << n;
    if (choice < 0.8 && next != polygon) {
      const auto c = static_cast<std::size_t>(corner);
      const auto off = [&](const std::array<double, 2>& p) {
        return std::hypot(p[0] - wanted[0], p[1] - wanted[1]);
      };
      // Another place that is clearly a corner too.
      SwingPolygon other = polygon;
      const double t = random.uniform();
      other[c] = {next[c][0] + t * (wanted[0] - next[c][0]) + random.uniform(-0.05, 0.05),
                  next[c][1] + t * (wanted[1] - next[c][1]) + random.uniform(-0.05, 0.05)};
      if (with_corner_moved(polygon, corner, other[c])[c] == other[c]) {
        EXPECT_LE(off(next[c]), off(other[c]) + 1e-6);
        ++compared;
      }
    }
    polygon = std::move(next);
  }
  EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace elbowroom
