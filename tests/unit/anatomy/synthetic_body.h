// SPDX-License-Identifier: MIT
// A body for tests: known proportions, any naming habit, any bone axes, any bind pose, mirrored or
// scaled. What it does with equal numbers must not depend on any of these.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "core/anatomy/limb_model.h"
#include "core/base/random.h"
#include "core/scene/model.h"

namespace elbowroom::test {

// Parts of one side, in the order of `SideNames`.
enum SidePart {
  kClavicle,
  kUpperArm,
  kForearm,
  kHand,
  kIndex,
  kThumb,
  kThigh,
  kShin,
  kFoot,
  kToes
};
using SideNames = std::array<std::string, 10>;

struct BodyOptions {
  SideNames left = {"clavicle_l", "upperarm_l", "lowerarm_l", "hand_l", "index_01_l",
                    "thumb_01_l", "thigh_l",    "calf_l",     "foot_l", "ball_l"};
  SideNames right = {"clavicle_r", "upperarm_r", "lowerarm_r", "hand_r", "index_01_r",
                     "thumb_01_r", "thigh_r",    "calf_r",     "foot_r", "ball_r"};
  std::string hips = "pelvis", spine = "spine_01", head = "head";
  std::string left_twist;       // a joint between upper arm and forearm; empty: none
  double arms_down = 0;         // radians: 0 a T-pose, pi/4 an A-pose
  double elbows_bent = 0;       // radians, towards the front
  std::uint64_t axes_seed = 0;  // 0: joints have the world's axes; else random ones
  Vec3 root_scale{1.0};         // of a node above the hips
  double yaw = 0;               // of that node, about up
};

struct Body {
  Model model;
  std::array<int, 10> left{}, right{};
  int hips = -1, left_twist = -1;
  const Character& character() const { return model.characters[0]; }
};

namespace detail {

inline Vec3 turned(const Vec3& p, const Vec3& about, const Vec3& axis, double angle) {
  return about + glm::angleAxis(angle, axis) * (p - about);
}

struct Builder {
  Body body;
  Random random;
  std::vector<Quat> world;  // of the joint, below the root node
  std::vector<Vec3> place;
  bool random_axes;

  explicit Builder(std::uint64_t seed) : random(seed), random_axes(seed != 0) {}

  Quat axes() {
    if (!random_axes) return Quat(1, 0, 0, 0);
    return glm::normalize(Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                               random.uniform(-1, 1)));
  }

  int add(const std::string& name, int parent, const Vec3& at) {
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    const Quat own = axes();
    const auto p = static_cast<std::size_t>(parent);
    joint.rest.rotation = glm::normalize(glm::conjugate(world[p]) * own);
    joint.rest.translation = glm::conjugate(world[p]) * (at - place[p]);
    world.push_back(own);
    place.push_back(at);
    body.model.skeleton.joints.push_back(joint);
    return static_cast<int>(body.model.skeleton.joints.size()) - 1;
  }
};

}  // namespace detail

inline Body make_body(const BodyOptions& options) {
  detail::Builder builder(options.axes_seed);
  Skeleton& skeleton = builder.body.model.skeleton;
  Joint root;
  root.name = "Armature";
  root.rest.scale = options.root_scale;
  root.rest.rotation = glm::angleAxis(options.yaw, Vec3(0, 1, 0));
  skeleton.joints.push_back(root);
  builder.world.push_back(Quat(1, 0, 0, 0));
  builder.place.push_back(Vec3(0.0));

  const int hips = builder.add(options.hips, 0, Vec3(0, 1, 0));
  const int spine = builder.add(options.spine, hips, Vec3(0, 1.25, 0));
  builder.add(options.head, spine, Vec3(0, 1.65, 0));
  for (const double side : {1.0, -1.0}) {
    const SideNames& names = side > 0 ? options.left : options.right;
    auto& joints = side > 0 ? builder.body.left : builder.body.right;
    const auto at = [&](double x, double y, double z) { return Vec3(side * x, y, z); };
    const Vec3 shoulder = at(0.18, 1.45, 0);
    Vec3 elbow = at(0.46, 1.45, 0);
    std::array<Vec3, 3> beyond = {at(0.71, 1.45, 0), at(0.8, 1.45, -0.01), at(0.74, 1.45, 0.05)};
    for (Vec3& p : beyond) {
      p = detail::turned(p, elbow, Vec3(0, -side, 0), options.elbows_bent);
      p = detail::turned(p, shoulder, Vec3(0, 0, -side), options.arms_down);
    }
    elbow = detail::turned(elbow, shoulder, Vec3(0, 0, -side), options.arms_down);
    joints[kClavicle] = builder.add(names[kClavicle], spine, at(0.04, 1.45, 0));
    joints[kUpperArm] = builder.add(names[kUpperArm], joints[kClavicle], shoulder);
    int above_elbow = joints[kUpperArm];
    if (side > 0 && !options.left_twist.empty()) {
      above_elbow = builder.add(options.left_twist, above_elbow, 0.5 * (shoulder + elbow));
      builder.body.left_twist = above_elbow;
    }
    joints[kForearm] = builder.add(names[kForearm], above_elbow, elbow);
    joints[kHand] = builder.add(names[kHand], joints[kForearm], beyond[0]);
    joints[kIndex] = builder.add(names[kIndex], joints[kHand], beyond[1]);
    joints[kThumb] = builder.add(names[kThumb], joints[kHand], beyond[2]);
    joints[kThigh] = builder.add(names[kThigh], hips, at(0.1, 0.95, 0));
    joints[kShin] = builder.add(names[kShin], joints[kThigh], at(0.1, 0.5, 0.02));
    joints[kFoot] = builder.add(names[kFoot], joints[kShin], at(0.1, 0.08, -0.02));
    joints[kToes] = builder.add(names[kToes], joints[kFoot], at(0.1, 0.02, 0.12));
  }
  builder.body.hips = hips;

  Model& model = builder.body.model;
  model.path = "synthetic.glb";
  link_skeleton(skeleton);
  std::vector<Mat4> globals;
  compute_globals(skeleton, rest_pose(skeleton), Mat4(1.0), globals);
  Skin skin;
  Character character;
  character.name = "Armature";
  for (int joint = 1; joint < skeleton.size(); ++joint) {
    skin.joints.push_back(joint);
    skin.inverse_bind.push_back(glm::inverse(globals[static_cast<std::size_t>(joint)]));
    character.joints.push_back(joint);
  }
  character.skins = {0};
  character.height = 1.75 * std::abs(options.root_scale.y);
  model.skins.push_back(skin);
  model.characters.push_back(character);
  return builder.body;
}

inline LimbModel fit(const Body& body, LimbKind kind) {
  const LimbFindings findings = find_limbs(body.model, body.character());
  for (const Limb& limb : findings.limbs) {
    if (limb.kind != kind) continue;
    auto fitted = fit_limb_model(body.model, body.character(), limb, findings);
    if (fitted) return *fitted;
  }
  return {};
}

// Origins of the limb's joints and of what stands beyond, in the frame of the root node's parent.
inline std::vector<Vec3> posed(const Body& body, const LimbModel& limb, const Dofs& q, int beyond) {
  Pose pose = rest_pose(body.model.skeleton);
  LimbState state;
  state.q = q;
  apply_limb_state(limb, state, pose);
  std::vector<Mat4> globals;
  compute_globals(body.model.skeleton, pose, Mat4(1.0), globals);
  std::vector<Vec3> points;
  for (const int joint : {limb.limb.root, limb.limb.middle, limb.limb.end, beyond}) {
    points.emplace_back(globals[static_cast<std::size_t>(joint)][3]);
  }
  return points;
}

}  // namespace elbowroom::test
