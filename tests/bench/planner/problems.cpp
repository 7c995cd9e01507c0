// SPDX-License-Identifier: MIT
#include "problems.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "assets/demo.h"
#include "core/editing/correct.h"
#include "core/io/open_scene.h"
#include "tests/support/shapes.h"
#include "tests/support/simple_glb.h"

namespace elbowroom::bench {
namespace {

constexpr double kSpeedReserve = 1.05;  // over the clip's own peak speed, where that is the limit

// A file's worth of rigid meshes, each an object; `path` moves all of them (one node, linear keys).
Actor obstacle(const std::string& name, const std::vector<test::SimpleMesh>& meshes,
               const std::vector<std::pair<float, Vec3>>& path = {}) {
  auto model = std::make_shared<Model>();
  model->path = name;
  Joint node;
  node.name = name;
  if (!path.empty()) node.rest.translation = path.front().second;
  model->skeleton.joints = {node};
  link_skeleton(model->skeleton);
  Object object;
  object.name = name;
  object.node = 0;
  object.animated = !path.empty();
  for (const test::SimpleMesh& m : meshes) {
    Mesh mesh;
    mesh.name = name;
    mesh.node = 0;
    mesh.source_mesh = static_cast<int>(model->meshes.size());
    mesh.source_primitive = 0;
    mesh.positions = m.positions;
    mesh.triangles = m.triangles;
    object.meshes.push_back(static_cast<int>(model->meshes.size()));
    object.triangles += static_cast<int>(m.triangles.size());
    model->meshes.push_back(std::move(mesh));
  }
  model->objects = {object};
  Actor actor;
  actor.name = name;
  if (!path.empty()) {
    Channel channel;
    channel.joint = 0;
    channel.path = Path::translation;
    channel.components = 3;
    for (const auto& [time, place] : path) {
      channel.times.push_back(time);
      for (int k = 0; k < 3; ++k) channel.values.push_back(static_cast<float>(place[k]));
    }
    Clip clip;
    clip.name = "flight";
    clip.begin = static_cast<double>(path.front().first);
    clip.end = static_cast<double>(path.back().first);
    clip.channels = {channel};
    actor.clip = std::make_shared<Clip>(clip);
    model->clips = {clip};
  }
  actor.model = model;
  return actor;
}

Vec3 joint_place(const World& world, const std::string& joint, double t) {
  std::vector<ActorState> states;
  world_state_at(world, t, states);
  const int index = world.actors.front().model->skeleton.find(joint);
  return index < 0 ? Vec3(0.0)
                   : Vec3(states.front().world_from_joint[static_cast<std::size_t>(index)][3]);
}

// The mannequin that walks with its umbrella, among obstacles to be added: an obstacle stands
// before attachments in a world's order only by habit, so more can follow.
Result<OpenedScene> demo_scene(bool posts) {
  const std::filesystem::path folder = ELBOWROOM_DEMO_DIR;
  SceneDescription description;
  description.character = folder / demo::kMannequinFile;
  description.clip = demo::kDemoClip;
  if (posts) description.obstacles = {folder / demo::kPostsFile};
  AttachedFile umbrella;
  umbrella.file = folder / demo::kUmbrellaFile;
  umbrella.joint = demo::kAttachJoint;
  umbrella.joint_from_object.translation = Vec3(demo::kGripX, demo::kGripY, demo::kGripZ);
  description.attachments = {umbrella};
  return open_scene(description);
}

Result<Problem> make(const std::string& name, const std::string& about, bool posts,
                     const std::function<void(World&)>& add) {
  auto opened = demo_scene(posts);
  if (!opened) return opened.error();
  if (add) add(opened->world);
  const Model& model = opened->model();
  const Character& character = model.characters[static_cast<std::size_t>(opened->character)];
  const LimbFindings findings = find_limbs(model, character);

  Problem p;
  p.name = name;
  p.about = about;
  std::vector<LimbModel> limbs;
  for (const Limb& limb : findings.limbs) {
    auto fitted = fit_limb_model(model, character, limb, findings);
    if (!fitted) return fitted.error();
    if (limb.kind == LimbKind::right_arm) p.limb = static_cast<int>(limbs.size());
    limbs.push_back(std::move(*fitted));
  }
  if (p.limb < 0) return Error{"no right arm was found", name, ""};
  const std::shared_ptr<const Clip> clip = opened->world.actors.front().clip;
  auto scene = SceneCollision::build(opened->world, 0, opened->character, limbs, clip->begin,
                                     clip->end, CollisionSettings{});
  if (!scene) return scene.error();
  p.scene = std::make_unique<SceneCollision>(std::move(*scene));

  // One window over all that the arm runs into.
  const auto contacts = p.scene->scan(clip->begin, clip->end, 120, p.limb, false);
  const double clearance = p.scene->settings().clearance * p.scene->height();
  const auto windows = propose_windows(*p.scene, p.limb, contacts, clearance);
  if (windows.empty()) return Error{"the clip does not collide", name, ""};
  p.begin = windows.front().begin;
  p.end = windows.front().end;
  for (const ProposedWindow& w : windows) {
    if (!w.blocked.empty()) return Error{w.blocked, name, ""};
    p.begin = std::min(p.begin, w.begin);
    p.end = std::max(p.end, w.end);
  }

  // Everything below refers to what the scene keeps.
  const World& world = p.scene->world();
  const LimbModel& limb = p.scene->limbs()[static_cast<std::size_t>(p.limb)];
  p.track = std::make_unique<LimbTrack>(*world.actors.front().model, *world.actors.front().clip,
                                        limb, p.begin, p.end);
  p.at_init = p.track->at(p.begin);
  p.at_goal = p.track->at(p.end);
  p.velocity_init = p.track->rate(p.begin, -1);
  p.velocity_goal = p.track->rate(p.end, 1);
  p.space = limb.space;
  for (int i = 0; i <= 500; ++i) {
    p.space.widen_to(p.track->at(p.begin + (p.end - p.begin) * i / 500).q);
  }
  p.space.widen_to(p.at_init.q);
  p.space.widen_to(p.at_goal.q);
  for (int d = 0; d < p.space.count(); ++d) {
    Dof& dof = p.space.dofs[static_cast<std::size_t>(d)];
    const double own = std::max(
        {p.track->peak_speed()[d], std::abs(p.velocity_init[d]), std::abs(p.velocity_goal[d])});
    dof.speed_limit = std::max(dof.speed_limit, kSpeedReserve * own);
  }
  double length = 0;
  for (std::size_t j = 1; j < limb.joints.size(); ++j) {
    const auto& names = world.actors.front().model->skeleton.joints;
    const auto place = [&](std::size_t k) {
      return joint_place(world, names[static_cast<std::size_t>(limb.joints[k].joint)].name,
                         p.begin);
    };
    length += glm::length(place(j) - place(j - 1));
  }
  p.length_unit = length;
  const auto space = p.planning_space(0);
  for (const auto& part : space->parts()) {
    (part.limb ? p.triangles_limb : p.triangles_rest) += part.mesh->triangles().size();
  }
  return p;
}

}  // namespace

std::unique_ptr<LimbPlanningSpace> Problem::planning_space(double clearance) const {
  LimbPlanningSpace::Settings settings;
  settings.clearance = clearance;
  return std::make_unique<LimbPlanningSpace>(*scene, limb, begin, end, at_init, at_goal, settings);
}

std::vector<std::string> problem_names() { return {"demo", "slalom", "balls"}; }

Result<Problem> make_problem(const std::string& name) {
  if (name == "demo")
    return make(name, "the demo scene: an umbrella between two posts", true, nullptr);
  if (name == "slalom")
    return make(name, "eight thin posts (radius 8 mm), four on each side of the way", false,
                [](World& world) {
                  std::vector<test::SimpleMesh> posts;
                  for (int i = 0; i < 8; ++i) {
                    const double x = i % 2 == 0 ? -0.62 : 0.52;
                    posts.push_back(test::upright_post(x, -1.4 + 0.4 * i, 0.008, 0.0, 2.4));
                  }
                  world.actors.push_back(obstacle("thin posts", posts));
                });
  if (name != "balls") return Error{"there is no such problem", name, "demo, slalom or balls"};
  return make(name,
              "the demo's posts, and two balls that fly at the hand, from ahead and from a side",
              true, [](World& world) {
                const Clip& clip = *world.actors.front().clip;
                const test::Shape shape = test::sphere_shape(0.12f, 24, 48);
                const test::SimpleMesh ball{shape.positions, shape.triangles};
                const auto fly = [&](const std::string& name, double share, const Vec3& velocity) {
                  const double meets = clip.begin + share * (clip.end - clip.begin);
                  const Vec3 hand = joint_place(world, demo::kAttachJoint, meets);
                  world.actors.push_back(obstacle(
                      name, {ball},
                      {{static_cast<float>(clip.begin), hand + (clip.begin - meets) * velocity},
                       {static_cast<float>(clip.end), hand + (clip.end - meets) * velocity}}));
                };
                fly("ball from ahead", 0.32, Vec3(0.3, -0.1, -1.2));
                fly("ball from the side", 0.62, Vec3(1.3, 0.1, 0.4));
              });
}

}  // namespace elbowroom::bench
