// SPDX-License-Identifier: MIT
#include "core/collision/containment.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace elbowroom {
namespace {

// Directions of no special relation to axes, diagonals or one another.
constexpr std::array<std::array<double, 3>, 8> kDirections = {{
    {0.5377, 0.2891, 0.7920},
    {-0.6743, 0.7093, 0.2054},
    {0.1689, -0.8812, 0.4416},
    {-0.3457, -0.4271, -0.8355},
    {0.9127, -0.3769, -0.1577},
    {-0.1213, 0.6101, -0.7830},
    {0.4909, 0.8087, -0.3243},
    {-0.8861, -0.2203, 0.4079},
}};

// A point at which every ray from p along direction k has left the mesh behind.
Vec3 far_point(const CollisionMesh::Data& mesh, const Vec3& p, std::size_t k) {
  const double reach = 2.0 * glm::length(p - mesh.tree.origin) + 4.0 * mesh.tree.radius();
  return p + 1.25 * reach * Vec3(kDirections[k][0], kDirections[k][1], kDirections[k][2]);
}

void candidates_of(const CollisionMesh::Data& mesh, const Vec3& p,
                   std::vector<std::uint32_t>& out) {
  out.clear();
  for (std::uint32_t c = 0; c < mesh.places.size(); ++c) {
    if (!mesh.topology.components[c].encloses) continue;
    const ComponentPlace& place = mesh.places[c];
    bool in = true;
    for (int k = 0; k < 3; ++k) {
      in = in && p[k] >= static_cast<double>(place.low[k]) &&
           p[k] <= static_cast<double>(place.high[k]);
    }
    if (in) out.push_back(c);
  }
}

// Conservative: separating axes of a segment (middle m, half vector h) and a box.
bool segment_near_box(const Vec3& m, const Vec3& h, const Vec3& center, const Vec3& half) {
  const Vec3 d = m - center;
  const double slack = 1e-12 * (std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + std::abs(h.x) +
                                std::abs(h.y) + std::abs(h.z));
  for (int i = 0; i < 3; ++i) {
    if (std::abs(d[i]) > std::abs(h[i]) + half[i] + slack) return false;
  }
  const Vec3 c = glm::cross(h, d);
  const double length = glm::length(h);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    if (std::abs(c[i]) > std::abs(h[j]) * half[k] + std::abs(h[k]) * half[j] + slack * length) {
      return false;
    }
  }
  return true;
}

// Crossings of the segment p–q per candidate component, modulo two. False if it grazes something.
bool exact_parities(const CollisionMesh::Data& mesh, const Vec3& p, const Vec3& q,
                    std::span<const std::uint32_t> candidates, std::vector<bool>& odd) {
  odd.assign(candidates.size(), false);
  const auto place_of = [&](std::uint32_t component) {
    return std::lower_bound(candidates.begin(), candidates.end(), component) - candidates.begin();
  };
  const auto wanted = [&](std::uint32_t component) {
    return std::binary_search(candidates.begin(), candidates.end(), component);
  };
  const Vec3 middle = 0.5 * (p + q) - mesh.tree.origin, half = 0.5 * (q - p);
  std::vector<BoxTree::Ref> stack = {0};
  while (!stack.empty()) {
    const BoxTree::Node& node = mesh.tree.nodes[static_cast<std::size_t>(stack.back())];
    stack.pop_back();
    for (int i = 0; i < node.count; ++i) {
      const Vec3 c(node.center[0][i], node.center[1][i], node.center[2][i]);
      const Vec3 h(node.half[0][i], node.half[1][i], node.half[2][i]);
      if (!segment_near_box(middle, half, c, h)) continue;
      if (!BoxTree::is_triangle(node.child[i])) {
        stack.push_back(node.child[i]);
        continue;
      }
      const std::uint32_t t = BoxTree::triangle_of(node.child[i]);
      if (!mesh.topology.counts[t] || !wanted(mesh.topology.component[t])) continue;
      const Passing passing = segment_passes(p, q, mesh.triangle(t));
      if (passing == Passing::grazes) return false;
      if (passing == Passing::crosses) {
        odd[static_cast<std::size_t>(place_of(mesh.topology.component[t]))].flip();
      }
    }
  }
  for (std::size_t c = 0; c < mesh.topology.caps.size(); ++c) {
    const std::uint32_t component = mesh.topology.loops[mesh.topology.caps[c].loop].component;
    if (!wanted(component)) continue;
    const Passing passing = segment_passes(p, q, mesh.cap(c));
    if (passing == Passing::grazes) return false;
    if (passing == Passing::crosses) odd[static_cast<std::size_t>(place_of(component))].flip();
  }
  return true;
}

// Parity per candidate from one ray's hits; false if a hit that matters is not clear.
bool ray_parities(const CollisionMesh::Data& mesh, std::uint32_t ray,
                  const std::vector<RayScene::Hit>& surface, const std::vector<RayScene::Hit>& caps,
                  std::span<const std::uint32_t> candidates, std::vector<bool>& odd) {
  odd.assign(candidates.size(), false);
  const auto count = [&](std::uint32_t component, bool clear) {
    const auto at = std::lower_bound(candidates.begin(), candidates.end(), component);
    if (at == candidates.end() || *at != component) return true;
    odd[static_cast<std::size_t>(at - candidates.begin())].flip();
    return clear;
  };
  for (const RayScene::Hit& hit : surface) {
    if (hit.ray != ray || !mesh.topology.counts[hit.triangle]) continue;
    if (!count(mesh.topology.component[hit.triangle], hit.clear)) return false;
  }
  for (const RayScene::Hit& hit : caps) {
    if (hit.ray != ray) continue;
    const std::uint32_t loop = mesh.topology.caps[hit.triangle].loop;
    if (!count(mesh.topology.loops[loop].component, hit.clear)) return false;
  }
  return true;
}

// Parities by exact crossings; all even if every direction grazes: the point is on the surface.
void settle_exactly(const CollisionMesh::Data& mesh, const Vec3& p,
                    std::span<const std::uint32_t> candidates, std::vector<bool>& odd) {
  for (std::size_t k = 0; k < kDirections.size(); ++k) {
    if (exact_parities(mesh, p, far_point(mesh, p, k), candidates, odd)) return;
  }
  odd.assign(candidates.size(), false);
}

// How many rays may agree for one answer, and what a packet then holds.
constexpr std::size_t kRaysPerPoint = 4;
constexpr std::size_t kPointsPerPacket = RayScene::kPacket / kRaysPerPoint;
// Fewer points than this do not pay for building a ray scene that a refit has made stale.
constexpr std::size_t kPointsForNewScene = 64;

}  // namespace

void find_enclosures(const CollisionMesh::Data& mesh, std::span<const Vec3> points,
                     std::vector<Enclosure>& out) {
  if (!mesh.can_enclose) return;
  std::vector<std::size_t> asked;
  std::vector<std::uint32_t> candidates;
  for (std::size_t i = 0; i < points.size(); ++i) {
    candidates_of(mesh, points[i], candidates);
    if (!candidates.empty()) asked.push_back(i);
  }
  const bool fire = mesh.rays_are_fresh() || asked.size() >= kPointsForNewScene || !mesh.was_refit;
  std::vector<RayScene::Hit> surface, caps;
  std::vector<bool> odd, odd_again;
  for (std::size_t begin = 0; begin < asked.size(); begin += kPointsPerPacket) {
    const std::size_t end = std::min(asked.size(), begin + kPointsPerPacket);
    surface.clear();
    caps.clear();
    if (fire) {
      RayScene::Ray rays[RayScene::kPacket];
      std::size_t n = 0;
      for (std::size_t i = begin; i < end; ++i) {
        const Vec3& p = points[asked[i]];
        for (std::size_t k = 0; k < kRaysPerPoint; ++k) {
          rays[n].origin = glm::vec3(p - mesh.tree.origin);
          rays[n].direction = glm::vec3(far_point(mesh, p, k) - p);
          ++n;
        }
      }
      mesh.surface_rays().all_hits({rays, n}, surface);
      if (!mesh.topology.caps.empty()) mesh.cap_rays().all_hits({rays, n}, caps);
    }
    for (std::size_t i = begin; i < end; ++i) {
      candidates_of(mesh, points[asked[i]], candidates);
      int agreeing = 0;
      bool settled = false;
      if (fire) {
        const auto first_ray = static_cast<std::uint32_t>((i - begin) * kRaysPerPoint);
        for (std::uint32_t k = 0; k < kRaysPerPoint && agreeing < 2; ++k) {
          if (!ray_parities(mesh, first_ray + k, surface, caps, candidates, odd_again)) continue;
          if (agreeing == 1 && odd_again != odd) break;
          odd = odd_again;
          ++agreeing;
        }
        settled = agreeing == 2;
      }
      if (!settled) settle_exactly(mesh, points[asked[i]], candidates, odd);
      for (std::size_t c = 0; c < candidates.size(); ++c) {
        if (odd[c]) out.push_back({static_cast<std::uint32_t>(asked[i]), candidates[c]});
      }
    }
  }
}

}  // namespace elbowroom
