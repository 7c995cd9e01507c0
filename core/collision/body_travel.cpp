// SPDX-License-Identifier: MIT
// Bounds of a body's own travel from those of the nodes it follows.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/animation/affine.h"
#include "core/collision/collision_body.h"

namespace elbowroom {
namespace {

float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

// No less than the largest factor by which the matrix lengthens a vector.
double longest(const Mat4& m) {
  return std::sqrt(glm::dot(Vec3(m[0]), Vec3(m[0])) + glm::dot(Vec3(m[1]), Vec3(m[1])) +
                   glm::dot(Vec3(m[2]), Vec3(m[2])));
}

const std::vector<double>& weights_of(const Mesh& mesh, const ActorState& state) {
  const auto node = static_cast<std::size_t>(mesh.node);
  const bool posed =
      node < state.pose.morph_weights.size() && !state.pose.morph_weights[node].empty();
  return posed ? state.pose.morph_weights[node] : mesh.morph_weights;
}

}  // namespace

void CollisionBody::measure_radii() {
  if (deforms_) {
    largest_radius_.assign(slots_.size(), 0.0);
    for (const Slot& slot : slots_) bind_stretch_.push_back(longest(slot.inverse_bind));
    radius_.reserve(weights_.size());
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      for (std::uint32_t i = weight_begin_[v]; i < weight_begin_[v + 1]; ++i) {
        const std::uint32_t slot = weights_[i].slot;
        const float radius =
            rounded_up(glm::length(transform_point(slots_[slot].inverse_bind, base_[v])));
        radius_.push_back(radius);
        if (weights_[i].weight != 0)
          largest_radius_[slot] = std::max(largest_radius_[slot], static_cast<double>(radius));
      }
  } else {
    largest_radius_.assign(sources_.size(), 0.0);
    bind_stretch_.assign(sources_.size(), 1.0);
  }
  std::size_t source = 0;
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    while (source + 1 < sources_.size() && sources_[source + 1].first_vertex <= v) ++source;
    source_of_.push_back(static_cast<std::uint32_t>(source));
    if (deforms_) continue;
    radius_.push_back(rounded_up(glm::length(base_[v])));
    largest_radius_[source] = std::max(largest_radius_[source], static_cast<double>(radius_[v]));
  }
}

CollisionBody::MorphReach CollisionBody::morph_reach(const ActorState& state,
                                                     const MotionBound& bound,
                                                     std::uint32_t vertex) const {
  MorphReach reach;
  if (morph_begin_.empty()) return reach;
  const std::size_t source = source_of_[vertex];
  const Mesh& mesh = model_->meshes[static_cast<std::size_t>(sources_[source].mesh)];
  const auto& change = bound.weight_travel(actor_, mesh.node);
  const auto& now = weights_of(mesh, state);
  for (std::uint32_t i = morph_begin_[vertex]; i < morph_begin_[vertex + 1]; ++i) {
    const std::size_t target = morphs_[i].target;
    const double size = glm::length(morphs_[i].offset);
    if (target < now.size()) reach.now += std::abs(now[target]) * size;
    if (target < change.size()) reach.change += change[target] * size;
  }
  return reach;
}

double CollisionBody::most_travel(const ActorState& state, const MotionBound& bound,
                                  const std::vector<PointTravel>& by_node) const {
  double now = 0, change = 0;
  if (!morph_begin_.empty())
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
      const MorphReach reach = morph_reach(state, bound, v);
      now = std::max(now, reach.now);
      change = std::max(change, reach.change);
    }
  double most = 0;
  for (std::size_t s = 0; s < largest_radius_.size(); ++s) {
    const int node = deforms_ ? slots_[s].joint
                              : model_->meshes[static_cast<std::size_t>(sources_[s].mesh)].node;
    const PointTravel& t = by_node[static_cast<std::size_t>(node)];
    most = std::max(most, t.fixed + t.per_radius * (largest_radius_[s] + bind_stretch_[s] * now) +
                              t.stretch * bind_stretch_[s] * change);
  }
  return most * (1 + 1e-6);
}

void CollisionBody::triangle_travel(const ActorState& state, const MotionBound& bound,
                                    const std::vector<PointTravel>& by_node,
                                    std::vector<float>& out) const {
  std::vector<float> by_vertex(vertices_.size());
  std::vector<PointTravel> by_slot;
  for (std::size_t s = 0; s < largest_radius_.size(); ++s) {
    const int node = deforms_ ? slots_[s].joint
                              : model_->meshes[static_cast<std::size_t>(sources_[s].mesh)].node;
    by_slot.push_back(by_node[static_cast<std::size_t>(node)]);
  }
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    const MorphReach morph = morph_reach(state, bound, v);
    double sum = 0;
    const auto add = [&](std::size_t slot, double radius, double weight) {
      const PointTravel& t = by_slot[slot];
      double travel = t.fixed + t.per_radius * radius;
      if (morph.now > 0 || morph.change > 0)
        travel += bind_stretch_[slot] * (t.per_radius * morph.now + t.stretch * morph.change);
      sum += std::abs(weight) * travel;
    };
    if (deforms_)
      for (std::uint32_t i = weight_begin_[v]; i < weight_begin_[v + 1]; ++i)
        add(weights_[i].slot, radius_[i], weights_[i].weight);
    else
      add(source_of_[v], radius_[v], 1.0);
    by_vertex[v] = rounded_up(sum * (1 + 1e-6));
  }
  const auto corners = mesh_->triangles();
  out.resize(corners.size());
  for (std::size_t t = 0; t < corners.size(); ++t)
    out[t] = std::max({by_vertex[corners[t].x], by_vertex[corners[t].y], by_vertex[corners[t].z]});
}

}  // namespace elbowroom
