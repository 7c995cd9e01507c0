// SPDX-License-Identifier: MIT
#include "assets/generator/walker.h"

#include <algorithm>

namespace elbowroom::demo {

namespace {

constexpr double degrees = kPi / 180.0;
constexpr double kTrack = 0.072;  // half the distance between the feet's lines, metres
constexpr double kToeOut = 5.0 * degrees;

double smooth(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

// How far the toes bend up against a foot whose heel is up by that angle: with it at first, then no
// further.
double bend(double heel_up) {
  constexpr double kBegin = 14.0 * degrees, kEnd = 40.0 * degrees;
  if (heel_up <= kBegin) return heel_up;
  const double over = std::min(heel_up, kEnd) - kBegin;
  return kBegin + over - over * over / (2.0 * (kEnd - kBegin));
}

Vec3 pitched(const Vec3& v, double toes_up) { return turn_x(-toes_up) * v; }

}  // namespace

Walker::Walker(const Figure& figure, const Gait& gait) : gait_(gait) {
  const auto at = [&](const char* name) {
    return figure.joints[static_cast<std::size_t>(figure.find(name))].position;
  };
  ankle_ = at("LeftFoot");
  thigh_ = glm::length(at("LeftLowerLeg") - at("LeftUpperLeg"));
  shank_ = glm::length(ankle_ - at("LeftLowerLeg"));
  hip_ = at("LeftUpperLeg") - at("Hips");
  heel_ = Vec3(0, -ankle_.y, -0.048);
  toes_ = Vec3(0, at("LeftToes").y - ankle_.y, at("LeftToes").z - ankle_.z);
  tip_ = Vec3(0, -ankle_.y, 0.190);
  fit();
}

// Pattern search: steps along one number at a time, halved when none helps. The numbers start at
// common values (Murray 1964: stride 0.8 of the stature, rise and fall 2 cm).
void Walker::fit() {
  stride_ = 0.8 * kStature;
  contact_ = 0.32;
  rise_cos_ = -0.015;
  rise_sin_ = -0.010;
  struct Number {
    double* value;
    double step;
  };
  Number numbers[] = {
      {&stride_, 0.05}, {&contact_, 0.02}, {&rise_cos_, 0.005}, {&rise_sin_, 0.005}};
  double best = disagreement();
  for (int round = 0; round < 60; ++round) {
    bool better = false;
    for (Number& n : numbers)
      for (const double sign : {1.0, -1.0}) {
        const double before = *n.value;
        *n.value = before + sign * n.step;
        const double now = disagreement();
        if (now < best) {
          best = now;
          better = true;
        } else {
          *n.value = before;
        }
      }
    if (better) continue;
    for (Number& n : numbers) n.step *= 0.5;
  }
  disagreement();  // leaves the height for the best
}

// Sets the pelvis as high as the legs reach with the least knee flexion, and returns the mean
// square difference of hip and knee angles from the published ones.
double Walker::disagreement() {
  constexpr double kLeastFlexion = 3.0 * degrees;
  const double reach =
      std::sqrt(thigh_ * thigh_ + shank_ * shank_ + 2 * thigh_ * shank_ * std::cos(kLeastFlexion));
  constexpr int kSteps = 60;
  height_ = 0.93;
  // Twice, as the foot's path in the air depends on the height too.
  for (int pass = 0; pass < 2; ++pass) {
    double too_high = -1e9;
    for (int i = 0; i < kSteps; ++i) {
      const double phase = static_cast<double>(i) / kSteps;
      const Vec3 d = left_hip(phase) - left_foot(phase);
      too_high = std::max(too_high, d.y - std::sqrt(reach * reach - d.x * d.x - d.z * d.z));
    }
    height_ -= too_high;
  }
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double phase = static_cast<double>(i) / kSteps;
    const Vec3 d = left_foot(phase) - left_hip(phase);
    const double length = std::min(glm::length(d), reach);
    // Both angles of the triangle, in the plane of progression.
    const double knee = kPi - std::acos((thigh_ * thigh_ + shank_ * shank_ - length * length) /
                                        (2 * thigh_ * shank_));
    const double at_hip =
        std::acos((thigh_ * thigh_ + length * length - shank_ * shank_) / (2 * thigh_ * length));
    const double hip = std::atan2(d.z, -d.y) + at_hip;
    sum += std::pow(knee - gait_.knee(phase), 2) + std::pow(hip - gait_.hip(phase), 2);
  }
  return sum / (2 * kSteps);
}

Quat Walker::pelvis(double phase) const {
  // At phase 0 the left leg leads: the pelvis is turned left side ahead (negative about y). In left
  // stance (phase 0.3) it hangs on the right and has swayed to the left.
  const double wave = 2.0 * kPi * phase;
  return turn_y(-gait_.pelvis_rotation * std::cos(wave)) *
         turn_z(gait_.pelvis_drop * std::sin(wave - 0.35)) * turn_x(1.5 * degrees);
}

Vec3 Walker::pelvis_place(double phase) const {
  return {gait_.pelvis_sway * std::sin(2.0 * kPi * phase - 0.25), pelvis_height(phase),
          stride_ * phase};
}

Vec3 Walker::left_hip(double phase) const { return pelvis_place(phase) + pelvis(phase) * hip_; }

Vec3 Walker::left_foot(double phase) const {
  Vec3 foot = ankle(phase);
  foot.x = kTrack;
  return foot;
}

double Walker::pelvis_height(double phase) const {
  return height_ + rise_cos_ * std::cos(4.0 * kPi * phase) +
         rise_sin_ * std::sin(4.0 * kPi * phase);
}

Vec3 Walker::leg(double phase) const {
  const double thigh = gait_.hip(phase), shank = thigh - gait_.knee(phase);
  return {0, -thigh_ * std::cos(thigh) - shank_ * std::cos(shank),
          thigh_ * std::sin(thigh) + shank_ * std::sin(shank)};
}

Vec3 Walker::published(double phase) const {
  const Vec3 hip = left_hip(phase);
  return leg(phase) + Vec3(0, hip.y, hip.z);
}

Vec3 Walker::stance(double phase) const {
  const double up = gait_.foot(phase);
  const Vec3 flat(0, ankle_.y, contact_);
  if (up >= 0) return flat + heel_ - pitched(heel_, up);
  // The toes bend while they lie flat, then roll over their tip.
  const Vec3 toes = flat + tip_ + pitched(toes_ - tip_, up + bend(-up));
  return toes - pitched(toes_, up);
}

Vec3 Walker::swing(double phase) const {
  const double begin = gait_.toe_off;
  const Vec3 at_toe_off = stance(begin) - published(begin);
  const Vec3 at_contact = stance(0.0) + Vec3(0, 0, stride_) - published(1.0);
  // A little higher than the angles have it, so that shoes clear the ground.
  const double u = (phase - begin) / (1 - begin), lift = 0.020 * std::sin(kPi * u);
  return published(phase) + glm::mix(at_toe_off, at_contact, smooth(u)) + Vec3(0, lift, 0);
}

Vec3 Walker::ankle(double phase) const {
  const double cycle = std::floor(phase);
  phase -= cycle;
  return (phase <= gait_.toe_off ? stance(phase) : swing(phase)) + Vec3(0, 0, cycle * stride_);
}

// Level with the sole again soon after toe-off.
double Walker::toe_bend(double phase) const {
  phase -= std::floor(phase);
  return bend(std::max(0.0, -gait_.foot(phase))) * (1.0 - smooth((phase - gait_.toe_off) / 0.14));
}

Quat Walker::pose(Poser& poser, double phase, double origin, bool travel) const {
  const double wave = 2.0 * kPi * phase;
  const double shift = travel ? origin : -stride_ * phase;
  poser.begin(pelvis_place(phase) + Vec3(0, 0, shift));
  const Quat hips = pelvis(phase);
  poser.set_world("Hips", hips);

  const double trunk_turn = gait_.trunk_rotation * std::cos(wave + 0.25);
  const double drop = gait_.pelvis_drop * std::sin(wave - 0.35);
  const double nod = 0.8 * degrees * std::cos(2.0 * wave - 0.6);
  const Quat chest = turn_y(trunk_turn) * turn_z(-0.25 * drop) * turn_x(3.0 * degrees + nod);
  poser.set_world("Spine", slerp_shortest(hips, chest, 0.45));
  poser.set_world("Chest", chest);
  poser.set_world("Neck", turn_y(0.45 * trunk_turn) * turn_x(1.0 * degrees + 0.4 * nod));
  poser.set_world("Head", turn_y(0.15 * trunk_turn) * turn_x(1.0 * degrees));
  poser.compute();

  for (const double side : {1.0, -1.0}) {
    const double own = side > 0 ? phase : phase - 0.5;
    Vec3 foot = ankle(own);
    foot.x = side * kTrack;
    foot.z += shift + (side < 0 ? 0.5 * stride_ : 0.0);
    const Vec3 ahead =
        turn_y(side * kToeOut - 0.3 * gait_.pelvis_rotation * std::cos(wave)) * Vec3(0, 0, 1);
    poser.set_leg(side, foot, turn_y(side * kToeOut) * turn_x(-gait_.foot(own)), ahead);
    poser.set_local(side > 0 ? "LeftToes" : "RightToes", turn_x(-toe_bend(own)));
  }
  return chest;
}

}  // namespace elbowroom::demo
