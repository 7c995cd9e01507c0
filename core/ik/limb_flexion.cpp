// SPDX-License-Identifier: MIT
// How far a limb's middle is bent for its end to be at a distance from its root: LimbIk's members
// for that.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ik/limb_ik.h"

namespace elbowroom {

// Sets the angle about bend.axis that brings the end to `distance` from the root; returns by how
// much the distance is beyond reach (in the root parent's units), with sign. Of the two solutions
// it is the one bent in the positive sense from the stretched limb for sense 0, else the other; of
// its turns the one nearest to `near`.
//
// With u the axis, w the bone, g = (root_from_zero)ᵀ · middle_offset and s the scale,
//   |end|² = |middle_offset|² + s² |w|² + 2 g · Rot(u, θ) w,
//   Rot(u, θ) w = w∥ + cos θ w⊥ + sin θ u × w.
double LimbIk::bend_to(double distance, int sense, double near, Bend& bend) const {
  const Vec3 bone = bone_of(bend);
  const Vec3 along = bend.axis * glm::dot(bend.axis, bone);
  const Vec3 g = glm::transpose(root_from_zero_) * middle_offset_;
  const double a = glm::dot(g, bone - along), b = glm::dot(g, glm::cross(bend.axis, bone));
  const double fixed = glm::dot(middle_offset_, middle_offset_) +
                       scale_squared_ * glm::dot(bone, bone) + 2 * glm::dot(g, along);
  const double amplitude = std::hypot(a, b);
  const double reach = glm::length(middle_offset_) + std::sqrt(scale_squared_) * glm::length(bone);
  const auto beyond = [&](double from) {
    const double miss = distance - from;
    return std::abs(miss) <= kReachTolerance * reach ? 0.0 : miss;
  };
  if (!(amplitude > 1e-14 * reach * reach)) {
    // A bone without length (or across which nothing turns): no bend changes the distance.
    bend.angle = near;
    return beyond(std::sqrt(std::max(0.0, fixed)));
  }
  const double stretched = std::atan2(b, a);
  const double cosine = (0.5 * (distance * distance - fixed)) / amplitude;
  const double away = std::acos(std::clamp(cosine, -1.0, 1.0));
  bend.angle = nearest_turn(stretched + (sense == 0 ? away : -away), near);
  if (uniform_) {
    if (std::abs(cosine) <= 1) {
      if (!exactly_uniform_) bend_by_newton(distance, bend);
      return 0;
    }
    return beyond(std::sqrt(std::max(0.0, fixed + 2 * amplitude * (cosine > 0 ? 1 : -1))));
  }
  bend_by_newton(distance, bend);
  return beyond(glm::length(end_in_root(bend)));
}

// Where scales are not uniform the sum above has second harmonics; h(θ) = |end|² - distance². Where
// h has no root nearby, what is nearest to one is an extremum of h: found by the same steps on h'.
void LimbIk::bend_by_newton(double distance, Bend& bend) const {
  constexpr int kMostSteps = 60, kRootsFirst = 5;
  const Vec3 bone = bone_of(bend);
  const Vec3 along = bend.axis * glm::dot(bend.axis, bone);
  const Vec3 fixed = middle_offset_ + root_from_zero_ * along;
  const Vec3 cosine_part = root_from_zero_ * (bone - along);
  const Vec3 sine_part = root_from_zero_ * glm::cross(bend.axis, bone);
  double best = bend.angle, least = std::numeric_limits<double>::infinity(), angle = bend.angle;
  for (int i = 0; i < kMostSteps; ++i) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const Vec3 turned = cosine * cosine_part + sine * sine_part;
    const Vec3 end = fixed + turned;
    const Vec3 slope_of_end = cosine * sine_part - sine * cosine_part;
    const double h = glm::dot(end, end) - distance * distance;
    const double slope = 2 * glm::dot(end, slope_of_end);
    const double before = least;
    if (std::abs(h) < least) {
      least = std::abs(h);
      best = angle;
    }
    if (least < 1e-15 * distance * distance || slope == 0) break;
    const double bow = 2 * (glm::dot(slope_of_end, slope_of_end) - glm::dot(end, turned));
    const bool rootless = i >= kRootsFirst && h * bow > 0 && slope * slope < 2 * h * bow;
    const double step = std::clamp(rootless ? slope / bow : h / slope, -0.3, 0.3);
    // Rounding is all that is left where a whole step no longer helps.
    if (rootless ? std::abs(step) < 1e-9 : std::abs(h) >= 0.9 * before && std::abs(step) < 1e-6)
      break;
    angle -= step;
  }
  bend.angle = best;
}

// The same, with what the middle's kind leaves open taken from `near`: for a ball its sideways
// angle, as far as the bend is large enough to have it. The axis of the bend depends on that, so a
// few rounds settle it; the distance is met whatever the axis.
double LimbIk::bend_middle(double distance, int sense, const Dofs& near, Bend& bend) const {
  const JointModel& middle = limb_->joints[1];
  const double near_angle = bend.angle;
  if (middle.kind != JointModelKind::ball) return bend_to(distance, sense, near_angle, bend);
  const double sideways = middle.side * near[middle.first_dof];
  constexpr int kRounds = 8;
  double miss = 0;
  bool settled = false;
  bend.axis = Vec3(0, 0, 1);
  for (int i = 0; i < kRounds && !settled; ++i) {
    miss = bend_to(distance, sense, 0, bend);
    bend.angle = std::remainder(bend.angle, 2 * kPi);
    const double sine = bend.angle != 0 ? sideways / bend.angle : 0.0;
    const double y = std::clamp(sine, -1.0, 1.0);
    const Vec3 axis(0, y, std::sqrt(1 - y * y));
    settled = glm::length(axis - bend.axis) < 1e-12;
    if (!settled && i + 1 < kRounds) bend.axis = axis;  // else the angle above belongs to the last
  }
  // What is far out of reach hangs on no angle.
  constexpr double kNearReach = 0.02;  // × distance
  if ((settled && miss == 0) || std::abs(miss) > kNearReach * distance) return miss;
  Bend held = bend;
  const double held_miss = bend_sideways(distance, sense, sideways, held);
  if (held_miss != 0 && miss == 0) return miss;
  bend = held;
  return held_miss;
}

// Where the limb is all but straight the axis turns so fast with the bend that the rounds above do
// not settle, and what it reaches hangs on the sideways angle. That held, the distance is a
// function of the flexion alone, greatest at one in the middle and falling to both sides.
double LimbIk::bend_sideways(double distance, int sense, double sideways, Bend& bend) const {
  const auto set = [&](double flexion) {
    bend.angle = std::hypot(sideways, flexion);
    bend.axis = bend.angle > 0 ? Vec3(0, sideways, flexion) / bend.angle : Vec3(0, 0, 1);
    return glm::length(end_in_root(bend));
  };
  // The most stretched: the best of a few, then golden sections about it.
  constexpr double kGolden = 0.61803398874989484820, kWidth = kPi / 8;
  double stretched = 0, longest = -1;
  for (double flexion = -kPi; flexion < kPi - 0.5 * kWidth; flexion += kWidth)
    if (const double length = set(flexion); length > longest) {
      longest = length;
      stretched = flexion;
    }
  double low = stretched - kWidth, high = stretched + kWidth;
  double c = high - kGolden * (high - low), d = low + kGolden * (high - low);
  double at_c = set(c), at_d = set(d);
  while (high - low > 1e-8) {
    if (at_c >= at_d) {
      high = d;
      d = c;
      at_d = at_c;
      at_c = set(c = high - kGolden * (high - low));
    } else {
      low = c;
      c = d;
      at_c = at_d;
      at_d = set(d = low + kGolden * (high - low));
    }
  }
  stretched = 0.5 * (low + high);
  longest = set(stretched);
  const double reach = kReachTolerance * longest;
  if (!(distance < longest - reach)) {
    const double miss = distance - longest;
    return std::abs(miss) <= reach ? 0.0 : miss;
  }
  // From there to the side of that sense until it is near enough: false position, Illinois.
  double inside = stretched, over = longest - distance;
  double outside = stretched, under = over;
  for (int i = 1; i <= 8 && under > 0; ++i)
    under = set(outside = stretched + (sense == 0 ? 1 : -1) * kWidth * i) - distance;
  if (under > 0) return -under;
  for (int i = 0; i < 60 && under < 0; ++i) {
    const double middle = (inside * under - outside * over) / (under - over);
    const double off = set(middle) - distance;
    if (std::abs(off) <= 1e-15 * distance || middle == inside || middle == outside) break;
    if (off > 0) {
      inside = middle;
      over = off;
      under *= 0.5;
    } else {
      outside = middle;
      under = off;
      over *= 0.5;
    }
  }
  return 0;
}

}  // namespace elbowroom
