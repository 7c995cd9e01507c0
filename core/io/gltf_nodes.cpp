// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>

#include "core/animation/affine.h"
#include "core/io/gltf_read_parts.h"

namespace elbowroom::gltf {
namespace {

Mat4 matrix_of(const double* columns) {
  Mat4 m;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) m[c][r] = columns[4 * c + r];
  }
  return m;
}

bool is_modest(const Mat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!(std::abs(m[c][r]) <= kLargestNumber)) return false;
    }
  }
  return true;
}

}  // namespace

void convert_nodes(Conversion& to) {
  Skeleton& skeleton = to.model.skeleton;
  skeleton.joints.resize(to.source.nodes.size());
  for (std::size_t i = 0; i < to.source.nodes.size(); ++i) {
    const tinygltf::Node& node = to.source.nodes[i];
    Joint& joint = skeleton.joints[i];
    joint.name = node.name;
    if (node.matrix.size() == 16) {
      joint.rest_matrix = matrix_of(node.matrix.data());
      joint.rest = decompose(*joint.rest_matrix);
    }
    const auto& t = node.translation;
    const auto& r = node.rotation;
    const auto& s = node.scale;
    if (t.size() == 3) joint.rest.translation = {t[0], t[1], t[2]};
    if (r.size() == 4) joint.rest.rotation = Quat(r[3], r[0], r[1], r[2]);
    if (s.size() == 3) joint.rest.scale = {s[0], s[1], s[2]};
    for (const int child : node.children) {
      skeleton.joints[static_cast<std::size_t>(child)].parent = static_cast<int>(i);
    }
  }
  if (!link_skeleton(skeleton)) refuse(to.file, "its nodes form a loop", kExportAgain);
  for (std::size_t i = 0; i < to.source.nodes.size(); ++i) {
    skeleton.children[i] = to.source.nodes[i].children;
  }

  // Each number is modest, but a chain of scales may still run away.
  std::vector<Mat4> globals;
  compute_globals(skeleton, rest_pose(skeleton), Mat4(1.0), globals);
  for (const int node : skeleton.order) {
    const auto i = static_cast<std::size_t>(node);
    if (is_modest(globals[i])) continue;
    refuse(to.in_file(part_name("node", i, skeleton.joints[i].name)),
           "its place in the scene is not finite: the scales and translations above it multiply "
           "beyond any use",
           "correct its scale or that of its parents");
  }
}

void convert_skins(Conversion& to) {
  // Skins may share their matrices, and each is looked for among all nodes: a small file could ask
  // for any amount of work.
  constexpr std::uint64_t kMostWork = 50'000'000;
  std::uint64_t work = to.source.skins.size() * to.source.nodes.size();
  for (const tinygltf::Skin& skin : to.source.skins) {
    if (skin.inverseBindMatrices < 0) continue;
    work += 16 * to.source.accessors[static_cast<std::size_t>(skin.inverseBindMatrices)].count;
  }
  if (work > kMostWork) {
    refuse(to.file, "its " + std::to_string(to.source.skins.size()) + " skins are too many",
           "split the file");
  }
  for (std::size_t i = 0; i < to.source.skins.size(); ++i) {
    const tinygltf::Skin& source = to.source.skins[i];
    const std::string part = part_name("skin", i, source.name);
    Skin skin;
    skin.name = source.name;
    skin.joints = source.joints;
    skin.inverse_bind.assign(skin.joints.size(), Mat4(1.0));
    if (source.inverseBindMatrices >= 0) {
      const std::vector<float> values =
          read_floats(to.source, to.checked, source.inverseBindMatrices, 16, false,
                      "its inverse bind matrices", to.in_file(part));
      if (values.size() < 16 * skin.joints.size()) {
        refuse(to.in_file(part),
               "it has " + std::to_string(values.size() / 16) + " inverse bind matrices for " +
                   std::to_string(skin.joints.size()) + " joints",
               kExportAgain);
      }
      bool projective = false;
      for (std::size_t slot = 0; slot < skin.joints.size(); ++slot) {
        double columns[16];
        for (std::size_t k = 0; k < 16; ++k) {
          columns[k] = static_cast<double>(values[16 * slot + k]);
        }
        Mat4 m = matrix_of(columns);
        if (!is_modest(m)) {
          const auto joint = static_cast<std::size_t>(skin.joints[slot]);
          refuse(to.in_file(part),
                 "the inverse bind matrix of " +
                     part_name("node", joint, to.model.skeleton.joints[joint].name) +
                     " is not finite",
                 kExportAgain);
        }
        for (int c = 0; c < 4; ++c) {
          const double expected = c == 3 ? 1.0 : 0.0;
          projective = projective || std::abs(m[c][3] - expected) > 1e-3;
          m[c][3] = expected;
        }
        skin.inverse_bind[slot] = m;
      }
      if (projective) {
        to.model.warnings.push_back(part +
                                    " has inverse bind matrices that are no affine "
                                    "transforms; their last row is taken as 0 0 0 1");
      }
    }
    to.model.skins.push_back(std::move(skin));
  }
}

}  // namespace elbowroom::gltf
