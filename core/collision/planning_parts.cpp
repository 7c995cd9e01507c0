// SPDX-License-Identifier: MIT
#include "core/collision/planning_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "core/animation/affine.h"

namespace elbowroom {
namespace {

constexpr std::size_t kLooks = 5;  // at the skin, over the window

void bound(PlanningPart& part) {
  const auto positions = part.mesh->positions();
  if (positions.empty()) return;
  Vec3 low(positions[0]), high = low;
  for (const glm::vec3& p : positions) low = glm::min(low, Vec3(p)), high = glm::max(high, Vec3(p));
  part.centre = 0.5 * (low + high);
  part.half = 0.5 * (high - low);
  for (const glm::vec3& p : positions)
    part.radius = std::max(part.radius, glm::distance(Vec3(p), part.centre));
}

void made_of(PlanningPart& part, int number) {
  const auto at = std::lower_bound(part.parts.begin(), part.parts.end(), number);
  if (at == part.parts.end() || *at != number) part.parts.insert(at, number);
}

// Scale or morphs that a clip changes need a shape of the window's own.
bool changes_shape(const Actor& actor, const CollisionBody& body) {
  if (!actor.clip) return false;
  return std::any_of(actor.clip->channels.begin(), actor.clip->channels.end(), [&](const auto& c) {
    return c.path == Path::weights ||
           (c.path == Path::scale && c.joint >= 0 &&
            actor.model->skeleton.is_within(body.frame_node(), c.joint)) ||
           (c.joint >= 0 && actor.model->skeleton.is_within(c.joint, body.frame_node()) &&
            c.joint != body.frame_node());
  });
}

// By patch of the body, the other bodies with which it lies about a shared joint; only pairs with
// the limb count.
std::vector<std::vector<int>> joints_by_patch(const SceneCollision::Data& scene, int body,
                                              int limb) {
  std::vector<std::vector<int>> joined(
      static_cast<std::size_t>(scene.bodies[static_cast<std::size_t>(body)].patch_count()));
  const auto of_limb = [&](int b) {
    const BodyRole& role = scene.roles[static_cast<std::size_t>(b)];
    return role.own && scene.in_limb(role.side.limb, limb);
  };
  for (const auto& [key, allowed] : scene.allowed_pairs) {
    const bool first = key.first == body;
    if (!first && key.second != body) continue;
    if (!of_limb(key.first) && !of_limb(key.second)) continue;
    for (int p = 0; p < allowed.patches_a; ++p)
      for (int q = 0; q < allowed.patches_b; ++q) {
        if (!(allowed.reasons_of(p, q) & AllowedPatches::kShared)) continue;
        auto& list = joined[static_cast<std::size_t>(first ? p : q)];
        const int other = first ? key.second : key.first;
        if (list.empty() || list.back() != other) list.push_back(other);
      }
  }
  for (auto& list : joined) std::sort(list.begin(), list.end());
  return joined;
}

}  // namespace

bool about_one_joint(const PlanningPart& a, const PlanningPart& b) {
  // Allowed patches about one joint are a product: all of one side with all of the other.
  return a.body != b.body && std::binary_search(a.joined_to.begin(), a.joined_to.end(), b.body) &&
         std::binary_search(b.joined_to.begin(), b.joined_to.end(), a.body);
}

std::vector<PlanningPart> planning_parts(const SceneCollision::Data& scene, const World& world,
                                         int limb, double t_init, double t_goal,
                                         const std::vector<std::vector<int>>& link) {
  std::vector<PlanningPart> parts;
  std::vector<std::vector<ActorState>> states(kLooks);  // by time
  for (std::size_t k = 0; k < kLooks; ++k)
    world_state_at(world, t_init + (t_goal - t_init) * static_cast<double>(k) / (kLooks - 1),
                   states[k]);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const CollisionBody& body = scene.bodies[b];
    const BodyRole& role = scene.roles[b];
    const Actor& actor = world.actors[static_cast<std::size_t>(body.actor())];
    const Model& model = *actor.model;
    const bool of_limb = role.own && scene.in_limb(role.side.limb, limb);

    if (!body.deforms() && !changes_shape(actor, body)) {
      PlanningPart part;
      part.mesh = &body.mesh();
      part.body = static_cast<int>(b);
      part.actor = body.actor();
      part.node = body.frame_node();
      part.node_from_part.translation = body.centre();
      part.of_limb = of_limb;
      part.segment = role.side.segment;
      part.patch_of = body.patch_of();
      part.name = scene.parts[static_cast<std::size_t>(body.triangles().front().part)];
      for (const BodyTriangle& t : body.triangles()) made_of(part, t.part);
      bound(part);
      parts.push_back(std::move(part));
      continue;
    }

    // Where every vertex is at each of the times, in the world.
    const std::size_t looks = body.deforms() ? states.size() : 1;
    std::map<int, std::vector<std::vector<Vec3>>> places;  // by mesh and time
    for (const BodyTriangle& t : body.triangles()) {
      auto& at = places[t.mesh];
      if (!at.empty()) continue;
      at.resize(looks);
      for (std::size_t k = 0; k < looks; ++k) {
        const ActorState& then = states[k][static_cast<std::size_t>(body.actor())];
        deform(model, model.meshes[static_cast<std::size_t>(t.mesh)], then.pose,
               then.world_from_joint, at[k]);
      }
    }
    const std::vector<int>& links = link[static_cast<std::size_t>(body.actor())];
    const auto joined = joints_by_patch(scene, static_cast<int>(b), limb);
    // By link, and within it by shared joints.
    std::map<std::pair<int, std::vector<int>>, std::vector<std::uint32_t>> pieces;
    for (std::uint32_t t = 0; t < body.triangles().size(); ++t)
      pieces[{links[static_cast<std::size_t>(body.triangles()[t].joint)],
              joined[body.patch_of()[t]]}]
          .push_back(t);
    for (const auto& [key, triangles] : pieces) {
      const int node = key.first;
      PlanningPart part;
      part.joined_to = key.second;
      part.body = static_cast<int>(b);
      part.actor = body.actor();
      part.node = node;
      part.of_limb = of_limb;
      part.deforms = body.deforms();
      part.segment = role.side.segment;
      std::vector<RigidTransform> part_from_world;
      for (std::size_t k = 0; k < looks; ++k)
        part_from_world.push_back(
            inverse(rigid_frame(states[k][static_cast<std::size_t>(body.actor())]
                                    .world_from_joint[static_cast<std::size_t>(node)])));
      std::vector<glm::vec3> positions;
      std::vector<glm::uvec3> indices;
      std::map<std::pair<int, std::uint32_t>, std::uint32_t> number;
      bool finite = true;
      int named = body.triangles()[triangles.front()].part;
      for (const std::uint32_t t : triangles) {
        const BodyTriangle& source = body.triangles()[t];
        const Mesh& mesh = model.meshes[static_cast<std::size_t>(source.mesh)];
        if (source.joint == node) named = source.part;
        made_of(part, source.part);
        glm::uvec3 corner;
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t v = mesh.triangles[source.triangle][k];
          const auto [at, fresh] =
              number.try_emplace({source.mesh, v}, static_cast<std::uint32_t>(positions.size()));
          corner[k] = at->second;
          if (!fresh) continue;
          Vec3 p(0.0);
          for (std::size_t k = 0; k < looks; ++k)
            p += part_from_world[k] * places.at(source.mesh)[k][v];
          p *= 1.0 / static_cast<double>(looks);
          finite = finite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
          positions.emplace_back(p);
        }
        indices.push_back(corner);
        part.patch_of.push_back(body.patch_of()[t]);
      }
      if (!finite) continue;
      // Pieces of skin stay open here: what is inside one has crossed it on its way.
      auto mesh = CollisionMesh::build(positions, indices);
      if (!mesh) continue;
      part.own = std::make_shared<CollisionMesh>(std::move(mesh).value());
      part.mesh = part.own.get();
      part.name = scene.parts[static_cast<std::size_t>(named)];
      bound(part);
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

}  // namespace elbowroom
