// SPDX-License-Identifier: MIT
#include "core/collision/contact_depth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/collision/triangle_predicates.h"

namespace elbowroom {
namespace {

struct Facet {
  TrianglePoints points;
  Vec3 normal;  // unit, outward; 0 for a degenerate triangle
  Vec3 middle;
  double radius;
};

bool near(const Facet& f, const Vec3& p, double distance) {
  const Vec3 to_middle = p - f.middle;
  const double reach = distance + f.radius;
  if (glm::dot(to_middle, to_middle) > reach * reach) return false;
  return glm::length(p - closest_point(p, f.points)) <= distance;
}

// The largest depth of the vertices of `from`'s patches behind `facets`, all in the query space; 0
// for one of at most `least`.
double depth_behind(const CollisionBody& from, const std::vector<std::uint16_t>& patches,
                    const std::vector<Facet>& facets, double least = 0) {
  if (facets.empty()) return 0;
  Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Facet& f : facets) {
    for (const Vec3& p : f.points) low = glm::min(low, p), high = glm::max(high, p);
  }
  std::vector<std::uint32_t> vertices;
  for (const std::uint16_t patch : patches)
    for (const std::uint32_t t : from.triangles_of_patch(patch))
      for (int k = 0; k < 3; ++k) vertices.push_back(from.mesh().triangles()[t][k]);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  double deepest = 0;
  std::size_t last = 0;  // the facet that was near enough last: neighbours are near the same one
  for (const std::uint32_t v : vertices) {
    const Vec3 p = from.query_from_body() * Vec3(from.mesh().positions()[v]);
    // Outside the box nothing is behind a surface that bulges; a flat one has vertices on it.
    if (p.x < low.x || p.y < low.y || p.z < low.z || p.x > high.x || p.y > high.y || p.z > high.z)
      continue;
    double best = std::numeric_limits<double>::infinity();
    double side = 0, steepest = -1;
    if (least > 0 && near(facets[last], p, least)) continue;
    for (const Facet& f : facets) {
      const double reach = best + f.radius;
      const Vec3 to_middle = p - f.middle;
      if (glm::dot(to_middle, to_middle) > reach * reach) continue;
      const Vec3 away = p - closest_point(p, f.points);
      const double distance = glm::length(away);
      const double tie = 1e-9 * (f.radius + distance);
      if (distance > best + tie) continue;
      if (distance < best - tie) steepest = -1;
      // Of several facets that meet at the nearest point the one looked at most squarely tells the
      // side; the flatter ones may be wrong about it at a sharp edge.
      const double cosine = distance > 0 ? glm::dot(f.normal, away) / distance : 0.0;
      if (std::abs(cosine) > steepest) {
        steepest = std::abs(cosine);
        side = cosine;
      }
      best = std::min(best, distance);
      if (best <= least) {
        last = static_cast<std::size_t>(&f - facets.data());
        break;
      }
    }
    if (best <= least) continue;
    if (side < 0 && best > deepest) deepest = best;
  }
  return deepest;
}

std::vector<Facet> facets_of(const CollisionBody& body, const std::vector<std::uint16_t>& patches) {
  std::vector<std::uint16_t> wide = patches;
  for (const std::uint16_t patch : patches) {
    const auto around = body.neighbours_of_patch(patch);
    wide.insert(wide.end(), around.begin(), around.end());
  }
  std::sort(wide.begin(), wide.end());
  wide.erase(std::unique(wide.begin(), wide.end()), wide.end());

  std::vector<Facet> facets;
  const auto positions = body.mesh().positions();
  for (const std::uint16_t patch : wide)
    for (const std::uint32_t t : body.triangles_of_patch(patch)) {
      const glm::uvec3& corner = body.mesh().triangles()[t];
      Facet f;
      for (int k = 0; k < 3; ++k)
        f.points[static_cast<std::size_t>(k)] = body.query_from_body() * Vec3(positions[corner[k]]);
      const auto& [p, q, r] = f.points;
      const Vec3 cross = glm::cross(q - p, r - p);
      const double area = glm::length(cross);
      f.normal = area > 0 ? cross * (body.winding(t) / area) : Vec3(0.0);
      f.middle = (p + q + r) / 3.0;
      f.radius = 0;
      for (const Vec3& point : f.points)
        f.radius = std::max(f.radius, glm::distance(point, f.middle));
      facets.push_back(f);
    }
  return facets;
}

}  // namespace

double contact_depth(const CollisionBody& a, const std::vector<std::uint16_t>& patches_a,
                     const CollisionBody& b, const std::vector<std::uint16_t>& patches_b) {
  return std::max(depth_behind(a, patches_a, facets_of(b, patches_b)),
                  depth_behind(b, patches_b, facets_of(a, patches_a)));
}

bool deeper_than(double limit, const CollisionBody& a, const std::vector<std::uint16_t>& patches_a,
                 const CollisionBody& b, const std::vector<std::uint16_t>& patches_b) {
  return depth_behind(a, patches_a, facets_of(b, patches_b), limit) > limit ||
         depth_behind(b, patches_b, facets_of(a, patches_a), limit) > limit;
}

}  // namespace elbowroom
