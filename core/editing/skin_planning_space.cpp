// SPDX-License-Identifier: MIT
#include "core/editing/skin_planning_space.h"

#include <algorithm>

#include "core/editing/limb_keys.h"

namespace elbowroom {

SkinPlanningSpace::SkinPlanningSpace(SceneCollision& scene, int limb, double t_init, double t_goal,
                                     const LimbState& at_init, const LimbState& at_goal,
                                     double clearance, double body_clearance,
                                     BesideClipContacts beside, const std::vector<double>& moments)
    : scene_(scene),
      limb_(limb),
      t_init_(t_init),
      t_goal_(t_goal),
      clearance_(clearance),
      body_clearance_(body_clearance),
      at_init_(at_init),
      at_goal_(at_goal),
      beside_(beside) {
  const auto add = [&](double t) {
    if (t > t_init && t < t_goal) steps_.push_back(t);
  };
  for (const auto& actor : scene.world().actors)
    if (actor.clip)
      for (const double t : elbowroom::step_times(*actor.clip)) add(t);
  for (const double t : moments) add(t);
  std::sort(steps_.begin(), steps_.end());
  steps_.erase(std::unique(steps_.begin(), steps_.end()), steps_.end());
}

SkinPlanningSpace::~SkinPlanningSpace() { scene_.pose_limb(limb_, nullptr); }

LimbState SkinPlanningSpace::state_of(const Configuration& c) const {
  LimbState state;
  state.q = c.q;
  state.residual = residual_between(at_init_, at_goal_,
                                    std::clamp((c.t - t_init_) / (t_goal_ - t_init_), 0.0, 1.0));
  return state;
}

bool SkinPlanningSpace::valid(const Configuration& c) {
  const LimbState state = state_of(c);
  scene_.pose_limb(limb_, &state);
  scene_.allow_beside_clip_contacts(beside_ == BesideClipContacts::slides);
  const bool hit = scene_.limb_in_contact(c.t, limb_, clearance_, body_clearance_);
  scene_.allow_beside_clip_contacts(true);
  return !hit;
}

void SkinPlanningSpace::metric_points(const Configuration& c, std::vector<Vec3>& points) {
  const LimbModel& limb = scene_.limbs()[static_cast<std::size_t>(limb_)];
  world_state_at(scene_.world(), c.t, states_);
  ActorState& actor = states_[static_cast<std::size_t>(scene_.actor())];
  const auto& placed = scene_.world().actors[static_cast<std::size_t>(scene_.actor())];
  const LimbState state = state_of(c);
  apply_limb_state(limb, state, actor.pose);
  compute_globals(placed.model->skeleton, actor.pose, placed.world_from_file, globals_);
  points.clear();
  for (std::size_t j = 1; j < limb.joints.size(); ++j)
    points.emplace_back(globals_[static_cast<std::size_t>(limb.joints[j].joint)][3]);
  // A cross about the end effector, a hand long, makes its turning count.
  const Mat4& end = globals_[static_cast<std::size_t>(limb.joints[2].joint)];
  const double reach = 0.1 * scene_.height();
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-reach, reach})
      points.push_back(Vec3(end[3]) + side * glm::normalize(Vec3(end[axis])));
}

const std::vector<double>& SkinPlanningSpace::step_times() const { return steps_; }

}  // namespace elbowroom
