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
  Vec3 middle;
  double radius;
  double winding;

  // Unit, outward; 0 for a degenerate triangle.
  Vec3 normal() const {
    const auto& [p, q, r] = points;
    const Vec3 cross = glm::cross(q - p, r - p);
    const double area = glm::length(cross);
    return area > 0 ? cross * (winding / area) : Vec3(0.0);
  }
};

bool near(const Facet& f, const Vec3& p, double distance) {
  const Vec3 to_middle = p - f.middle;
  const double reach = distance + f.radius;
  if (glm::dot(to_middle, to_middle) > reach * reach) return false;
  return glm::length(p - closest_point(p, f.points)) <= distance;
}

// A body's vertices in the query space.
class Places {
 public:
  explicit Places(const CollisionBody& body)
      : positions_(body.mesh().positions()),
        query_from_body_(body.query_from_body()),
        moves_(!body.deforms()) {}
  Vec3 operator[](std::uint32_t vertex) const {
    const Vec3 p(positions_[vertex]);
    return moves_ ? query_from_body_ * p : p;
  }

 private:
  std::span<const glm::vec3> positions_;
  const RigidTransform& query_from_body_;
  bool moves_;
};

// A body's patches and those next to them, ascending.
std::vector<std::uint16_t> widened(const CollisionBody& body,
                                   const std::vector<std::uint16_t>& patches) {
  std::vector<std::uint16_t> wide = patches;
  for (const std::uint16_t patch : patches) {
    const auto around = body.neighbours_of_patch(patch);
    wide.insert(wide.end(), around.begin(), around.end());
  }
  std::sort(wide.begin(), wide.end());
  wide.erase(std::unique(wide.begin(), wide.end()), wide.end());
  return wide;
}

std::vector<Facet> facets_of(const CollisionBody& body, const std::vector<std::uint16_t>& patches) {
  std::vector<Facet> facets;
  const Places places(body);
  const auto triangles = body.mesh().triangles();
  for (const std::uint16_t patch : patches)
    for (const std::uint32_t t : body.triangles_of_patch(patch)) {
      const glm::uvec3& corner = triangles[t];
      Facet f;
      f.points = {places[corner.x], places[corner.y], places[corner.z]};
      const auto& [p, q, r] = f.points;
      f.middle = (p + q + r) / 3.0;
      double radius2 = 0;
      for (const Vec3& point : f.points) {
        const Vec3 out = point - f.middle;
        radius2 = std::max(radius2, glm::dot(out, out));
      }
      f.radius = std::sqrt(radius2);
      f.winding = body.winding(t);
      facets.push_back(f);
    }
  return facets;
}

// Vertices of the patches of `from`, each once, that lie in the box of `onto`'s patches: outside of
// it nothing is behind a surface that bulges; a flat one has vertices on it.
std::vector<Vec3> vertices_within(const CollisionBody& from,
                                  const std::vector<std::uint16_t>& patches,
                                  const CollisionBody& onto,
                                  const std::vector<std::uint16_t>& onto_patches) {
  Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
  const Places onto_places(onto), from_places(from);
  for (const std::uint16_t patch : onto_patches)
    for (const std::uint32_t v : onto.vertices_of_patch(patch)) {
      const Vec3 p = onto_places[v];
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  std::vector<std::uint32_t> vertices;
  for (const std::uint16_t patch : patches)
    for (const std::uint32_t v : from.vertices_of_patch(patch)) {
      const Vec3 p = from_places[v];
      if (p.x < low.x || p.y < low.y || p.z < low.z || p.x > high.x || p.y > high.y || p.z > high.z)
        continue;
      vertices.push_back(v);
    }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<Vec3> places;
  for (const std::uint32_t v : vertices) places.push_back(from_places[v]);
  return places;
}

// The largest depth of the vertices of `from`'s patches behind those of `onto` and what is next to
// them; 0 for one of at most `least`.
double depth_behind(const CollisionBody& from, const std::vector<std::uint16_t>& patches,
                    const CollisionBody& onto, const std::vector<std::uint16_t>& onto_patches,
                    double least = 0) {
  const std::vector<std::uint16_t> wide = widened(onto, onto_patches);
  const std::vector<Vec3> vertices = vertices_within(from, patches, onto, wide);
  if (vertices.empty()) return 0;
  const std::vector<Facet> facets = facets_of(onto, wide);
  double deepest = 0;
  std::size_t last = 0;  // the facet that was near enough last: neighbours are near the same one
  for (const Vec3& p : vertices) {
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
      const double cosine = distance > 0 ? glm::dot(f.normal(), away) / distance : 0.0;
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

}  // namespace

double contact_depth(const CollisionBody& a, const std::vector<std::uint16_t>& patches_a,
                     const CollisionBody& b, const std::vector<std::uint16_t>& patches_b) {
  return std::max(depth_behind(a, patches_a, b, patches_b),
                  depth_behind(b, patches_b, a, patches_a));
}

bool deeper_than(double limit, const CollisionBody& a, const std::vector<std::uint16_t>& patches_a,
                 const CollisionBody& b, const std::vector<std::uint16_t>& patches_b) {
  return depth_behind(a, patches_a, b, patches_b, limit) > limit ||
         depth_behind(b, patches_b, a, patches_a, limit) > limit;
}

}  // namespace elbowroom
