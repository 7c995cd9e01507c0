// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/anatomy/following.h"
#include "core/anatomy/limb_clip.h"
#include "core/anatomy/limb_model.h"

namespace elbowroom {
namespace {

// The angle that is `angle` up to whole turns and nearest to `near`.
double nearest_turn(double angle, double near) {
  return std::isfinite(near) ? near + std::remainder(angle - near, 2 * kPi) : angle;
}

// exp(v) is one rotation with exp(v - 2π·v/|v|): of the two the nearer to (first, second).
void nearest_swing(double& a, double& b, double first, double second) {
  const double length = std::hypot(a, b);
  if (!(length > 1e-9)) return;
  const double shrink = (length - 2 * kPi) / length;
  const double here = std::hypot(a - first, b - second);
  const double there = std::hypot(a * shrink - first, b * shrink - second);
  if (there < here) {
    a *= shrink;
    b *= shrink;
  }
}

LimbState state_of(const LimbModel& limb, const std::array<Quat, 3>& locals,
                   const LimbState* previous) {
  LimbState state;
  state.q.count = limb.dof_count();
  if (previous != nullptr && previous->q.count != state.q.count) previous = nullptr;
  for (std::size_t i = 0; i < 3; ++i) {
    const JointModel& joint = limb.joints[i];
    double* q = state.q.value.data() + joint.first_dof;
    decompose(joint, locals[i], q, state.residual[i]);
    const auto near = [&](int k) {
      const int dof = joint.first_dof + k;
      if (previous != nullptr) return previous->q[dof];
      const Dof& limits = limb.space.dofs[static_cast<std::size_t>(dof)];
      return 0.5 * (limits.lower + limits.upper);
    };
    if (joint.kind == JointModelKind::hinge) {
      q[0] = nearest_turn(q[0], near(0));
      q[1] = nearest_turn(q[1], near(1));
    } else if (joint.kind != JointModelKind::fixed) {
      // Without a previous state the swing stays the short one, which is unique.
      if (previous != nullptr) nearest_swing(q[0], q[1], near(0), near(1));
      if (joint.kind == JointModelKind::ball) q[2] = nearest_turn(q[2], near(2));
    }
    // q and -q are one rotation; residuals of neighbouring times should be neighbours.
    if (previous != nullptr && glm::dot(previous->residual[i], state.residual[i]) < 0) {
      state.residual[i] = -state.residual[i];
    }
  }
  return state;
}

Quat clip_rotation(const Model& model, const Clip& clip, int joint, double t) {
  const int channel = clip.find_channel(joint, Path::rotation);
  const Joint& node = model.skeleton.joints[static_cast<std::size_t>(joint)];
  if (channel < 0 || node.rest_matrix) return node.rest.rotation;
  return sample_rotation(clip.channels[static_cast<std::size_t>(channel)], t);
}

}  // namespace

LimbState limb_state(const LimbModel& limb, const Pose& pose, const LimbState* previous) {
  std::array<Quat, 3> locals;
  for (std::size_t i = 0; i < 3; ++i) {
    locals[i] = pose.local[static_cast<std::size_t>(limb.joints[i].joint)].rotation;
  }
  return state_of(limb, locals, previous);
}

void apply_limb_state(const LimbModel& limb, const LimbState& state, Pose& pose) {
  for (std::size_t i = 0; i < 3; ++i) {
    const JointModel& joint = limb.joints[i];
    pose.local[static_cast<std::size_t>(joint.joint)].rotation =
        local_rotation(joint, state.q.value.data() + joint.first_dof, state.residual[i]);
  }
}

void apply_limb_state(const LimbModel& limb, const LimbState& state, const Skeleton& skeleton,
                      Pose& pose) {
  if (limb.limb.following.empty()) return apply_limb_state(limb, state, pose);
  const Pose clip = pose;
  apply_limb_state(limb, state, pose);
  pose_following(limb.limb, skeleton, clip, pose);
}

LimbState limb_state_at(const LimbModel& limb, const Model& model, const Clip& clip, double t,
                        const LimbState* previous) {
  std::array<Quat, 3> locals;
  for (std::size_t i = 0; i < 3; ++i) {
    locals[i] = clip_rotation(model, clip, limb.joints[i].joint, t);
  }
  return state_of(limb, locals, previous);
}

Dofs limb_rates_at(const LimbModel& limb, const Model& model, const Clip& clip, double t,
                   int side) {
  // One-sided difference of second order from t ± h, 2h, 3h. The state at t itself takes no part:
  // at a step it belongs to the side after it.
  const double h = side < 0 ? -kRateStep : kRateStep;
  const LimbState s1 = limb_state_at(limb, model, clip, t + h);
  const LimbState s2 = limb_state_at(limb, model, clip, t + 2 * h, &s1);
  const LimbState s3 = limb_state_at(limb, model, clip, t + 3 * h, &s2);
  Dofs rates;
  rates.count = limb.dof_count();
  for (int i = 0; i < rates.count; ++i) {
    rates[i] = (-5 * s1.q[i] + 8 * s2.q[i] - 3 * s3.q[i]) / (2 * h);
  }
  return rates;
}

Elevation elevation(const LimbModel& limb, const Dofs& q) {
  const JointModel& root = limb.joints[0];
  const Vec3 bone = root.parent_from_zero *
                    (joint_rotation(root, q.value.data() + root.first_dof) * Vec3(1, 0, 0));
  const double up = std::clamp(glm::dot(bone, limb.up), -1.0, 1.0);
  const double out = glm::dot(bone, limb.outward);
  const double ahead = glm::dot(bone, limb.forward);
  Elevation result;
  result.raise = std::acos(-up);
  // Hanging or overhead the bone points to no side.
  if (std::hypot(out, ahead) > 1e-9) result.forward = std::atan2(ahead, out);
  return result;
}

}  // namespace elbowroom
