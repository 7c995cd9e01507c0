// SPDX-License-Identifier: MIT
// A figure made by hand for collision tests: a trunk, an arm of two bones with a hand, skinned as
// one tube, and a thigh that the hanging hand brushes; and things to set in its way.
//
// The arm points along +x from the shoulder at (0.2, 1.4, 0): elbow at x = 0.5, wrist at 0.75, end
// at 0.95, radius 0.05. The figure counts as 1.75 high, in metres, at scale 1. The limb's numbers:
// shoulder swing about y and z and twist, elbow flexion about z and twist, wrist swing; all rest
// rotations are the identity, so shoulder q[1] = -pi/2 lets the arm hang.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/anatomy/limb_model.h"
#include "core/collision/scene_collision.h"
#include "core/scene/world.h"
#include "tests/support/shapes.h"

namespace elbowroom::test {

inline constexpr int kHips = 0, kUpper = 1, kFore = 2, kHand = 3, kFinger = 4;
inline constexpr int kForeEnd = 5;  // of a figure whose hand is detached: in the wrist's place
inline constexpr double kHeight = 1.75;
inline constexpr double kEpsilon = 1e-5 * kHeight;

struct FigureOptions {
  double scale = 1;            // of all lengths
  bool thigh = true;           // a box below the shoulder, part of the trunk
  bool sword = false;          // a rigid mesh that hangs below the hand
  bool detached_hand = false;  // it hangs from the hips, and follows the arm
  double thigh_side = 0.16;    // its outer face, x: the hanging arm reaches in to 0.15
};

std::shared_ptr<Model> make_figure(const FigureOptions& options = {});
LimbModel arm_of(const Model& model);

// Keys of the shoulder's q[1] (radians about z): linear rotation channel.
std::shared_ptr<Clip> swing_clip(const std::vector<float>& times, const std::vector<double>& angles,
                                 Interpolation interpolation = Interpolation::linear);

// A model with one object of that shape.
std::shared_ptr<Model> make_object(const std::string& name, const Shape& shape);
Actor actor(const std::string& name, std::shared_ptr<const Model> model, const Vec3& at = Vec3(0.0),
            double scale = 1);

// The figure playing a clip, and other actors.
World world_of(const std::shared_ptr<const Model>& figure, std::shared_ptr<const Clip> clip,
               const std::vector<Actor>& others = {});
SceneCollision scene_of(const World& world, double begin = 0, double end = 1,
                        const CollisionSettings& settings = {});

// Not allowed contacts of the limb at t with a part whose name holds `what`.
bool touches(SceneCollision& scene, double t, const std::string& what);

}  // namespace elbowroom::test
