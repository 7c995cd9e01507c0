// SPDX-License-Identifier: MIT
#include "assets/generator/figure.h"

#include <array>

namespace elbowroom::demo {

namespace {

constexpr double kH = kStature;
constexpr double degrees = kPi / 180.0;

// Left side of the bind pose. The arm hangs half-way between level and down; the elbow is bent a
// little forward, so that the rig itself tells which way it flexes.
const Vec3 kShoulder(0.184, 0.812 * kH, -0.016);
const Vec3 kArm = glm::normalize(Vec3(1.0, -1.0, 0.0));
const Vec3 kForearm = glm::normalize(kArm + Vec3(0, 0, std::tan(6.0 * degrees)));
const Vec3 kElbow = kShoulder + 0.186 * kH * kArm;
const Vec3 kWrist = kElbow + 0.146 * kH * kForearm;

const Vec3 kHip(0.086, 0.530 * kH - 0.004, -0.002);
const Vec3 kKnee(0.092, 0.285 * kH, 0.006);
const Vec3 kAnkle(0.097, 0.039 * kH, -0.012);

}  // namespace

HandFrame left_hand_frame() {
  HandFrame f;
  f.wrist = kWrist;
  f.along = kForearm;
  f.thumb = glm::normalize(Vec3(0, 0, 1) - glm::dot(Vec3(0, 0, 1), kForearm) * kForearm);
  f.palm = glm::cross(f.thumb, f.along) * -1.0;
  return f;
}

std::vector<Finger> left_fingers() {
  const HandFrame hand = left_hand_frame();
  struct Layout {
    const char* name;
    double l, t, n;  // knuckle
    double spread;   // degrees to the thumb's side
    double length;   // knuckle to finger tip
    double radius;   // at the knuckle
  };
  // Lengths about those of Garrett, The adult human hand, 1971 (50th percentile, scaled to the
  // stature); spread wide enough that the polygonized fingers stay apart.
  constexpr std::array<Layout, 4> layout{
      {{"Index", 0.0915, 0.0305, 0.000, 10.0, 0.0810, 0.0088},
       {"Middle", 0.0955, 0.0098, -0.002, 2.5, 0.0910, 0.0090},
       {"Ring", 0.0915, -0.0112, -0.001, -5.5, 0.0850, 0.0085},
       {"Little", 0.0830, -0.0305, 0.002, -14.0, 0.0670, 0.0075}}};
  std::vector<Finger> fingers;

  Finger thumb{"Thumb", {}, {0.0165, 0.0122, 0.0102, 0.0082}};
  const Vec3 base(0.018, 0.022, 0.010);
  const Vec3 directions[3] = {glm::normalize(Vec3(0.72, 0.60, 0.36)),
                              glm::normalize(Vec3(0.84, 0.46, 0.28)),
                              glm::normalize(Vec3(0.92, 0.34, 0.20))};
  const double lengths[3] = {0.046, 0.034, 0.0205};
  Vec3 at = base;
  for (int i = 0; i < 4; ++i) {
    thumb.points[i] = hand.point(at.x, at.y, at.z);
    if (i < 3) at += lengths[i] * directions[i];
  }
  fingers.push_back(thumb);

  for (const Layout& f : layout) {
    Finger finger{f.name, {}, {f.radius, 0.93 * f.radius, 0.84 * f.radius, 0.76 * f.radius}};
    const double bone = f.length - finger.radius[3];
    const double share[3] = {0.49, 0.29, 0.22};
    Vec3 p(f.l, f.t, f.n);
    double flexion = 6.0;
    for (int i = 0; i < 4; ++i) {
      finger.points[i] = hand.point(p.x, p.y, p.z);
      if (i == 3) break;
      const double a = flexion * degrees, s = f.spread * degrees;
      p +=
          share[i] * bone * Vec3(std::cos(a) * std::cos(s), std::cos(a) * std::sin(s), std::sin(a));
      flexion += 5.0;
    }
    fingers.push_back(finger);
  }
  return fingers;
}

int Figure::find(const std::string& name) const {
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i].name == name) return static_cast<int>(i);
  return -1;
}

Vec3 Figure::offset(int joint) const {
  const FigureJoint& j = joints[static_cast<std::size_t>(joint)];
  if (j.parent < 0) return j.position;
  const FigureJoint& p = joints[static_cast<std::size_t>(j.parent)];
  return glm::conjugate(p.rotation) * (j.position - p.position);
}

Figure make_figure() {
  Figure figure;
  const auto add = [&](const std::string& name, int parent, const Vec3& position,
                       const Quat& rotation) {
    figure.joints.push_back({name, parent, position, rotation});
    return static_cast<int>(figure.joints.size()) - 1;
  };
  const Quat none(1, 0, 0, 0);
  const int hips = add("Hips", -1, {0, 0.545 * kH, -0.012}, none);
  const int spine = add("Spine", hips, {0, 1.055, -0.012}, none);
  const int chest = add("Chest", spine, {0, 1.205, -0.020}, none);
  const int neck = add("Neck", chest, {0, 1.478, -0.030}, none);
  add("Head", neck, {0, 1.565, -0.010}, none);

  const auto fingers = left_fingers();
  for (const double side : {1.0, -1.0}) {
    const std::string prefix = side > 0 ? "Left" : "Right";
    const auto mirror = [&](const Vec3& p) { return Vec3(side * p.x, p.y, p.z); };
    // Columns x, y, z of world_from_joint for the whole arm: z along the upper arm, y ahead.
    const Vec3 z = mirror(kArm), y(0, 0, 1), x = glm::cross(y, z);
    const Quat arm = glm::normalize(glm::quat_cast(Mat3(x, y, z)));

    const int shoulder = add(prefix + "Shoulder", chest, mirror({0.024, 1.436, -0.004}), none);
    const int upper = add(prefix + "UpperArm", shoulder, mirror(kShoulder), arm);
    const int lower = add(prefix + "LowerArm", upper, mirror(kElbow), arm);
    const int hand = add(prefix + "Hand", lower, mirror(kWrist), arm);
    for (const Finger& f : fingers) {
      int parent = hand;
      for (int i = 0; i < 3; ++i)
        parent = add(prefix + f.name + std::to_string(i + 1), parent, mirror(f.points[i]), arm);
    }
    const int thigh = add(prefix + "UpperLeg", hips, mirror(kHip), none);
    const int shank = add(prefix + "LowerLeg", thigh, mirror(kKnee), none);
    const int foot = add(prefix + "Foot", shank, mirror(kAnkle), none);
    add(prefix + "Toes", foot, mirror({0.109, 0.020, 0.118}), none);
  }
  return figure;
}

}  // namespace elbowroom::demo
