// SPDX-License-Identifier: MIT
// An Embree scene of one set of triangles: rays in, the triangles they hit out. The only place that
// knows Embree, and which version of it.
//
// What Embree reports is a proposal: near edges, vertices and in a triangle's plane it may miss or
// hit falsely, differently by instruction set. Callers confirm what matters with an exact
// predicate. Coordinates are float, in whatever frame the positions are given.
//
// One device serves the process, with one thread. FTZ and DAZ are on only inside these calls.
// Queries may run on several threads; set() may not run beside them.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace elbowroom {

class RayScene {
 public:
  static constexpr int kPacket = 16;

  RayScene();
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Builds the scene, or rebuilds it for new positions of the same triangles. O(n log n).
  void set(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

  struct Ray {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f};  // the ray ends at origin + direction
  };

  struct Hit {
    std::uint32_t ray = 0;  // index in the packet
    std::uint32_t triangle = 0;
    bool clear = false;  // well inside the triangle, not along it, not at an end of the ray
  };

  // Every hit of every ray, in no order; up to kPacket rays. Appends.
  void all_hits(std::span<const Ray> rays, std::vector<Hit>& hits) const;

  // One hit of each ray that has any; up to kPacket rays. Appends.
  void any_hits(std::span<const Ray> rays, std::vector<Hit>& hits) const;

  struct Nearest {
    std::uint32_t triangle = 0;
    float t = 0;  // the hit is at origin + t × direction
  };
  // Told the triangle and the cosine-like product of its geometric normal and the direction (> 0:
  // its back); false lets the ray pass. Asked of any hit, in no order.
  using Accept = std::function<bool(std::uint32_t triangle, float facing)>;
  // The hit that is nearest to the origin, among those accepted.
  std::optional<Nearest> nearest_hit(const Ray& ray, const Accept& accept) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
