// SPDX-License-Identifier: MIT
#include "tests/unit/rigs/rig_maker.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/random.h"

namespace elbowroom::test {
namespace {

Vec3 turned(const Vec3& p, const Vec3& about, const Vec3& axis, double angle) {
  return about + glm::angleAxis(angle, axis) * (p - about);
}

// A body 1.75 m tall in the T-pose, y up, facing +z; left side. Limbs' places move with the stance.
Vec3 place_of(const std::string& name, double side, const Stance& stance) {
  static const std::map<std::string, Vec3> trunk = {
      {"ground", {0, 0, 0}},          {"hips", {0, 0.98, 0}},        {"spine1", {0, 1.08, -0.01}},
      {"spine2", {0, 1.2, -0.02}},    {"chest", {0, 1.32, -0.02}},   {"neck", {0, 1.5, -0.01}},
      {"head", {0, 1.58, 0.01}},      {"head_end", {0, 1.75, 0}},    {"hair1", {0.06, 1.7, -0.08}},
      {"hair2", {0.1, 1.5, -0.12}},   {"hair3", {0.12, 1.3, -0.12}}, {"hair4", {0.13, 1.1, -0.12}},
      {"skirt1", {0.15, 0.95, 0.05}}, {"skirt2", {0.2, 0.75, 0.08}}, {"skirt3", {0.24, 0.55, 0.1}},
      {"eye", {0.03, 1.66, 0.09}},    {"breast", {0.08, 1.3, 0.1}},  {"pole", {0.3, 1.2, -0.5}},
      {"knee_pole", {0.1, 0.5, 0.6}}, {"ear", {0.05, 1.75, 0}},      {"ear_end", {0.07, 1.95, 0}}};
  static const std::map<std::string, Vec3> arm = {
      {"clavicle", {0.03, 1.43, 0}},           {"shoulder", {0.18, 1.43, -0.01}},
      {"upper_mid", {0.32, 1.43, -0.015}},     {"elbow", {0.46, 1.43, -0.02}},
      {"fore_mid", {0.585, 1.43, -0.015}},     {"wrist", {0.71, 1.43, -0.01}},
      {"upper_third", {0.273, 1.43, -0.0133}}, {"upper_two", {0.367, 1.43, -0.0167}},
      {"fore_third", {0.543, 1.43, -0.0167}},  {"fore_two", {0.627, 1.43, -0.0133}},
      {"elbow_back", {0.46, 1.43, -0.06}},     {"palm", {0.74, 1.43, -0.01}},
      {"index1", {0.8, 1.43, 0.015}},          {"index2", {0.84, 1.425, 0.016}},
      {"index3", {0.865, 1.42, 0.017}},        {"middle1", {0.805, 1.432, -0.008}},
      {"middle2", {0.85, 1.43, -0.008}},       {"middle3", {0.878, 1.425, -0.008}},
      {"ring1", {0.8, 1.43, -0.03}},           {"ring2", {0.842, 1.428, -0.031}},
      {"pinky1", {0.79, 1.425, -0.048}},       {"pinky2", {0.82, 1.42, -0.05}},
      {"thumb1", {0.735, 1.42, 0.02}},         {"thumb2", {0.765, 1.415, 0.045}},
      {"thumb3", {0.785, 1.41, 0.06}}};
  static const std::map<std::string, Vec3> leg = {
      {"hip_helper", {0.06, 0.95, 0}},       {"hip", {0.1, 0.93, 0}},
      {"thigh_mid", {0.1, 0.71, 0.01}},      {"knee", {0.1, 0.49, 0.02}},
      {"shin_mid", {0.1, 0.285, 0}},         {"ankle", {0.1, 0.08, -0.02}},
      {"ball", {0.1, 0.02, 0.11}},           {"toe", {0.1, 0.02, 0.18}},
      {"thigh_third", {0.1, 0.783, 0.0067}}, {"thigh_two", {0.1, 0.637, 0.0133}},
      {"shin_third", {0.1, 0.353, 0.0067}},  {"shin_two", {0.1, 0.217, -0.0067}},
      {"knee_front", {0.1, 0.49, 0.08}},     {"heel", {0.1, 0.01, -0.06}}};
  Vec3 p(0.0);
  if (const auto found = trunk.find(name); found != trunk.end()) {
    p = found->second;
  } else if (const auto of_arm = arm.find(name); of_arm != arm.end()) {
    p = of_arm->second;
    const Vec3 shoulder = arm.at("shoulder"), elbow = arm.at("elbow");
    if (p.x > elbow.x) p = turned(p, elbow, Vec3(0, -1, 0), stance.elbows_bent);
    if (of_arm->second.x > shoulder.x) p = turned(p, shoulder, Vec3(0, 0, -1), stance.arms_down);
  } else {
    p = leg.at(name);
    const Vec3 hip = leg.at("hip"), knee = leg.at("knee");
    const double forward = side * stance.stride;
    if (p.y < knee.y) p = turned(p, knee, Vec3(1, 0, 0), 0.6 * stance.stride);
    if (leg.at(name).y < hip.y) p = turned(p, hip, Vec3(1, 0, 0), -forward);
  }
  return Vec3(side * p.x, p.y, p.z);
}

}  // namespace

std::string sided(const std::string& name, bool left) {
  const auto open = name.find('{'), bar = name.find('|', open), close = name.find('}', open);
  if (open == std::string::npos || bar == std::string::npos || close == std::string::npos) {
    return name;
  }
  return name.substr(0, open) +
         (left ? name.substr(open + 1, bar - open - 1) : name.substr(bar + 1, close - bar - 1)) +
         sided(name.substr(close + 1), left);
}

int MadeRig::joint(const std::string& name, bool left) const {
  const std::string wanted = sided(name, left);
  for (std::size_t i = 0; i < row_names.size(); ++i) {
    if (row_names[i] == wanted) return static_cast<int>(i);
  }
  return -1;
}

MadeRig make_rig(const Convention& convention, const Stance& stance, const Placement& placement,
                 bool nonsense_names) {
  std::vector<PlacedJoint> placed;
  const auto find = [&](const std::string& name) {
    for (std::size_t i = 0; i < placed.size(); ++i) {
      if (placed[i].name == name) return static_cast<int>(i) + 1;
    }
    return 0;
  };
  const auto add = [&](const Row& row, bool left, bool first_side) {
    const std::string name = sided(row.name, left);
    if (!first_side && name == row.name) return;  // a middle one stands already
    placed.push_back({name, *row.parent == 0 ? 0 : find(sided(row.parent, left)),
                      place_of(row.place, left ? 1 : -1, stance), row.carries});
  };
  for (const Row& row : convention.rows) {
    add(row, true, true);
    add(row, false, false);
  }
  return make_rig(placed, placement, nonsense_names);
}

MadeRig make_rig(const std::vector<PlacedJoint>& placed, const Placement& placement,
                 bool nonsense_names) {
  MadeRig rig;
  Model& model = rig.model;
  Skeleton& skeleton = model.skeleton;
  Random random(7);
  const Quat data_from_body =
      placement.z_up ? glm::angleAxis(kPi / 2, Vec3(1, 0, 0)) : Quat(1, 0, 0, 0);
  Joint root;
  root.name = "Scene";
  root.rest.scale = placement.scale;
  root.rest.rotation = glm::normalize(placement.rotation * glm::conjugate(data_from_body));
  skeleton.joints.push_back(root);
  rig.row_names.push_back("");
  std::vector<Quat> world = {Quat(1, 0, 0, 0)};
  std::vector<Vec3> places = {Vec3(0.0)};
  std::vector<Carries> carries = {Carries::no_joint};
  double low = INFINITY, high = -INFINITY;
  for (const PlacedJoint& row : placed) {
    const auto p = static_cast<std::size_t>(row.parent);
    const Vec3 at = data_from_body * row.place;
    Joint joint;
    joint.name = row.name;
    joint.parent = row.parent;
    const Quat own = glm::normalize(Quat(random.uniform(-1, 1), random.uniform(-1, 1),
                                         random.uniform(-1, 1), random.uniform(-1, 1)));
    joint.rest.rotation = glm::normalize(glm::conjugate(world[p]) * own);
    joint.rest.translation = glm::conjugate(world[p]) * (at - places[p]);
    world.push_back(own);
    places.push_back(at);
    carries.push_back(row.carries);
    skeleton.joints.push_back(joint);
    rig.row_names.push_back(row.name);
    low = std::min(low, row.place.y);
    high = std::max(high, row.place.y);
  }
  const double height = high - low;
  if (nonsense_names) {
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
      skeleton.joints[i].name = i % 3 == 0 ? "" : "qx" + std::to_string(i * 7919 % 1000);
    }
  }
  link_skeleton(skeleton);
  std::vector<Mat4> globals;
  compute_globals(skeleton, rest_pose(skeleton), Mat4(1.0), globals);
  Skin skin;
  Character character;
  Mesh mesh;
  mesh.node = 0;
  mesh.skin = 0;
  mesh.influence_begin.push_back(0);
  for (int joint = 1; joint < skeleton.size(); ++joint) {
    const auto j = static_cast<std::size_t>(joint);
    if (carries[j] == Carries::no_joint) continue;
    const auto slot = static_cast<std::int32_t>(skin.joints.size());
    skin.joints.push_back(joint);
    skin.inverse_bind.push_back(glm::inverse(globals[j]));
    character.joints.push_back(joint);
    if (carries[j] == Carries::nothing) continue;
    const Vec3 place(globals[j][3]);
    for (int corner = 0; corner < 4; ++corner) {
      const Vec3 off(corner == 1 ? 0.006 * height : 0, corner == 2 ? 0.006 * height : 0,
                     corner == 3 ? 0.006 * height : 0);
      mesh.positions.emplace_back(glm::vec3(place + off * std::abs(placement.scale.y)));
      mesh.influences.push_back({joint, slot, 1.0f});
      mesh.influence_begin.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
    }
  }
  character.name = "made";
  character.skins = {0};
  character.meshes = {0};
  character.height = height * std::abs(placement.scale.y);
  model.path = "made.glb";
  model.skins.push_back(skin);
  model.meshes.push_back(mesh);
  model.characters.push_back(character);
  return rig;
}

}  // namespace elbowroom::test
