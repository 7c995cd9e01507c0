// SPDX-License-Identifier: MIT
// What is expected of every sample character, written by hand from looking at the files: what kind
// of rig it is and where its limbs are.
#pragma once

#include <array>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/anatomy/limb_model.h"

namespace elbowroom::test {

// Root, middle and end by name; empty where there is no such limb, which is to be said then.
using LimbNames = std::vector<std::string>;

struct RigRow {
  std::string file;  // under humanoids
  std::string kind;
  std::array<LimbNames, 4> limbs;  // left arm, right arm, left leg, right leg
  // Sides in the names are those of a person who looks at the figure.
  bool sides_swapped = false;
  // Without its names shape alone must find the same; false: the names are all there is to tell by.
  bool by_shape = true;
};

inline void PrintTo(const RigRow& one, std::ostream* out) { *out << one.file; }

std::vector<RigRow> rig_table();

// The name of a test of that row.
std::string test_name(const RigRow& row);

// Every key of the limb's joints, and a regular 30 Hz, of all clips.
std::vector<std::pair<const Clip*, double>> moments_of(const Model& model, const LimbModel& limb);

// How well a limb's model expresses its clips, by joint from root to end, degrees; and what it
// bends about, world axes of the bind pose.
struct LimbFit {
  std::array<double, 3> median{}, high{};  // of the residuals; high: 99th percentile
  std::size_t frames = 0;
  Vec3 flexion_axis{0.0};
};
LimbFit fit_of(const Model& model, const Character& character, const LimbModel& limb);

// The row's file, read; null with a test failure if it can't be.
std::shared_ptr<const Model> read_row(const RigRow& row);

}  // namespace elbowroom::test
