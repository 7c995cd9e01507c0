// SPDX-License-Identifier: MIT
// Where the bodies of a world are over time: what a camera frames, a shadow map covers and a grid
// is scaled by. Computed on the CPU, in double, world space, the scene's units.
#pragma once

#include <limits>
#include <vector>

#include "core/base/math.h"
#include "core/scene/world.h"

namespace elbowroom {

struct Bounds {
  Vec3 lower{std::numeric_limits<double>::infinity()};
  Vec3 upper{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(lower.x <= upper.x); }
  Vec3 centre() const { return 0.5 * (lower + upper); }
  Vec3 extent() const { return empty() ? Vec3(0.0) : upper - lower; }
  // Ignores points that are not finite.
  void add(const Vec3& point);
  void add(const Bounds& other);
  // Squared distance of a point from the box, 0 inside.
  double distance(const Vec3& point) const;
};

// What a mesh is to the scene, which decides its tone and whether a camera must show it.
enum class Role {
  character,  // part of a skinned figure
  prop,       // attached to a joint, or moved by hand along with a figure
  obstacle,   // everything else
};

// The role of each mesh of an actor, by mesh index.
std::vector<Role> mesh_roles(const Actor& actor);

// The length by which sizes in pictures scale: the first character's height as it stands in the
// world; without a character, the largest extent of what the world holds; 1 for an empty world.
double scene_size(const World& world);

// Deformed vertices of some meshes of one actor at one state, thinned to at most `at_most` a mesh
// (every k-th vertex). Vertices that are not finite are left out.
void body_points(const Actor& actor, const ActorState& state, const std::vector<int>& meshes,
                 std::size_t at_most, std::vector<Vec3>& out);

// All bodies of a world over times; `roles` as bits 1 << Role. Empty world: empty bounds.
Bounds bounds_over(const World& world, const std::vector<double>& times, unsigned roles = 7u);

}  // namespace elbowroom
