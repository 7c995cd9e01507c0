// SPDX-License-Identifier: MIT
// The humanoid bones that VRM files name. Nothing here is needed to show the file, so whatever is
// wrong costs the bone and gives one warning.
#include "core/io/gltf_check_parts.h"

namespace elbowroom::gltf {
namespace {

constexpr std::size_t kMostBones = 256;   // VRM knows 55
constexpr std::size_t kLongestName = 64;  // of a bone

class Reader {
 public:
  Reader(CheckState& state, std::size_t nodes) : state_(state), nodes_(nodes) {}

  // VRM 1.0: {"leftUpperArm": {"node": 5}, ...}
  void read_object(const Json& bones) {
    for (const auto& [name, bone] : bones.items()) take(name, bone);
  }
  // VRM 0.x: [{"bone": "leftUpperArm", "node": 5}, ...]
  void read_list(const Json& bones) {
    for (const Json& bone : bones) {
      const Json* name = member(bone, "bone");
      if (name && name->is_string()) {
        take(name->get<std::string>(), bone);
      } else {
        ++odd_;
      }
    }
  }
  void warn(const char* extension) {
    if (odd_ == 0) return;
    state_.out.warnings.push_back(std::string(extension) + ": " + std::to_string(odd_) +
                                  " of its humanoid bones name no node and are passed over");
  }

 private:
  void take(const std::string& name, const Json& bone) {
    const Json* node = member(bone, "node");
    const bool whole = node && node->is_number_integer();
    const std::int64_t index = whole ? node->get<std::int64_t>() : -1;
    if (index < 0 || static_cast<std::uint64_t>(index) >= nodes_ || name.size() > kLongestName ||
        state_.out.human_bones.size() >= kMostBones) {
      ++odd_;
      return;
    }
    state_.out.human_bones.push_back({name, static_cast<int>(index)});
  }

  CheckState& state_;
  std::size_t nodes_;
  std::size_t odd_ = 0;
};

}  // namespace

void check_human_bones(CheckState& state) {
  const Json* extensions = member(state.document, "extensions");
  if (!extensions) return;
  const std::size_t nodes = state.access.section("nodes").size();
  // The newest first: a file may carry both.
  for (const char* name : {"VRMC_vrm", "VRM"}) {
    const Json* extension = member(*extensions, name);
    const Json* humanoid = extension ? member(*extension, "humanoid") : nullptr;
    const Json* bones = humanoid ? member(*humanoid, "humanBones") : nullptr;
    if (!bones) continue;
    Reader reader(state, nodes);
    if (bones->is_object()) {
      reader.read_object(*bones);
    } else if (bones->is_array()) {
      reader.read_list(*bones);
    } else {
      state.out.warnings.push_back(std::string(name) + ": its humanoid bones are no list");
    }
    reader.warn(name);
    if (!state.out.human_bones.empty()) return;
  }
}

}  // namespace elbowroom::gltf
