// SPDX-License-Identifier: MIT
// The joints of one file and a pose of them.
//
// A skeleton holds every node of its file under the file's own node index, so that what is read,
// planned and written back speaks of the same numbers; which nodes a skin uses is the Skin's to
// say (core/scene/model.h). A pose holds local transforms; global ones are world_from_joint
// matrices in the file's units (glTF: metres, y up).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/math.h"

namespace elbowroom {

// parent_from_joint = translation · rotation · scale, as in glTF.
struct Transform {
  Vec3 translation{0.0};
  Quat rotation{1, 0, 0, 0};
  Vec3 scale{1.0};

  Mat4 matrix() const;
  bool operator==(const Transform&) const = default;
};

struct Joint {
  std::string name;                 // as in the file; may be empty or not unique
  int parent = -1;                  // index, -1 for a root
  Transform rest;                   // the node's own TRS; of a `matrix` node its best decomposition
  std::optional<Mat4> rest_matrix;  // set for a node with `matrix`: it can't be animated and this
                                    // is what places it
};

struct Skeleton {
  std::vector<Joint> joints;
  std::vector<int> order;                  // every index once, parents before children
  std::vector<std::vector<int>> children;  // by joint, in the file's order

  int size() const { return static_cast<int>(joints.size()); }
  // First joint of that exact name, -1 if none.
  int find(const std::string& name) const;
  // True if `joint` is `ancestor` or below it.
  bool is_within(int joint, int ancestor) const;
};

// Fills `order` and `children` from the parents. Requires parents in range and no cycle (the
// reader has checked both); returns false if there is one, and leaves the skeleton unusable.
bool link_skeleton(Skeleton& skeleton);

struct Pose {
  std::vector<Transform> local;                    // by joint
  std::vector<std::vector<double>> morph_weights;  // by joint (node); empty: the mesh's own
};

Pose rest_pose(const Skeleton& skeleton);

// world_from_joint by joint; `world_from_file` places the roots. O(joints), no allocation once the
// vector has its size.
void compute_globals(const Skeleton& skeleton, const Pose& pose, const Mat4& world_from_file,
                     std::vector<Mat4>& world_from_joint);

// The rotation part of a matrix with scale (and mirror): the nearest rotation after the columns'
// lengths and a negative determinant are taken out.
Quat rotation_of(const Mat4& m);

}  // namespace elbowroom
