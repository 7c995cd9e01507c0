// SPDX-License-Identifier: MIT
// From an implicit body to a closed triangle surface with well-shaped triangles of wanted sizes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "assets/generator/body_shape.h"

namespace elbowroom::demo {

struct Surface {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from outside
};

// Marching tetrahedra over a grid of that cell size: closed and 2-manifold by construction, for a
// body inside the shape's box.
Surface polygonize(const BodyShape& shape, double cell);

// Isotropic remeshing (Botsch and Kobbelt, A remeshing approach to multiresolution modeling, 2004)
// to the shape's wanted edge lengths, vertices projected to the surface. Keeps the topology.
Surface remesh(const Surface& surface, const BodyShape& shape, int rounds);

// Moves and splits edges so that none crosses the line where `field` is 0: a clean border for a
// change of material. Keeps the topology.
Surface cut_along(const Surface& surface, const BodyShape& shape,
                  const std::function<double(const Vec3&)>& field);

}  // namespace elbowroom::demo
