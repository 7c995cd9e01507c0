// SPDX-License-Identifier: MIT
// Writes a GLB of one rigid triangle mesh, for obstacles that tests make.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace elbowroom::test {

struct SimpleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
};

// A closed upright cylinder of `sides` sides, its axis at (x, z), from y_low to y_high.
SimpleMesh upright_post(double x, double z, double radius, double y_low, double y_high,
                        int sides = 16);
SimpleMesh box(const glm::vec3& lower, const glm::vec3& upper);

// True if the file was written. `move_to` not zero: the mesh's node is animated, from where it
// stands to that translation over [0, seconds].
bool write_simple_glb(const std::filesystem::path& file, const std::string& name,
                      const SimpleMesh& mesh, const glm::vec3& move_to = glm::vec3(0.0f),
                      float seconds = 0.0f);

}  // namespace elbowroom::test
