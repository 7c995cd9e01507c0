// SPDX-License-Identifier: MIT
// Small generated meshes for tests.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/base/random.h"

namespace elbowroom::test {

struct Shape {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
};

// Axis-aligned box around the origin, 12 triangles, closed.
Shape box_shape(const glm::vec3& half);
// Closed sphere of `rings` × `segments` quads (triangles at the poles).
Shape sphere_shape(float radius, int rings, int segments);
// Tube along z from −half_length to half_length, open at both ends, or closed by fans.
Shape tube_shape(float radius, float half_length, int rings, int segments, bool closed);
// Flat square in the plane z = 0, n × n quads, open.
Shape sheet_shape(float half, int n);
// A limb: a closed tube whose girth varies, with a rough skin.
Shape limb_shape(float radius, float half_length, int rings, int segments, Random& random);
// Thin closed cone along z: a needle.
Shape needle_shape(float radius, float half_length, int segments);

void append(Shape& to, const Shape& shape, const glm::vec3& offset = glm::vec3(0.0f));

}  // namespace elbowroom::test
