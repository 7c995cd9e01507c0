// SPDX-License-Identifier: MIT
// What a CollisionMesh holds. Private to the collision folder.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/collision/box_tree.h"
#include "core/collision/collision_mesh.h"
#include "core/collision/ray_scene.h"
#include "core/collision/topology.h"
#include "core/collision/triangle_predicates.h"

namespace elbowroom {

// Where a component is: its box, and vertices that touch the box's six sides.
struct ComponentPlace {
  glm::vec3 low{0.0f}, high{0.0f};
  std::uint32_t extreme[6] = {0, 0, 0, 0, 0, 0};
};

struct CollisionMesh::Data {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  BoxTree tree;
  Topology topology;
  std::vector<ComponentPlace> places;                         // one a component
  std::vector<std::pair<std::uint32_t, std::uint32_t>> used;  // vertex and component, each once
  std::vector<glm::vec3> loop_middles;                        // one a loop
  bool can_enclose = false;                                   // some component encloses
  std::vector<BoxPack> enclosing;   // boxes of components that do, relative to tree.origin
  bool was_refit = false;           // it may be again: ray scenes are short-lived
  glm::vec3 low{0.0f}, high{0.0f};  // box of all components, in the mesh's frame

  // Rays against the surface, and against the caps of openings apart from it: caps count for
  // inside and outside, never for contact. Coordinates are relative to tree.origin. Built when
  // first asked for after a change.
  const RayScene& surface_rays() const;
  const RayScene& cap_rays() const;
  bool rays_are_fresh() const { return rays_fresh_.load(std::memory_order_acquire); }

  TrianglePoints triangle(std::uint32_t t) const {
    const glm::uvec3& i = triangles[t];
    return {Vec3(positions[i.x]), Vec3(positions[i.y]), Vec3(positions[i.z])};
  }
  TrianglePoints cap(std::size_t c) const {
    const Topology::CapTriangle& cap = topology.caps[c];
    return {Vec3(positions[cap.a]), Vec3(positions[cap.b]), Vec3(loop_middles[cap.loop])};
  }

  // False if nothing in a sphere (the mesh's frame) can touch the surface, by the boxes of the
  // tree's root, nor be inside, by those of enclosing components.
  bool sphere_may_meet(const Vec3& centre, double radius) const;

  // Everything that depends on positions but not on topology: the components' boxes, and, with the
  // tree about the same positions, all else.
  void place_components();
  void place_rest();

 private:
  void make_rays_fresh() const;

  mutable std::mutex rays_mutex_;
  mutable std::atomic<bool> rays_fresh_{false};
  mutable std::unique_ptr<RayScene> surface_rays_, cap_rays_;
};

}  // namespace elbowroom
