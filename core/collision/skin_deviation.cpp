// SPDX-License-Identifier: MIT
#include "core/collision/skin_deviation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "core/animation/affine.h"
#include "core/base/random.h"
#include "core/collision/scene_collision_data.h"

namespace elbowroom {

SkinDeviation measure_skin_deviation(SceneCollision& scene, int limb, double t, int configurations,
                                     std::uint64_t seed) {
  SkinDeviation deviation;
  SceneCollision::Data& data = scene.data();
  if (limb < 0 || !data.knows(limb) || !std::isfinite(t)) return deviation;
  const LimbModel& model = data.limbs[static_cast<std::size_t>(limb)];
  const ActorState bind = bind_state(data.world, data.actor, data.character);

  // Patches of each body that lie about some joint.
  std::vector<std::vector<bool>> about_joint(data.bodies.size());
  for (std::size_t b = 0; b < data.bodies.size(); ++b)
    about_joint[b].assign(static_cast<std::size_t>(data.bodies[b].patch_count()), false);
  for (const auto& [key, allowed] : data.allowed_pairs)
    for (int p = 0; p < allowed.patches_a; ++p)
      for (int q = 0; q < allowed.patches_b; ++q)
        if (allowed.reasons_of(p, q) & AllowedPatches::kShared) {
          about_joint[static_cast<std::size_t>(key.first)][static_cast<std::size_t>(p)] = true;
          about_joint[static_cast<std::size_t>(key.second)][static_cast<std::size_t>(q)] = true;
        }

  // Bind places of the limb's skin in the world.
  data.pose_actor(bind);
  std::map<std::size_t, std::vector<Vec3>> bind_places;
  for (std::size_t b = 0; b < data.bodies.size(); ++b) {
    if (!data.roles[b].own || !data.bodies[b].deforms() ||
        !data.in_limb(data.roles[b].side.limb, limb))
      continue;
    auto& places = bind_places[b];
    for (const glm::vec3& p : data.placed(static_cast<int>(b)).mesh().positions())
      places.push_back(Vec3(p) + data.origin);
  }

  const std::optional<LimbState> before = data.posed_limbs[static_cast<std::size_t>(limb)];
  Random random(seed);
  std::vector<double> found;
  for (int i = 0; i < configurations; ++i) {
    LimbState state;
    state.q.count = model.dof_count();
    for (int d = 0; d < model.dof_count(); ++d) {
      const Dof& dof = model.space.dofs[static_cast<std::size_t>(d)];
      state.q[d] = random.uniform(dof.lower, dof.upper);
    }
    // Swings outside their ellipse are no poses of the joint: drawn back onto it.
    for (const EllipseLimit& e : model.space.ellipses) {
      const double x = state.q[e.first] / e.half_first, y = state.q[e.second] / e.half_second;
      const double out = std::sqrt(x * x + y * y);
      if (out > 1) state.q[e.first] /= out, state.q[e.second] /= out;
    }
    for (const PolygonLimit& p : model.space.polygons) {
      const double out = p.gauge(state.q[p.first], state.q[p.second]);
      if (out > 1) state.q[p.first] /= out, state.q[p.second] /= out;
    }
    scene.pose_limb(limb, &state);
    data.pose(t);
    const auto& globals = data.states[static_cast<std::size_t>(data.actor)].world_from_joint;
    for (const auto& [b, places] : bind_places) {
      const CollisionBody& body = data.placed(static_cast<int>(b));
      const auto positions = body.mesh().positions();
      std::map<int, Mat4> world_from_bind;
      for (std::uint32_t n = 0; n < body.triangles().size(); ++n) {
        if (about_joint[b][body.patch_of()[n]]) continue;
        const int joint = body.triangles()[n].joint;
        const auto [m, made] = world_from_bind.try_emplace(joint);
        if (made)
          m->second = globals[static_cast<std::size_t>(joint)] *
                      glm::inverse(bind.world_from_joint[static_cast<std::size_t>(joint)]);
        const glm::uvec3& corner = body.mesh().triangles()[n];
        Vec3 rigid[3];
        for (int k = 0; k < 3; ++k)
          rigid[k] = transform_point(m->second, places[corner[k]]) - data.origin;
        const Vec3 cross = glm::cross(rigid[1] - rigid[0], rigid[2] - rigid[0]);
        const double area = glm::length(cross);
        if (!(area > 0)) continue;
        const Vec3 normal = cross * (body.winding(n) / area);
        for (int k = 0; k < 3; ++k)
          found.push_back(std::max(0.0, glm::dot(Vec3(positions[corner[k]]) - rigid[k], normal)));
      }
    }
  }
  scene.pose_limb(limb, before ? &*before : nullptr);
  data.posed = false;
  if (found.empty()) return deviation;
  std::sort(found.begin(), found.end());
  deviation.measured = found.size();
  deviation.median = found[found.size() / 2];
  deviation.percentile_95 = found[found.size() * 95 / 100];
  deviation.largest = found.back();
  return deviation;
}

}  // namespace elbowroom
