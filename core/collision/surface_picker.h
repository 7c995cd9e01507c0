// SPDX-License-Identifier: MIT
// What a ray meets first: the surface point under the mouse, to choose a limb by a click or to put
// a target on a body while it is dragged.
//
// World space, the scene's units; rays and results in double. Each mesh has an Embree scene of its
// own in a frame about its middle, scaled to unit size, so that neither the distance from the
// world's origin nor the scene's unit matters; the place is computed anew in double from the
// triangle that was hit. As good as Embree: on a shared edge either neighbour may be reported.
//
// Nothing is built before the first query that needs it. A query compares what moves each mesh
// (model, matrices, morph weights) with what it was built from, bit by bit, and deforms and builds
// anew only what differs; an edit that moves an arm's prop leaves the ground's tree alone.
//
// Cost: an unchanged world of 25,000 triangles below 0.05 ms; a figure of that size in a new pose
// is deformed and its tree made anew in about 10 ms. Memory: about 100 bytes a triangle.
// One thread at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/ray.h"
#include "core/scene/world.h"

namespace elbowroom {

struct SurfaceHit {
  int actor = -1, mesh = -1;   // index in World::actors, in Model::meshes
  std::uint32_t triangle = 0;  // index in Mesh::triangles
  int joint = -1;              // node that moves the triangle most; of a rigid mesh its node
  Vec3 place{0.0};             // world
  Vec3 normal{0.0};            // unit, of the triangle's plane, on the side the ray comes from
  double distance = 0;         // from the ray's origin, world
};

// What a ray passes through as if it were not there.
struct PickFilter {
  std::vector<std::uint8_t> hidden;  // by actor, not 0: all of it; may be shorter
  bool back_faces = false;  // true: back faces are met even where pictures do not show them, that
                            // is of materials that are not double-sided
  // Triangles that these joints move most: a limb that follows the target which is being dragged
  // over the other surfaces. By node of one actor, not 0; may be shorter.
  int through_actor = -1;
  std::vector<std::uint8_t> through_joints;
};

// The node whose weights on the triangle's corners sum to most, the lowest of equals; of a rigid
// mesh its node. Requires triangle < mesh.triangles.size().
int moving_joint(const Mesh& mesh, std::uint32_t triangle);

class SurfacePicker {
 public:
  SurfacePicker();
  ~SurfacePicker();
  SurfacePicker(SurfacePicker&&) noexcept;
  SurfacePicker& operator=(SurfacePicker&&) noexcept;

  // The nearest hit; none if the ray meets nothing, is not finite or has no direction. `states` are
  // those of world_state_at; actors without one take no part, nor do vertices that are not finite.
  std::optional<SurfaceHit> nearest(const World& world, const std::vector<ActorState>& states,
                                    const WorldRay& ray, const PickFilter& filter = {});

  // How many meshes have been deformed and built so far: what a caller wasted.
  std::uint64_t builds() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
