// SPDX-License-Identifier: MIT
#include "core/anatomy/grasp_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/hand_parts.h"
#include "core/animation/affine.h"

namespace elbowroom {
namespace {

constexpr double kThickness = 0.15;  // of the palm's length, off the bones, where there is no skin
constexpr double kNear = 0.2;        // of the palm's length: skin beside the line that counts
constexpr double kClearSpread = 0.15;  // of the palm's length, for a line of knuckles
constexpr double kClearlyFlat = 0.8;   // thickness to width, for the skin to show the palm
constexpr double kDegree = kPi / 180;

// Directions across a unit vector in which points spread most and least, with their spreads
// (standard deviations).
struct Spread {
  Vec3 most{0.0}, least{0.0};
  double width = 0, thickness = 0;
};

Spread spread_across(const std::vector<WeightedPoint>& points, const Vec3& axis) {
  const Vec3 other = std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
  double weight = 0, mean_u = 0, mean_v = 0;
  for (const WeightedPoint& p : points) {
    weight += p.weight;
    mean_u += p.weight * glm::dot(p.place, u);
    mean_v += p.weight * glm::dot(p.place, v);
  }
  Spread spread{u, v, 0, 0};
  if (!(weight > 0)) return spread;
  mean_u /= weight;
  mean_v /= weight;
  double uu = 0, uv = 0, vv = 0;
  for (const WeightedPoint& p : points) {
    const double a = glm::dot(p.place, u) - mean_u, b = glm::dot(p.place, v) - mean_v;
    uu += p.weight * a * a / weight;
    uv += p.weight * a * b / weight;
    vv += p.weight * b * b / weight;
  }
  const double angle = 0.5 * std::atan2(2 * uv, uu - vv);
  const double middle = 0.5 * (uu + vv), half = std::hypot(0.5 * (uu - vv), uv);
  spread.most = u * std::cos(angle) + v * std::sin(angle);
  spread.least = glm::cross(axis, spread.most);
  spread.width = std::sqrt(std::max(0.0, middle + half));
  spread.thickness = std::sqrt(std::max(0.0, middle - half));
  return spread;
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum(0.0);
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// Height at which the line from `start` along `way` leaves a triangle, nothing if it passes it.
std::optional<double> along_line(const Vec3& start, const Vec3& way,
                                 const std::array<Vec3, 3>& triangle) {
  const Vec3 e1 = triangle[1] - triangle[0], e2 = triangle[2] - triangle[0];
  const Vec3 p = glm::cross(way, e2);
  const double det = glm::dot(e1, p);
  if (det == 0) return std::nullopt;
  const Vec3 s = start - triangle[0];
  const double u = glm::dot(s, p) / det;
  const Vec3 q = glm::cross(s, e1);
  const double v = glm::dot(way, q) / det;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) return std::nullopt;
  return glm::dot(e2, q) / det;
}

// How far the skin goes along `way` on the line and within `near` of it.
std::optional<double> farthest_skin(const HandSkin& skin, const Vec3& start, const Vec3& way,
                                    double near) {
  std::optional<double> farthest;
  const auto take = [&](double height) {
    if (std::isfinite(height) && (!farthest || height > *farthest)) farthest = height;
  };
  for (const auto& triangle : skin.triangles) {
    if (const auto height = along_line(start, way, triangle)) take(*height);
    for (const Vec3& corner : triangle) {
      const Vec3 to = corner - start;
      const double height = glm::dot(to, way);
      if (glm::length(to - way * height) <= near) take(height);
    }
  }
  return farthest;
}

// Where the palm faces, and why.
struct Facing {
  Vec3 y{0.0};
  std::string from;
};

std::optional<Facing> by_fingers(const GraspEvidence& e, const HandParts& hand, const Vec3& x,
                                 double length) {
  const auto guess = direction_across(e.palm, x);
  const Vec3 fingers = mean_of(hand.finger_roots);
  Vec3 thumb(0.0);  // its side; none if zero
  if (!hand.thumb_roots.empty())
    thumb = direction_across(mean_of(hand.thumb_roots) - fingers, x).value_or(Vec3(0.0));
  const bool has_thumb = thumb != Vec3(0.0);
  const auto palm_of = [&](const Vec3& radial) { return e.side * glm::cross(x, radial); };
  if (hand.finger_roots.size() >= 2) {
    std::vector<WeightedPoint> knuckles;
    for (const Vec3& p : hand.finger_roots) knuckles.push_back({p, 1});
    const Spread line = spread_across(knuckles, x);
    Vec3 y = palm_of(line.most);
    if (line.width > kClearSpread * length &&
        (!has_thumb || std::abs(glm::dot(thumb, line.most)) > std::cos(60 * kDegree))) {
      if (has_thumb) return Facing{glm::dot(thumb, line.most) < 0 ? -y : y, "knuckles and thumb"};
      if (guess)
        return Facing{glm::dot(*guess, y) < 0 ? -y : y,
                      "knuckles, their palm's side guessed by where the elbow bends to"};
    }
  }
  if (has_thumb) return Facing{palm_of(thumb), "fingers and thumb"};
  return std::nullopt;
}

std::optional<Facing> by_skin(const GraspEvidence& e, const HandParts& hand, const Vec3& x) {
  const auto guess = direction_across(e.palm, x);
  if (!guess) return std::nullopt;
  const Spread skin = spread_across(weighted_points(hand.all), x);
  const double agrees = glm::dot(skin.least, *guess);
  if (skin.width > 0 && skin.thickness < kClearlyFlat * skin.width &&
      std::abs(agrees) > std::cos(50 * kDegree))
    return Facing{agrees < 0 ? -skin.least : skin.least,
                  "the hand's flat skin, its palm's side guessed by where the elbow bends to"};
  return Facing{*guess, "guessed by where the elbow bends to"};
}

}  // namespace

Result<GraspFrame> fit_grasp_frame(const GraspEvidence& e) {
  const bool leg = e.limb.kind == LimbKind::left_leg || e.limb.kind == LimbKind::right_leg;
  const std::string part = leg ? "sole" : "palm";
  const std::string where =
      e.figure.model.path.filename().string() + ", joint '" +
      e.figure.model.skeleton.joints[static_cast<std::size_t>(e.limb.end)].name + "'";
  const auto unknown = [&](const std::string& why) {
    return Error{"the " + part + " cannot be told: " + why, where, "aim the end joint itself"};
  };
  const Mat4& global = e.figure.globals[static_cast<std::size_t>(e.limb.end)];
  const Mat3 world_from_joint(global);
  const Mat3 joint_from_world = glm::inverse(world_from_joint);
  for (int c = 0; c < 3; ++c) {
    if (!finite(joint_from_world[c])) return unknown("the joint has no size");
  }

  const HandParts hand = hand_parts(e.figure, e.limb.end, leg, e.end_is_fixed);
  const Vec3 wrist = origin(e.figure.globals, e.limb.end);
  const auto skin_middle = middle_of(hand.all);
  Vec3 middle, along;
  std::string x_from;
  if (!hand.finger_roots.empty() && direction(mean_of(hand.finger_roots) - wrist)) {
    along = mean_of(hand.finger_roots) - wrist;
    middle = wrist + 0.5 * along;
    x_from = leg ? "toe joints" : "finger joints";
  } else if (skin_middle && direction(*skin_middle - wrist)) {
    middle = *skin_middle;
    along = 2.0 * (middle - wrist);
    x_from = "the middle of the skin";
  } else {
    return unknown("neither skin nor joints are beyond it");
  }
  const double length = glm::length(along);

  Facing facing;
  Vec3 x = along / length;
  if (leg) {
    facing = {e.down, "the body's down as bound"};
    if (glm::dot(e.down, e.lower) < std::cos(60 * kDegree))
      facing = {e.lower, "the shin, which is bound aslant"};
    const auto across = direction_across(along, facing.y);
    if (!across) return unknown("its toes point down the shin");
    x = *across;
  } else {
    auto found = hand.finger_roots.empty() ? std::nullopt : by_fingers(e, hand, x, length);
    if (!found) found = by_skin(e, hand, x);
    if (!found) return unknown("the hand points where the palm would face");
    facing = *found;
  }

  // Out to the skin: the palm's own, else whatever there is.
  std::optional<double> out;
  for (const HandSkin* skin : {&hand.palm, &hand.all}) {
    for (const double near : {kNear * length, 0.5 * length}) {
      if (!out) out = farthest_skin(*skin, middle, facing.y, near);
    }
  }
  std::string out_from = "its skin";
  if (!out) {
    out = kThickness * length;
    out_from = "a share of its length, since no skin is there";
  }
  const Vec3 place = middle + facing.y * *out;
  double beyond = 0;
  for (const auto& triangle : hand.all.triangles)
    for (const Vec3& corner : triangle)
      beyond = std::max(beyond, glm::dot(corner - place, facing.y));

  GraspFrame frame;
  frame.origin = joint_from_world * (place - wrist);
  const Vec3 y = joint_from_world * facing.y;
  const auto x_joint = direction(joint_from_world * x), y_joint = direction(y);
  if (!x_joint || !y_joint || !finite(frame.origin)) return unknown("the joint has no size");
  frame.x = *x_joint;
  frame.y = *y_joint;
  frame.beyond = beyond * glm::length(y);
  frame.from = part + " along " + x_from + ", facing by " + facing.from + ", out to " + out_from;
  return frame;
}

namespace {

Quat frame_along(const Vec3& x, const Vec3& y) {
  return frame_of(direction(x).value_or(Vec3(1, 0, 0)), y).value_or(Quat(1, 0, 0, 0));
}

}  // namespace

GraspPlace grasp_place(const GraspFrame& frame, const Mat4& world_from_end) {
  const Mat3 linear(world_from_end);
  GraspPlace place;
  place.position = transform_point(world_from_end, frame.origin);
  place.orientation = frame_along(linear * frame.x, linear * frame.y);
  place.beyond = frame.beyond * glm::length(linear * frame.y);
  return place;
}

EndPlacement end_for_grasp(const GraspFrame& frame, const Mat4& world_from_end,
                           const Vec3& position, const Quat& orientation) {
  // world_from_joint = R · U: U, the scale and the mirror, is the same in every pose.
  const Quat rotation = rotation_of(world_from_end);
  const Mat3 stretch = glm::mat3_cast(glm::conjugate(rotation)) * Mat3(world_from_end);
  const Quat own = frame_along(stretch * frame.x, stretch * frame.y);
  EndPlacement end;
  end.rotation = glm::normalize(orientation * glm::conjugate(own));
  end.position = position - end.rotation * (stretch * frame.origin);
  return end;
}

}  // namespace elbowroom
