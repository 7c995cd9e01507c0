// SPDX-License-Identifier: MIT
#include "core/collision/turning_travel.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

// J(u) v in the frame after the swing exp(u): ∫ exp(−αu) v dα.
Vec3 swing_rate(const Vec3& u, const Vec3& v) {
  const double angle2 = glm::dot(u, u), angle = std::sqrt(angle2);
  // By their series where the quotients would lose digits.
  const bool small = angle < 1e-3;
  const double first = small ? 0.5 - angle2 / 24 : (1 - std::cos(angle)) / angle2;
  const double second =
      small ? 1.0 / 6 - angle2 / 120 : (angle - std::sin(angle)) / (angle2 * angle);
  const Vec3 across = glm::cross(u, v);
  return v - first * across + second * glm::cross(u, across);
}

// Of a frame before a twist by `angle`, seen in the frame after it.
Vec3 before_twist(const Vec3& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {v.x, c * v.y + s * v.z, c * v.z - s * v.y};
}

}  // namespace

void set_turn(TurningJoint& turn, const JointModel& model, const double* q, const double* rate,
              double half, const Mat3& world_from_bone) {
  turn.swing = turn.twist = Vec3(0.0);
  turn.swing_angle = 0;
  switch (model.kind) {
    case JointModelKind::ball:
    case JointModelKind::swing: {
      const Vec3 u(0, model.side * q[0], q[1]), v(0, model.side * rate[0], rate[1]);
      Vec3 swing = swing_rate(u, v);
      if (model.kind == JointModelKind::ball) {
        swing = before_twist(swing, model.side * q[2]);
        turn.twist = world_from_bone * Vec3(half * model.side * rate[2], 0, 0);
      }
      turn.swing = world_from_bone * (half * swing);
      turn.swing_angle = half * glm::length(v);
      return;
    }
    case JointModelKind::hinge:
      turn.swing = world_from_bone * before_twist(Vec3(0, 0, half * rate[0]), model.side * q[1]);
      turn.swing_angle = half * std::abs(rate[0]);
      turn.twist = world_from_bone * Vec3(half * model.side * rate[1], 0, 0);
      return;
    case JointModelKind::fixed:
      return;
  }
}

double turning_travel(std::span<const TurningJoint* const> joints, const TurningPart& part) {
  double alone = 0;   // what each joint does by itself
  double beyond = 0;  // what the first order leaves out
  double outside = 0;
  Vec3 turn(0.0), velocity(0.0);  // of the part's centre
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const TurningJoint& joint = *joints[i];
    const Vec3 from = part.centre - joint.origin;
    const double far = glm::length(from) + part.radius;
    const double twist = glm::length(joint.twist), swing = joint.swing_angle;
    double any = joint.lift + joint.loose * far;
    alone += any + swing * far;
    if (twist > 0)
      alone += i + 1 == joints.size() && part.twist_radius >= 0
                   ? twist * part.twist_radius
                   : glm::length(glm::cross(joint.twist, from)) + twist * part.radius;
    any += far * (0.75 * swing * swing + 0.5 * twist * twist + outside * swing +
                  (outside + swing) * twist);
    beyond += any;
    outside += swing + twist + joint.loose;
    const Vec3 own = joint.swing + joint.twist;
    turn += own;
    velocity += glm::cross(own, from);
  }
  if (beyond >= alone) return alone;
  const Vec3 x = glm::cross(turn, part.half[0]), y = glm::cross(turn, part.half[1]),
             z = glm::cross(turn, part.half[2]);
  double fastest2 = 0;
  for (const Vec3& edge : {y + z, y - z})
    for (const Vec3& corner : {x + edge, x - edge})
      fastest2 = std::max({fastest2, glm::dot(velocity + corner, velocity + corner),
                           glm::dot(velocity - corner, velocity - corner)});
  // Nor is any point farther from the centre than the sphere says.
  const double round = glm::length(velocity) + glm::length(turn) * part.radius;
  return std::min(alone, std::min(std::sqrt(fastest2), round) + beyond);
}

}  // namespace elbowroom
