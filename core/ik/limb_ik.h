// SPDX-License-Identifier: MIT
// Analytic inverse kinematics of a limb in its own joint models [SKF07 5; Tolani and Badler 1996].
//
// A limb of root (ball), middle (hinge or ball) and end (swing, ball or fixed) reaches a position
// with one number left free: the swivel angle, the rotation of the elbow (knee) about the line from
// root to end. For a given swivel everything follows in closed form:
//
//   flexion    from the distance of root and end. Turning about a fixed axis, the end's distance
//              squared is A cos θ + B sin θ + C, whatever offsets and residuals tilt the bones.
//   root       from the direction to the target and the swivel: one frame onto another.
//   twist      of the middle, from the orientation: with N the rotation that twist and end have to
//              make up, T(τ) · B · S(a, b) = N, where S has no twist if the x of the quaternion
//              B⁻¹ T(-τ) N vanishes, which is linear in cos τ/2 and sin τ/2.
//   end        what then remains, S(a, b).
//
// Where residual or offsets take the lower bone off the twist's axis, position depends on the twist
// too; then τ is a fixed point of these steps, found by secants from the analytic value.
//
// Swivel 0 is where the elbow points down (the knee forward) as seen at the limb's zero pose,
// carried from the zero pose's direction to that of root→end by the shortest rotation: body axes,
// continuous but for the direction opposite to the zero pose, which points into the trunk. Positive
// is outward on both sides. It is measured on the normal of the plane of flexion, so that it is
// defined for a straight limb and goes on through hyperextension.
//
// Exact with any uniform scale and with mirrors, above and within the limb. Under scales that are
// not uniform the position is still exact (the flexion by Newton's method from the same seed) and
// the orientation is iterated to; should that not converge, no solution is given.
//
// Spaces: targets are in the world; locals and offsets are those of the pose given, so keyed ones
// are taken at its time. Driven joints keep the pose's local transforms. Units: scene units,
// radians. Immutable once built, any thread; nothing is allocated by solving. Keeps a reference to
// the limb model.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "core/anatomy/limb_model.h"
#include "core/base/result.h"

namespace elbowroom {

struct IkTarget {
  Vec3 position{0.0};               // of the end joint's origin, world
  std::optional<Quat> orientation;  // world_from_joint rotation of the end joint; none: free
};

// Positions off by up to this share of the limb's length count as reached: a hundredth of what is
// promised, and more than the twist of a limb that is all but stretched can be told apart by.
inline constexpr double kReachTolerance = 1e-7;

// Postures for one swivel: one for each sense of the middle's bend.
struct IkSolutions {
  struct One {
    Dofs q;
    // How far the target is beyond (or within) what the bones reach, scene units; 0: reached. The
    // posture is then that which comes nearest along the target's direction.
    double miss = 0;
    int sense = 0;  // 0: flexed (the positive way), 1: the other. Continuous in the swivel
  };
  std::array<One, 2> one;
  int count = 0;
};

class LimbIk {
 public:
  // `pose` holds the locals of all joints at the time, `world_from_parent` is the placement of the
  // root joint's parent (world_from_file for none). `residual` is what the solutions are to have.
  // Errors: a space without volume above the limb, a residual that is no rotation.
  static Result<LimbIk> build(const LimbModel& limb, const Skeleton& skeleton, const Pose& pose,
                              const Mat4& world_from_parent, const std::array<Quat, 3>& residual);

  const LimbModel& limb() const { return *limb_; }
  const std::array<Quat, 3>& residual() const { return residual_; }
  // The limb's parameters in the pose it was built from.
  const Dofs& current() const { return current_; }
  LimbState state(const Dofs& q) const { return {q, residual_}; }

  // Whether the end can take up an orientation; a fixed one can't, and orientations are passed
  // over.
  bool serves_orientation() const { return limb_->joints[2].kind != JointModelKind::fixed; }
  // Longest distance of root and end, stretched out; scene units of the pose's scale. The unit of
  // accuracies.
  double length() const { return world_length_; }
  // False if no posture reaches the target, whatever its limits. A first glance: what it lets pass
  // may still be out of reach.
  bool may_reach(const IkTarget& target) const;
  // Whether all scales are uniform (mirrors included), up to the rounding of a file's numbers.
  bool uniform() const { return uniform_; }

  // Forward kinematics, world.
  struct Points {
    Vec3 root, middle, end;
    Quat end_rotation;
  };
  Points points(const Dofs& q) const;

  // The swivel angle of a posture, (-pi, pi]; 0 where bones have no length.
  double swivel_of(const Dofs& q) const;

  // All postures that reach the target at this swivel. What the target leaves open is as in
  // `near`: middle's sideways angle and end's twist where they are DOFs, the middle's twist and the
  // end if no orientation is asked for. Whole turns are those nearest to `near`. Limits are not
  // looked at. Nothing for a target, swivel or posture that isn't finite.
  IkSolutions solve_at_swivel(const IkTarget& target, double swivel, const Dofs& near) const;
  // Of these the one of that sense, 0 or 1.
  std::optional<IkSolutions::One> solve_at_swivel(const IkTarget& target, double swivel,
                                                  const Dofs& near, int sense) const;
  // The posture with this angle of the middle (about the axis of its bend) instead of the one that
  // reaches: the limb points at the target.
  std::optional<Dofs> point_at(const IkTarget& target, double swivel, const Dofs& near,
                               double flexion) const;

 private:
  LimbIk() = default;

  // The middle's rotation, Rot(axis, angle) · T(twist), in its zero frame.
  struct Bend {
    Vec3 axis{0, 0, 1};
    double angle = 0, twist = 0;
  };
  // A target seen from the root's parent.
  struct Aim {
    Vec3 direction{1, 0, 0};  // of the end, unit
    double distance = 0;
    Vec3 side{0, 1, 0};                 // where the swivel wants the elbow, unit, across direction
    std::optional<Quat> orientation{};  // of the end's anatomical frame with its residual taken off
  };

  Bend bend_of(const Dofs& q) const;
  Vec3 bone_of(const Bend& bend) const;
  Vec3 end_in_root(const Bend& bend) const;
  // The same angle, by whole turns, that is nearest to `near`.
  static double nearest_turn(double angle, double near) {
    return near + std::remainder(angle - near, 2 * kPi);
  }
  double bend_to(double distance, int sense, double near, Bend& bend) const;
  double bend_middle(double distance, int sense, const Dofs& near, Bend& bend) const;
  double bend_sideways(double distance, int sense, double sideways, Bend& bend) const;
  void bend_by_newton(double distance, Bend& bend) const;
  Vec3 swivel_zero(const Vec3& axis) const;
  std::optional<Aim> aim_at(const IkTarget& target, double swivel) const;
  std::optional<Quat> root_towards(const Aim& aim, const Vec3& end_in_root) const;
  double twist_towards(const Quat& wanted, double near, Quat& swing) const;
  bool solve(const Aim& aim, const Dofs& near, int sense, const double* flexion,
             IkSolutions::One& one) const;
  bool solve_for(const IkTarget& target, double swivel, const Dofs& near, int sense,
                 const double* flexion, IkSolutions::One& one) const;

  const LimbModel* limb_ = nullptr;
  std::array<Quat, 3> residual_;
  Dofs current_;
  Mat3 world_from_root_parent_{1.0}, root_parent_from_world_{1.0};
  Vec3 root_in_world_{0.0};
  Vec3 middle_offset_{0.0};  // root's axes after its rotation
  Mat3 root_from_middle_parent_{1.0};
  Mat3 root_from_zero_{1.0};  // that times P of the middle
  Vec3 end_offset_{0.0};      // middle's axes after its rotation
  Vec3 end_on_bone_{0.0};     // E C⁻¹ of that: what the middle's twist turns
  Mat3 middle_from_end_parent_{1.0}, end_scale_{1.0};
  Quat q_world_, q_between_, q_lower_, q_end_;         // rotations of these matrices
  Quat before_end_;                                    // B = E C⁻¹ · q_lower · P of the end
  Vec3 flexion_normal_{0.0};                           // of the plane of flexion, root's axes
  Vec3 zero_axis_{1, 0, 0}, zero_direction_{0, 1, 0};  // swivel's, root's parent's axes
  double scale_squared_ = 1;                           // of root_from_zero_
  double world_length_ = 0;
  double twist_moves_ = 0;       // share of the lower bone that stands off the twist's axis
  bool uniform_ = true;          // up to kUniform
  bool exactly_uniform_ = true;  // up to rounding in double
  bool end_by_matrix_ = false;
};

}  // namespace elbowroom
