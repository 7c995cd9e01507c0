// SPDX-License-Identifier: MIT
#include <algorithm>

#include "assets/generator/half_edges.h"
#include "assets/generator/surface.h"

namespace elbowroom::demo {

namespace {

class Remesher {
 public:
  Remesher(const Surface& surface, const BodyShape& shape)
      : shape_(shape), mesh_(to_half_edges(surface)) {}

  void collapse_short() {
    // Repeated sweeps: a sweep leaves a vertex alone once it has been moved, so that sizes shrink
    // evenly instead of along chains.
    for (int sweep = 0; sweep < 24; ++sweep) {
      std::vector<char> moved(mesh_.n_vertices(), 0);
      int collapsed = 0;
      const std::size_t edges = mesh_.n_edges();
      for (std::size_t i = 0; i < edges; ++i) {
        const auto e = mesh_.edge_handle(static_cast<unsigned>(i));
        if (mesh_.status(e).deleted()) continue;
        const auto h = mesh_.halfedge_handle(e, 0);
        const auto from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
        if (moved[index(from)] || moved[index(to)]) continue;
        const Vec3 middle = 0.5 * (point(from) + point(to));
        const double wanted = shape_.edge_length(middle);
        if (glm::length(point(to) - point(from)) > 0.8 * wanted) continue;
        if (!mesh_.is_collapse_ok(h) || !collapse_keeps_shape(h, middle, wanted)) continue;
        mesh_.set_point(to, to_mesh(middle));
        mesh_.collapse(h);
        moved[index(to)] = 1;
        for (const auto v : mesh_.vv_range(to)) moved[index(v)] = 1;
        ++collapsed;
      }
      mesh_.garbage_collection();
      if (collapsed == 0) break;
    }
    project_all();
  }

  void split_long() {
    const std::size_t edges = mesh_.n_edges();
    for (std::size_t i = 0; i < edges; ++i) {
      const auto e = mesh_.edge_handle(static_cast<unsigned>(i));
      const auto h = mesh_.halfedge_handle(e, 0);
      const Vec3 a = point(mesh_.from_vertex_handle(h)), b = point(mesh_.to_vertex_handle(h));
      const Vec3 middle = 0.5 * (a + b);
      if (glm::length(b - a) < 4.0 / 3.0 * shape_.edge_length(middle)) continue;
      mesh_.split(e, to_mesh(shape_.project(middle)));
    }
    mesh_.garbage_collection();
  }

  void flip_to_valence() {
    for (const auto e : mesh_.edges()) {
      if (!mesh_.is_flip_ok(e)) continue;
      const auto h = mesh_.halfedge_handle(e, 0);
      const auto a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
      const auto c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
      const auto d =
          mesh_.to_vertex_handle(mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(h)));
      const auto off = [&](OpenMesh::VertexHandle v, int change) {
        const int n = static_cast<int>(mesh_.valence(v)) + change - 6;
        return n * n;
      };
      const int before = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0);
      const int after = off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1);
      if (after >= before) continue;
      // The two new triangles must look the way the old ones did, and not be needles.
      const Vec3 pa = point(a), pb = point(b), pc = point(c), pd = point(d);
      const Vec3 old_normal =
          glm::normalize(glm::cross(pb - pa, pc - pa) + glm::cross(pa - pb, pd - pb));
      if (!well_shaped(pc, pd, pb, old_normal, 0.5) || !well_shaped(pd, pc, pa, old_normal, 0.5))
        continue;
      mesh_.flip(e);
    }
  }

  void relax() {
    std::vector<Vec3> moved(mesh_.n_vertices());
    for (const auto v : mesh_.vertices()) {
      // Centroid of the ring, triangles weighted by area over wanted area.
      Vec3 sum(0.0);
      double total = 0;
      for (const auto f : mesh_.vf_range(v)) {
        Vec3 corner[3];
        int n = 0;
        for (const auto w : mesh_.fv_range(f)) corner[n++] = point(w);
        const Vec3 centre = (corner[0] + corner[1] + corner[2]) / 3.0;
        const double wanted = shape_.edge_length(centre);
        const double weight =
            glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0])) /
            (wanted * wanted);
        sum += weight * centre;
        total += weight;
      }
      const Vec3 p = point(v);
      const Vec3 n = shape_.normal(p);
      const Vec3 step = total > 0 ? sum / total - p : Vec3(0.0);
      moved[index(v)] = p + 0.7 * (step - glm::dot(step, n) * n);
    }
    for (const auto v : mesh_.vertices()) {
      const Vec3 old = point(v), fresh = shape_.project(moved[index(v)]);
      mesh_.set_point(v, to_mesh(fresh));
      // Undone where a triangle would turn over.
      const Vec3 n = shape_.normal(fresh);
      for (const auto f : mesh_.vf_range(v)) {
        Vec3 corner[3];
        int k = 0;
        for (const auto w : mesh_.fv_range(f)) corner[k++] = point(w);
        if (!well_shaped(corner[0], corner[1], corner[2], n, 0.1)) {
          mesh_.set_point(v, to_mesh(old));
          break;
        }
      }
    }
  }

  Surface result() const { return to_surface(mesh_); }

 private:
  static std::size_t index(OpenMesh::VertexHandle v) { return static_cast<std::size_t>(v.idx()); }
  Vec3 point(OpenMesh::VertexHandle v) const { return to_glm(mesh_.point(v)); }

  // Faces along `normal` (cosine at least `facing`) and is no needle.
  static bool well_shaped(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal,
                          double facing) {
    const Vec3 n = glm::cross(b - a, c - a);
    const double area = glm::length(n);
    const double longest =
        std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    return area > 0.05 * longest && glm::dot(n, normal) > facing * area;
  }

  bool collapse_keeps_shape(OpenMesh::HalfedgeHandle h, const Vec3& middle, double wanted) const {
    const auto from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    for (const auto v : {from, to}) {
      const auto other = v == from ? to : from;
      for (const auto f : mesh_.vf_range(v)) {
        Vec3 old[3], fresh[3];
        int n = 0;
        bool vanishes = false;
        for (const auto w : mesh_.fv_range(f)) {
          if (w == other) vanishes = true;
          old[n] = point(w);
          fresh[n] = w == v ? middle : old[n];
          ++n;
        }
        if (vanishes) continue;
        const Vec3 before = glm::cross(old[1] - old[0], old[2] - old[0]);
        const Vec3 after = glm::cross(fresh[1] - fresh[0], fresh[2] - fresh[0]);
        if (glm::dot(before, after) <= 0.3 * glm::length(before) * glm::length(after)) return false;
        for (int i = 0; i < 3; ++i)
          if (glm::length(fresh[i] - fresh[(i + 1) % 3]) > 1.35 * wanted) return false;
      }
    }
    return true;
  }

  void project_all() {
    for (const auto v : mesh_.vertices()) mesh_.set_point(v, to_mesh(shape_.project(point(v))));
  }

  const BodyShape& shape_;
  HalfEdges mesh_;
};

}  // namespace

Surface remesh(const Surface& surface, const BodyShape& shape, int rounds) {
  Remesher remesher(surface, shape);
  for (int i = 0; i < rounds; ++i) {
    if (i > 0) remesher.split_long();
    remesher.collapse_short();
    remesher.flip_to_valence();
    for (int k = 0; k < (i == 0 ? 1 : 3); ++k) remesher.relax();
  }
  return remesher.result();
}

}  // namespace elbowroom::demo
