// SPDX-License-Identifier: MIT
#include "core/scene/joint_name.h"

#include <algorithm>

namespace elbowroom {

NamedJoint joint_of_name(const Model& model, const Character& character, const std::string& name) {
  const auto& joints = model.skeleton.joints;
  NamedJoint found;
  const auto look_at = [&](int joint) {
    if (joints[static_cast<std::size_t>(joint)].name != name) return;
    if (found.node < 0)
      found.node = joint;
    else
      ++found.namesakes;
  };
  for (const int joint : character.joints) look_at(joint);
  if (found.node >= 0) return found;
  for (int joint = 0; joint < model.skeleton.size(); ++joint) look_at(joint);
  if (found.node >= 0) return found;
  const bool number =
      !name.empty() && name.size() < 9 &&
      std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!number) return found;
  const int index = std::stoi(name);
  if (index < model.skeleton.size()) found.node = index;
  return found;
}

}  // namespace elbowroom
