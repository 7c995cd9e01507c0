// SPDX-License-Identifier: MIT
// How far a channel's value gets within an interval from where it is at one time of it: upper
// bounds, taken from the keys as they are, for proofs about all times between samples.
//
// Of [begin, end] about `middle`, which lies in it; seconds. Outside its keys a channel clamps and
// does not move.
//  * LINEAR rotations turn evenly between two keys: angles of the pieces add up. LINEAR vectors are
//    farthest from their middle at a key or an end, so their bound is exact.
//  * CUBICSPLINE: the derivative of a Hermite piece is a quadratic and lies in the hull of its
//  three
//    Bézier points. A rotation's spline is normalized, which turns by at most 2·|q'|/|q| rad a
//    unit; |q| is bounded below by its value at the middle of the piece. Where that proves nothing
//    (a spline near 0) the bound is π.
//  * STEP: the farthest of the keys that hold within the interval.
// Bounds are up to rounding (1e-12 of the value); never tight for turns about different axes.
// Pure functions; O(log keys + keys within).
#pragma once

#include "core/animation/clip.h"

namespace elbowroom {

// Angle, [0, π] rad, that sample_rotation() keeps to from its value at `middle`.
double rotation_travel(const Channel& channel, double begin, double end, double middle);

// Distance that sample_vector() keeps to from its value at `middle`.
double vector_travel(const Channel& channel, double begin, double end, double middle);

// The same for one component of any channel but a rotation.
double component_travel(const Channel& channel, int component, double begin, double end,
                        double middle);

}  // namespace elbowroom
