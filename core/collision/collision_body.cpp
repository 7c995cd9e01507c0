// SPDX-License-Identifier: MIT
#include "core/collision/collision_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/animation/affine.h"
#include "core/collision/surface_patches.h"

namespace elbowroom {
namespace {

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

const std::vector<double>& morph_weights_of(const Mesh& mesh, const ActorState& state) {
  const auto node = static_cast<std::size_t>(mesh.node);
  const bool posed =
      node < state.pose.morph_weights.size() && !state.pose.morph_weights[node].empty();
  return posed ? state.pose.morph_weights[node] : mesh.morph_weights;
}

Error not_finite(const Model& model, int mesh) {
  const Mesh& m = model.meshes[static_cast<std::size_t>(mesh)];
  return {"a vertex of mesh \"" + m.name + "\" has no finite place once it is posed",
          model.path.string() + ": meshes[" + std::to_string(m.source_mesh) + "]",
          "look for NaN or infinity in its node's transform, its skin's inverse bind matrices and "
          "its weights"};
}

}  // namespace

RigidTransform rigid_frame(const Mat4& world_from_node) {
  return {glm::mat3_cast(rotation_of(world_from_node)), Vec3(world_from_node[3])};
}

Result<CollisionBody> CollisionBody::build(const Actor& actor, int actor_index, bool deforms,
                                           int frame_node, std::vector<BodyTriangle> triangles,
                                           const ActorState& state, double patch_diameter,
                                           double weld_tolerance) {
  CollisionBody body;
  body.actor_ = actor_index;
  body.frame_node_ = frame_node;
  body.deforms_ = deforms;
  body.model_ = actor.model;
  // Vertices of one mesh stand together, so that a mesh's matrix is looked up once for all.
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const auto& a, const auto& b) { return a.mesh < b.mesh; });
  body.triangles_ = std::move(triangles);

  const Model& model = *body.model_;
  std::vector<glm::uvec3> indices;
  indices.reserve(body.triangles_.size());
  std::vector<std::uint32_t> number;
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  for (const BodyTriangle& t : body.triangles_) {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(t.mesh)];
    if (body.sources_.empty() || body.sources_.back().mesh != t.mesh) {
      body.sources_.push_back({t.mesh, static_cast<std::uint32_t>(body.vertices_.size())});
      number.assign(mesh.positions.size(), kNone);
    }
    glm::uvec3 corner;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t.triangle][k];
      if (number[v] == kNone) {
        number[v] = static_cast<std::uint32_t>(body.vertices_.size());
        body.vertices_.push_back({t.mesh, v});
        body.base_.emplace_back(mesh.positions[v]);
      }
      corner[k] = number[v];
    }
    indices.push_back(corner);
  }

  bool morphing = false;
  for (const Source& source : body.sources_)
    morphing = morphing || !model.meshes[static_cast<std::size_t>(source.mesh)].morphs.empty();
  if (morphing) {
    body.morph_begin_.assign(1, 0);
    for (const VertexSource& v : body.vertices_) {
      const Mesh& mesh = model.meshes[static_cast<std::size_t>(v.mesh)];
      for (std::size_t target = 0; target < mesh.morphs.size(); ++target) {
        const auto& offsets = mesh.morphs[target].offsets;
        if (offsets.size() == mesh.positions.size() && offsets[v.vertex] != glm::vec3(0.0f))
          body.morphs_.push_back({static_cast<std::uint32_t>(target), Vec3(offsets[v.vertex])});
      }
      body.morph_begin_.push_back(static_cast<std::uint32_t>(body.morphs_.size()));
    }
  }
  if (deforms) {
    std::map<std::pair<int, int>, std::uint32_t> slot_number;  // skin and its slot
    body.weight_begin_.assign(1, 0);
    for (const VertexSource& v : body.vertices_) {
      const Mesh& mesh = model.meshes[static_cast<std::size_t>(v.mesh)];
      const auto add = [&](int skin, int slot, int joint, const Mat4& inverse_bind, double weight) {
        const auto [at, fresh] =
            slot_number.try_emplace({skin, slot}, static_cast<std::uint32_t>(body.slots_.size()));
        if (fresh) body.slots_.push_back({joint, inverse_bind});
        body.weights_.push_back({at->second, weight});
      };
      if (mesh.skin < 0) {  // a rigid mesh among skinned ones follows its node wholly
        add(-1, mesh.node, mesh.node, Mat4(1.0), 1.0);
      } else {
        const Skin& skin = model.skins[static_cast<std::size_t>(mesh.skin)];
        for (std::uint32_t i = mesh.influence_begin[v.vertex];
             i < mesh.influence_begin[v.vertex + 1]; ++i) {
          const Influence& influence = mesh.influences[i];
          const auto slot = static_cast<std::size_t>(influence.slot);
          add(mesh.skin, influence.slot, skin.joints[slot], skin.inverse_bind[slot],
              influence.weight);
        }
      }
      body.weight_begin_.push_back(static_cast<std::uint32_t>(body.weights_.size()));
    }
  }

  body.scratch_.assign(body.vertices_.size(), glm::vec3(0.0f));
  if (deforms) {
    // Any origin serves for the build; the mesh's own first joint is as near as any.
    const Vec3 origin =
        body.slots_.empty()
            ? Vec3(0.0)
            : Vec3(state.world_from_joint[static_cast<std::size_t>(body.slots_[0].joint)][3]);
    if (!finite(origin)) return not_finite(model, body.sources_.front().mesh);
    body.skin(state, origin);
  } else if (const Status baked = body.bake(state); !baked) {
    return baked.error();
  }
  for (std::size_t v = 0; v < body.scratch_.size(); ++v)
    if (!finite(Vec3(body.scratch_[v]))) return not_finite(model, body.vertices_[v].mesh);
  // A piece cut out of a skin has an inside; an object's own openings are openings.
  auto mesh =
      CollisionMesh::build(body.scratch_, indices, deforms ? Openings::capped : Openings::open);
  if (!mesh) return mesh.error();
  body.mesh_ = std::make_unique<CollisionMesh>(std::move(mesh).value());
  body.cut(patch_diameter, weld_tolerance);
  body.measure_radii();
  return body;
}

// Positions in the rigid frame of the frame node, less their centre, into scratch_ and used_.
Status CollisionBody::bake(const ActorState& state) {
  const RigidTransform world_from_frame =
      rigid_frame(state.world_from_joint[static_cast<std::size_t>(frame_node_)]);
  const Mat3 turn = glm::transpose(world_from_frame.rotation);
  Baking baking;
  for (const Source& source : sources_) {
    const Mesh& mesh = model_->meshes[static_cast<std::size_t>(source.mesh)];
    const Mat4& world_from_mesh = state.world_from_joint[static_cast<std::size_t>(mesh.node)];
    Mat4 m(1.0);
    for (int c = 0; c < 3; ++c) m[c] = glm::dvec4(turn * Vec3(world_from_mesh[c]), 0.0);
    m[3] = glm::dvec4(turn * (Vec3(world_from_mesh[3]) - world_from_frame.translation), 1.0);
    baking.body_from_mesh.push_back(m);
    if (!mesh.morphs.empty()) {
      const auto& weights = morph_weights_of(mesh, state);
      baking.morph_weights.insert(baking.morph_weights.end(), weights.begin(), weights.end());
    }
  }
  // Noise of the globals' products is no change of shape; a baking within it is the build's own,
  // whatever was asked in between.
  const auto near = [](const Baking& a, const Baking& b) {
    if (a.body_from_mesh.size() != b.body_from_mesh.size() || a.morph_weights != b.morph_weights)
      return false;
    for (std::size_t i = 0; i < a.body_from_mesh.size(); ++i) {
      const Mat4 &x = a.body_from_mesh[i], &y = b.body_from_mesh[i];
      double scale = 0, shift = 0;
      for (int c = 0; c < 3; ++c) scale = std::max(scale, glm::length(Vec3(x[c])));
      for (int c = 0; c < 3; ++c)
        if (!(glm::distance(Vec3(x[c]), Vec3(y[c])) <= 1e-9 * scale)) return false;
      shift = glm::length(Vec3(x[3]));
      if (!(glm::distance(Vec3(x[3]), Vec3(y[3])) <= 1e-9 * (shift + scale))) return false;
    }
    return true;
  };
  if (mesh_ && near(built_, baking)) baking = built_;
  if (mesh_ && near(used_, baking)) return Done{};

  std::vector<Vec3> places(vertices_.size());
  std::size_t next_source = 0;
  std::vector<double> weights;
  const Mat4* body_from_mesh = nullptr;
  const Mesh* mesh = nullptr;
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    if (next_source < sources_.size() && sources_[next_source].first_vertex == v) {
      mesh = &model_->meshes[static_cast<std::size_t>(sources_[next_source].mesh)];
      body_from_mesh = &baking.body_from_mesh[next_source];
      weights = morph_weights_of(*mesh, state);
      ++next_source;
    }
    Vec3 p = base_[v];
    if (!morph_begin_.empty())
      for (std::uint32_t i = morph_begin_[v]; i < morph_begin_[v + 1]; ++i)
        if (morphs_[i].target < weights.size()) p += weights[morphs_[i].target] * morphs_[i].offset;
    places[v] = transform_point(*body_from_mesh, p);
    if (!finite(places[v])) return not_finite(*model_, vertices_[v].mesh);
  }
  if (!mesh_) {
    built_ = baking;
    Vec3 low(0.0), high(0.0);
    for (std::size_t v = 0; v < places.size(); ++v) {
      low = v ? glm::min(low, places[v]) : places[v];
      high = v ? glm::max(high, places[v]) : places[v];
    }
    centre_ = 0.5 * (low + high);
  }
  used_ = std::move(baking);
  local_low_ = Vec3(std::numeric_limits<double>::infinity());
  local_high_ = -local_low_;
  for (std::size_t v = 0; v < places.size(); ++v) {
    scratch_[v] = glm::vec3(places[v] - centre_);
    local_low_ = glm::min(local_low_, Vec3(scratch_[v]));
    local_high_ = glm::max(local_high_, Vec3(scratch_[v]));
  }
  stale_ = mesh_ != nullptr;
  return Done{};
}

void CollisionBody::skin(const ActorState& state, const Vec3& origin) {
  // What moved since last time decides; a skin that stands still costs its matrices only.
  bool same = placed_ && origin == origin_;
  world_from_bind_.resize(slots_.size());
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const Mat4 m = multiply_affine(
        state.world_from_joint[static_cast<std::size_t>(slots_[s].joint)], slots_[s].inverse_bind);
    same = same && m == world_from_bind_[s];
    world_from_bind_[s] = m;
  }
  std::vector<double> morph_weights;
  std::vector<std::uint32_t> first_weight;  // by source
  if (!morph_begin_.empty()) {
    for (const Source& source : sources_) {
      const Mesh& mesh = model_->meshes[static_cast<std::size_t>(source.mesh)];
      first_weight.push_back(static_cast<std::uint32_t>(morph_weights.size()));
      std::vector<double> weights = morph_weights_of(mesh, state);
      weights.resize(mesh.morphs.size(), 0.0);  // targets without a weight do nothing
      morph_weights.insert(morph_weights.end(), weights.begin(), weights.end());
    }
    same = same && morph_weights == morph_weights_;
    morph_weights_ = morph_weights;
  }
  if (same) return;
  origin_ = origin;
  placed_ = true;

  // Rows of the matrices with the origin already taken off, so that the blend loop is plain.
  struct Rows {
    double m[12];
  };
  std::vector<Rows> rows(slots_.size());
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const Mat4& m = world_from_bind_[s];
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 3; ++r) rows[s].m[3 * c + r] = m[c][r] - (c == 3 ? origin[r] : 0.0);
  }

  Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
  std::size_t next_source = 0;
  std::uint32_t weight_base = 0;
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    if (next_source < sources_.size() && sources_[next_source].first_vertex == v) {
      if (!first_weight.empty()) weight_base = first_weight[next_source];
      ++next_source;
    }
    Vec3 p = base_[v];
    if (!morph_begin_.empty())
      for (std::uint32_t i = morph_begin_[v]; i < morph_begin_[v + 1]; ++i)
        p += morph_weights_[weight_base + morphs_[i].target] * morphs_[i].offset;
    const std::uint32_t first = weight_begin_[v], last = weight_begin_[v + 1];
    Vec3 q;
    if (last - first == 1 && weights_[first].weight == 1.0) {
      const double* m = rows[weights_[first].slot].m;
      for (int r = 0; r < 3; ++r) q[r] = m[r] * p.x + m[3 + r] * p.y + m[6 + r] * p.z + m[9 + r];
    } else {
      double blend[12] = {};
      double total = 0;
      for (std::uint32_t i = first; i < last; ++i) {
        const double w = weights_[i].weight;
        const double* m = rows[weights_[i].slot].m;
        for (int k = 0; k < 12; ++k) blend[k] += w * m[k];
        total += w;
      }
      // Weights are float and sum to 1 but for rounding; the player's sum is what stands there, so
      // the part of the origin that the weights left out is put right.
      for (int r = 0; r < 3; ++r)
        q[r] = blend[r] * p.x + blend[3 + r] * p.y + blend[6 + r] * p.z + blend[9 + r] -
               (1.0 - total) * origin[r];
    }
    glm::vec3 place(q);
    // A pose that leaves the numbers (a scale that overflows) keeps the last place it had: contact
    // can't be decided there, and the reader has refused files that hold such numbers themselves.
    if (mesh_ && !(std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z)))
      place = scratch_[v];
    scratch_[v] = place;
    low = glm::min(low, Vec3(place));
    high = glm::max(high, Vec3(place));
  }
  box_ = {low, high};
  stale_ = mesh_ != nullptr;
}

void CollisionBody::place(const ActorState& state, const Vec3& origin) {
  if (deforms_) {
    skin(state, origin);
    return;
  }
  const Mat4& world_from_frame = state.world_from_joint[static_cast<std::size_t>(frame_node_)];
  // A baking that fails (numbers that overflow in some pose) leaves the last shape.
  if (const Status baked = bake(state); !baked) return;
  const RigidTransform frame = rigid_frame(world_from_frame);
  query_from_body_.rotation = frame.rotation;
  query_from_body_.translation = (frame.translation - origin) + frame.rotation * centre_;
  if (local_low_.x > local_high_.x) {
    box_ = {Vec3(1.0), Vec3(-1.0)};
    return;
  }
  const Vec3 middle = 0.5 * (local_low_ + local_high_), half = 0.5 * (local_high_ - local_low_);
  const Vec3 at = query_from_body_ * middle;
  Vec3 reach(0.0);
  for (int c = 0; c < 3; ++c) reach += glm::abs(frame.rotation[c]) * half[c];
  box_ = {at - reach, at + reach};
}

// Patches, their neighbours and the winding, from the positions of the build.
void CollisionBody::cut(double patch_diameter, double weld_tolerance) {
  const std::vector<Vec3> positions(mesh_->positions().begin(), mesh_->positions().end());
  const WeldedSurface surface = weld(positions, mesh_->triangles(), weld_tolerance);
  std::vector<int> group;
  group.reserve(triangles_.size());
  for (const BodyTriangle& t : triangles_) group.push_back(t.part);
  Patches patches = cut_into_patches(surface, group, patch_diameter);
  patch_of_ = std::move(patches.of_triangle);
  patch_count_ = patches.count;

  const auto count = static_cast<std::size_t>(patch_count_);
  patch_begin_.assign(count + 1, 0);
  for (const std::uint16_t p : patch_of_) ++patch_begin_[p + 1u];
  for (std::size_t p = 1; p <= count; ++p) patch_begin_[p] += patch_begin_[p - 1];
  patch_triangles_.resize(patch_of_.size());
  std::vector<std::uint32_t> next(patch_begin_.begin(), patch_begin_.end() - 1);
  for (std::uint32_t i = 0; i < patch_of_.size(); ++i) patch_triangles_[next[patch_of_[i]]++] = i;

  patch_vertex_begin_.assign(1, 0);
  for (std::size_t p = 0; p < count; ++p) {
    std::set<std::uint32_t> vertices;
    for (std::uint32_t i = patch_begin_[p]; i < patch_begin_[p + 1]; ++i)
      for (int k = 0; k < 3; ++k) vertices.insert(mesh_->triangles()[patch_triangles_[i]][k]);
    patch_vertices_.insert(patch_vertices_.end(), vertices.begin(), vertices.end());
    patch_vertex_begin_.push_back(static_cast<std::uint32_t>(patch_vertices_.size()));
  }

  std::vector<std::set<std::uint16_t>> around(count);
  std::vector<std::uint16_t> here;  // patches that meet at a point
  for (std::size_t p = 0; p + 1 < surface.fan_begin.size(); ++p) {
    here.clear();
    for (std::uint32_t i = surface.fan_begin[p]; i < surface.fan_begin[p + 1]; ++i)
      here.push_back(patch_of_[surface.fan[i]]);
    std::sort(here.begin(), here.end());
    here.erase(std::unique(here.begin(), here.end()), here.end());
    for (const std::uint16_t a : here)
      for (const std::uint16_t b : here)
        if (a != b) around[a].insert(b);
  }
  neighbour_begin_.assign(1, 0);
  for (const auto& set : around) {
    neighbours_.insert(neighbours_.end(), set.begin(), set.end());
    neighbour_begin_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  }

  // The sign of the volume a component encloses (an open one about its own middle) says which way
  // its winding looks.
  const std::vector<int> component = connected_components(surface);
  int components = 0;
  for (const int c : component) components = std::max(components, c + 1);
  std::vector<Vec3> sum(static_cast<std::size_t>(components), Vec3(0.0));
  std::vector<double> points(static_cast<std::size_t>(components), 0.0);
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    sum[static_cast<std::size_t>(component[p])] += surface.points[p];
    points[static_cast<std::size_t>(component[p])] += 1;
  }
  std::vector<double> volume(static_cast<std::size_t>(components), 0.0);
  for (const glm::uvec3& t : surface.triangles) {
    const auto c = static_cast<std::size_t>(component[t.x]);
    const Vec3 middle = sum[c] / points[c];
    volume[c] += glm::dot(surface.points[t.x] - middle,
                          glm::cross(surface.points[t.y] - middle, surface.points[t.z] - middle));
  }
  winding_.reserve(surface.triangles.size());
  for (const glm::uvec3& t : surface.triangles)
    winding_.push_back(volume[static_cast<std::size_t>(component[t.x])] < 0 ? -1.0 : 1.0);
}

std::span<const std::uint32_t> CollisionBody::triangles_of_patch(int patch) const {
  const auto p = static_cast<std::size_t>(patch);
  return std::span(patch_triangles_)
      .subspan(patch_begin_[p], patch_begin_[p + 1] - patch_begin_[p]);
}

std::span<const std::uint32_t> CollisionBody::vertices_of_patch(int patch) const {
  const auto p = static_cast<std::size_t>(patch);
  return std::span(patch_vertices_)
      .subspan(patch_vertex_begin_[p], patch_vertex_begin_[p + 1] - patch_vertex_begin_[p]);
}

std::span<const std::uint16_t> CollisionBody::neighbours_of_patch(int patch) const {
  const auto p = static_cast<std::size_t>(patch);
  return std::span(neighbours_)
      .subspan(neighbour_begin_[p], neighbour_begin_[p + 1] - neighbour_begin_[p]);
}

}  // namespace elbowroom
