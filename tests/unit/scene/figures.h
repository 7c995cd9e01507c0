// SPDX-License-Identifier: MIT
// Small models made by hand for the tests of this folder.
#pragma once

#include "core/scene/grouping.h"
#include "core/scene/model.h"

namespace elbowroom::test {

inline int add_joint(Model& model, const std::string& name, int parent, const Vec3& translation) {
  Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.rest.translation = translation;
  model.skeleton.joints.push_back(joint);
  return model.skeleton.size() - 1;
}

// A skin over `joints`, bound in the present rest pose with the mesh's space that of `mesh_node`
// (-1: the world).
inline int add_skin(Model& model, const std::vector<int>& joints, int mesh_node = -1) {
  link_skeleton(model.skeleton);
  std::vector<Mat4> world;
  compute_globals(model.skeleton, rest_pose(model.skeleton), Mat4(1.0), world);
  Skin skin;
  skin.joints = joints;
  for (const int joint : joints) {
    const Mat4 inverse = glm::inverse(world[static_cast<std::size_t>(joint)]);
    skin.inverse_bind.push_back(
        mesh_node < 0 ? inverse : inverse * world[static_cast<std::size_t>(mesh_node)]);
  }
  model.skins.push_back(skin);
  return static_cast<int>(model.skins.size()) - 1;
}

// One triangle per three positions; vertex i follows `slots[i]` of the skin wholly.
inline int add_mesh(Model& model, int node, int skin, const std::vector<glm::vec3>& positions,
                    const std::vector<int>& slots = {}) {
  Mesh mesh;
  mesh.node = node;
  mesh.skin = skin;
  mesh.positions = positions;
  for (unsigned i = 0; i + 2 < positions.size(); i += 3)
    mesh.triangles.emplace_back(i, i + 1, i + 2);
  if (skin >= 0) {
    mesh.influence_begin.push_back(0);
    for (const int slot : slots) {
      const int joint =
          model.skins[static_cast<std::size_t>(skin)].joints[static_cast<std::size_t>(slot)];
      mesh.influences.push_back({joint, slot, 1.0f});
      mesh.influence_begin.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
    }
  }
  model.meshes.push_back(mesh);
  return static_cast<int>(model.meshes.size()) - 1;
}

inline std::vector<Mat4> globals_at(const Model& model, const Pose& pose) {
  std::vector<Mat4> world;
  compute_globals(model.skeleton, pose, Mat4(1.0), world);
  return world;
}

}  // namespace elbowroom::test
