// SPDX-License-Identifier: MIT
#include "assets/generator/clips.h"

#include <algorithm>
#include <functional>

#include "assets/demo.h"
#include "assets/generator/gait.h"
#include "assets/generator/posing.h"

namespace elbowroom::demo {

namespace {

constexpr double degrees = kPi / 180.0;
constexpr double kRate = 30.0;  // keys a second

double smooth(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

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

// Walking as a function of the stride's phase (left heel contact at 0) with planted feet.
class Walker {
 public:
  Walker(const Figure& figure, const Gait& gait) : figure_(figure), gait_(gait) {
    const auto at = [&](const char* name) {
      return figure.joints[static_cast<std::size_t>(figure.find(name))].position;
    };
    ankle_ = at("LeftFoot");
    thigh_ = glm::length(at("LeftLowerLeg") - at("LeftUpperLeg"));
    shank_ = glm::length(ankle_ - at("LeftLowerLeg"));
    hip_below_pelvis_ = at("Hips").y - at("LeftUpperLeg").y;
    // The sole's pivots, from the ankle: the heel's rear edge and the ball under the toe joint.
    heel_ = Vec3(0, -ankle_.y, -0.048);
    ball_ = Vec3(0, -ankle_.y, at("LeftToes").z - ankle_.z + 0.004);
    place_feet();
    place_pelvis();
  }

  // Pitch of the sole at a phase of its own leg, toes up positive.
  double pitch(double phase) const { return gait_.foot(phase); }

  // How far the toes bend up against the foot: flat on the ground while the heel rises, level with
  // the sole again soon after toe-off.
  double toe_bend(double phase) const {
    phase -= std::floor(phase);
    if (phase > 0.80) return 0.0;
    const double fade = 1.0 - smooth((phase - gait_.toe_off) / 0.14);
    return std::max(0.0, -pitch(phase)) * fade;
  }

  // The ankle at a phase of its own leg, walking direction z, as the pelvis moves on at constant
  // speed: z is relative to the pelvis's place at phase 0.
  Vec3 ankle(double phase) const {
    const double cycle = std::floor(phase);
    phase -= cycle;
    Vec3 p = phase <= gait_.toe_off ? stance(phase) : swing(phase);
    p.z += cycle * gait_.stride;
    return p;
  }

  double pelvis_height(double phase) const {
    return height_ + gait_.pelvis_rise * std::cos(4.0 * kPi * (phase - 0.31));
  }
  double pelvis_forward(double phase) const { return gait_.stride * phase; }

  // Sets pelvis, spine, head and legs of a pose; `phase` may run on over strides, `origin` shifts
  // the walk along z, `travel` false keeps the pelvis on the spot.
  Quat pose(Poser& poser, double phase, double origin, bool travel) const {
    const double wave = 2.0 * kPi * phase;
    // The left side leads with its leg at phase 0: the pelvis turns left side ahead (negative about
    // y), drops on the swinging side, sways over the stance leg (left leg at 0.3).
    const double rotation = -gait_.pelvis_rotation * std::cos(wave);
    const double drop = gait_.pelvis_drop * std::sin(wave - 0.35);
    const double sway = gait_.pelvis_sway * std::sin(wave - 0.25);
    const double forward = pelvis_forward(phase);
    const double shift = travel ? origin : -forward;
    poser.begin(Vec3(sway, pelvis_height(phase), forward + shift));
    const Quat pelvis = turn_y(rotation) * turn_z(drop) * turn_x(1.5 * degrees);
    poser.set_world("Hips", pelvis);
    const double trunk_turn = gait_.trunk_rotation * std::cos(wave + 0.25);
    const double nod = 0.8 * degrees * std::cos(2.0 * wave - 0.6);
    const Quat chest = turn_y(trunk_turn) * turn_z(-0.25 * drop) * turn_x(3.0 * degrees + nod);
    poser.set_world("Spine", slerp_shortest(pelvis, chest, 0.45));
    poser.set_world("Chest", chest);
    poser.set_world("Neck", turn_y(0.45 * trunk_turn) * turn_x(1.0 * degrees + 0.4 * nod));
    poser.set_world("Head", turn_y(0.15 * trunk_turn) * turn_x(1.0 * degrees));
    poser.compute();
    for (const double side : {1.0, -1.0}) {
      const double own = side > 0 ? phase : phase - 0.5;
      Vec3 a = ankle(own);
      if (side < 0) a.z += 0.5 * gait_.stride;
      a.x = side * kTrack;
      a.z += shift;
      const double toe_out = side * 5.0 * degrees;
      poser.set_leg(side, a, turn_y(toe_out) * turn_x(-pitch(own)),
                    turn_y(toe_out + 0.3 * rotation) * Vec3(0, 0, 1));
      poser.set_local(side > 0 ? "LeftToes" : "RightToes", turn_x(-toe_bend(own)));
    }
    return chest;
  }

 private:
  static constexpr double kTrack = 0.072;  // half the distance between the feet's lines

  static Vec3 turned(const Vec3& v, double pitch_up) { return turn_x(-pitch_up) * v; }

  // On the ground the foot rolls over its heel, then stands, then rolls over the ball: the ankle
  // follows from the pitch, and the foot never slides.
  Vec3 stance(double phase) const {
    const double up = pitch(phase);
    const Vec3& pivot = up > 0 ? heel_ : ball_;
    const Vec3 flat = Vec3(0, ankle_.y, contact_);  // the ankle with the sole flat
    return flat + pivot - turned(pivot, up);
  }

  // The ankle from the published hip and knee angles, hip on its steady way.
  Vec3 published(double phase) const {
    const double thigh = gait_.hip(phase), shank = thigh - gait_.knee(phase);
    const double y = pelvis_height_guess(phase) - hip_below_pelvis_ - thigh_ * std::cos(thigh) -
                     shank_ * std::cos(shank);
    const double z = pelvis_forward(phase) + thigh_ * std::sin(thigh) + shank_ * std::sin(shank);
    return {0, y, z};
  }
  double pelvis_height_guess(double phase) const {
    return (height_ > 0 ? height_ : figure_.joints[0].position.y - 0.02) +
           gait_.pelvis_rise * std::cos(4.0 * kPi * (phase - 0.31));
  }

  // In the air: the published path, bent by a cubic so that place and speed agree with the ground
  // at toe-off and at the next heel contact.
  Vec3 swing(double phase) const {
    constexpr double h = 1e-4;
    const double begin = gait_.toe_off, length = 1.0 - begin;
    const Vec3 next(0, 0, gait_.stride);
    const Vec3 gap0 = stance(begin) - published(begin), gap1 = stance(0.0) + next - published(1.0);
    const Vec3 slope0 = (stance(begin) - stance(begin - h)) / h -
                        (published(begin + h) - published(begin - h)) / (2 * h);
    const Vec3 slope1 =
        (stance(h) - stance(0.0)) / h - (published(1.0 + h) - published(1.0 - h)) / (2 * h);
    const double u = (phase - begin) / length, u2 = u * u, u3 = u2 * u;
    return published(phase) + (2 * u3 - 3 * u2 + 1) * gap0 + (u3 - 2 * u2 + u) * length * slope0 +
           (3 * u2 - 2 * u3) * gap1 + (u3 - u2) * length * slope1;
  }

  // The footprint lies where the published angles put the foot on average over its stance.
  void place_feet() {
    contact_ = 0;
    double sum = 0;
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
      const double phase = gait_.toe_off * i / kSteps;
      sum += published(phase).z - stance(phase).z;
    }
    contact_ = sum / kSteps;
  }

  // As high as the legs reach at all phases with the least knee flexion people walk with.
  void place_pelvis() {
    const double reach = std::sqrt(thigh_ * thigh_ + shank_ * shank_ +
                                   2 * thigh_ * shank_ * std::cos(5.0 * degrees));
    double highest = 1e9;
    for (int i = 0; i <= 100; ++i) {
      const double phase = gait_.toe_off * i / 100;
      const Vec3 a = stance(phase);
      const double dz = a.z - pelvis_forward(phase) - hip_ahead(phase);
      const double wave = gait_.pelvis_rise * std::cos(4.0 * kPi * (phase - 0.31));
      highest =
          std::min(highest, a.y + std::sqrt(reach * reach - dz * dz) + hip_below_pelvis_ - wave);
    }
    height_ = highest;
  }
  // The pelvis's rotation carries the hip of the leg ahead forward.
  double hip_ahead(double phase) const {
    return 0.086 * std::sin(gait_.pelvis_rotation * std::cos(2.0 * kPi * phase));
  }

  const Figure& figure_;
  const Gait gait_;
  Vec3 ankle_, heel_, ball_;
  double thigh_ = 0, shank_ = 0, hip_below_pelvis_ = 0;
  double contact_ = 0;
  double height_ = 0;
};

Poser::Arm swinging_arm(const Gait& gait, double phase) {
  Poser::Arm arm;
  arm.flexion = gait.shoulder(phase);
  arm.elbow = gait.elbow(phase);
  arm.abduction = 9.0 * degrees;
  arm.rotation = 12.0 * degrees;
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
  arm.rotation = -6.0 * degrees;
  arm.elbow = (88.0 - 2.0 * std::cos(2.0 * wave - 0.8)) * degrees;
  arm.twist = 0;
  poser.set_arm(-1.0, chest, arm);
  const Quat upright = turn_y(8.0 * degrees) * turn_z((1.5 + 1.2 * std::sin(wave)) * degrees) *
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
  const int way_keys = static_cast<int>(std::lround(kWay / gait.stride * gait.period * kRate));
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
