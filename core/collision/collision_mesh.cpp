// SPDX-License-Identifier: MIT
#include "core/collision/collision_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/collision/mesh_data.h"

namespace elbowroom {
namespace {

bool usable(const glm::vec3& p) {
  for (int k = 0; k < 3; ++k) {
    if (!(std::abs(p[k]) <= CollisionMesh::kLargestCoordinate)) return false;
  }
  return true;
}

}  // namespace

RigidTransform inverse(const RigidTransform& t) {
  const Mat3 back = glm::transpose(t.rotation);
  return {back, -(back * t.translation)};
}

RigidTransform operator*(const RigidTransform& a_from_b, const RigidTransform& b_from_c) {
  return {a_from_b.rotation * b_from_c.rotation, a_from_b * b_from_c.translation};
}

Result<CollisionMesh> CollisionMesh::build(std::span<const glm::vec3> positions,
                                           std::span<const glm::uvec3> triangles,
                                           Openings openings) {
  // References to triangles are 31 bits.
  if (triangles.size() > std::numeric_limits<std::int32_t>::max() ||
      positions.size() > std::numeric_limits<std::int32_t>::max()) {
    return Error{"the mesh has more than 2^31 - 1 vertices or triangles", "", "split the mesh"};
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (triangles[t][i] >= positions.size()) {
        return Error{"triangle " + std::to_string(t) + " names vertex " +
                         std::to_string(triangles[t][i]) + " of " +
                         std::to_string(positions.size()),
                     "", "export the mesh again"};
      }
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!usable(positions[i])) {
      return Error{"vertex " + std::to_string(i) +
                       " has a coordinate that is no number, infinite or "
                       "beyond 1e15",
                   "", "export the mesh again"};
    }
  }
  auto data = std::make_unique<Data>();
  data->positions.assign(positions.begin(), positions.end());
  data->triangles.assign(triangles.begin(), triangles.end());
  data->topology = build_topology(positions, triangles, openings == Openings::capped);
  data->tree = build_box_tree(positions, triangles);
  data->places.resize(data->topology.components.size());
  data->loop_middles.resize(data->topology.loops.size());
  for (const auto& component : data->topology.components) {
    data->can_enclose = data->can_enclose || component.encloses;
  }
  std::vector<bool> is_used(positions.size(), false);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t vertex = triangles[t][i];
      if (is_used[vertex]) continue;
      is_used[vertex] = true;
      data->used.emplace_back(vertex, data->topology.component[t]);
    }
  data->place_components();
  data->place_rest();
  return CollisionMesh(std::move(data));
}

CollisionMesh::CollisionMesh(std::unique_ptr<Data> data) : data_(std::move(data)) {}
CollisionMesh::CollisionMesh(CollisionMesh&&) noexcept = default;
CollisionMesh& CollisionMesh::operator=(CollisionMesh&&) noexcept = default;
CollisionMesh::~CollisionMesh() = default;

bool CollisionMesh::refit(std::span<const glm::vec3> positions) {
  if (positions.size() != data_->positions.size()) return false;
  if (!std::all_of(positions.begin(), positions.end(), usable)) return false;
  std::copy(positions.begin(), positions.end(), data_->positions.begin());
  data_->was_refit = true;
  data_->place_components();
  refit_box_tree(data_->tree, data_->low, data_->high, data_->positions, data_->triangles);
  data_->place_rest();
  return true;
}

std::span<const glm::vec3> CollisionMesh::positions() const { return data_->positions; }
std::span<const glm::uvec3> CollisionMesh::triangles() const { return data_->triangles; }

void CollisionMesh::Data::place_components() {
  for (std::size_t c = 0; c < places.size(); ++c) {
    ComponentPlace& place = places[c];
    const std::uint32_t first = triangles[topology.components[c].first_triangle].x;
    place.low = place.high = positions[first];
    std::fill(std::begin(place.extreme), std::end(place.extreme), first);
  }
  for (const auto& [vertex, component] : used) {
    ComponentPlace& place = places[component];
    const glm::vec3& p = positions[vertex];
    for (int k = 0; k < 3; ++k) {
      if (p[k] < place.low[k]) {
        place.low[k] = p[k];
        place.extreme[k] = vertex;
      }
      if (p[k] > place.high[k]) {
        place.high[k] = p[k];
        place.extreme[k + 3] = vertex;
      }
    }
  }
  if (!places.empty()) {
    low = places[0].low;
    high = places[0].high;
  }
  for (const ComponentPlace& place : places) {
    low = glm::min(low, place.low);
    high = glm::max(high, place.high);
  }
}

void CollisionMesh::Data::place_rest() {
  std::vector<std::pair<glm::vec3, glm::vec3>> boxes;
  for (std::size_t c = 0; c < places.size(); ++c)
    if (topology.components[c].encloses) boxes.emplace_back(places[c].low, places[c].high);
  enclosing = pack_boxes(boxes, tree.origin);
  for (std::size_t l = 0; l < loop_middles.size(); ++l) {
    loop_middles[l] = glm::vec3(loop_middle(topology.loops[l], positions));
  }
  rays_fresh_.store(false, std::memory_order_release);
}

bool CollisionMesh::Data::sphere_may_meet(const Vec3& centre, double radius) const {
  if (sphere_near_root(tree, centre, radius)) return true;
  return sphere_near_boxes(enclosing.data(), enclosing.size(), centre - tree.origin, radius);
}

void CollisionMesh::Data::make_rays_fresh() const {
  if (rays_are_fresh()) return;
  const std::lock_guard lock(rays_mutex_);
  if (rays_are_fresh()) return;
  const auto local = [&](const glm::vec3& p) { return glm::vec3(Vec3(p) - tree.origin); };
  std::vector<glm::vec3> corners(positions.size());
  std::transform(positions.begin(), positions.end(), corners.begin(), local);
  if (!surface_rays_) surface_rays_ = std::make_unique<RayScene>();
  surface_rays_->set(corners, triangles);
  if (!cap_rays_) cap_rays_ = std::make_unique<RayScene>();
  if (!topology.caps.empty()) {
    corners.insert(corners.end(), loop_middles.size(), glm::vec3(0.0f));
    std::transform(loop_middles.begin(), loop_middles.end(),
                   corners.end() - static_cast<std::ptrdiff_t>(loop_middles.size()), local);
    std::vector<glm::uvec3> caps;
    caps.reserve(topology.caps.size());
    for (const Topology::CapTriangle& cap : topology.caps) {
      caps.push_back({cap.a, cap.b, static_cast<std::uint32_t>(positions.size()) + cap.loop});
    }
    cap_rays_->set(corners, caps);
  }
  rays_fresh_.store(true, std::memory_order_release);
}

const RayScene& CollisionMesh::Data::surface_rays() const {
  make_rays_fresh();
  return *surface_rays_;
}

const RayScene& CollisionMesh::Data::cap_rays() const {
  make_rays_fresh();
  return *cap_rays_;
}

}  // namespace elbowroom
