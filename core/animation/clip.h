// SPDX-License-Identifier: MIT
// A clip: the source motion, as the file has it and never modified; and how a player samples it
// (glTF 2.0, Appendix C).
//
// Times are seconds of the clip's own clock, float32 as in the file. Outside its keys a channel
// clamps. LINEAR rotation is slerp along the shorter way; CUBICSPLINE is a Hermite spline whose
// tangents scale with the key interval, rotations normalized; STEP holds.
#pragma once

#include <string>
#include <vector>

#include "core/animation/skeleton.h"

namespace elbowroom {

enum class Path { translation, rotation, scale, weights };
enum class Interpolation { linear, step, cubic_spline };

struct Channel {
  int joint = -1;  // node index; channels without a node are not kept here (the file keeps them)
  Path path = Path::rotation;
  Interpolation interpolation = Interpolation::linear;
  int components = 4;         // 3 for translation and scale, 4 for rotation (x, y, z, w as in
                              // glTF), the number of targets for weights
  std::vector<float> times;   // strictly increasing, at least one
  std::vector<float> values;  // components a key; CUBICSPLINE: in-tangent, value, out-tangent.
                              // Normalized integers are already converted to float
  int source_channel = -1;    // index in the file's animation, -1 for a new one
};

struct Clip {
  std::string name;  // as in the file; may be empty
  std::vector<Channel> channels;
  int source_animation = -1;  // index in the file
  double begin = 0;           // first and last key of all channels, seconds
  double end = 0;

  double duration() const { return end - begin; }
  // Index of the channel for that joint and path, -1 if none.
  int find_channel(int joint, Path path) const;
};

// Value of a rotation channel at t, unit. Requires path == rotation.
Quat sample_rotation(const Channel& channel, double t);
// Value of a translation or scale channel at t.
Vec3 sample_vector(const Channel& channel, double t);
// Values of a weights channel at t.
void sample_weights(const Channel& channel, double t, std::vector<double>& weights);

// Sets in `pose` what the clip animates; the rest of the pose stays. pose must have the skeleton's
// size; start from rest_pose(). Joints with rest_matrix are left alone (they can't be animated).
void sample_clip(const Clip& clip, double t, Pose& pose);

// Times at which a STEP channel of the clip changes value, sorted, unique: no continuous bound
// crosses them, and both sides are tested (DESIGN.md, "Interpolation").
std::vector<double> step_times(const Clip& clip);

// The densest regular key rate the rotation channels use, in Hz, [1, 240]; 30 if there is but one
// key: export is at this rate or denser.
double key_rate(const Clip& clip);

}  // namespace elbowroom
