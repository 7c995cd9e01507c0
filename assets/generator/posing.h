// SPDX-License-Identifier: MIT
// Poses of the figure by the world orientation of each joint: trunk, arms, closed hands and legs
// that reach a given foot. Orientations are world_from_joint; 1 is the bind pose for trunk and legs
// and an arm held ahead, thumb up.
#pragma once

#include "assets/generator/figure.h"

namespace elbowroom::demo {

struct FigurePose {
  Vec3 hips{0.0};              // world position of Hips
  std::vector<Quat> world;     // world_from_joint by joint; a joint's parent comes before it
  std::vector<Vec3> position;  // world, by joint
};

Quat turn_x(double angle);
Quat turn_y(double angle);
Quat turn_z(double angle);

class Poser {
 public:
  explicit Poser(const Figure& figure);

  // The bind pose's relation to the parent for all joints not set before compute().
  void begin(const Vec3& hips);
  void set_world(const std::string& joint, const Quat& world_from_joint);
  // Turned in its own axes from the bind pose.
  void set_local(const std::string& joint, const Quat& turn);
  // World orientations and positions as set so far.
  const FigurePose& compute();

  // Angles of an arm in anatomical terms, radians, the same for both sides: flexion forward,
  // abduction to the side, rotation inward; elbow flexion, forearm twist inward.
  struct Arm {
    double flexion = 0, abduction = 0, rotation = 0, elbow = 0, twist = 0;
  };
  // Relative to `trunk` (the chest's world orientation). The hand follows the forearm.
  void set_arm(double side, const Quat& trunk, const Arm& arm);

  // Thigh and shank so that the ankle comes to `ankle` with the knee pointing along `ahead` as near
  // as may be, and the foot's world orientation. Call after compute() of the pelvis. Returns how
  // far out of reach the ankle is (0 if reached).
  double set_leg(double side, const Vec3& ankle, const Quat& foot, const Vec3& ahead);

  // Fingers: curled at ease by `amount` (0 to 1), or closed about a stick through the hand.
  void relax_hand(double side, double amount);
  void grip_hand(double side, const Vec3& stick, double radius);

  const Figure& figure() const { return figure_; }

 private:
  std::size_t at(const std::string& joint) const;
  const Figure& figure_;
  FigurePose pose_;
  std::vector<char> set_;  // 1: world given, 2: local given
  std::vector<Quat> given_;
};

}  // namespace elbowroom::demo
