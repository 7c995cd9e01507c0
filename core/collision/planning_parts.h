// SPDX-License-Identifier: MIT
// The rigid pieces a world is taken apart into for planning one limb over one window.
//
// A piece of skin has the mean of the shapes, in its joint's rigid frame, that the clip gives it
// over the window: the rigid part that is nearest to them all, and nearer to those of a motion that
// stays about the clip than the bind pose's shape. Rigid things are themselves, with scale as it is
// at the window's beginning.
//
// Skin is also cut where contact about a joint begins to be allowed, so that the two sides of a
// seam, which touch always and may, are pieces that need not be tested against each other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/collision/scene_collision_data.h"

namespace elbowroom {

struct PlanningPart {
  const CollisionMesh* mesh = nullptr;  // own's, or the scene's for rigid things
  std::shared_ptr<CollisionMesh> own;
  std::string name;
  std::vector<int> parts;               // of the scene, that it is made of; ascending
  int body = -1;                        // in the scene
  int actor = -1, node = -1;            // what it follows
  RigidTransform node_from_part;        // identity but for the scene's own bodies
  bool of_limb = false;                 // of the limb being planned (not what it carries)
  bool deforms = false;                 // cut from a skin
  int segment = -1;                     // of its limb
  std::vector<std::uint16_t> patch_of;  // by triangle; the body's patch numbers
  // Bodies against whose part at the shared joint all of this piece may touch; ascending.
  std::vector<int> joined_to;
  Vec3 centre{0.0};  // bounding sphere, part frame
  double radius = 0;
  Vec3 half{0.0};  // of the box about the same centre, along the part's axes
};

// True if the two lie about a joint they share: nothing between them is a contact.
bool about_one_joint(const PlanningPart& a, const PlanningPart& b);

// `link`: rigid links of the actor in view and of the others, by actor (rigid_links.h).
// Pieces whose shape is not finite are left out: no contact can be decided for them.
std::vector<PlanningPart> planning_parts(const SceneCollision::Data& scene, const World& world,
                                         int limb, double t_init, double t_goal,
                                         const std::vector<std::vector<int>>& link);

}  // namespace elbowroom
