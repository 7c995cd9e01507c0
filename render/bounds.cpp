// SPDX-License-Identifier: MIT
#include "render/bounds.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {

void Bounds::add(const Vec3& point) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) return;
  lower = glm::min(lower, point);
  upper = glm::max(upper, point);
}

void Bounds::add(const Bounds& other) {
  if (other.empty()) return;
  lower = glm::min(lower, other.lower);
  upper = glm::max(upper, other.upper);
}

double Bounds::distance(const Vec3& point) const {
  if (empty()) return std::numeric_limits<double>::infinity();
  return glm::length(glm::max(Vec3(0.0), glm::max(lower - point, point - upper)));
}

std::vector<Role> mesh_roles(const Actor& actor) {
  if (!actor.model) return {};
  const Role rigid = actor.attachment ? Role::prop : Role::obstacle;
  std::vector<Role> roles(actor.model->meshes.size(), rigid);
  for (const auto& character : actor.model->characters) {
    for (const int mesh : character.meshes) {
      if (mesh >= 0 && mesh < static_cast<int>(roles.size())) {
        roles[static_cast<std::size_t>(mesh)] = Role::character;
      }
    }
  }
  return roles;
}

double scene_size(const World& world) {
  for (const auto& actor : world.actors) {
    if (!actor.model || actor.model->characters.empty()) continue;
    const double scale = std::cbrt(std::abs(glm::determinant(Mat3(actor.world_from_file))));
    const double height = actor.model->characters.front().height * scale;
    if (std::isfinite(height) && height > 0) return height;
  }
  const Vec3 extent = bounds_over(world, {0.0}).extent();
  const double largest = std::max({extent.x, extent.y, extent.z});
  return std::isfinite(largest) && largest > 0 ? largest : 1.0;
}

void body_points(const Actor& actor, const ActorState& state, const std::vector<int>& meshes,
                 std::size_t at_most, std::vector<Vec3>& out) {
  if (!actor.model) return;
  std::vector<Vec3> deformed;
  for (const int index : meshes) {
    const Mesh& mesh = actor.model->meshes[static_cast<std::size_t>(index)];
    deform(*actor.model, mesh, state.pose, state.world_from_joint, deformed);
    const std::size_t step = at_most == 0 ? 1 : std::max<std::size_t>(1, deformed.size() / at_most);
    for (std::size_t i = 0; i < deformed.size(); i += step) {
      const Vec3& p = deformed[i];
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) out.push_back(p);
    }
  }
}

Bounds bounds_over(const World& world, const std::vector<double>& times, unsigned roles) {
  Bounds bounds;
  std::vector<ActorState> states;
  std::vector<Vec3> points;
  for (const double t : times) {
    world_state_at(world, t, states);
    for (std::size_t a = 0; a < world.actors.size(); ++a) {
      const auto role = mesh_roles(world.actors[a]);
      std::vector<int> meshes;
      for (std::size_t m = 0; m < role.size(); ++m) {
        if (roles & (1u << static_cast<unsigned>(role[m]))) meshes.push_back(static_cast<int>(m));
      }
      points.clear();
      body_points(world.actors[a], states[a], meshes, 4000, points);
      for (const auto& p : points) bounds.add(p);
    }
  }
  return bounds;
}

}  // namespace elbowroom
