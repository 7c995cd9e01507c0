// SPDX-License-Identifier: MIT
// The figure walking: published joint angles, made to fit its own legs and a floor on which feet do
// not slide.
#pragma once

#include "assets/generator/gait.h"
#include "assets/generator/posing.h"

namespace elbowroom::demo {

// On the ground a foot rolls over its heel, stands, and rolls over ball and toes: planted by
// construction. In the air the ankle follows the published angles, bent to meet the ground at both
// ends. Legs reach their feet by inverse kinematics; stride length, the feet's place under the body
// and the pelvis's rise and fall are those for which hip and knee then agree best with the
// published angles.
class Walker {
 public:
  Walker(const Figure& figure, const Gait& gait);

  double stride() const { return stride_; }  // metres

  // Sets pelvis, trunk, head and legs of a pose; returns the chest's world orientation. Phase 0 is
  // the left heel's contact, +1 a stride later; `travel` false keeps the pelvis on the spot, else
  // it stands at z = origin at phase 0.
  Quat pose(Poser& poser, double phase, double origin, bool travel) const;

 private:
  Vec3 stance(double phase) const;  // ankle, of its own leg's phase; z from the pelvis at phase 0
  Vec3 swing(double phase) const;
  Vec3 ankle(double phase) const;
  Vec3 published(double phase) const;  // ankle by the published angles
  Vec3 leg(double phase) const;        // hip to ankle by them
  double pelvis_height(double phase) const;
  Vec3 pelvis_place(double phase) const;  // on its way along z, from 0 at phase 0
  Quat pelvis(double phase) const;        // its world orientation
  Vec3 left_hip(double phase) const;
  Vec3 left_foot(double phase) const;  // ankle
  double toe_bend(double phase) const;
  void fit();
  double disagreement();

  const Gait gait_;
  Vec3 ankle_{0.0};                        // bind pose
  Vec3 heel_{0.0}, toes_{0.0}, tip_{0.0};  // the heel's rear edge, toe joint, toe tip, from it
  Vec3 hip_{0.0};                          // left hip from the pelvis, bind pose
  double thigh_ = 0, shank_ = 0;
  double stride_ = 0;
  double contact_ = 0;  // z of the ankle on a flat foot
  double height_ = 0, rise_cos_ = 0, rise_sin_ = 0;
};

}  // namespace elbowroom::demo
