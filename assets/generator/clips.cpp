// SPDX-License-Identifier: MIT
#include "assets/generator/clips.h"

#include <algorithm>
#include <functional>

#include "assets/demo.h"
#include "assets/generator/gait.h"
#include "assets/generator/posing.h"
#include "assets/generator/walker.h"

namespace elbowroom::demo {

namespace {

constexpr double degrees = kPi / 180.0;
constexpr double kRate = 30.0;  // keys a second

// Samples poses at 0, 1/30 s, ... A loop's last key is its first one.
FigureClip record(const Figure& figure, const std::string& name, int keys, bool loop,
                  const std::function<const FigurePose&(double)>& pose_at) {
  FigureClip clip;
  clip.name = name;
  clip.rotations.resize(figure.joints.size());
  for (int k = 0; k < keys; ++k) {
    clip.times.push_back(k / kRate);
    const FigurePose& pose = pose_at(loop && k == keys - 1 ? 0.0 : k / kRate);
    clip.hips.push_back(pose.position[0]);
    for (std::size_t j = 0; j < figure.joints.size(); ++j) {
      const int parent = figure.joints[j].parent;
      Quat local =
          parent < 0 ? pose.world[j]
                     : glm::conjugate(pose.world[static_cast<std::size_t>(parent)]) * pose.world[j];
      if (k > 0 && glm::dot(local, clip.rotations[j].back()) < 0) local = -local;
      clip.rotations[j].push_back(glm::normalize(local));
    }
  }
  return clip;
}

Poser::Arm swinging_arm(const Gait& gait, double phase) {
  Poser::Arm arm;
  arm.flexion = gait.shoulder(phase);
  arm.elbow = gait.elbow(phase);
  arm.abduction = 11.5 * degrees;  // hands pass the thighs without touching
  arm.rotation = 9.0 * degrees;
  arm.twist = 10.0 * degrees;
  return arm;
}

// The umbrella arm: elbow at a right angle, shaft upright a little to the side; it gives with the
// steps.
void carry_umbrella(Poser& poser, const Quat& chest, double phase) {
  const double wave = 2.0 * kPi * phase;
  Poser::Arm arm;
  arm.flexion = (6.0 + 2.5 * std::cos(wave + 0.4)) * degrees;
  arm.abduction = (13.0 + 0.8 * std::sin(wave)) * degrees;
  arm.rotation = -12.0 * degrees;
  arm.elbow = (88.0 - 2.0 * std::cos(2.0 * wave - 0.8)) * degrees;
  arm.twist = 0;
  poser.set_arm(-1.0, chest, arm);
  const Quat upright = turn_z((1.5 + 1.2 * std::sin(wave)) * degrees) *
                       turn_x((-3.0 + 1.0 * std::cos(2.0 * wave)) * degrees);
  poser.set_world("RightHand", upright);
}

}  // namespace

std::vector<FigureClip> make_clips(const Figure& figure) {
  const Gait gait = natural_gait();
  const Walker walker(figure, gait);
  Poser poser(figure);
  const Vec3 grip(kGripX, kGripY, kGripZ);
  std::vector<FigureClip> clips;

  // Four seconds: one breath and a shift of the weight from leg to leg.
  clips.push_back(record(figure, kIdleClip, 121, true, [&](double t) -> const FigurePose& {
    const double wave = 2.0 * kPi * t / 4.0;
    const double shift = std::sin(wave), breath = std::sin(wave - 0.9);
    const Vec3 bind = figure.joints[0].position;
    poser.begin(bind +
                Vec3(0.014 * shift, -0.014 - 0.001 * shift * shift, 0.004 * std::sin(wave + 1.0)));
    const Quat pelvis = turn_z(-1.6 * degrees * shift) * turn_y(1.2 * degrees * shift);
    poser.set_world("Hips", pelvis);
    const Quat chest = turn_z(0.7 * degrees * shift) * turn_y(-0.8 * degrees * shift) *
                       turn_x((-0.9 * breath + 0.5) * degrees);
    poser.set_world("Spine", slerp_shortest(pelvis, chest, 0.5));
    poser.set_world("Chest", chest);
    poser.set_world("Neck", turn_x(0.8 * degrees) * turn_z(0.3 * degrees * shift));
    poser.set_world("Head", turn_y(2.0 * degrees * std::sin(wave + 0.5)) * turn_x(1.0 * degrees));
    poser.compute();
    for (const double side : {1.0, -1.0}) {
      const Vec3 ankle(side * 0.100,
                       figure.joints[static_cast<std::size_t>(figure.find("LeftFoot"))].position.y,
                       -0.012);
      poser.set_leg(side, ankle, turn_y(side * 7.0 * degrees),
                    turn_y(side * 7.0 * degrees) * Vec3(0, 0, 1));
      Poser::Arm arm;
      arm.flexion = (-1.0 + 0.8 * breath) * degrees;
      arm.abduction = (9.0 + 0.5 * breath) * degrees;
      arm.rotation = 14.0 * degrees;
      arm.elbow = (13.0 + 0.8 * breath) * degrees;
      arm.twist = 12.0 * degrees;
      poser.set_arm(side, chest, arm);
      poser.relax_hand(side, 1.0);
    }
    return poser.compute();
  }));

  const int stride_keys = static_cast<int>(std::lround(gait.period * kRate));
  clips.push_back(
      record(figure, kWalkClip, stride_keys + 1, true, [&](double t) -> const FigurePose& {
        const double phase = t * kRate / stride_keys;
        const Quat chest = walker.pose(poser, phase, 0.0, false);
        for (const double side : {1.0, -1.0}) {
          poser.set_arm(side, chest, swinging_arm(gait, side > 0 ? phase : phase - 0.5));
          poser.relax_hand(side, 1.0);
        }
        return poser.compute();
      }));

  // Five metres, the posts' line in the middle.
  constexpr double kWay = 5.0;
  const int way_keys = static_cast<int>(std::lround(kWay / walker.stride() * gait.period * kRate));
  clips.push_back(
      record(figure, kDemoClip, way_keys + 1, false, [&](double t) -> const FigurePose& {
        const double phase = t / gait.period;
        const Quat chest = walker.pose(poser, phase, -0.5 * kWay, true);
        poser.set_arm(1.0, chest, swinging_arm(gait, phase));
        poser.relax_hand(1.0, 1.0);
        carry_umbrella(poser, chest, phase);
        poser.grip_hand(-1.0, grip, 0.0115);
        return poser.compute();
      }));
  return clips;
}

}  // namespace elbowroom::demo
