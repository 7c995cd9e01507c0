// SPDX-License-Identifier: MIT
#include "tests/unit/following/detached_rig.h"

#include <cmath>

#include "core/anatomy/following.h"
#include "core/animation/affine.h"
#include "core/base/random.h"

namespace elbowroom::test {
namespace {

struct Maker {
  DetachedRig rig{std::make_shared<Model>()};
  std::vector<Quat> world{};
  std::vector<Vec3> places{};
  std::vector<bool> carries{};
  Random random{11};

  void add(const std::string& name, const std::string& parent, const Vec3& place,
           bool skin = true) {
    Joint joint;
    joint.name = name;
    joint.parent = rig.joint(parent);
    const auto p = static_cast<std::size_t>(joint.parent);
    const Quat own = glm::normalize(Quat(random.uniform(-1, 1), random.uniform(-1, 1),
                                         random.uniform(-1, 1), random.uniform(-1, 1)));
    joint.rest.rotation = glm::normalize(glm::conjugate(world[p]) * own);
    joint.rest.translation = glm::conjugate(world[p]) * (place - places[p]);
    rig.model->skeleton.joints.push_back(joint);
    world.push_back(own);
    places.push_back(place);
    carries.push_back(skin);
  }
};

// Four vertices about each joint that carries skin.
void add_skin(Model& model, const std::vector<bool>& carries) {
  std::vector<Mat4> globals;
  compute_globals(model.skeleton, rest_pose(model.skeleton), Mat4(1.0), globals);
  Skin skin;
  Character character;
  character.name = "Rig";
  Mesh mesh;
  mesh.name = "Skin";
  mesh.node = 0;
  mesh.skin = 0;
  mesh.influence_begin.push_back(0);
  double low = INFINITY, high = -INFINITY;
  for (int joint = 1; joint < model.skeleton.size(); ++joint) {
    const auto j = static_cast<std::size_t>(joint);
    const auto slot = static_cast<std::int32_t>(skin.joints.size());
    skin.joints.push_back(joint);
    skin.inverse_bind.push_back(glm::inverse(globals[j]));
    character.joints.push_back(joint);
    if (!carries[j]) continue;
    const Vec3 place(globals[j][3]);
    low = std::min(low, place.y);
    high = std::max(high, place.y);
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const double size = 0.01 * glm::length(globals[0][1]);
    for (int corner = 0; corner < 4; ++corner) {
      Vec3 at = place;
      if (corner > 0) at[corner - 1] += size;
      mesh.positions.emplace_back(at);
      mesh.influences.push_back({joint, slot, 1.0f});
      mesh.influence_begin.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
    }
    for (const glm::uvec3 t :
         {glm::uvec3(0, 2, 1), glm::uvec3(0, 1, 3), glm::uvec3(0, 3, 2), glm::uvec3(1, 2, 3)})
      mesh.triangles.push_back(t + base);
  }
  character.skins = {0};
  character.meshes = {0};
  character.triangles = static_cast<int>(mesh.triangles.size());
  character.height = high - low;
  model.skins.push_back(skin);
  model.meshes.push_back(mesh);
  model.characters.push_back(character);
}

}  // namespace

DetachedRig make_detached_rig(const RigOptions& options) {
  Maker maker;
  Joint top;
  top.name = "Armature";
  const double width = (options.mirrored ? -1 : 1) * (options.uneven ? 2 : 1) * options.scale;
  top.rest.scale = Vec3(width, options.scale, options.scale);
  maker.rig.model->skeleton.joints.push_back(top);
  maker.world.push_back(Quat(1, 0, 0, 0));
  maker.places.push_back(Vec3(0.0));
  maker.carries.push_back(false);
  maker.add("Root", "Armature", Vec3(0, 0, 0), false);
  maker.add("FootControls", "Root", Vec3(0, 0, 0.1), false);
  maker.add("Hips", "Root", Vec3(0, 1, 0));
  maker.add("Spine", "Hips", Vec3(0, 1.25, 0));
  maker.add("Head", "Spine", Vec3(0, 1.65, 0));
  for (const double side : {1.0, -1.0}) {
    const std::string s = side > 0 ? ".L" : ".R";
    const auto at = [&](double x, double y, double z) { return Vec3(side * x, y, z); };
    maker.add("Shoulder" + s, "Spine", at(0.04, 1.45, 0));
    maker.add("UpperArm" + s, "Shoulder" + s, at(0.18, 1.45, 0));
    if (options.twist) maker.add("UpperArmTwist" + s, "Shoulder" + s, at(0.32, 1.45, -0.005));
    maker.add("LowerArm" + s, "UpperArm" + s, at(0.46, 1.45, -0.01));
    if (options.detached_hand)
      maker.add("LowerArm_end" + s, "LowerArm" + s, at(0.71, 1.45, 0), false);
    maker.add("Hand" + s, options.detached_hand ? "Root" : "LowerArm" + s, at(0.71, 1.45, 0));
    maker.add("Index1" + s, "Hand" + s, at(0.8, 1.45, 0.01));
    maker.add("UpperLeg" + s, "Hips", at(0.1, 0.95, 0));
    maker.add("LowerLeg" + s, "UpperLeg" + s, at(0.1, 0.5, 0.02));
    if (!options.plain) maker.add("LowerLeg_end" + s, "LowerLeg" + s, at(0.1, 0.08, -0.02), false);
    maker.add("Foot" + s, options.plain ? "LowerLeg" + s : "FootControls", at(0.1, 0.08, -0.02));
    maker.add("Toes" + s, "Foot" + s, at(0.1, 0.02, 0.12));
    if (!options.garment) continue;
    maker.add("trousers 1" + s, "Root", at(0.1, 0.95, 0));
    maker.add("trousers 2" + s, "trousers 1" + s, at(0.1, 0.5, 0.02));
    maker.add("trousers 3" + s, "trousers 2" + s, at(0.1, 0.08, -0.02));
  }
  Model& model = *maker.rig.model;
  Joint& controls =
      model.skeleton.joints[static_cast<std::size_t>(maker.rig.joint("FootControls"))];
  controls.rest.scale = options.foot_parent_scale;
  if (options.matrix_foot) {
    Joint& foot = model.skeleton.joints[static_cast<std::size_t>(maker.rig.joint("Foot.L"))];
    foot.rest_matrix = foot.rest.matrix();
  }
  model.path = "detached.glb";
  link_skeleton(model.skeleton);
  add_skin(model, maker.carries);
  return maker.rig;
}

std::shared_ptr<Clip> walk_of(const DetachedRig& rig, FootKeys keys, int rate) {
  const Skeleton& skeleton = rig.model->skeleton;
  auto clip = std::make_shared<Clip>();
  clip->name = "walk";
  clip->end = 2;
  const auto rest = [&](int joint) {
    return skeleton.joints[static_cast<std::size_t>(joint)].rest;
  };
  const auto add = [&](int joint, Path path, int every, const auto& value) {
    Channel channel;
    channel.joint = joint;
    channel.path = path;
    channel.components = path == Path::rotation ? 4 : 3;
    for (int i = 0; i <= 2 * rate; i += every) {
      channel.times.push_back(static_cast<float>(i) / static_cast<float>(rate));
      value(i / static_cast<double>(rate), channel.values);
    }
    channel.source_channel = static_cast<int>(clip->channels.size());
    clip->channels.push_back(channel);
  };
  const auto put = [](std::vector<float>& values, const Vec3& v) {
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(v[k]));
  };
  const auto put_rotation = [](std::vector<float>& values, const Quat& q) {
    for (const double v : {q.x, q.y, q.z, q.w}) values.push_back(static_cast<float>(v));
  };
  const auto swing = [&](const std::string& name, const Vec3& axis, double size, double phase) {
    const int joint = rig.joint(name);
    add(joint, Path::rotation, 1, [&](double t, std::vector<float>& values) {
      const double angle = size * std::sin(kPi * t + phase);
      put_rotation(values, glm::normalize(rest(joint).rotation * glm::angleAxis(angle, axis)));
    });
  };
  add(rig.joint("Root"), Path::translation, 3, [&](double t, std::vector<float>& values) {
    put(values,
        rest(rig.joint("Root")).translation + Vec3(0.1 * t, 0.02 * std::sin(5 * t), 0.4 * t));
  });
  swing("Root", Vec3(0, 1, 0), 0.4, 0);
  swing("FootControls", Vec3(0.6, 0, 0.8), 0.2, 1);
  swing("Hips", Vec3(0, 0.6, 0.8), 0.1, 0.5);
  for (const std::string s : {".L", ".R"}) {
    swing("UpperLeg" + s, Vec3(1, 0, 0), 0.4, s == ".L" ? 0 : kPi);
    swing("LowerLeg" + s, Vec3(0, 0.8, 0.6), 0.3, s == ".L" ? 0.3 : 2);
    if (keys == FootKeys::none || rig.joint("LowerLeg_end" + s) < 0) continue;
    // Where the shin has it at these times, by the relation that they have at rest.
    const int foot = rig.joint("Foot" + s), end = rig.joint("LowerLeg_end" + s);
    const int parent = skeleton.joints[static_cast<std::size_t>(foot)].parent;
    const Pose bound = rest_pose(skeleton);
    Clip so_far = *clip;
    const auto local = [&](double t) {
      Pose pose = bound;
      sample_clip(so_far, static_cast<double>(static_cast<float>(t)), pose);
      return following_local(global_of(skeleton, pose, parent), global_of(skeleton, pose, end),
                             global_of(skeleton, bound, end), global_of(skeleton, bound, parent),
                             rest(foot));
    };
    const int every = keys == FootKeys::step ? 10 : 1;
    for (const Path path : {Path::translation, Path::rotation}) {
      add(foot, path, every, [&](double t, std::vector<float>& values) {
        const auto one = [&](double at) {
          if (path == Path::rotation)
            put_rotation(values, local(at).rotation);
          else
            put(values, local(at).translation);
        };
        if (keys != FootKeys::cubic) return one(t);
        for (int k = 0; k < (path == Path::rotation ? 4 : 3); ++k) values.push_back(0);
        one(t);
        for (int k = 0; k < (path == Path::rotation ? 4 : 3); ++k) values.push_back(0);
      });
      clip->channels.back().interpolation = keys == FootKeys::cubic  ? Interpolation::cubic_spline
                                            : keys == FootKeys::step ? Interpolation::step
                                                                     : Interpolation::linear;
    }
  }
  return clip;
}

}  // namespace elbowroom::test
