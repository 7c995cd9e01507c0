// SPDX-License-Identifier: MIT
// One triangle mesh made ready for collision queries in its own frame: a wide box tree for culling,
// OpenMesh topology (unique edges, borders, closed components) and an Embree scene for rays.
//
// Positions are float32 in the mesh's own frame and stay where they are while a planner runs: a
// query brings the other mesh's relative transform along. A mesh that deforms is refit in place.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/base/result.h"

namespace elbowroom {

// a_from_b: rotation and translation, no scale (scale is baked into positions).
struct RigidTransform {
  Mat3 rotation{1.0};
  Vec3 translation{0.0};
};
RigidTransform inverse(const RigidTransform& t);
RigidTransform operator*(const RigidTransform& a_from_b, const RigidTransform& b_from_c);
inline Vec3 operator*(const RigidTransform& t, const Vec3& p) {
  return t.rotation * p + t.translation;
}

// Whether components with openings have an inside (DESIGN.md, "Contact"). A bowl has none: what
// lies in it touches nothing. A body part cut out of a skin has: give `capped` for those, and every
// opening is closed by a fan, which counts for inside and outside but never for contact.
enum class Openings { open, capped };

class CollisionMesh {
 public:
  // Positions beyond this are refused: squares and cubes of them must stay finite.
  static constexpr float kLargestCoordinate = 1e15f;

  // Error: index out of range, a position that is not finite or too large. Empty meshes are allowed
  // and touch nothing. Degenerate triangles are kept: a needle of zero area still touches.
  static Result<CollisionMesh> build(std::span<const glm::vec3> positions,
                                     std::span<const glm::uvec3> triangles,
                                     Openings openings = Openings::open);
  CollisionMesh(CollisionMesh&&) noexcept;
  CollisionMesh& operator=(CollisionMesh&&) noexcept;
  ~CollisionMesh();

  // New positions for the same triangles (a deformed skin): boxes are refit and rays see the new
  // places; topology stays. O(n). False, and nothing changed, if the number of positions differs
  // or one of them is not finite. Not beside queries on other threads.
  bool refit(std::span<const glm::vec3> positions);

  std::span<const glm::vec3> positions() const;
  std::span<const glm::uvec3> triangles() const;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  explicit CollisionMesh(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
