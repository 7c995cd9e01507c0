// SPDX-License-Identifier: MIT
// Random targets for the limbs of a file, each judged by forward kinematics of its own: the pose
// with the solved state, its global transforms, and what they say about position and orientation.
#pragma once

#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "core/ik/swivel_search.h"
#include "core/scene/model.h"

namespace elbowroom::test {

// One file's limbs and how it is placed.
struct IkRig {
  std::shared_ptr<const Model> model;
  std::vector<LimbModel> limbs;
  Mat4 world_from_file{1.0};
};

// Every file of humanoids whose limbs are found, sorted by path; empty without samples.
std::vector<std::filesystem::path> sample_humanoids();
// "3_Knight_glb": the name of a test of that file.
template <typename Info>
std::string file_test_name(const Info& info) {
  std::string text = std::to_string(info.index) + "_";
  for (const char c : info.param.filename().string())
    text += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return text;
}
// No limbs if the file can't be read or none is found.
IkRig read_rig(const std::filesystem::path& file);

// A limb at a random time of a random clip (or at rest).
struct LimbInPose {
  const IkRig* rig = nullptr;
  const LimbModel* limb = nullptr;
  Pose pose;
  Mat4 world_from_parent{1.0};
  std::array<Quat, 3> residual;
};
LimbInPose random_moment(const IkRig& rig, const LimbModel& limb, std::uint64_t seed);

// By compute_globals on the pose with the state applied.
struct EndPlace {
  Vec3 position, middle;
  Quat rotation;
};
EndPlace place_of(const LimbInPose& moment, const LimbState& state);

// What a run over one rig came to.
struct TargetCounts {
  long targets = 0, solved = 0, not_solved = 0;
  long reachable = 0, reachable_missed = 0;  // made by forward kinematics of a posture in limits
  long outside = 0, outside_wrong = 0;       // out of reach
  long wrong_position = 0, wrong_orientation = 0, beyond_limits = 0, in_obstacle = 0;
  long scan_found_more = 0;  // not solved, though a scan of whole degrees finds a valid posture
  long between_degrees = 0;  // though one between whole degrees does: told, not forbidden
  long failed_but_scanned = 0;
  double worst_position = 0;     // × length
  double worst_orientation = 0;  // radians
  std::string first_problem;

  long problems() const {
    return reachable_missed + outside_wrong + wrong_position + wrong_orientation + beyond_limits +
           in_obstacle + scan_found_more;
  }
};

// `count` targets for each limb of the rig.
TargetCounts try_targets(const IkRig& rig, int count, std::uint64_t seed);

std::string summary(const TargetCounts& counts);

}  // namespace elbowroom::test
