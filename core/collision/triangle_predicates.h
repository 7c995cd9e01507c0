// SPDX-License-Identifier: MIT
// Two triangles in double: do they share a point, how far apart are they.
//
// Signs of determinants are exact: a floating-point filter (Shewchuk 1997, bound A) settles nearly
// all, expansion arithmetic the rest. Exact means for the doubles given; magnitudes from 1e-45 to
// 1e18 neither overflow nor underflow. FTZ and DAZ must be off. Any thread.
//
// Triangles are closed sets; degenerate ones are the segments or points they collapse to.
#pragma once

#include <array>
#include <limits>

#include "core/base/math.h"

namespace elbowroom {

using TrianglePoints = std::array<Vec3, 3>;

// Sign (-1, 0, 1) of det(a - d, b - d, c - d): positive if a, b, c turn clockwise seen from d's
// side, that is, d lies below the plane of a, b, c.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Sign of the area of (a, b, c) projected along `axis` (0, 1, 2).
int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

// True if the two share a point. Exact.
bool triangles_intersect(const TrianglePoints& a, const TrianglePoints& b);

// How a segment p, q passes a triangle, for counting crossings. Exact.
enum class Passing {
  misses,
  crosses,
  grazes
};  // grazes: through an edge, a vertex or in the plane
Passing segment_passes(const Vec3& p, const Vec3& q, const TrianglePoints& t);

struct ClosestPoints {
  double distance2 = 0;  // squared
  Vec3 on_a{0.0}, on_b{0.0};
};

// Closest points of two triangles that do not cross (of two that cross: of their borders), if their
// distance² is below `at_most`; else distance2 is `at_most`. Relative error about 1e-12 of the
// triangles' size. Stops early at a pair with distance² ≤ `enough`.
ClosestPoints closest_points(const TrianglePoints& a, const TrianglePoints& b, double enough = 0,
                             double at_most = std::numeric_limits<double>::infinity());

// Closest point of t to p.
Vec3 closest_point(const Vec3& p, const TrianglePoints& t);

// The normal of one of the triangles shows that they are farther apart than `distance` ≥ 0. Cheap;
// allows for its own rounding.
bool surely_apart(const TrianglePoints& a, const TrianglePoints& b, double distance);

// The triangles are in contact: they share a point (exact) or are at most `distance` apart.
bool triangles_touch(const TrianglePoints& a, const TrianglePoints& b, double distance);

// A point of the intersection of two triangles that share one (within rounding).
Vec3 intersection_point(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace elbowroom
