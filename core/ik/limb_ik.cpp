// SPDX-License-Identifier: MIT
#include "core/ik/limb_ik.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/animation/affine.h"

namespace elbowroom {
namespace {

// A fixed point of the twist is searched for until it moves by less than this, radians; more than
// the second is no solution.
constexpr double kTwistDone = 1e-13, kTwistAccepted = 1e-9;
constexpr int kTwistSteps = 40;
// Scales that differ by less are uniform: well below the accuracies promised, above the rounding of
// float32. Positions are made exact beyond the second.
constexpr double kUniform = 2e-6, kExactlyUniform = 1e-13;
// Under scales that are not uniform: the orientation's correction.
constexpr int kOrientationSteps = 60;
constexpr double kOrientationDone = 1e-9, kOrientationAccepted = 1e-5;

Quat about_x(double angle) { return Quat(std::cos(0.5 * angle), std::sin(0.5 * angle), 0, 0); }

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const Dofs& q) {
  for (int i = 0; i < q.count; ++i) {
    if (!std::isfinite(q[i])) return false;
  }
  return true;
}

std::optional<Quat> unit(const Quat& q) {
  const double length = glm::length(q);
  if (!(length > 1e-6) || !std::isfinite(length)) return std::nullopt;
  return q / length;
}

std::optional<Vec3> unit(const Vec3& v, double least = 1e-150) {
  const double length = glm::length(v);
  if (!(length > least) || !std::isfinite(length)) return std::nullopt;
  return v / length;
}

std::optional<Vec3> unit_across(const Vec3& v, const Vec3& axis) {
  return unit(v - axis * glm::dot(v, axis), 1e-6);
}

// Square of the factor by which m scales lengths, in the mean.
double scale_squared(const Mat3& m) {
  return (glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])) / 3;
}

bool is_uniform(const Mat3& m, double within) {
  const double s = scale_squared(m);
  for (int c = 0; c < 3; ++c) {
    if (!(std::abs(glm::dot(m[c], m[c]) - s) <= within * s)) return false;
    if (!(std::abs(glm::dot(m[c], m[(c + 1) % 3])) <= within * s)) return false;
  }
  return true;
}

Mat4 local_matrix(const Skeleton& skeleton, const Pose& pose, int joint) {
  const auto j = static_cast<std::size_t>(joint);
  return skeleton.joints[j].rest_matrix ? *skeleton.joints[j].rest_matrix : pose.local[j].matrix();
}

// What stands between the rotations of two limb joints: the upper one's scale, the driven joints
// and the lower one's translation.
Mat4 between(const Skeleton& skeleton, const Pose& pose, int upper, int lower) {
  const auto l = static_cast<std::size_t>(lower);
  Mat4 m(1.0);
  m[3] = skeleton.joints[l].rest_matrix ? (*skeleton.joints[l].rest_matrix)[3]
                                        : glm::dvec4(pose.local[l].translation, 1.0);
  int joint = skeleton.joints[l].parent;
  for (; joint >= 0 && joint != upper;
       joint = skeleton.joints[static_cast<std::size_t>(joint)].parent)
    m = multiply_affine(local_matrix(skeleton, pose, joint), m);
  const Vec3 scale = pose.local[static_cast<std::size_t>(upper)].scale;
  Mat4 scaling(1.0);
  for (int c = 0; c < 3; ++c) scaling[c][c] = scale[c];
  return multiply_affine(scaling, m);
}

}  // namespace

Result<LimbIk> LimbIk::build(const LimbModel& limb, const Skeleton& skeleton, const Pose& pose,
                             const Mat4& world_from_parent, const std::array<Quat, 3>& residual) {
  const JointModel& root = limb.joints[0];
  const JointModel& middle = limb.joints[1];
  const JointModel& end = limb.joints[2];
  const auto joint_name = [&](const JointModel& joint) {
    return skeleton.joints[static_cast<std::size_t>(joint.joint)].name;
  };
  LimbIk ik;
  ik.limb_ = &limb;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto checked = unit(residual[i]);
    if (!checked) return Error{"the residual is no rotation", joint_name(limb.joints[i]), ""};
    ik.residual_[i] = *checked;
  }
  ik.current_ = limb_state(limb, pose).q;

  const Transform& root_local = pose.local[static_cast<std::size_t>(root.joint)];
  ik.world_from_root_parent_ = Mat3(world_from_parent);
  ik.root_parent_from_world_ = glm::inverse(ik.world_from_root_parent_);
  ik.root_in_world_ = transform_point(world_from_parent, root_local.translation);
  for (int c = 0; c < 3; ++c) {
    if (!finite(ik.root_parent_from_world_[c]) || !finite(ik.world_from_root_parent_[c]))
      return Error{"the joint's parent has no size", joint_name(root), "repair the rig"};
  }

  const Mat4 upper = between(skeleton, pose, root.joint, middle.joint);
  const Mat4 lower = between(skeleton, pose, middle.joint, end.joint);
  ik.middle_offset_ = Vec3(upper[3]);
  ik.root_from_middle_parent_ = Mat3(upper);
  ik.root_from_zero_ = Mat3(upper) * glm::mat3_cast(middle.parent_from_zero);
  ik.end_offset_ = Vec3(lower[3]);
  const Quat bone_from_joint = ik.residual_[1] * glm::conjugate(middle.joint_from_anatomy);
  ik.end_on_bone_ = bone_from_joint * ik.end_offset_;
  ik.middle_from_end_parent_ = Mat3(lower);
  const Joint& end_joint = skeleton.joints[static_cast<std::size_t>(end.joint)];
  ik.end_by_matrix_ = end_joint.rest_matrix.has_value();
  if (ik.end_by_matrix_) {
    ik.end_scale_ = Mat3(*end_joint.rest_matrix);
  } else {
    const Vec3 scale = pose.local[static_cast<std::size_t>(end.joint)].scale;
    for (int c = 0; c < 3; ++c) ik.end_scale_[c][c] = scale[c];
  }
  ik.q_world_ = rotation_of(Mat4(ik.world_from_root_parent_));
  ik.q_between_ = rotation_of(upper);
  ik.q_lower_ = rotation_of(lower);
  ik.q_end_ = rotation_of(Mat4(ik.end_scale_));
  ik.before_end_ = bone_from_joint * ik.q_lower_ * end.parent_from_zero;
  const auto all_uniform = [&](double within) {
    return is_uniform(ik.world_from_root_parent_, within) &&
           is_uniform(ik.root_from_middle_parent_, within) &&
           is_uniform(ik.middle_from_end_parent_, within) && is_uniform(ik.end_scale_, within);
  };
  ik.uniform_ = all_uniform(kUniform);
  ik.exactly_uniform_ = is_uniform(ik.root_from_middle_parent_, kExactlyUniform);
  ik.scale_squared_ = scale_squared(ik.root_from_zero_);
  const Mat3& zero = ik.root_from_zero_;
  ik.flexion_normal_ = unit(glm::cross(zero[0], zero[1])).value_or(Vec3(0, 0, 1));
  ik.twist_moves_ = glm::length(Vec3(0, ik.end_on_bone_.y, ik.end_on_bone_.z)) /
                    std::max(1e-300, glm::length(ik.end_on_bone_));

  ik.zero_axis_ = root.parent_from_zero * Vec3(1, 0, 0);
  const Vec3 y = root.parent_from_zero * Vec3(0, 1, 0);
  const bool leg = limb.limb.kind == LimbKind::left_leg || limb.limb.kind == LimbKind::right_leg;
  const Vec3 wanted = leg ? limb.forward : limb.limb.is_arm() ? -limb.up : -y;
  ik.zero_direction_ = unit_across(wanted, ik.zero_axis_).value_or(y);

  ik.world_length_ = (glm::length(ik.middle_offset_) +
                      std::sqrt(ik.scale_squared_) * glm::length(ik.end_on_bone_)) *
                     std::sqrt(scale_squared(ik.world_from_root_parent_));
  if (!std::isfinite(ik.world_length_) || !finite(ik.root_in_world_))
    return Error{"the limb's pose is not finite", joint_name(root), "repair the clip"};
  return ik;
}

// ---------------------------------------------------------------- forward

LimbIk::Points LimbIk::points(const Dofs& q) const {
  std::array<Quat, 3> local;
  for (std::size_t i = 0; i < 3; ++i) {
    const JointModel& joint = limb_->joints[i];
    local[i] = local_rotation(joint, q.value.data() + joint.first_dof, residual_[i]);
  }
  if (end_by_matrix_) local[2] = Quat(1, 0, 0, 0);
  const auto world = [&](const Vec3& in_root) {
    return root_in_world_ + world_from_root_parent_ * (local[0] * in_root);
  };
  Points points;
  points.root = root_in_world_;
  points.middle = world(middle_offset_);
  points.end = world(middle_offset_ + root_from_middle_parent_ * (local[1] * end_offset_));
  if (uniform_) {
    points.end_rotation =
        glm::normalize(q_world_ * local[0] * q_between_ * local[1] * q_lower_ * local[2] * q_end_);
  } else {
    points.end_rotation =
        rotation_of(Mat4(world_from_root_parent_ * glm::mat3_cast(local[0]) *
                         root_from_middle_parent_ * glm::mat3_cast(local[1]) *
                         middle_from_end_parent_ * glm::mat3_cast(local[2]) * end_scale_));
  }
  return points;
}

LimbIk::Bend LimbIk::bend_of(const Dofs& q) const {
  const JointModel& middle = limb_->joints[1];
  const double* n = q.value.data() + middle.first_dof;
  Bend bend;
  if (middle.kind == JointModelKind::ball) {
    const Vec3 swing(0, middle.side * n[0], n[1]);
    // Bent the other way is a negative angle about an axis on the same side.
    const double length = glm::length(swing) * (n[1] < 0 ? -1 : 1);
    if (std::abs(length) > 1e-12) bend.axis = swing / length;
    bend.angle = length;
    bend.twist = middle.side * n[2];
  } else {
    bend.angle = n[0];
    bend.twist = middle.side * n[1];
  }
  return bend;
}

// The lower bone before it is bent, in the middle's zero frame.
Vec3 LimbIk::bone_of(const Bend& bend) const { return about_x(bend.twist) * end_on_bone_; }

Vec3 LimbIk::end_in_root(const Bend& bend) const {
  const Vec3 bone = glm::angleAxis(bend.angle, bend.axis) * bone_of(bend);
  return middle_offset_ + root_from_zero_ * bone;
}

Vec3 LimbIk::swivel_zero(const Vec3& axis) const {
  return shortest_rotation(zero_axis_, axis) * zero_direction_;
}

double LimbIk::swivel_of(const Dofs& q) const {
  const JointModel& root = limb_->joints[0];
  const Quat rotation = local_rotation(root, q.value.data() + root.first_dof, residual_[0]);
  const auto end = unit(end_in_root(bend_of(q)));
  const auto elbow = end ? unit(glm::cross(*end, flexion_normal_), 1e-9) : std::nullopt;
  if (!elbow) return 0;
  const Vec3 axis = rotation * *end, side = rotation * *elbow;
  const Vec3 zero = swivel_zero(axis);
  return root.side * std::atan2(glm::dot(axis, glm::cross(zero, side)), glm::dot(zero, side));
}

bool LimbIk::may_reach(const IkTarget& target) const {
  const auto aim = aim_at(target, 0);
  if (!aim) return false;
  if (!uniform_) return true;
  const double upper = glm::length(middle_offset_);
  const double lower = std::sqrt(scale_squared_) * glm::length(end_on_bone_);
  const double slack = kReachTolerance * (upper + lower);
  return aim->distance <= upper + lower + slack && aim->distance >= std::abs(upper - lower) - slack;
}

// ---------------------------------------------------------------- root, twist, end

std::optional<LimbIk::Aim> LimbIk::aim_at(const IkTarget& target, double swivel) const {
  if (!finite(target.position) || !std::isfinite(swivel)) return std::nullopt;
  const Vec3 end = root_parent_from_world_ * (target.position - root_in_world_);
  Aim aim;
  aim.distance = glm::length(end);
  if (!std::isfinite(aim.distance)) return std::nullopt;
  aim.direction = unit(end).value_or(zero_axis_);
  const Vec3 zero = swivel_zero(aim.direction);
  aim.side = glm::angleAxis(limb_->joints[0].side * swivel, aim.direction) * zero;
  if (target.orientation && serves_orientation()) {
    const auto wanted = unit(*target.orientation);
    if (!wanted) return std::nullopt;
    aim.orientation = glm::conjugate(q_world_) * *wanted * glm::conjugate(q_end_) *
                      limb_->joints[2].joint_from_anatomy * glm::conjugate(residual_[2]);
  }
  return aim;
}

std::optional<Quat> LimbIk::root_towards(const Aim& aim, const Vec3& end_in_root) const {
  const auto end = unit(end_in_root);
  const auto elbow = end ? unit(glm::cross(*end, flexion_normal_), 1e-9) : std::nullopt;
  if (!elbow) return std::nullopt;
  const Mat3 from(*end, *elbow, glm::cross(*end, *elbow));
  const Mat3 to(aim.direction, aim.side, glm::cross(aim.direction, aim.side));
  return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

// The τ nearest to `near` with T(τ) · B · S = wanted and S without twist; S too.
double LimbIk::twist_towards(const Quat& wanted, double near, Quat& swing) const {
  const Quat back = glm::conjugate(before_end_);
  const Quat first = back * wanted, second = back * (Quat(0, 1, 0, 0) * wanted);
  // x of B⁻¹ T(-τ) wanted is cos(τ/2) first.x - sin(τ/2) second.x.
  const double half = first.x == 0 && second.x == 0 ? 0.5 * near : std::atan2(first.x, second.x);
  const double twist = nearest_turn(2 * half, near);
  swing = back * (about_x(-twist) * wanted);
  swing = glm::normalize(Quat(swing.w, 0, swing.y, swing.z));
  return twist;
}

bool LimbIk::solve(const Aim& aim, const Dofs& near, int sense, const double* flexion,
                   IkSolutions::One& one) const {
  const JointModel& root = limb_->joints[0];
  const JointModel& middle = limb_->joints[1];
  const JointModel& end = limb_->joints[2];
  const bool ball = middle.kind == JointModelKind::ball;
  const Bend near_bend = bend_of(near);
  const double* near_end = near.value.data() + end.first_dof;
  Quat wanted(1, 0, 0, 0), swing(1, 0, 0, 0), root_rotation(1, 0, 0, 0);
  if (aim.orientation)
    wanted = *aim.orientation *
             about_x(end.kind == JointModelKind::ball ? -end.side * near_end[2] : 0.0);

  Bend bend;
  double miss = 0;
  // All but the twist for a given twist; returns the twist that the orientation then wants.
  const auto round = [&](double twist) -> std::optional<double> {
    bend = near_bend;
    bend.twist = twist;
    if (flexion == nullptr) {
      miss = bend_middle(aim.distance, sense, near, bend);
    } else if (ball) {
      const double sideways = middle.side * near[middle.first_dof];
      const Vec3 vector(0, sideways, *flexion);
      bend.angle = glm::length(vector);
      if (bend.angle > 0) bend.axis = vector / bend.angle;
    } else {
      bend.angle = *flexion;
    }
    const auto rotation = root_towards(aim, end_in_root(bend));
    if (!rotation) return std::nullopt;
    root_rotation = *rotation;
    if (!aim.orientation) return twist;
    const Quat before = root_rotation * q_between_ * middle.parent_from_zero *
                        glm::angleAxis(bend.angle, bend.axis);
    return twist_towards(glm::conjugate(before) * wanted, twist, swing);
  };

  double twist = near_bend.twist;
  auto next = round(twist);
  if (!next) return false;
  if (aim.orientation) {
    // Where the twist moves nothing the second round only confirms the first.
    double last_twist = twist, last_step = *next - twist;
    twist = *next;
    double step = 0;
    for (int i = 0; i < kTwistSteps; ++i) {
      next = round(twist);
      if (!next) return false;
      step = *next - twist;
      if (std::abs(step) <= kTwistDone || twist_moves_ < 1e-12) break;
      const double slope = (step - last_step) / (twist - last_twist);
      last_twist = twist;
      last_step = step;
      // Secant on next(twist) - twist; near the fixed point the slope is about -1.
      const bool sound = std::isfinite(slope) && slope < -0.2 && slope > -5 && i < 20;
      twist += sound ? -step / slope : step;
      if (twist == last_twist) break;
    }
    if (!(std::abs(step) <= kTwistAccepted)) return false;
    bend.twist = twist;
  }

  Dofs& q = one.q;
  q = near;
  Quat unused;
  const Quat& frame = root.joint_from_anatomy;
  decompose(root, root_rotation * frame * glm::conjugate(residual_[0]) * glm::conjugate(frame),
            q.value.data() + root.first_dof, unused);
  q[root.first_dof + 2] = nearest_turn(q[root.first_dof + 2], near[root.first_dof + 2]);
  double* n = q.value.data() + middle.first_dof;
  if (ball) {
    n[0] = middle.side * bend.angle * bend.axis.y;
    n[1] = bend.angle * bend.axis.z;
    n[2] = middle.side * bend.twist;
  } else {
    n[0] = bend.angle;
    n[1] = middle.side * bend.twist;
  }
  if (aim.orientation) {
    const Vec3 vector = rotation_vector_from_quat(swing);
    q[end.first_dof] = end.side * vector.y;
    q[end.first_dof + 1] = vector.z;
  }
  if (miss != 0) {
    // Along the aim's direction, in the world.
    one.miss = std::abs(miss) * glm::length(world_from_root_parent_ * aim.direction);
  } else {
    one.miss = 0;
  }
  one.sense = sense;
  return finite(q);
}

bool LimbIk::solve_for(const IkTarget& target, double swivel, const Dofs& near, int sense,
                       const double* flexion, IkSolutions::One& one) const {
  const auto aim = aim_at(target, swivel);
  if (!aim || !solve(*aim, near, sense, flexion, one)) return false;
  if (uniform_ || !aim->orientation) return true;
  // The rotation of a sheared matrix is no product of rotations: aim off by what is missing.
  const Quat wanted = glm::normalize(*target.orientation);
  IkTarget corrected = target;
  corrected.orientation = wanted;
  for (int i = 0; i < kOrientationSteps; ++i) {
    const Quat actual = points(one.q).end_rotation;
    const double off = angle_between(actual, wanted);
    if (off <= kOrientationDone) return true;
    corrected.orientation =
        glm::normalize(wanted * glm::conjugate(actual) * *corrected.orientation);
    const auto again = aim_at(corrected, swivel);
    if (!again || !solve(*again, near, sense, flexion, one)) return false;
  }
  return angle_between(points(one.q).end_rotation, wanted) <= kOrientationAccepted;
}

IkSolutions LimbIk::solve_at_swivel(const IkTarget& target, double swivel, const Dofs& near) const {
  IkSolutions solutions;
  if (near.count != limb_->dof_count() || !finite(near)) return solutions;
  for (int sense = 0; sense < 2; ++sense) {
    IkSolutions::One& one = solutions.one[static_cast<std::size_t>(solutions.count)];
    if (!solve_for(target, swivel, near, sense, nullptr, one)) continue;
    ++solutions.count;
  }
  return solutions;
}

std::optional<IkSolutions::One> LimbIk::solve_at_swivel(const IkTarget& target, double swivel,
                                                        const Dofs& near, int sense) const {
  IkSolutions::One one;
  if (near.count != limb_->dof_count() || !finite(near)) return std::nullopt;
  if (!solve_for(target, swivel, near, sense, nullptr, one)) return std::nullopt;
  return one;
}

std::optional<Dofs> LimbIk::point_at(const IkTarget& target, double swivel, const Dofs& near,
                                     double flexion) const {
  if (near.count != limb_->dof_count() || !finite(near) || !std::isfinite(flexion))
    return std::nullopt;
  IkSolutions::One one;
  if (!solve_for(target, swivel, near, 0, &flexion, one)) return std::nullopt;
  return one.q;
}

}  // namespace elbowroom
