// SPDX-License-Identifier: MIT
// The demo's files as built, read back the way the program reads them.
#pragma once

#include <string>
#include <vector>

#include "core/scene/model.h"

namespace elbowroom::test {

// Each is read once; fails the test run if a file can't be read.
const Model& mannequin();
const Model& umbrella();
const Model& posts();

struct Body {
  std::vector<Vec3> positions;  // welded: no two alike
  std::vector<glm::uvec3> triangles;
  std::vector<std::vector<Influence>> influences;  // empty for a rigid file
};

// All meshes of the file as one surface in its bind (or only) pose, vertices welded where their
// positions are equal to the bit.
Body welded(const Model& model);

// The file's joints at a time of a clip (its rest pose if the name is empty).
std::vector<Mat4> globals_at(const Model& model, const std::string& clip, double t);

// The welded body's vertices in that pose.
std::vector<Vec3> deformed(const Model& model, const Body& body, const std::vector<Mat4>& globals);

// Position of a joint by name.
Vec3 joint_position(const Model& model, const std::vector<Mat4>& globals, const std::string& name);

// Key times of a clip.
std::vector<double> key_times(const Model& model, const std::string& clip);

}  // namespace elbowroom::test
