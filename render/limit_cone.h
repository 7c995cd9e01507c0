// SPDX-License-Identifier: MIT
// How far a shoulder, hip, wrist or ankle may swing, as lines about the joint: where the bone's end
// may go at most, and the part of it that is sampled [SKF07 4.2].
//
// World space; the swing ellipse and the ranges of the limb's DofSpace about the joint's zero pose,
// as core/anatomy/joint_model.h turns numbers into a direction. Right under mirrored parents too.
// Pure values, any thread.
#pragma once

#include <vector>

#include "core/anatomy/limb_model.h"
#include "render/frame.h"

namespace elbowroom {

struct LimitCone {
  Vec3 apex{0.0};              // the joint
  Vec3 zero{0.0};              // where the bone's end is at the zero pose
  std::vector<Vec3> rim;       // closed: of the last point the next is the first
  std::vector<Vec3> sampling;  // the same of the sampling intervals, cut off at the limit
};

// `which`: 0 the limb's root, 2 its end. `world_from_parent`: of the joint's parent node; `apex`:
// where the joint is; `length`: how far from it the rim lies. Empty rims if that joint has no swing
// or the input is not finite.
LimitCone limit_cone(const LimbModel& limb, int which, const Mat4& world_from_parent,
                     const Vec3& apex, double length, int points = 72);

// Rim, spokes and zero direction for Frame::trails; the sampled part as a stronger loop.
std::vector<Trail> cone_trails(const LimitCone& cone, Rgb colour, float opacity = 0.5f);

}  // namespace elbowroom
