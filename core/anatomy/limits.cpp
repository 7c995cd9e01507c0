// SPDX-License-Identifier: MIT
#include "core/anatomy/limits.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace elbowroom {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kBriefestMovement = 0.15;  // seconds

struct Range {
  const char* name;
  DofRole role;
  double lower, upper;  // degrees
  double sample_share;  // of the limit, about its value nearest to zero
  double speed;         // rad/s
};

struct JointRanges {
  std::array<Range, 3> dof;  // in the order of a ball: first swing (or flexion), second, twist
  double half_first, half_second;  // ellipse, degrees; 0: none
};

// --- Roots. Zero: see zero_direction. First swing up (arm) or outward (leg), second forward.
//
// Shoulder, carried over from abduction 184, flexion 167, extension 62 (Boone, Azen) and horizontal
// abduction 45, adduction 135 (AAOS): in (up, forward) of our zero pose overhead is (109, 16), 60
// of extension (-73, -88), 45 of horizontal abduction (13, -89), 135 of horizontal adduction (-13,
// 89), a hand behind the back (-92, -80). Twist is zero in the T-pose with an elbow that bends
// forward; there, rotation is -104 (outward) to
// 69. Hanging straight down with the elbow bending forward is -37, and rotation at the side leads
// from -107 to 33; overhead with the elbow bent back is -127, a hand behind the back 84.
constexpr JointRanges kShoulder = {{{{"Shoulder, swing up", DofRole::swing, -115, 125, 1, 8},
                                     {"Shoulder, swing forward", DofRole::swing, -118, 95, 1, 8},
                                     {"Shoulder, twist", DofRole::twist, -125, 90, 1, 10}}},
                                   125,
                                   118};
// Hip: flexion 122, extension 10 (Boone, Azen; AAOS 30), abduction 46, adduction 27, rotation 47
// both ways. In (out, forward) standing is (-11, -45), 30 of extension (-9, -75), 122 of flexion
// (2, 77), abduction (39, -35), adduction (-41, -40), flexed by 120 and abducted by 30 (39, 61).
// Twist is zero standing with knees to the front; the way to these poses adds -27 to 19.
constexpr JointRanges kHip = {{{{"Hip, swing out", DofRole::swing, -52, 52, 1, 7},
                                {"Hip, swing forward", DofRole::swing, -85, 88, 1, 10},
                                {"Hip, twist", DofRole::twist, -60, 55, 1, 7}}},
                              52,
                              88};

// --- Middles. Zero: straight.
//
// Elbow: flexion 143, a little hyperextension; pronation 76 inward, supination 82 outward from the
// neutral forearm.
constexpr JointRanges kElbow = {{{{"Elbow, flexion", DofRole::flexion, -10, 150, 1, 14},
                                  {"Forearm, twist", DofRole::twist, -85, 85, 1, 14},
                                  {"", DofRole::twist, 0, 0, 1, 1}}},
                                0,
                                0};
// Knee: flexion 143, a little hyperextension; bent, the shin turns by 40 outward and 30 inward
// (Kapandji).
constexpr JointRanges kKnee = {{{{"Knee, flexion", DofRole::flexion, -8, 150, 1, 16},
                                 {"Shin, twist", DofRole::twist, -40, 30, 1, 8},
                                 {"", DofRole::twist, 0, 0, 1, 1}}},
                               0,
                               0};
// The same where the rig bends the bone out of the plane of flexion as well.
constexpr JointRanges kElbowBall = {
    {{{"Elbow, sideways", DofRole::secondary_swing, -15, 15, 0.6, 8},
      {"Elbow, flexion", DofRole::flexion, -10, 150, 1, 14},
      {"Forearm, twist", DofRole::twist, -85, 85, 1, 14}}},
    0,
    0};
constexpr JointRanges kKneeBall = {{{{"Knee, sideways", DofRole::secondary_swing, -10, 10, 0.6, 6},
                                     {"Knee, flexion", DofRole::flexion, -8, 150, 1, 16},
                                     {"Shin, twist", DofRole::twist, -40, 30, 1, 8}}},
                                   0,
                                   0};

// --- Ends.
//
// Wrist, zero along the forearm: flexion 76, extension 75, radial deviation 22 (positive),
// ulnar 36. Its twist, in rigs that have it, is the forearm's.
constexpr JointRanges kWrist = {{{{"Wrist, sideways", DofRole::secondary_swing, -36, 24, 0.5, 10},
                                  {"Wrist, bend", DofRole::secondary_swing, -75, 76, 0.5, 12},
                                  {"Wrist, twist", DofRole::twist, -85, 85, 0.5, 12}}},
                                36,
                                78};
// Ankle, zero as bound (about square): dorsiflexion 13 free, 30 under the body's weight, plantar
// flexion 56; eversion 21 (positive), inversion 37.
constexpr JointRanges kAnkle = {{{{"Ankle, sideways", DofRole::secondary_swing, -37, 24, 0.5, 8},
                                  {"Ankle, bend", DofRole::secondary_swing, -56, 32, 0.5, 12},
                                  {"Ankle, twist", DofRole::twist, -30, 30, 0.5, 8}}},
                                38,
                                58};

// --- Chains of which we know nothing. Zero: as bound.
constexpr JointRanges kChainRoot = {{{{"swing 1", DofRole::swing, -90, 90, 1, 8},
                                      {"swing 2", DofRole::swing, -90, 90, 1, 8},
                                      {"twist", DofRole::twist, -60, 60, 1, 8}}},
                                    90,
                                    90};
constexpr JointRanges kChainMiddle = {{{{"flexion", DofRole::flexion, -20, 150, 1, 12},
                                        {"twist", DofRole::twist, -60, 60, 1, 10},
                                        {"", DofRole::twist, 0, 0, 1, 1}}},
                                      0,
                                      0};
constexpr JointRanges kChainMiddleBall = {{{{"sideways", DofRole::secondary_swing, -45, 45, 0.6, 8},
                                            {"flexion", DofRole::flexion, -45, 150, 1, 12},
                                            {"twist", DofRole::twist, -60, 60, 1, 10}}},
                                          0,
                                          0};
constexpr JointRanges kChainEnd = {{{{"swing 1", DofRole::secondary_swing, -45, 45, 0.5, 8},
                                     {"swing 2", DofRole::secondary_swing, -45, 45, 0.5, 8},
                                     {"twist", DofRole::twist, -45, 45, 0.5, 8}}},
                                   45,
                                   45};

const JointRanges& ranges_of(LimbKind kind, LimbJointRole role, bool ball) {
  const bool arm = kind == LimbKind::left_arm || kind == LimbKind::right_arm;
  if (kind == LimbKind::chain) {
    if (role == LimbJointRole::root) return kChainRoot;
    if (role == LimbJointRole::middle) return ball ? kChainMiddleBall : kChainMiddle;
    return kChainEnd;
  }
  if (role == LimbJointRole::root) return arm ? kShoulder : kHip;
  if (role == LimbJointRole::middle) {
    if (arm) return ball ? kElbowBall : kElbow;
    return ball ? kKneeBall : kKnee;
  }
  return arm ? kWrist : kAnkle;
}

}  // namespace

ZeroDirection zero_direction(bool arm) {
  if (arm) {
    // 45° forward of the side, 20° below level.
    const double level = std::cos(20 * kDegree);
    return {level * std::cos(45 * kDegree), -std::sin(20 * kDegree),
            level * std::sin(45 * kDegree)};
  }
  // Flexed by 45°, abducted by 10°.
  const double hang = std::cos(10 * kDegree);
  return {std::sin(10 * kDegree), -hang * std::cos(45 * kDegree), hang * std::sin(45 * kDegree)};
}

void append_dofs(LimbKind kind, LimbJointRole role, const JointModel& model,
                 const std::string& joint_name, DofSpace& space) {
  const JointRanges& ranges = ranges_of(kind, role, model.kind == JointModelKind::ball);
  const int first = space.count();
  for (int i = 0; i < model.dof_count(); ++i) {
    const Range& range = ranges.dof[static_cast<std::size_t>(i)];
    Dof dof;
    dof.name = kind == LimbKind::chain ? joint_name + ", " + range.name : range.name;
    dof.role = range.role;
    dof.lower = range.lower * kDegree;
    dof.upper = range.upper * kDegree;
    dof.sample_lower = dof.lower * range.sample_share;
    dof.sample_upper = dof.upper * range.sample_share;
    dof.speed_limit = range.speed;
    dof.acceleration_limit = kMinimumJerkRatio / kBriefestMovement * range.speed;
    space.dofs.push_back(dof);
  }
  if (ranges.half_first > 0 && model.dof_count() >= 2) {
    space.ellipses.push_back(
        {first, first + 1, ranges.half_first * kDegree, ranges.half_second * kDegree});
  }
}

Status set_swing_polygon(LimbModel& limb, LimbJointRole role, const SwingPolygon& corners,
                         bool keep_ellipse) {
  const JointModel& joint = limb.joints[static_cast<std::size_t>(role)];
  const int first = joint.first_dof;
  const bool swings = joint.kind == JointModelKind::ball || joint.kind == JointModelKind::swing;
  if (!swings || first < 0 || first + 1 >= limb.dof_count())
    return Error{"the joint has no swing to bound", limb.limb.name, "choose another joint"};
  auto polygon = make_swing_polygon(first, first + 1, corners);
  if (!polygon) return polygon.error();
  DofSpace& space = limb.space;
  const auto of_joint = [&](const auto& limit) { return limit.first == first; };
  std::erase_if(space.polygons, of_joint);
  if (!keep_ellipse) std::erase_if(space.ellipses, of_joint);
  for (std::size_t i = 0; i < 2; ++i) {
    Dof& dof = space.dofs[static_cast<std::size_t>(first) + i];
    dof.lower = dof.upper = 0;
    for (const auto& corner : polygon->corners) {
      dof.lower = std::min(dof.lower, corner[i]);
      dof.upper = std::max(dof.upper, corner[i]);
    }
    dof.sample_lower = std::clamp(dof.sample_lower, dof.lower, dof.upper);
    dof.sample_upper = std::clamp(dof.sample_upper, dof.sample_lower, dof.upper);
  }
  space.polygons.push_back(std::move(*polygon));
  return Done{};
}

SwingPolygon polygon_of_ellipse(const LimbModel& limb, LimbJointRole role, int corners) {
  const int first = limb.joints[static_cast<std::size_t>(role)].first_dof;
  SwingPolygon polygon;
  for (const EllipseLimit& ellipse : limb.space.ellipses) {
    if (ellipse.first != first) continue;
    const Dof& a = limb.space.dofs[static_cast<std::size_t>(ellipse.first)];
    const Dof& b = limb.space.dofs[static_cast<std::size_t>(ellipse.second)];
    for (int i = 0; i < std::clamp(corners, 3, 360); ++i) {
      const double angle = 2 * kPi * i / std::clamp(corners, 3, 360);
      polygon.push_back({std::clamp(ellipse.half_first * std::cos(angle), a.lower, a.upper),
                         std::clamp(ellipse.half_second * std::sin(angle), b.lower, b.upper)});
    }
  }
  return polygon;
}

SwingPolygon swing_polygon_of(const LimbModel& limb, LimbJointRole role, int corners) {
  const JointModel& joint = limb.joints[static_cast<std::size_t>(role)];
  const int first = joint.first_dof;
  const bool swings = joint.kind == JointModelKind::ball || joint.kind == JointModelKind::swing;
  if (!swings || first < 0 || first + 1 >= limb.dof_count()) return {};
  SwingPolygon polygon = polygon_of_ellipse(limb, role, corners);
  if (polygon.empty()) {
    const Dof& a = limb.space.dofs[static_cast<std::size_t>(first)];
    const Dof& b = limb.space.dofs[static_cast<std::size_t>(first) + 1];
    polygon = {{a.lower, b.lower}, {a.upper, b.lower}, {a.upper, b.upper}, {a.lower, b.upper}};
  }
  // Corners that the ranges have put in one place or on one line are none.
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
  const auto limit = make_swing_polygon(first, first + 1, polygon);
  return limit ? limit->corners : SwingPolygon{};
}

}  // namespace elbowroom
