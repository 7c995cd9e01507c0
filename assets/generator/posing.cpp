// SPDX-License-Identifier: MIT
#include "assets/generator/posing.h"

#include <algorithm>

namespace elbowroom::demo {

namespace {

constexpr double degrees = kPi / 180.0;
constexpr const char* kFingers[] = {"Index", "Middle", "Ring", "Little"};

std::string side_name(double side) { return side > 0 ? "Left" : "Right"; }

}  // namespace

Quat turn_x(double angle) { return quat_from_rotation_vector({angle, 0, 0}); }
Quat turn_y(double angle) { return quat_from_rotation_vector({0, angle, 0}); }
Quat turn_z(double angle) { return quat_from_rotation_vector({0, 0, angle}); }

Poser::Poser(const Figure& figure) : figure_(figure) { begin(figure.joints[0].position); }

std::size_t Poser::at(const std::string& joint) const {
  return static_cast<std::size_t>(figure_.find(joint));
}

void Poser::begin(const Vec3& hips) {
  pose_.hips = hips;
  set_.assign(figure_.joints.size(), 0);
  given_.assign(figure_.joints.size(), Quat(1, 0, 0, 0));
}

void Poser::set_world(const std::string& joint, const Quat& world_from_joint) {
  set_[at(joint)] = 1;
  given_[at(joint)] = world_from_joint;
}

void Poser::set_local(const std::string& joint, const Quat& turn) {
  set_[at(joint)] = 2;
  given_[at(joint)] = turn;
}

const FigurePose& Poser::compute() {
  const std::size_t n = figure_.joints.size();
  pose_.world.resize(n);
  pose_.position.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    const FigureJoint& joint = figure_.joints[j];
    if (joint.parent < 0) {
      pose_.world[j] = set_[j] ? given_[j] : joint.rotation;
      pose_.position[j] = pose_.hips;
      continue;
    }
    const auto p = static_cast<std::size_t>(joint.parent);
    pose_.position[j] = pose_.position[p] + pose_.world[p] * figure_.offset(static_cast<int>(j));
    if (set_[j] == 1) {
      pose_.world[j] = given_[j];
    } else {
      const Quat bind = glm::conjugate(figure_.joints[p].rotation) * joint.rotation;
      pose_.world[j] = pose_.world[p] * bind * (set_[j] == 2 ? given_[j] : Quat(1, 0, 0, 0));
    }
    pose_.world[j] = glm::normalize(pose_.world[j]);
  }
  return pose_;
}

void Poser::set_arm(double side, const Quat& trunk, const Arm& arm) {
  const std::string s = side_name(side);
  // From an arm held ahead: a quarter turn down makes it hang, thumb ahead.
  const Quat hanging = turn_x(0.5 * kPi);
  const Quat upper = trunk * turn_z(side * arm.abduction) * turn_x(-arm.flexion) * hanging *
                     turn_z(side * arm.rotation);
  const Quat lower = upper * turn_x(-arm.elbow) * turn_z(side * arm.twist);
  set_world(s + "UpperArm", upper);
  set_world(s + "LowerArm", lower);
  set_world(s + "Hand", lower);
}

double Poser::set_leg(double side, const Vec3& ankle, const Quat& foot, const Vec3& ahead) {
  const std::string s = side_name(side);
  const std::size_t thigh = at(s + "UpperLeg"), shank = at(s + "LowerLeg"), end = at(s + "Foot");
  const Vec3 hip = pose_.position[thigh];
  const Vec3 thigh_bone = figure_.offset(static_cast<int>(shank));
  const Vec3 shank_bone = figure_.offset(static_cast<int>(end));
  const double a = glm::length(thigh_bone), b = glm::length(shank_bone);
  const Vec3 to = ankle - hip;
  const double wanted = glm::length(to);
  const double reach = std::min(wanted, 0.99995 * (a + b));
  const Vec3 along = to / wanted;
  const Vec3 forward = glm::normalize(ahead - glm::dot(ahead, along) * along);
  const double cosine = std::clamp((a * a + reach * reach - b * b) / (2 * a * reach), -1.0, 1.0);
  const double sine = std::sqrt(1.0 - cosine * cosine);
  const Vec3 knee = hip + a * (cosine * along + sine * forward);
  const Vec3 end_at = hip + reach * along;
  // The bones' frames: along the bone, and across the leg's plane.
  const Vec3 across = glm::normalize(glm::cross(-along, forward));  // to the left
  const auto frame = [&](const Vec3& bone, const Vec3& side_axis) {
    const Vec3 y = glm::normalize(-bone);
    const Vec3 x = glm::normalize(side_axis - glm::dot(side_axis, y) * y);
    return glm::normalize(glm::quat_cast(Mat3(x, y, glm::cross(x, y))));
  };
  const Quat bind_thigh = frame(thigh_bone, {1, 0, 0}), bind_shank = frame(shank_bone, {1, 0, 0});
  set_world(s + "UpperLeg", frame(knee - hip, across) * glm::conjugate(bind_thigh));
  set_world(s + "LowerLeg", frame(end_at - knee, across) * glm::conjugate(bind_shank));
  set_world(s + "Foot", foot);
  return wanted - reach;
}

void Poser::relax_hand(double side, double amount) {
  const std::string s = side_name(side);
  for (int f = 0; f < 4; ++f) {
    const double more = 1.0 + 0.10 * f;  // the little finger curls most
    const double curl[3] = {22.0, 30.0, 18.0};
    for (int i = 0; i < 3; ++i) {
      Quat turn = turn_y(-side * amount * more * curl[i] * degrees);
      // Spread fingers close up at ease.
      if (i == 0)
        turn = turn_x((f == 0 ? 6.0 : f == 1 ? 1.0 : f == 2 ? -4.5 : -10.0) * degrees) * turn;
      set_local(s + kFingers[f] + std::to_string(i + 1), turn);
    }
  }
  set_local(s + "Thumb1", turn_x(10.0 * amount * degrees) * turn_y(-side * 8.0 * amount * degrees));
  set_local(s + "Thumb2", turn_y(-side * 6.0 * amount * degrees) * turn_x(6.0 * amount * degrees));
  set_local(s + "Thumb3", turn_x(14.0 * amount * degrees));
}

void Poser::grip_hand(double side, const Vec3& stick, double radius) {
  const std::string s = side_name(side);
  // In the hand's frame the stick runs along y through `stick`. Joint after joint a finger curls
  // until the phalanx it moves comes to lie on the stick.
  const auto fingers = left_fingers();
  const HandFrame frame = left_hand_frame();
  const std::size_t hand = at(s + "Hand");
  const Quat hand_from_world = glm::conjugate(figure_.joints[hand].rotation);
  for (std::size_t f = 1; f < fingers.size(); ++f) {
    // Bind positions in the hand's frame.
    Vec3 p[4];
    for (int i = 0; i < 4; ++i) {
      Vec3 world = fingers[f].points[i];
      world.x *= side;
      const Vec3 wrist(side * frame.wrist.x, frame.wrist.y, frame.wrist.z);
      p[i] = hand_from_world * (world - wrist);
    }
    const double close_up = (f == 1   ? 7.5
                             : f == 2 ? 1.5
                             : f == 3 ? -4.5
                                      : -11.5) *
                            degrees;  // undo the spread
    for (int i = 0; i < 3; ++i) {
      const Quat base = i == 0 ? turn_x(close_up) : Quat(1, 0, 0, 0);
      double angle = 0;
      const double most = (i == 0 ? 85.0 : i == 1 ? 100.0 : 70.0) * degrees;
      const double touch = radius + 0.5 * (fingers[f].radius[i] + fingers[f].radius[i + 1]);
      for (; angle < most; angle += 0.5 * degrees) {
        const Quat turn = turn_y(-side * (angle + 0.5 * degrees)) * base;
        // Distance in the x–z plane from the stick to the moved phalanx.
        const Vec3 a = p[i], b = p[i] + turn * (p[i + 1] - p[i]);
        const double abx = b.x - a.x, abz = b.z - a.z;
        const double t = std::clamp(
            ((stick.x - a.x) * abx + (stick.z - a.z) * abz) / (abx * abx + abz * abz), 0.0, 1.0);
        const double dx = a.x + t * abx - stick.x, dz = a.z + t * abz - stick.z;
        if (std::sqrt(dx * dx + dz * dz) < touch && t > 0.2) break;
      }
      const Quat turn = turn_y(-side * angle) * base;
      set_local(s + fingers[f].name + std::to_string(i + 1), turn);
      for (int k = i + 1; k < 4; ++k) p[k] = p[i] + turn * (p[k] - p[i]);
    }
  }
  // The thumb closes above the index finger round the other side of the stick: a bone each past it,
  // over it and behind it. Along the hand, to the thumb's side, out of the palm.
  const Vec3 wanted[3] = {{0.60, 0.58, 0.51}, {0.72, -0.02, 0.69}, {0.74, -0.12, -0.66}};
  Quat before(1, 0, 0, 0);
  for (int i = 0; i < 3; ++i) {
    const auto into_hand = [&](Vec3 world) {
      world.x *= side;
      return glm::normalize(hand_from_world * world);
    };
    const Vec3 bone = into_hand(fingers[0].points[i + 1] - fingers[0].points[i]);
    const Vec3 to = into_hand(frame.point(wanted[i].x, wanted[i].y, wanted[i].z) - frame.wrist);
    const Quat turn = shortest_rotation(before * bone, to) * before;
    set_local(s + "Thumb" + std::to_string(i + 1), glm::conjugate(before) * turn);
    before = turn;
  }
}

}  // namespace elbowroom::demo
