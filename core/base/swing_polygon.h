// SPDX-License-Identifier: MIT
// A swing's limit drawn by hand: the corners of a spherical polygon (core/base/dof_space.h), and
// how they are moved, added and taken away without its ceasing to be one.
//
// Corners are swings (first, second) from the zero pose, radians, in counter-clockwise order. Such
// a polygon is convex in them, because the planner goes straight from one swing to another and has
// to stay inside (DESIGN.md, "Interpolation"); it has the zero pose inside; and it stays below half
// a turn, where a swing is singular. Pure functions, any thread; cost: the number of corners.
#pragma once

#include <array>
#include <vector>

#include "core/base/dof_space.h"
#include "core/base/result.h"

namespace elbowroom {

using SwingPolygon = std::vector<std::array<double, 2>>;

// The limit of two DOFs. Error: what is wrong with the corners, and what to do about it.
Result<PolygonLimit> make_swing_polygon(int first, int second, const SwingPolygon& corners);

// The corners counter-clockwise, the first one first.
SwingPolygon counter_clockwise(SwingPolygon corners);

// The corner at `wanted`, or as near to it as the others allow. Unchanged if there is no such
// corner or `wanted` is no number.
SwingPolygon with_corner_moved(const SwingPolygon& polygon, int corner,
                               std::array<double, 2> wanted);

// One corner more, after corner `edge`, at `wanted` or as near to it as the others allow; it is
// corner edge + 1. Unchanged where there is no room for one.
SwingPolygon with_corner_added(const SwingPolygon& polygon, int edge, std::array<double, 2> wanted);

// Without it, if what is left has the zero pose inside; else unchanged.
SwingPolygon with_corner_removed(const SwingPolygon& polygon, int corner);

}  // namespace elbowroom
