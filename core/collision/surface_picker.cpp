// SPDX-License-Identifier: MIT
#include "core/collision/surface_picker.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/animation/affine.h"
#include "core/collision/ray_scene.h"

namespace elbowroom {
namespace {

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// All that a mesh's deformed shape depends on.
struct Movers {
  std::vector<Mat4> matrices;
  std::vector<double> morph_weights;
};

// False if the state does not fit the model.
bool find_movers(const Model& model, const Mesh& mesh, const ActorState& state, Movers& out) {
  const auto& globals = state.world_from_joint;
  out.matrices.clear();
  out.morph_weights.clear();
  const auto at = [&](int node) {
    const auto index = static_cast<std::size_t>(node);
    if (node < 0 || index >= globals.size()) return false;
    out.matrices.push_back(globals[index]);
    return true;
  };
  if (mesh.skin < 0) {
    if (!at(mesh.node)) return false;
  } else {
    for (const int joint : model.skins[static_cast<std::size_t>(mesh.skin)].joints) {
      if (!at(joint)) return false;
    }
  }
  const auto node = static_cast<std::size_t>(std::max(mesh.node, 0));
  if (!mesh.morphs.empty() && node < state.pose.morph_weights.size()) {
    out.morph_weights = state.pose.morph_weights[node];
  }
  return true;
}

// +1, or −1 where the placement turns the winding round. A mirror is the whole figure's, so the
// first matrix stands for all.
double winding_of(const Model& model, const Mesh& mesh, const Movers& movers) {
  if (movers.matrices.empty()) return 1;
  Mat4 matrix = movers.matrices.front();
  if (mesh.skin >= 0) {
    matrix = multiply_affine(matrix,
                             model.skins[static_cast<std::size_t>(mesh.skin)].inverse_bind.front());
  }
  return glm::determinant(Mat3(matrix)) < 0 ? -1 : 1;
}

// Where a ray runs through a box: false if it does not, else the stretch [begin, end] ≥ 0 of its
// parameter.
bool clip(const Vec3& origin, const Vec3& direction, const Vec3& lower, const Vec3& upper,
          double& begin, double& end) {
  begin = 0;
  end = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) {
      if (origin[i] < lower[i] || origin[i] > upper[i]) return false;
      continue;
    }
    double a = (lower[i] - origin[i]) / direction[i], b = (upper[i] - origin[i]) / direction[i];
    if (a > b) std::swap(a, b);
    begin = std::max(begin, a);
    end = std::min(end, b);
  }
  return begin <= end && std::isfinite(end);
}

// One mesh of one actor as it was last deformed.
struct Surface {
  std::shared_ptr<const Model> model;  // kept alive: another model may not come to its address
  Movers movers;
  bool built = false;
  bool can_be_hit = false;
  std::vector<Vec3> positions;  // world
  Vec3 middle{0.0};
  double half = 1;  // half of the longest side
  Vec3 lower{0.0}, upper{0.0};
  double winding = 1;
  RayScene scene;
  std::vector<int> joints;  // by triangle; filled when first asked for
};

void build(Surface& surface, const Mesh& mesh, const ActorState& state) {
  const Model& model = *surface.model;
  surface.built = true;
  surface.can_be_hit = false;
  deform(model, mesh, state.pose, state.world_from_joint, surface.positions);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 lower(kInfinity), upper(-kInfinity);
  for (const Vec3& p : surface.positions) {
    if (!finite(p)) continue;
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  const Vec3 extent = upper - lower;
  const double half = 0.5 * std::max({extent.x, extent.y, extent.z});
  if (!(half > 0) || !std::isfinite(half) || mesh.triangles.empty()) return;
  surface.middle = lower + 0.5 * extent;
  surface.half = half;
  // Room for the rounding of floats, and for flat meshes.
  const double pad = 1e-5 * half;
  surface.lower = lower - pad;
  surface.upper = upper + pad;
  surface.winding = winding_of(model, mesh, surface.movers);
  std::vector<glm::vec3> scaled(surface.positions.size());
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    // Embree leaves triangles out that have a vertex which is not finite.
    scaled[i] = glm::vec3((surface.positions[i] - surface.middle) / half);
  }
  surface.scene.set(scaled, mesh.triangles);
  surface.can_be_hit = true;
}

struct Candidate {
  int actor, mesh;
  Surface* surface;
  double begin, end;
};

}  // namespace

int moving_joint(const Mesh& mesh, std::uint32_t triangle) {
  if (mesh.skin < 0) return mesh.node;
  std::vector<std::pair<int, double>> sums;  // few: a linear search is the fastest
  const glm::uvec3 corners = mesh.triangles[triangle];
  for (int c = 0; c < 3; ++c) {
    for (auto i = mesh.influence_begin[corners[c]]; i < mesh.influence_begin[corners[c] + 1]; ++i) {
      const Influence& influence = mesh.influences[i];
      const auto known = std::find_if(
          sums.begin(), sums.end(), [&](const auto& sum) { return sum.first == influence.joint; });
      if (known == sums.end()) {
        sums.emplace_back(influence.joint, influence.weight);
      } else {
        known->second += influence.weight;
      }
    }
  }
  int best = mesh.node;
  double most = -1;
  for (const auto& [joint, sum] : sums) {
    if (sum > most || (sum == most && joint < best)) {
      best = joint;
      most = sum;
    }
  }
  return best;
}

struct SurfacePicker::Data {
  std::vector<std::vector<std::unique_ptr<Surface>>> actors;  // by actor, by mesh
  std::uint64_t builds = 0;
  Movers movers;

  Surface* surface_of(const Actor& actor, std::size_t index, std::size_t mesh,
                      const ActorState& state);
};

Surface* SurfacePicker::Data::surface_of(const Actor& actor, std::size_t index, std::size_t mesh,
                                         const ActorState& state) {
  auto& have = actors[index][mesh];
  if (!have) have = std::make_unique<Surface>();
  if (have->model != actor.model) {
    have = std::make_unique<Surface>();
    have->model = actor.model;
  }
  const Mesh& shape = actor.model->meshes[mesh];
  if (!find_movers(*actor.model, shape, state, movers)) return nullptr;
  if (!have->built || !same_bits(have->movers.matrices, movers.matrices) ||
      !same_bits(have->movers.morph_weights, movers.morph_weights)) {
    have->movers = movers;
    build(*have, shape, state);
    ++builds;
  }
  return have.get();
}

SurfacePicker::SurfacePicker() : data_(std::make_unique<Data>()) {}
SurfacePicker::~SurfacePicker() = default;
SurfacePicker::SurfacePicker(SurfacePicker&&) noexcept = default;
SurfacePicker& SurfacePicker::operator=(SurfacePicker&&) noexcept = default;

std::uint64_t SurfacePicker::builds() const { return data_->builds; }

std::optional<SurfaceHit> SurfacePicker::nearest(const World& world,
                                                 const std::vector<ActorState>& states,
                                                 const WorldRay& ray, const PickFilter& filter) {
  Data& d = *data_;
  d.actors.resize(world.actors.size());
  const double length = glm::length(ray.direction);
  if (!finite(ray.origin) || !(length > 0) || !std::isfinite(length)) return std::nullopt;
  const Vec3 along = ray.direction / length;

  std::vector<Candidate> candidates;
  for (std::size_t a = 0; a < world.actors.size(); ++a) {
    const Actor& actor = world.actors[a];
    const bool hidden = a < filter.hidden.size() && filter.hidden[a] != 0;
    if (!actor.model || a >= states.size() || hidden) continue;
    d.actors[a].resize(actor.model->meshes.size());
    for (std::size_t m = 0; m < actor.model->meshes.size(); ++m) {
      Surface* surface = d.surface_of(actor, a, m, states[a]);
      double begin = 0, end = 0;
      if (surface == nullptr || !surface->can_be_hit ||
          !clip(ray.origin, along, surface->lower, surface->upper, begin, end)) {
        continue;
      }
      candidates.push_back({static_cast<int>(a), static_cast<int>(m), surface, begin, end});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.begin < b.begin; });

  std::optional<SurfaceHit> best;
  for (const Candidate& candidate : candidates) {
    if (best && candidate.begin > best->distance) break;
    Surface& surface = *candidate.surface;
    const Model& model = *surface.model;
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(candidate.mesh)];
    const bool known_material =
        mesh.material >= 0 && mesh.material < static_cast<int>(model.materials.size());
    const bool both_sides =
        filter.back_faces ||
        (known_material && model.materials[static_cast<std::size_t>(mesh.material)].double_sided);
    const bool through = filter.through_actor == candidate.actor && !filter.through_joints.empty();
    if (through && surface.joints.empty()) {
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        surface.joints.push_back(moving_joint(mesh, t));
      }
    }
    const auto accept = [&](std::uint32_t triangle, float facing) {
      if (!both_sides && facing * surface.winding > 0) return false;
      if (!through) return true;
      const auto joint = static_cast<std::size_t>(surface.joints[triangle]);
      return joint >= filter.through_joints.size() || filter.through_joints[joint] == 0;
    };
    // Only the stretch inside the box: short, and near the frame's origin.
    const double stretch = candidate.end - candidate.begin;
    RayScene::Ray local;
    local.origin =
        glm::vec3((ray.origin - surface.middle + candidate.begin * along) / surface.half);
    local.direction = glm::vec3(along * (stretch / surface.half));
    const auto found = surface.scene.nearest_hit(local, accept);
    if (!found) continue;

    const glm::uvec3 corners = mesh.triangles[found->triangle];
    const Vec3 a = surface.positions[corners.x], b = surface.positions[corners.y],
               c = surface.positions[corners.z];
    Vec3 normal = glm::cross(b - a, c - a);
    const double size = glm::length(normal);
    if (!(size > 0)) continue;
    normal /= size;
    double slant = glm::dot(normal, along);
    if (slant > 0) {
      normal = -normal;
      slant = -slant;
    }
    const double proposed = candidate.begin + found->t * stretch;
    double distance = proposed;
    // Where the ray lies nearly in the plane, the plane says less than Embree does.
    if (slant < -1e-6) {
      const double exact = glm::dot(normal, a - ray.origin) / slant;
      if (std::abs(exact - proposed) <= 1e-3 * surface.half) distance = std::max(exact, 0.0);
    }
    if (best && distance >= best->distance) continue;
    best = SurfaceHit{candidate.actor,
                      candidate.mesh,
                      found->triangle,
                      moving_joint(mesh, found->triangle),
                      ray.origin + distance * along,
                      normal,
                      distance};
  }
  return best;
}

}  // namespace elbowroom
