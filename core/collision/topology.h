// SPDX-License-Identifier: MIT
// How the triangles of a mesh hang together: vertices welded by position, unique edges, borders,
// connected components, and what each component encloses.
//
// OpenMesh holds the manifold part; faces it refuses (a third triangle at an edge, bow ties) are
// kept beside it and share the same edges and components. Every triangle of the file is still
// tested for contact: topology only says which edges to fire and which component may contain
// something.
//
// What a component encloses is decided modulo two. Its border is the set of edges used by an odd
// number of its (distinct, non-degenerate) triangles. Without a border, a ray's crossings count
// inside and outside whatever the winding. A border always falls into closed loops; if openings are
// to be capped, a fan from each loop's middle closes it. Three-fold edges and doubled sheets need
// no case of their own.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace elbowroom {

struct Topology {
  struct Edge {
    std::uint32_t a, b;  // positions of the mesh (one of those welded together), a ≠ b
  };
  struct Component {
    std::uint32_t first_triangle = 0;  // lowest index
    std::uint32_t triangles = 0;
    std::uint32_t border_edges = 0;
    bool encloses = false;  // closed, or its openings are capped
  };
  // A triangle of a cap: two neighbouring vertices of a border loop, and the loop's middle.
  struct CapTriangle {
    std::uint32_t a, b, loop;
  };
  struct Loop {
    std::uint32_t component = 0;
    std::vector<std::uint32_t> vertices;  // positions; the middle is their mean
  };

  std::vector<std::uint32_t> welded;  // position → lowest position at the same place
  std::vector<Edge> edges;            // unique, of the welded mesh
  std::vector<std::uint32_t> edge_begin, edge_of_triangle;  // triangle → its (up to 3) edges
  std::vector<std::uint32_t> component;                     // of each triangle
  std::vector<bool> counts;           // of each triangle: false for repeats and degenerate ones
  std::vector<Component> components;  // ascending by first triangle
  std::vector<Loop> loops;
  std::vector<CapTriangle> caps;
  std::uint32_t complex_faces = 0;  // refused by OpenMesh
};

// Indices are in range and positions finite.
Topology build_topology(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                        bool cap_openings);

// Middle of a loop at the given positions of the mesh.
Vec3 loop_middle(const Topology::Loop& loop, std::span<const glm::vec3> positions);

}  // namespace elbowroom
