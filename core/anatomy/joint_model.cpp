// SPDX-License-Identifier: MIT
#include "core/anatomy/joint_model.h"

#include <cmath>

namespace elbowroom {
namespace {

Quat about_x(double angle) { return Quat(std::cos(0.5 * angle), std::sin(0.5 * angle), 0, 0); }
Quat about_z(double angle) { return Quat(std::cos(0.5 * angle), 0, 0, std::sin(0.5 * angle)); }
Quat swing(double a, double b) { return quat_from_rotation_vector(Vec3(0, a, b)); }

// Angle in [-pi, pi] of the twist about x that is nearest to n: of the rotations about x it is the
// one whose quaternion is n's own (w, x), brought to unit length. Where both vanish, which is at a
// swing by pi, every twist is equally near and none is taken.
double twist_of(const Quat& n) {
  if (n.w == 0 && n.x == 0) return 0;
  return n.w < 0 ? 2 * std::atan2(-n.x, -n.w) : 2 * std::atan2(n.x, n.w);
}

// (0, a, b) of n = S(a, b) · T(twist). The swing's x is zero in exact arithmetic; it is left out so
// that rounding does not bring it back.
void swing_of(const Quat& n, double twist, double& a, double& b) {
  const Quat s = n * about_x(-twist);
  const Vec3 v = rotation_vector_from_quat(Quat(s.w, 0, s.y, s.z));
  a = v.y;
  b = v.z;
}

}  // namespace

Quat joint_rotation(const JointModel& model, const double* q) {
  switch (model.kind) {
    case JointModelKind::ball:
      return swing(model.side * q[0], q[1]) * about_x(model.side * q[2]);
    case JointModelKind::hinge:
      return about_z(q[0]) * about_x(model.side * q[1]);
    case JointModelKind::swing:
      return swing(model.side * q[0], q[1]);
    case JointModelKind::fixed:
      break;
  }
  return Quat(1, 0, 0, 0);
}

Quat local_rotation(const JointModel& model, const double* q, const Quat& residual) {
  return glm::normalize(model.parent_from_zero * joint_rotation(model, q) * residual *
                        glm::conjugate(model.joint_from_anatomy));
}

void decompose(const JointModel& model, const Quat& local, double* q, Quat& residual) {
  // N = M · E.
  const Quat n =
      glm::normalize(glm::conjugate(model.parent_from_zero) * local * model.joint_from_anatomy);
  switch (model.kind) {
    case JointModelKind::ball: {
      const double twist = twist_of(n);
      double a = 0;
      swing_of(n, twist, a, q[1]);
      q[0] = model.side * a;
      q[2] = model.side * twist;
      residual = Quat(1, 0, 0, 0);
      return;
    }
    case JointModelKind::hinge: {
      // F and T leave the bone's height over the plane of flexion alone, so the azimuth of the bone
      // is the flexion; of what remains, T · E, the part about x is the twist and E has none.
      const Vec3 bone = n * Vec3(1, 0, 0);
      q[0] = std::atan2(bone.y, bone.x);
      const Quat rest = about_z(-q[0]) * n;
      const double twist = twist_of(rest);
      q[1] = model.side * twist;
      residual = glm::normalize(about_x(-twist) * rest);
      return;
    }
    case JointModelKind::swing: {
      const double twist = twist_of(n);
      double a = 0;
      swing_of(n, twist, a, q[1]);
      q[0] = model.side * a;
      residual = about_x(twist);
      return;
    }
    case JointModelKind::fixed:
      residual = n;
      return;
  }
}

}  // namespace elbowroom
