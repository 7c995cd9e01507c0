// SPDX-License-Identifier: MIT
#include "core/editing/surface_target.h"

#include <algorithm>
#include <optional>

#include "core/anatomy/bind_geometry.h"

namespace elbowroom {
namespace {

constexpr int kTurns = 12;              // to either side
constexpr double kTurn = kPi / kTurns;  // radians
constexpr double kSpare = 1.01;         // a hand at the clearance itself is not clear

// The palm's x on the surface: where it points, or, if that is into it, where its back or side
// does.
std::optional<Vec3> along_surface(const Quat& palm, const Vec3& normal) {
  const Vec3 x = palm * Vec3(1, 0, 0);
  if (const auto along = direction_across(x, normal)) return along;
  // The wrist bends over the edge of the palm: fingers that point at the surface go on to where the
  // palm's back is.
  const Vec3 y = palm * Vec3(0, 1, 0);
  return direction_across(glm::dot(x, normal) < 0 ? -y : y, normal);
}

}  // namespace

std::vector<HandTarget> surface_targets(const LimbModel& limb, const Mat4& world_from_end,
                                        const SurfacePoint& point, double clearance,
                                        double hand_length, double time) {
  std::vector<HandTarget> targets;
  HandTarget target;
  target.time = time;
  const bool turns = limb.joints[2].kind != JointModelKind::fixed;
  const auto normal = direction(point.normal);
  if (limb.grasp && turns && normal) {
    const GraspPlace palm = grasp_place(*limb.grasp, world_from_end);
    const auto along = along_surface(palm.orientation, *normal);
    const auto frame = along ? frame_of(*along, -*normal) : std::nullopt;
    if (frame) {
      target.grasp = true;
      target.position = point.place + *normal * (kSpare * clearance + palm.beyond);
      for (int i = 0; i < 2 * kTurns; ++i) {
        const double turn = (i % 2 == 0 ? -1 : 1) * ((i + 1) / 2) * kTurn;
        target.orientation = glm::normalize(glm::angleAxis(turn, *normal) * *frame);
        targets.push_back(target);
      }
    }
  }
  target.grasp = false;
  target.orientation.reset();
  target.position = point.place + point.normal * hand_length;
  targets.push_back(target);
  return targets;
}

double hand_length(const Model& model, const Character& character, const Limb& limb) {
  const auto globals = bind_globals(model, character);
  const Vec3 from = origin(globals, limb.end);
  double length = 0;
  std::vector<Vec3> positions;
  const Pose pose = rest_pose(model.skeleton);
  const auto is_hands = [&](int joint) {
    return model.skeleton.is_within(joint, limb.end) ||
           std::any_of(limb.following.begin(), limb.following.end(), [&](const auto& own) {
             return own.serves == limb.end && model.skeleton.is_within(joint, own.joint);
           });
  };
  for (const int m : character.meshes) {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(m)];
    if (mesh.skin < 0) continue;
    deform(model, mesh, pose, globals, positions);
    for (std::size_t v = 0; v + 1 < mesh.influence_begin.size(); ++v) {
      const Influence* heaviest = nullptr;
      for (std::uint32_t i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i)
        if (!heaviest || mesh.influences[i].weight > heaviest->weight)
          heaviest = &mesh.influences[i];
      if (heaviest && is_hands(heaviest->joint))
        length = std::max(length, glm::length(positions[v] - from));
    }
  }
  return length;
}

}  // namespace elbowroom
