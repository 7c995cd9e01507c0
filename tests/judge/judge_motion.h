// SPDX-License-Identifier: MIT
// What a glTF player shows at a time: the judge's own sampling, joint globals and skinning.
#pragma once

#include <string>
#include <vector>

#include "tests/judge/judge_file.h"

namespace judge {

// glTF 2.0 Appendix C. Components of the value at t; rotations unit (x, y, z, w).
std::vector<double> sample(const KeyChannel& channel, double t);
glm::dquat sample_rotation(const KeyChannel& channel, double t);

// Rotation of a node in an animation at t, its own where no channel turns it.
glm::dquat rotation_at(const File& file, const KeyAnimation& animation, int node, double t);

// Angle of the rotation between two unit quaternions, radians.
double angle(const glm::dquat& a, const glm::dquat& b);

struct State {
  std::vector<glm::dmat4> world;             // world_from_node
  std::vector<std::vector<double>> weights;  // morph weights by node, empty: the mesh's own
};

// animation null: the nodes as the file has them. `placement` is world_from_file.
State state_at(const File& file, const KeyAnimation* animation, double t,
               const glm::dmat4& placement = glm::dmat4(1.0));

// The frame of a joint without its scale, shear or mirror: what an attached object is placed in.
glm::dmat4 rigid_frame(const glm::dmat4& world_from_node);

// All triangles of a file's scene; which of them follow which joint does not change with time.
struct Soup {
  std::vector<glm::uvec3> triangles;  // indices in `points`
  std::vector<int>
      joint;  // by triangle: the node that most of its weight follows; a rigid mesh's node
  std::vector<int> mesh_node;  // by triangle: the node that holds its mesh
  std::vector<bool> rigid;     // by triangle: no skin and no morph targets
  std::size_t point_count = 0;
};
Soup soup_of(const File& file);
// Its points in the world.
void place(const File& file, const State& state, std::vector<glm::dvec3>& points);

}  // namespace judge
