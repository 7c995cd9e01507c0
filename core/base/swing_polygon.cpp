// SPDX-License-Identifier: MIT
#include "core/base/swing_polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace elbowroom {
namespace {

using Point = std::array<double, 2>;

// How clearly a corner drawn by hand is one, and how far the zero pose is inside, radians: less
// could not be told from an edge.
constexpr double kClear = 0.004, kRoomAboutZero = 0.03;
constexpr double kFarthest = 0.98 * std::numbers::pi;

double cross(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

// Points p with normal · p ≥ offset.
struct HalfPlane {
  Point normal{};
  double offset = 0;

  double room(const Point& p) const { return normal[0] * p[0] + normal[1] * p[1] - offset; }
};

// To the left of a → b, by `clear` at least.
std::optional<HalfPlane> left_of(const Point& a, const Point& b, double clear) {
  const double length = distance(a, b);
  if (!(length > 0)) return std::nullopt;
  HalfPlane half{{(a[1] - b[1]) / length, (b[0] - a[0]) / length}, 0};
  half.offset = half.normal[0] * a[0] + half.normal[1] * a[1] + clear;
  return half;
}

// The point nearest to `wanted` in all the half-planes and the disc of swings; none if there is no
// such point. The nearest one is `wanted` itself, or lies on one border, or where two meet.
std::optional<Point> nearest(const std::vector<HalfPlane>& halves, const Point& wanted) {
  std::vector<Point> places = {wanted};
  const auto onto_disc = [](const Point& p) {
    const double r = std::hypot(p[0], p[1]);
    return r > kFarthest ? Point{p[0] * kFarthest / r, p[1] * kFarthest / r} : p;
  };
  places.push_back(onto_disc(wanted));
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const HalfPlane& a = halves[i];
    const double room = a.room(wanted);
    places.push_back({wanted[0] - room * a.normal[0], wanted[1] - room * a.normal[1]});
    const double off = kFarthest * kFarthest - a.offset * a.offset;
    if (off >= 0)
      for (const double side : {-std::sqrt(off), std::sqrt(off)})
        places.push_back({a.offset * a.normal[0] - side * a.normal[1],
                          a.offset * a.normal[1] + side * a.normal[0]});
    for (std::size_t j = i + 1; j < halves.size(); ++j) {
      const HalfPlane& b = halves[j];
      const double det = a.normal[0] * b.normal[1] - a.normal[1] * b.normal[0];
      if (std::abs(det) < 1e-9) continue;
      places.push_back({(a.offset * b.normal[1] - b.offset * a.normal[1]) / det,
                        (b.offset * a.normal[0] - a.offset * b.normal[0]) / det});
    }
  }
  std::optional<Point> best;
  for (const Point& place : places) {
    if (!(std::hypot(place[0], place[1]) <= kFarthest + 1e-9)) continue;
    if (std::any_of(halves.begin(), halves.end(),
                    [&](const HalfPlane& half) { return !(half.room(place) >= -1e-9); }))
      continue;
    if (!best || distance(place, wanted) < distance(*best, wanted)) best = place;
  }
  return best;
}

// Where a corner between `before` and `after` may be, so that it and both of them stay corners and
// the zero pose stays inside; as near to `wanted` as can be.
std::optional<Point> corner_between(const Point& before_that, const Point& before,
                                    const Point& after, const Point& after_that,
                                    const Point& wanted) {
  std::vector<HalfPlane> halves;
  for (const auto& half : {left_of(before_that, before, kClear), left_of(after, after_that, kClear),
                           left_of(after, before, kClear), left_of({0, 0}, before, kRoomAboutZero),
                           left_of(after, {0, 0}, kRoomAboutZero)}) {
    if (!half) return std::nullopt;
    halves.push_back(*half);
  }
  return nearest(halves, wanted);
}

}  // namespace

Result<PolygonLimit> make_swing_polygon(int first, int second, const SwingPolygon& corners) {
  for (const Point& corner : corners) {
    // Written so that NaN is none either; that is told of below.
    if (std::hypot(corner[0], corner[1]) >= std::numbers::pi)
      return Error{"a corner is half a turn or more from the zero pose", "swing polygon",
                   "draw it nearer: corners are in radians, below 3.14 from the zero pose"};
  }
  return make_polygon_limit(first, second, corners);
}

SwingPolygon counter_clockwise(SwingPolygon corners) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    area += cross({0, 0}, corners[i], corners[(i + 1) % corners.size()]);
  if (area < 0) std::reverse(corners.begin() + 1, corners.end());
  return corners;
}

SwingPolygon with_corner_moved(const SwingPolygon& polygon, int corner,
                               std::array<double, 2> wanted) {
  const auto n = polygon.size();
  const auto i = static_cast<std::size_t>(corner);
  if (corner < 0 || i >= n || n < 3 || !std::isfinite(wanted[0]) || !std::isfinite(wanted[1]))
    return polygon;
  const auto at = [&](std::size_t k) { return polygon[(i + k) % n]; };
  const auto place = corner_between(at(n - 2), at(n - 1), at(1), at(2), wanted);
  SwingPolygon moved = polygon;
  if (place) moved[i] = *place;
  return make_swing_polygon(0, 1, moved) ? moved : polygon;
}

SwingPolygon with_corner_added(const SwingPolygon& polygon, int edge,
                               std::array<double, 2> wanted) {
  const auto n = polygon.size();
  const auto i = static_cast<std::size_t>(edge);
  if (edge < 0 || i >= n || n < 3 || !std::isfinite(wanted[0]) || !std::isfinite(wanted[1]))
    return polygon;
  const auto at = [&](std::size_t k) { return polygon[(i + k) % n]; };
  const auto place = corner_between(at(n - 1), at(0), at(1), at(2), wanted);
  if (!place) return polygon;
  SwingPolygon more = polygon;
  more.insert(more.begin() + edge + 1, *place);
  return make_swing_polygon(0, 1, more) ? more : polygon;
}

SwingPolygon with_corner_removed(const SwingPolygon& polygon, int corner) {
  if (corner < 0 || static_cast<std::size_t>(corner) >= polygon.size() || polygon.size() < 4)
    return polygon;
  SwingPolygon fewer = polygon;
  fewer.erase(fewer.begin() + corner);
  return make_swing_polygon(0, 1, fewer) ? fewer : polygon;
}

}  // namespace elbowroom
