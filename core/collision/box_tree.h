// SPDX-License-Identifier: MIT
// A wide tree of axis-aligned boxes over the triangles of one mesh: 16 boxes a node, in float,
// stored as centres and half extents so that 16 of them meet one box of another tree at once. Each
// box has a slab besides, across the normal its triangles share most: a slanted patch of skin fills
// its box poorly and its slab well, and a triangle's slab is its plane. Where that says much more
// than the box, a second slab lies across the first and along the part: a slanted rod fills its box
// and one slab poorly, and two slabs well.
//
// Coordinates are relative to `origin` (the middle of the mesh), so that meshes far from the origin
// lose nothing; boxes are rounded outwards, so a box always holds its triangles. Boxes are in the
// mesh's own frame and its units. Memory: about 90 bytes a triangle.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/collision/box_pack.h"

namespace elbowroom {

struct BoxTree {
  static constexpr int kWidth = BoxPack::kWidth;
  // No path from the root is longer, so traversals of two trees get by with a fixed stack.
  static constexpr int kMaxDepth = 28;

  // Child references: a node's index, or the bitwise complement of a triangle's.
  using Ref = std::int32_t;
  static constexpr bool is_triangle(Ref ref) { return ref < 0; }
  static constexpr std::uint32_t triangle_of(Ref ref) { return static_cast<std::uint32_t>(~ref); }

  struct Node : BoxPack {
    Ref child[kWidth];  // the used ones come first
    // What opening a box takes off it: the sum of its half extents less its children's mean one. Of
    // two boxes the one with more is opened first: a post of full-length triangles opens to no
    // avail.
    float shrinks[kWidth];
    // |normal · x − middle| ≤ thickness for all x in the slab; a unit normal, or 0 for no slab.
    struct Slabs {
      float normal[3][kWidth];
      float middle[kWidth];
      float thickness[kWidth];
    };
    Slabs slab[2];
    std::int32_t count = 0;
    std::int32_t slabs = 2;  // 1 if no child has a second one
  };

  Vec3 origin{0.0};             // about the middle; float values
  Vec3 lower{0.0}, upper{0.0};  // of all triangles, relative to origin, exact
  std::vector<Node> nodes;      // root first, children after their parents; empty without triangles
  float root_center[3] = {0, 0, 0};
  float root_half[3] = {0, 0, 0};
  float root_shrinks = 0;
  // Kept for refit. Of each node: its box, and the sum of n·nᵀ/|n| over its triangles' normals n,
  // as xx, yy, zz, xy, yz, zx.
  std::vector<glm::vec3> low, high;
  std::vector<std::array<double, 6>> normals;
  // Triangles so that those of each node are [begin[node], end[node]).
  std::vector<std::uint32_t> order, begin, end;
  bool was_refit = false;

  bool empty() const { return nodes.empty(); }
  // Of a sphere about `origin` that holds all.
  double radius() const { return glm::length(glm::max(glm::abs(lower), glm::abs(upper))); }
};

// False if no box of the root is nearer to `centre` (the mesh's frame) than `radius`.
inline bool sphere_near_root(const BoxTree& tree, const Vec3& centre, double radius) {
  return !tree.empty() && sphere_near_boxes(&tree.nodes.front(), 1, centre - tree.origin, radius);
}

// O(n log n); deterministic.
BoxTree build_box_tree(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

// The same tree around new positions of the same triangles, by boxes alone: skin is refit for a
// question or two, and slabs would cost more than they save. `low` and `high`: the new box of all
// triangles, exactly. O(n), allocates nothing.
void refit_box_tree(BoxTree& tree, const glm::vec3& low, const glm::vec3& high,
                    std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

}  // namespace elbowroom
