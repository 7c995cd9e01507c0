// SPDX-License-Identifier: MIT
#include "tests/unit/scene_collision/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace elbowroom::test {
namespace {

void add_joint(Model& model, const char* name, int parent, const Vec3& at) {
  Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.rest.translation = at;
  model.skeleton.joints.push_back(joint);
}

// Weight of the joint farther out, about a border at x.
double share(double x, double border) { return std::clamp((x - border) / 0.08 + 0.5, 0.0, 1.0); }

void add_skin(Mesh& mesh, const glm::vec3& p, const std::vector<std::pair<int, double>>& weights) {
  if (mesh.influence_begin.empty()) mesh.influence_begin.push_back(0);
  mesh.positions.push_back(p);
  for (const auto& [joint, weight] : weights)
    if (weight > 0) mesh.influences.push_back({joint, joint, static_cast<float>(weight)});
  mesh.influence_begin.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
}

void add_box(Mesh& mesh, const glm::vec3& low, const glm::vec3& high) {
  const Shape box = box_shape(0.5f * (high - low));
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::vec3& p : box.positions) add_skin(mesh, p + 0.5f * (low + high), {{kHips, 1.0}});
  for (const glm::uvec3& t : box.triangles) mesh.triangles.push_back(t + base);
}

}  // namespace

std::shared_ptr<Model> make_figure(const FigureOptions& options) {
  auto model = std::make_shared<Model>();
  model->path = "figure.glb";
  add_joint(*model, "Hips", -1, Vec3(0, 1, 0));
  add_joint(*model, "UpperArm", kHips, Vec3(0.2, 0.4, 0));
  add_joint(*model, "ForeArm", kUpper, Vec3(0.3, 0, 0));
  if (options.detached_hand)
    add_joint(*model, "Hand", kHips, Vec3(0.75, 0.4, 0));
  else
    add_joint(*model, "Hand", kFore, Vec3(0.25, 0, 0));
  add_joint(*model, "Finger", kHand, Vec3(0.1, 0, 0));
  if (options.detached_hand) add_joint(*model, "ForeArm_end", kFore, Vec3(0.25, 0, 0));

  Mesh skin;
  skin.name = "Body";
  skin.node = kHips;
  skin.skin = 0;
  // One tube from inside the trunk to the finger tip, with caps.
  const int rings = 38, sides = 12;
  for (int r = 0; r <= rings; ++r) {
    const double x = 0.025 * r;
    for (int s = 0; s < sides; ++s) {
      const double a = 2 * kPi * s / sides;
      const double upper = share(x, 0.2), fore = share(x, 0.5), hand = share(x, 0.75),
                   finger = share(x, 0.87);
      add_skin(skin, glm::vec3(x, 1.4 + 0.05 * std::cos(a), 0.05 * std::sin(a)),
               {{kHips, 1 - upper},
                {kUpper, upper * (1 - fore)},
                {kFore, upper * fore * (1 - hand)},
                {kHand, upper * fore * hand * (1 - finger)},
                {kFinger, upper * fore * hand * finger}});
    }
  }
  const auto at = [&](int r, int s) { return static_cast<std::uint32_t>(r * sides + s % sides); };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sides; ++s) {
      skin.triangles.emplace_back(at(r, s), at(r, s + 1), at(r + 1, s));
      skin.triangles.emplace_back(at(r + 1, s), at(r, s + 1), at(r + 1, s + 1));
    }
  for (int s = 1; s + 1 < sides; ++s) {
    skin.triangles.emplace_back(at(0, 0), at(0, s + 1), at(0, s));
    skin.triangles.emplace_back(at(rings, 0), at(rings, s), at(rings, s + 1));
  }
  add_box(skin, {-0.2f, 0.9f, -0.12f}, {0.1f, 1.5f, 0.12f});
  if (options.thigh)
    add_box(skin, {0.02f, 0.3f, -0.1f}, {static_cast<float>(options.thigh_side), 0.85f, 0.1f});
  model->meshes.push_back(skin);
  if (options.sword) {
    Mesh sword;
    sword.name = "Sword";
    sword.node = kHand;
    const Shape blade = box_shape({0.01f, 0.4f, 0.005f});
    for (const glm::vec3& p : blade.positions) sword.positions.push_back(p + glm::vec3(0.1f, 0, 0));
    sword.triangles = blade.triangles;
    model->meshes.push_back(sword);
  }

  const auto scale = static_cast<float>(options.scale);
  for (Mesh& mesh : model->meshes)
    for (glm::vec3& p : mesh.positions) p *= scale;
  for (Joint& joint : model->skeleton.joints) joint.rest.translation *= options.scale;
  EXPECT_TRUE(link_skeleton(model->skeleton));
  std::vector<Mat4> globals;
  compute_globals(model->skeleton, rest_pose(model->skeleton), Mat4(1.0), globals);
  Skin bound;
  for (int j = 0; j < model->skeleton.size(); ++j) {
    bound.joints.push_back(j);
    bound.inverse_bind.push_back(glm::inverse(globals[static_cast<std::size_t>(j)]));
  }
  model->skins.push_back(bound);
  Character character;
  character.name = "Ada";
  character.skins = {0};
  for (std::size_t m = 0; m < model->meshes.size(); ++m) {
    character.meshes.push_back(static_cast<int>(m));
    character.triangles += static_cast<int>(model->meshes[m].triangles.size());
  }
  character.joints = bound.joints;
  character.height = kHeight * options.scale;
  model->characters.push_back(character);
  return model;
}

LimbModel arm_of(const Model& model) {
  LimbModel arm;
  arm.limb.kind = LimbKind::left_arm;
  arm.limb.name = "left_arm";
  const bool detached = model.skeleton.size() > kForeEnd;
  arm.limb.joints = {kUpper, kFore, detached ? kForeEnd : kHand};
  if (detached) arm.limb.following = {{kHand, kForeEnd}};
  arm.limb.root = kUpper;
  arm.limb.middle = kFore;
  arm.limb.end = arm.limb.joints.back();
  const JointModelKind kinds[3] = {JointModelKind::ball, JointModelKind::hinge,
                                   JointModelKind::swing};
  int dof = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    arm.joints[j].kind = kinds[j];
    arm.joints[j].joint = arm.limb.joints[j];
    arm.joints[j].first_dof = dof;
    for (int k = 0; k < arm.joints[j].dof_count(); ++k, ++dof) {
      Dof d;
      d.name = model.skeleton.joints[static_cast<std::size_t>(arm.limb.joints[j])].name + " " +
               std::to_string(k);
      d.lower = d.sample_lower = -2.0;
      d.upper = d.sample_upper = 2.0;
      d.speed_limit = 10;
      arm.space.dofs.push_back(d);
    }
  }
  return arm;
}

std::shared_ptr<Clip> swing_clip(const std::vector<float>& times, const std::vector<double>& angles,
                                 Interpolation interpolation) {
  auto clip = std::make_shared<Clip>();
  clip->name = "swing";
  Channel channel;
  channel.joint = kUpper;
  channel.path = Path::rotation;
  channel.interpolation = interpolation;
  channel.components = 4;
  channel.times = times;
  for (const double angle : angles)
    for (const double v : {0.0, 0.0, std::sin(angle / 2), std::cos(angle / 2)})
      channel.values.push_back(static_cast<float>(v));
  clip->begin = times.front();
  clip->end = times.back();
  clip->channels.push_back(channel);
  return clip;
}

std::shared_ptr<Model> make_object(const std::string& name, const Shape& shape) {
  auto model = std::make_shared<Model>();
  model->path = name + ".glb";
  Joint joint;
  joint.name = name;
  model->skeleton.joints.push_back(joint);
  EXPECT_TRUE(link_skeleton(model->skeleton));
  Mesh mesh;
  mesh.name = name;
  mesh.node = 0;
  mesh.positions = shape.positions;
  mesh.triangles = shape.triangles;
  model->meshes.push_back(mesh);
  Object object;
  object.name = name;
  object.node = 0;
  object.meshes = {0};
  object.triangles = static_cast<int>(shape.triangles.size());
  model->objects.push_back(object);
  return model;
}

Actor actor(const std::string& name, std::shared_ptr<const Model> model, const Vec3& at,
            double scale) {
  Actor placed;
  placed.name = name;
  placed.model = std::move(model);
  placed.world_from_file[3] = glm::dvec4(at, 1.0);
  for (int c = 0; c < 3; ++c) placed.world_from_file[c] *= scale;
  return placed;
}

World world_of(const std::shared_ptr<const Model>& figure, std::shared_ptr<const Clip> clip,
               const std::vector<Actor>& others) {
  World world;
  world.actors.push_back(actor("figure.glb", figure));
  world.actors[0].clip = std::move(clip);
  world.actors.insert(world.actors.end(), others.begin(), others.end());
  return world;
}

SceneCollision scene_of(const World& world, double begin, double end,
                        const CollisionSettings& settings) {
  auto scene =
      SceneCollision::build(world, 0, 0, {arm_of(*world.actors[0].model)}, begin, end, settings);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message());
  return std::move(scene).value();
}

bool touches(SceneCollision& scene, double t, const std::string& what) {
  std::vector<ContactSample> contacts;
  scene.contacts_at(t, 0, false, contacts);
  return std::any_of(contacts.begin(), contacts.end(), [&](const auto& contact) {
    return contact.part_b.find(what) != std::string::npos;
  });
}

}  // namespace elbowroom::test
