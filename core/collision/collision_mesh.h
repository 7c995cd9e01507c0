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
Vec3 operator*(const RigidTransform& t, const Vec3& p);

class CollisionMesh {
 public:
  // Error: index out of range, non-finite position. Empty meshes are allowed and touch nothing.
  // Degenerate triangles are kept: a needle of zero area still touches.
  static Result<CollisionMesh> build(std::span<const glm::vec3> positions,
                                     std::span<const glm::uvec3> triangles);
  CollisionMesh(CollisionMesh&&) noexcept;
  CollisionMesh& operator=(CollisionMesh&&) noexcept;
  ~CollisionMesh();

  // New positions for the same triangles (a deformed skin): boxes are refit and rays see the new
  // places; topology stays. O(n).
  void refit(std::span<const glm::vec3> positions);

  std::span<const glm::vec3> positions() const;
  std::span<const glm::uvec3> triangles() const;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  explicit CollisionMesh(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
