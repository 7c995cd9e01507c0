// SPDX-License-Identifier: MIT
#include "core/collision/topology.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <array>
#include <bit>
#include <mutex>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

namespace elbowroom {
namespace {

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;

struct PlaceHash {
  std::size_t operator()(const std::array<std::uint32_t, 3>& k) const {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (const std::uint32_t word : k) {
      h = (h ^ word) * 0xbf58476d1ce4e5b9ull;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }
};

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? (static_cast<std::uint64_t>(a) << 32) | b
               : (static_cast<std::uint64_t>(b) << 32) | a;
}

std::vector<std::uint32_t> weld(std::span<const glm::vec3> positions) {
  std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, PlaceHash> first;
  first.reserve(positions.size());
  std::vector<std::uint32_t> welded(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::vec3 p = positions[i] + glm::vec3(0.0f);  // −0 becomes 0
    const std::array<std::uint32_t, 3> key = {std::bit_cast<std::uint32_t>(p.x),
                                              std::bit_cast<std::uint32_t>(p.y),
                                              std::bit_cast<std::uint32_t>(p.z)};
    welded[i] = first.try_emplace(key, static_cast<std::uint32_t>(i)).first->second;
  }
  return welded;
}

// Union-find with the lowest index as root, so that results do not depend on the order of unions.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// OpenMesh would refuse the face, and say so on the error stream: a third face at an edge, one of
// opposite winding, or a vertex without a gap in its fan.
bool is_complex(const Mesh& mesh, const std::array<Mesh::VertexHandle, 3>& v) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!mesh.is_isolated(v[i]) && !mesh.is_boundary(v[i])) return true;
    const auto halfedge = mesh.find_halfedge(v[i], v[(i + 1) % 3]);
    if (halfedge.is_valid() && !mesh.is_boundary(halfedge)) return true;
  }
  return false;
}

// Border edges of one component form loops once every vertex is entered as often as it is left:
// at every vertex an even number of them meets. Walks them off in index order.
void walk_loops(const std::vector<Topology::Edge>& border, std::uint32_t component,
                std::vector<Topology::Loop>& loops) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> at;
  for (std::uint32_t e = 0; e < border.size(); ++e) {
    at[border[e].a].push_back(e);
    at[border[e].b].push_back(e);
  }
  std::vector<bool> used(border.size(), false);
  for (std::uint32_t e = 0; e < border.size(); ++e) {
    if (used[e]) continue;
    used[e] = true;
    Topology::Loop loop;
    loop.component = component;
    const std::uint32_t start = border[e].a;
    loop.vertices = {start};
    std::uint32_t here = border[e].b;
    while (here != start) {
      loop.vertices.push_back(here);
      std::uint32_t next = static_cast<std::uint32_t>(border.size());
      for (const std::uint32_t candidate : at[here]) {
        if (!used[candidate]) {
          next = candidate;
          break;
        }
      }
      if (next == border.size()) break;  // cannot be: degrees are even
      used[next] = true;
      here = border[next].a == here ? border[next].b : border[next].a;
    }
    loops.push_back(std::move(loop));
  }
}

}  // namespace

Topology build_topology(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                        bool cap_openings) {
  Topology topology;
  topology.welded = weld(positions);
  topology.counts.assign(triangles.size(), false);

  static std::once_flag quiet;
  std::call_once(quiet, [] { omerr().disable(); });
  Mesh mesh;
  std::vector<Mesh::VertexHandle> vertex_of(positions.size());
  std::vector<std::uint32_t> position_of;
  std::vector<glm::uvec3> complex_faces;
  std::unordered_set<std::array<std::uint32_t, 3>, PlaceHash> seen;
  seen.reserve(triangles.size());
  Sets sets(positions.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const glm::uvec3 w(topology.welded[triangles[t].x], topology.welded[triangles[t].y],
                       topology.welded[triangles[t].z]);
    sets.join(w.x, w.y);
    sets.join(w.y, w.z);
    if (w.x == w.y || w.y == w.z || w.z == w.x) continue;
    std::array<std::uint32_t, 3> key = {w.x, w.y, w.z};
    std::sort(key.begin(), key.end());
    if (!seen.insert(key).second) continue;
    topology.counts[t] = true;
    std::array<Mesh::VertexHandle, 3> v;
    for (int i = 0; i < 3; ++i) {
      Mesh::VertexHandle& handle = vertex_of[w[i]];
      if (!handle.is_valid()) {
        const glm::vec3& p = positions[w[i]];
        handle = mesh.add_vertex(Mesh::Point(p.x, p.y, p.z));
        position_of.push_back(w[i]);
      }
      v[static_cast<std::size_t>(i)] = handle;
    }
    if (is_complex(mesh, v) || !mesh.add_face(v[0], v[1], v[2]).is_valid()) {
      complex_faces.push_back(w);
    }
  }
  topology.complex_faces = static_cast<std::uint32_t>(complex_faces.size());

  // Unique edges and how many faces use each: OpenMesh's first, then those only complex faces have.
  std::unordered_map<std::uint64_t, std::uint32_t> edge_index;
  edge_index.reserve(mesh.n_edges() + 3 * complex_faces.size());
  std::vector<std::uint32_t> uses;
  const auto edge_at = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, is_new] =
        edge_index.try_emplace(edge_key(a, b), static_cast<std::uint32_t>(topology.edges.size()));
    if (is_new) {
      topology.edges.push_back({std::min(a, b), std::max(a, b)});
      uses.push_back(0);
    }
    return it->second;
  };
  for (const auto edge : mesh.edges()) {
    const auto halfedge = mesh.halfedge_handle(edge, 0);
    const auto from = static_cast<std::size_t>(mesh.from_vertex_handle(halfedge).idx());
    const auto to = static_cast<std::size_t>(mesh.to_vertex_handle(halfedge).idx());
    const std::uint32_t e = edge_at(position_of[from], position_of[to]);
    for (unsigned side = 0; side < 2; ++side) {
      if (!mesh.is_boundary(mesh.halfedge_handle(edge, side))) ++uses[e];
    }
  }
  for (const glm::uvec3& w : complex_faces) {
    for (int i = 0; i < 3; ++i) ++uses[edge_at(w[i], w[(i + 1) % 3])];
  }
  // Degenerate triangles have edges too, which rays must fire.
  topology.edge_begin.push_back(0);
  for (const glm::uvec3& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = topology.welded[t[i]], b = topology.welded[t[(i + 1) % 3]];
      if (a != b) topology.edge_of_triangle.push_back(edge_at(a, b));
    }
    topology.edge_begin.push_back(static_cast<std::uint32_t>(topology.edge_of_triangle.size()));
  }

  // Components, in the order of their first triangles.
  std::unordered_map<std::uint32_t, std::uint32_t> component_of_root;
  topology.component.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t root = sets.find(topology.welded[triangles[t].x]);
    const auto [it, is_new] =
        component_of_root.try_emplace(root, static_cast<std::uint32_t>(topology.components.size()));
    if (is_new) {
      topology.components.emplace_back();
      topology.components.back().first_triangle = static_cast<std::uint32_t>(t);
    }
    topology.component[t] = it->second;
    ++topology.components[it->second].triangles;
  }

  std::vector<std::vector<Topology::Edge>> border(topology.components.size());
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    if (uses[e] % 2 == 0) continue;
    const std::uint32_t c = component_of_root.at(sets.find(topology.edges[e].a));
    border[c].push_back(topology.edges[e]);
  }
  std::vector<bool> has_surface(topology.components.size(), false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (topology.counts[t]) has_surface[topology.component[t]] = true;
  }
  for (std::uint32_t c = 0; c < topology.components.size(); ++c) {
    Topology::Component& component = topology.components[c];
    component.border_edges = static_cast<std::uint32_t>(border[c].size());
    component.encloses = has_surface[c] && (border[c].empty() || cap_openings);
    if (!border[c].empty() && cap_openings) walk_loops(border[c], c, topology.loops);
  }
  for (std::uint32_t l = 0; l < topology.loops.size(); ++l) {
    const auto& v = topology.loops[l].vertices;
    for (std::size_t i = 0; i < v.size(); ++i) {
      topology.caps.push_back({v[i], v[(i + 1) % v.size()], l});
    }
  }
  return topology;
}

Vec3 loop_middle(const Topology::Loop& loop, std::span<const glm::vec3> positions) {
  Vec3 sum(0.0);
  for (const std::uint32_t v : loop.vertices) sum += Vec3(positions[v]);
  return sum / static_cast<double>(loop.vertices.size());
}

}  // namespace elbowroom
