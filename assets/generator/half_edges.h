// SPDX-License-Identifier: MIT
// A surface as OpenMesh half-edges, for the generator's own .cpp files only (a heavy header).
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "assets/generator/surface.h"

namespace elbowroom::demo {

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;

inline Vec3 to_glm(const OpenMesh::Vec3d& p) { return {p[0], p[1], p[2]}; }
inline OpenMesh::Vec3d to_mesh(const Vec3& p) { return {p.x, p.y, p.z}; }

inline HalfEdges to_half_edges(const Surface& surface) {
  HalfEdges mesh;
  for (const Vec3& p : surface.positions) mesh.add_vertex(to_mesh(p));
  for (const auto& t : surface.triangles)
    mesh.add_face(mesh.vertex_handle(t[0]), mesh.vertex_handle(t[1]), mesh.vertex_handle(t[2]));
  return mesh;
}

// Requires garbage collection done.
inline Surface to_surface(const HalfEdges& mesh) {
  Surface surface;
  for (const auto v : mesh.vertices()) surface.positions.push_back(to_glm(mesh.point(v)));
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> t{};
    std::size_t n = 0;
    for (const auto v : mesh.fv_range(f)) t[n++] = static_cast<std::uint32_t>(v.idx());
    surface.triangles.push_back(t);
  }
  return surface;
}

}  // namespace elbowroom::demo
