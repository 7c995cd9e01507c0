// SPDX-License-Identifier: MIT
#include "tests/property/rigs/changed_rigs.h"

#include <gtest/gtest.h>

#include "core/scene/grouping.h"

namespace elbowroom::test {

Model without_names(const Model& model) {
  Model changed = model;
  changed.human_bones.clear();
  auto& joints = changed.skeleton.joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::array<std::string, 4> names = {"", "zz", "k" + std::to_string(i * 37 % 101),
                                              "q_" + std::to_string(i)};
    joints[i].name = names[i % 4];
  }
  return changed;
}

Model placed(const Model& model, const Transform& placement) {
  Model changed = model;
  const int top = changed.skeleton.size();
  Joint node;
  node.name = "placement";
  node.rest = placement;
  for (Joint& joint : changed.skeleton.joints) {
    if (joint.parent < 0) joint.parent = top;
  }
  changed.skeleton.joints.push_back(node);
  EXPECT_TRUE(link_skeleton(changed.skeleton));
  group_characters_and_objects(changed);
  return changed;
}

Model scaled(const Model& model, double factor) {
  Model changed = model;
  const auto f = static_cast<float>(factor);
  for (Joint& joint : changed.skeleton.joints) {
    joint.rest.translation *= factor;
    if (joint.rest_matrix)
      (*joint.rest_matrix)[3] = glm::dvec4(Vec3((*joint.rest_matrix)[3]) * factor, 1);
  }
  for (Skin& skin : changed.skins) {
    for (Mat4& matrix : skin.inverse_bind) matrix[3] = glm::dvec4(Vec3(matrix[3]) * factor, 1);
  }
  for (Mesh& mesh : changed.meshes) {
    for (glm::vec3& position : mesh.positions) position *= f;
    for (MorphTarget& morph : mesh.morphs) {
      for (glm::vec3& offset : morph.offsets) offset *= f;
    }
  }
  for (Clip& clip : changed.clips) {
    for (Channel& channel : clip.channels) {
      if (channel.path != Path::translation) continue;
      for (float& value : channel.values) value *= f;
    }
  }
  group_characters_and_objects(changed);
  return changed;
}

}  // namespace elbowroom::test
