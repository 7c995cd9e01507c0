// SPDX-License-Identifier: MIT
// The mannequin's skeleton in its bind pose (an A-pose), metres, y up, facing +z, feet on y = 0.
//
// Segment lengths are fractions of the stature after Drillis and Contini, Body Segment Parameters,
// 1966, as reprinted by Winter, Biomechanics and Motor Control of Human Movement, fig. 4.1: upper
// arm 0.186, forearm 0.146, hand 0.108, thigh 0.245, shank 0.246, ankle height 0.039, foot length
// 0.152, hip height 0.530, shoulder height 0.818, chin 0.870.
//
// Axes: trunk, head and legs have the world's in the bind pose. From the upper arm to the finger
// tips a joint has z along the arm and y to the thumb's side, so that it would have the world's
// with the arm held ahead, thumb up.
#pragma once

#include <string>
#include <vector>

#include "core/base/math.h"

namespace elbowroom::demo {

inline constexpr double kStature = 1.75;

struct FigureJoint {
  std::string name;
  int parent = -1;
  Vec3 position{0.0};         // bind pose, world
  Quat rotation{1, 0, 0, 0};  // bind pose, world_from_joint
};

struct Figure {
  std::vector<FigureJoint> joints;          // parents before children; joint 0 is Hips
  int find(const std::string& name) const;  // -1 if none
  // parent_from_joint translation in the bind pose (constant in all clips but for Hips).
  Vec3 offset(int joint) const;
};

Figure make_figure();

// The left hand's own frame in the bind pose, from which fingers are laid out: along the hand, to
// the thumb's side, out of the palm.
struct HandFrame {
  Vec3 wrist, along, thumb, palm;
  Vec3 point(double l, double t, double n) const {
    return wrist + l * along + t * thumb + n * palm;
  }
};
HandFrame left_hand_frame();

// Fingers of the left hand in its frame: four points each, three joints and the tip's centre.
struct Finger {
  const char* name;
  Vec3 points[4];    // world, bind pose
  double radius[4];  // at each
};
std::vector<Finger> left_fingers();  // thumb first

}  // namespace elbowroom::demo
