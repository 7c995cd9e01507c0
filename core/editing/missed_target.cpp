// SPDX-License-Identifier: MIT
#include "core/editing/missed_target.h"

#include <cmath>
#include <cstdio>

#include "core/editing/target_posture.h"
#include "core/editing/wrist_target.h"

namespace elbowroom {
namespace {

constexpr double kMissed = 1e-4;      // × limb length
constexpr double kMissedTurn = 1e-3;  // rad

// The limb's end in the world, by what the scene plays.
Mat4 end_at(const WindowProblem& p, double t) {
  std::vector<ActorState> states;
  actor_state_at(p.scene->world(), p.scene->actor(), t, states);
  return states[static_cast<std::size_t>(p.scene->actor())]
      .world_from_joint[static_cast<std::size_t>(p.limb->limb.end)];
}

}  // namespace

std::string missed_target(const WindowProblem& p, const HandTarget& target,
                          const std::shared_ptr<const Clip>& clip) {
  const auto t = static_cast<double>(static_cast<float>(target.time));
  if (!(t > p.begin && t < p.end)) return "its target's time is not inside the window";
  p.scene->set_clip(p.clip);
  const auto ik = limb_ik_at(*p.scene, p.limb_index, t, p.residual_at(t));
  if (!ik) return ik.error().message();
  const auto goal = wrist_target(*ik, end_at(p, t), target);
  if (!goal) return goal.error().message();
  p.scene->set_clip(clip);
  const Mat4 end = end_at(p, t);
  p.scene->set_clip(p.clip);
  char text[80];
  // Written so that what is not a number has missed.
  const double distance = glm::length(Vec3(end[3]) - goal->position);
  if (!(distance <= kMissed * p.length_unit)) {
    std::snprintf(text, sizeof text, "it is %.3g from its target at %.3f s", distance, t);
    return text;
  }
  if (!goal->orientation) return {};
  const double turned = angle_between(rotation_of(end), glm::normalize(*goal->orientation));
  if (turned <= kMissedTurn) return {};
  std::snprintf(text, sizeof text, "it is turned by %.3g° from its target at %.3f s",
                turned * 180 / kPi, t);
  return text;
}

}  // namespace elbowroom
