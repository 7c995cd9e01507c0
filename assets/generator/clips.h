// SPDX-License-Identifier: MIT
// The mannequin's clips: a pose for every 30th of a second.
#pragma once

#include <string>
#include <vector>

#include "assets/generator/figure.h"

namespace elbowroom::demo {

struct FigureClip {
  std::string name;
  std::vector<double> times;                 // seconds, from 0
  std::vector<Vec3> hips;                    // Hips' translation, one a key
  std::vector<std::vector<Quat>> rotations;  // [joint][key], parent_from_joint
};

std::vector<FigureClip> make_clips(const Figure& figure);

}  // namespace elbowroom::demo
