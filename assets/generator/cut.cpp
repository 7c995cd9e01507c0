// SPDX-License-Identifier: MIT
#include "assets/generator/half_edges.h"
#include "assets/generator/surface.h"

namespace elbowroom::demo {

Surface cut_along(const Surface& surface, const BodyShape& shape,
                  const std::function<double(const Vec3&)>& field) {
  HalfEdges mesh = to_half_edges(surface);
  std::vector<double> value;
  for (const auto v : mesh.vertices()) value.push_back(field(to_glm(mesh.point(v))));
  const auto at = [&](OpenMesh::VertexHandle v) -> double& {
    return value[static_cast<std::size_t>(v.idx())];
  };
  // The line's place on an edge that crosses it; the field need not be linear.
  const auto crossing = [&](const Vec3& a, const Vec3& b, double fa) {
    double low = 0, high = 1;
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (low + high);
      ((field(glm::mix(a, b, middle)) < 0) == (fa < 0) ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };

  // Vertices near the line move onto it, so that cutting leaves no slivers.
  for (const auto v : mesh.vertices()) {
    double nearest = 0.35;
    Vec3 target(0.0);
    const Vec3 p = to_glm(mesh.point(v));
    for (const auto w : mesh.vv_range(v)) {
      if (at(v) * at(w) >= 0) continue;
      const Vec3 q = to_glm(mesh.point(w));
      const double t = crossing(p, q, at(v));
      if (t < nearest) {
        nearest = t;
        target = glm::mix(p, q, t);
      }
    }
    if (nearest < 0.35) {
      mesh.set_point(v, to_mesh(shape.project(target)));
      at(v) = 0.0;
    }
  }
  // Edges that still cross are split; a split also joins the new vertex to the opposite ones.
  const std::size_t edges = mesh.n_edges();
  for (std::size_t i = 0; i < edges; ++i) {
    const auto e = mesh.edge_handle(static_cast<unsigned>(i));
    const auto h = mesh.halfedge_handle(e, 0);
    const auto a = mesh.from_vertex_handle(h), b = mesh.to_vertex_handle(h);
    if (at(a) * at(b) >= 0) continue;
    const Vec3 p = to_glm(mesh.point(a)), q = to_glm(mesh.point(b));
    const auto fresh =
        mesh.add_vertex(to_mesh(shape.project(glm::mix(p, q, crossing(p, q, at(a))))));
    mesh.split(e, fresh);
    value.push_back(0.0);
  }
  mesh.garbage_collection();
  return to_surface(mesh);
}

}  // namespace elbowroom::demo
