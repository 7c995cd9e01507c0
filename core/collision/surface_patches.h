// SPDX-License-Identifier: MIT
// Triangles cut into patches a few centimetres wide, and distances along a surface: what allowed
// contacts are stated in (DESIGN.md, "Allowed contacts").
//
// All functions are pure and deterministic: triangles and vertices are taken in their own order.
// Lengths are in the positions' units.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace elbowroom {

// A triangle soup with vertices that stand at one place made one: glTF splits them along UV seams
// and between materials, where the surface goes on.
struct WeldedSurface {
  std::vector<Vec3> points;
  std::vector<glm::uvec3> triangles;     // into points; in the order given, degenerate ones too
  std::vector<std::uint32_t> point_of;   // by original vertex
  std::vector<std::uint32_t> fan_begin;  // points + 1 entries into fan
  std::vector<std::uint32_t> fan;        // triangles around each point, ascending
};

// Vertices within about `tolerance` of each other (and chains of such) become one point, at the
// place of the first. Requires finite positions and indices in range. O(n).
WeldedSurface weld(std::span<const Vec3> positions, std::span<const glm::uvec3> triangles,
                   double tolerance);

// Numbers the triangles' patches from 0. A patch is connected, lies in one group (`group` has one
// number a triangle: its mesh and body part) and has all centroids within diameter / 2 of its first
// triangle's. A soup of more than `most` such pieces is gathered by place instead, in cells that
// are coarsened until the number fits.
struct Patches {
  std::vector<std::uint16_t> of_triangle;
  int count = 0;
};
Patches cut_into_patches(const WeldedSurface& surface, std::span<const int> group, double diameter,
                         int most = 4096);

// Distance along the surface's edges from the nearest source to every point (an upper bound of the
// geodesic, by at most a fifth or so on usual meshes); infinity beyond `limit` and where no source
// can be reached.
std::vector<double> distance_along(const WeldedSurface& surface,
                                   std::span<const std::uint32_t> sources, double limit);

// Number of the connected component of every point, from 0 in order of first points.
std::vector<int> connected_components(const WeldedSurface& surface);

}  // namespace elbowroom
