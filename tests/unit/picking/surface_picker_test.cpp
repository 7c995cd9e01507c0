// SPDX-License-Identifier: MIT
// The picker against a double loop over all triangles, on real figures in motion.
#include "core/collision/surface_picker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "assets/demo.h"
#include "core/base/random.h"
#include "core/io/open_scene.h"
#include "tests/support/samples.h"
#include "tests/support/shapes.h"

namespace elbowroom::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

World opened(const SceneDescription& description) {
  auto scene = open_scene(description);
  EXPECT_TRUE(scene.ok()) << scene.error().message();
  return scene.ok() ? scene->world : World{};
}

World demo_world() {
  const std::filesystem::path folder(ELBOWROOM_DEMO_DIR);
  SceneDescription description;
  description.character = folder / demo::kMannequinFile;
  description.clip = demo::kDemoClip;
  description.obstacles = {folder / demo::kPostsFile};
  AttachedFile umbrella;
  umbrella.file = folder / demo::kUmbrellaFile;
  umbrella.joint = demo::kAttachJoint;
  umbrella.joint_from_object.translation = Vec3(demo::kGripX, demo::kGripY, demo::kGripZ);
  description.attachments = {umbrella};
  return opened(description);
}

// A square of side 2 in the plane z = 0 that faces +z, of two triangles.
std::shared_ptr<Model> square(const Vec3& at = Vec3(0.0)) {
  auto model = std::make_shared<Model>();
  Joint joint;
  joint.rest.translation = at;
  model->skeleton.joints.push_back(joint);
  link_skeleton(model->skeleton);
  Mesh mesh;
  mesh.node = 0;
  const Shape shape = sheet_shape(1.0f, 1);
  mesh.positions = shape.positions;
  mesh.triangles = shape.triangles;
  model->meshes.push_back(mesh);
  return model;
}

World world_of(std::shared_ptr<const Model> model, const Mat4& place = Mat4(1.0)) {
  World world;
  world.actors.push_back({"", std::move(model), nullptr, std::nullopt, place});
  return world;
}

struct Found {
  int actor = -1, mesh = -1;
  std::uint32_t triangle = 0;
  double distance = kInfinity;
  Vec3 normal{0.0};
  bool clear = false;  // well inside its triangle, and nothing else as near
};

class BruteForce {
 public:
  BruteForce(const World& world, const std::vector<ActorState>& states) : world_(world) {
    for (std::size_t a = 0; a < world.actors.size(); ++a) {
      for (const Mesh& mesh : world.actors[a].model->meshes) {
        positions_.emplace_back();
        deform(*world.actors[a].model, mesh, states[a].pose, states[a].world_from_joint,
               positions_.back());
        for (const Vec3& p : positions_.back()) {
          lower_ = glm::min(lower_, p);
          upper_ = glm::max(upper_, p);
        }
      }
    }
  }

  double size() const { return glm::length(upper_ - lower_); }

  // From a place about the scene to another one in it.
  WorldRay random_ray(Random& random) const {
    const auto inside = [&] {
      return Vec3(random.uniform(lower_.x, upper_.x), random.uniform(lower_.y, upper_.y),
                  random.uniform(lower_.z, upper_.z));
    };
    WorldRay ray;
    const Vec3 way(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    ray.origin = inside() + size() * random.uniform(0, 2) * way;
    ray.direction = (inside() - ray.origin) * random.uniform(0.01, 3);
    return ray;
  }

  // Towards a random point of a random triangle, so that most rays hit.
  WorldRay aimed_ray(Random& random) const {
    WorldRay ray = random_ray(random);
    std::size_t part = random.below(positions_.size()), i = 0;
    for (const Actor& actor : world_.actors) {
      for (const Mesh& mesh : actor.model->meshes) {
        if (i++ != part || mesh.triangles.empty()) continue;
        const auto corners = mesh.triangles[random.below(mesh.triangles.size())];
        const double u = random.uniform(), v = random.uniform() * (1 - u);
        const auto& p = positions_[part];
        ray.direction =
            u * p[corners.x] + v * p[corners.y] + (1 - u - v) * p[corners.z] - ray.origin;
      }
    }
    return ray;
  }

  // `sign` −1: the world is mirrored, so winding turns round.
  Found nearest(const WorldRay& ray, bool back_faces, double sign = 1) const {
    Found best;
    double second = kInfinity;
    const Vec3 along = glm::normalize(ray.direction);
    std::size_t part = 0;
    for (std::size_t a = 0; a < world_.actors.size(); ++a) {
      const Model& model = *world_.actors[a].model;
      for (std::size_t m = 0; m < model.meshes.size(); ++m, ++part) {
        const Mesh& mesh = model.meshes[m];
        const bool both =
            back_faces || (mesh.material >= 0 &&
                           model.materials[static_cast<std::size_t>(mesh.material)].double_sided);
        const auto& p = positions_[part];
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
          const auto corners = mesh.triangles[t];
          const Vec3 e = p[corners.y] - p[corners.x], f = p[corners.z] - p[corners.x];
          const Vec3 h = glm::cross(along, f);
          const double det = glm::dot(e, h);
          if (det == 0) continue;
          const Vec3 s = ray.origin - p[corners.x], q = glm::cross(s, e);
          const double u = glm::dot(s, h) / det, v = glm::dot(along, q) / det;
          const double distance = glm::dot(f, q) / det;
          if (u < 0 || v < 0 || u + v > 1 || distance < 0) continue;
          Vec3 normal = glm::normalize(glm::cross(e, f));
          if (!both && glm::dot(normal, along) * sign > 0) continue;
          if (distance < best.distance) {
            second = best.distance;
            if (glm::dot(normal, along) > 0) normal = -normal;
            // Slivers are as wide as floats are fine: nobody can say which of two is hit.
            const double height = std::abs(glm::length(glm::cross(e, f))) /
                                  std::max({glm::length(e), glm::length(f), glm::length(e - f)});
            const double edge = std::min({u, v, 1 - u - v}) * height;
            best = {static_cast<int>(a),
                    static_cast<int>(m),
                    t,
                    distance,
                    normal,
                    edge > 1e-6 * size() && -glm::dot(normal, along) > 0.02};
          } else {
            second = std::min(second, distance);
          }
        }
      }
    }
    best.clear = best.clear && second - best.distance > 1e-5 * size();
    return best;
  }

 private:
  const World& world_;
  std::vector<std::vector<Vec3>> positions_;  // by actor and mesh
  Vec3 lower_{kInfinity}, upper_{-kInfinity};
};

// Compares rays at a time; returns how many met something.
int compare(SurfacePicker& picker, const World& world, double t, int rays, std::uint64_t seed,
            bool back_faces, double sign = 1) {
  std::vector<ActorState> states;
  world_state_at(world, t, states);
  const BruteForce brute(world, states);
  Random random(seed);
  PickFilter filter;
  filter.back_faces = back_faces;
  int met = 0, unclear = 0;
  for (int i = 0; i < rays; ++i) {
    const WorldRay ray = i % 2 == 0 ? brute.random_ray(random) : brute.aimed_ray(random);
    const Found want = brute.nearest(ray, back_faces, sign);
    const auto got = picker.nearest(world, states, ray, filter);
    if (want.actor >= 0) ++met;
    if (want.actor >= 0 && !want.clear) {
      ++unclear;
      continue;
    }
    if (want.actor < 0) {
      // Only along an edge may there be a hit.
      if (got) ++unclear;
      continue;
    }
    EXPECT_TRUE(got.has_value()) << "seed " << seed << " ray " << i;
    if (!got) continue;
    EXPECT_EQ(got->actor, want.actor);
    EXPECT_EQ(got->mesh, want.mesh);
    // A quad that is there twice may be hit as either.
    EXPECT_NEAR(got->distance, want.distance, 1e-9 * (brute.size() + want.distance));
    EXPECT_EQ(got->triangle, want.triangle);
    EXPECT_LT(glm::length(got->normal - want.normal), 1e-6);
    const Vec3 place = ray.origin + want.distance * glm::normalize(ray.direction);
    EXPECT_LT(glm::length(got->place - place), 1e-8 * (brute.size() + want.distance));
    const Mesh& mesh = world.actors[static_cast<std::size_t>(got->actor)]
                           .model->meshes[static_cast<std::size_t>(got->mesh)];
    EXPECT_EQ(got->joint, moving_joint(mesh, got->triangle));
  }
  EXPECT_LT(unclear, rays / 10);
  return met;
}

TEST(SurfacePicker, AgreesWithEveryTriangleOfTheDemo) {
  const World world = demo_world();
  SurfacePicker picker;
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(compare(picker, world, 0.9 * i, 250, 10 + static_cast<std::uint64_t>(i), i == 1),
              100);
  }
}

TEST(SurfacePicker, AgreesOnMirroredScaledAndFarPlacements) {
  World world = demo_world();
  SurfacePicker picker;
  const Mat4 mirror = glm::scale(Mat4(1.0), Vec3(-1, 1, 1));
  for (auto& actor : world.actors) {
    if (!actor.attachment) actor.world_from_file = mirror * actor.world_from_file;
  }
  // The attached umbrella stands in the rigid frame of the hand, which is not mirrored.
  World without = world;
  without.actors.pop_back();
  EXPECT_GT(compare(picker, without, 1.1, 200, 1, false, -1), 80);

  for (const double scale : {1e-3, 1e3}) {
    World scaled = demo_world();
    scaled.actors.pop_back();
    for (auto& actor : scaled.actors) {
      actor.world_from_file = glm::scale(Mat4(1.0), Vec3(scale)) * actor.world_from_file;
    }
    EXPECT_GT(compare(picker, scaled, 1.1, 150, 2, false), 50);
  }
}

TEST(SurfacePicker, IsAsGoodAThousandKilometresAway) {
  World world = demo_world();
  const Vec3 far(1e6, -2e5, 7e5);
  std::vector<ActorState> here, there;
  world_state_at(world, 1.3, here);
  World moved = world;
  for (auto& actor : moved.actors) {
    actor.world_from_file = glm::translate(Mat4(1.0), far) * actor.world_from_file;
  }
  world_state_at(moved, 1.3, there);
  SurfacePicker near_picker, far_picker;
  const BruteForce brute(world, here);
  Random random(5);
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const WorldRay ray = brute.aimed_ray(random);
    const Found want = brute.nearest(ray, false);
    if (!want.clear) continue;
    const auto got = far_picker.nearest(moved, there, {ray.origin + far, ray.direction});
    ASSERT_TRUE(got.has_value());
    ++hits;
    EXPECT_EQ(got->triangle, want.triangle);
    EXPECT_NEAR(got->distance, want.distance, 1e-6);
  }
  EXPECT_GT(hits, 100);
}

TEST(SurfacePicker, NamesTheLimbThatWasClicked) {
  const World world = demo_world();
  std::vector<ActorState> states;
  world_state_at(world, 0.4, states);
  const Model& model = *world.actors[0].model;
  SurfacePicker picker;
  PickFilter filter;
  filter.hidden = {0, 1, 1};
  for (const char* name : {"RightLowerArm", "LeftLowerArm", "RightLowerLeg", "LeftLowerLeg"}) {
    const int joint = model.skeleton.find(name);
    ASSERT_GE(joint, 0) << name;
    const auto& children = model.skeleton.children[static_cast<std::size_t>(joint)];
    ASSERT_FALSE(children.empty());
    const auto& globals = states[0].world_from_joint;
    const Vec3 middle = 0.5 * (Vec3(globals[static_cast<std::size_t>(joint)][3]) +
                               Vec3(globals[static_cast<std::size_t>(children[0])][3]));
    // From ahead, and close, so that nothing else is in the way.
    const auto hit =
        picker.nearest(world, states, {middle + Vec3(0, 0, 0.15), Vec3(0, 0, -1)}, filter);
    ASSERT_TRUE(hit.has_value()) << name;
    EXPECT_EQ(hit->joint, joint) << name;
    // Passing through that joint's surface something else is met, or nothing.
    PickFilter through = filter;
    through.through_actor = 0;
    through.through_joints.assign(static_cast<std::size_t>(model.skeleton.size()), 0);
    through.through_joints[static_cast<std::size_t>(joint)] = 1;
    const auto behind =
        picker.nearest(world, states, {middle + Vec3(0, 0, 0.15), Vec3(0, 0, -1)}, through);
    if (behind) {
      EXPECT_NE(behind->joint, joint);
      EXPECT_GT(behind->distance, hit->distance);
    }
  }
}

TEST(SurfacePicker, BuildsOnlyWhatMoved) {
  const World world = demo_world();
  std::size_t meshes = 0;
  for (const auto& actor : world.actors) meshes += actor.model->meshes.size();
  std::vector<ActorState> states;
  world_state_at(world, 0.4, states);
  SurfacePicker picker;
  const WorldRay ray{Vec3(0, 1, 5), Vec3(0, 0, -1)};
  (void)picker.nearest(world, states, ray);
  EXPECT_EQ(picker.builds(), meshes);
  (void)picker.nearest(world, states, ray);
  EXPECT_EQ(picker.builds(), meshes);
  // The posts stand still.
  std::size_t standing = 0;
  for (const auto& actor : world.actors) {
    if (!actor.clip && !actor.attachment) standing += actor.model->meshes.size();
  }
  EXPECT_GT(standing, 0u);
  world_state_at(world, 0.8, states);
  (void)picker.nearest(world, states, ray);
  EXPECT_EQ(picker.builds(), 2 * meshes - standing);
}

TEST(SurfacePicker, FacesCountAsPicturesShowThem) {
  std::vector<ActorState> states;
  const WorldRay front{Vec3(0.2, 0.3, 2), Vec3(0, 0, -4)};
  const WorldRay back{Vec3(0.2, 0.3, -2), Vec3(0, 0, 1)};
  const auto both = [&](const World& world, bool in_front, bool behind) {
    SurfacePicker picker;
    world_state_at(world, 0, states);
    const auto a = picker.nearest(world, states, front), b = picker.nearest(world, states, back);
    EXPECT_EQ(a.has_value(), in_front);
    EXPECT_EQ(b.has_value(), behind);
    if (a) {
      EXPECT_EQ(a->normal, Vec3(0, 0, 1));
      EXPECT_DOUBLE_EQ(a->distance, 2);
      EXPECT_EQ(a->joint, 0);
    }
    if (b) {
      EXPECT_EQ(b->normal, Vec3(0, 0, -1));
      EXPECT_DOUBLE_EQ(b->distance, 2);
    }
    PickFilter filter;
    filter.back_faces = true;
    EXPECT_TRUE(picker.nearest(world, states, front, filter).has_value());
    EXPECT_TRUE(picker.nearest(world, states, back, filter).has_value());
  };
  both(world_of(square()), true, false);
  // A mirror in x turns the winding round but not the side that a figure shows.
  both(world_of(square(), glm::scale(Mat4(1.0), Vec3(-1, 1, 1))), true, false);
  both(world_of(square(), glm::scale(Mat4(1.0), Vec3(1, 1, -1))), false, true);
  auto sheet = square();
  sheet->materials.emplace_back();
  sheet->materials[0].double_sided = true;
  sheet->meshes[0].material = 0;
  both(world_of(sheet), true, true);
}

TEST(SurfacePicker, HostileInputHitsNothing) {
  SurfacePicker picker;
  std::vector<ActorState> states;
  World world;
  EXPECT_FALSE(picker.nearest(world, states, {}).has_value());
  world.actors.emplace_back();  // no model
  world_state_at(world, 0, states);
  EXPECT_FALSE(picker.nearest(world, states, {}).has_value());
  world.actors[0].model = std::make_shared<Model>();
  world_state_at(world, 0, states);
  EXPECT_FALSE(picker.nearest(world, states, {}).has_value());

  world.actors[0].model = square();
  world_state_at(world, 0, states);
  const WorldRay sound{Vec3(0.1, 0.2, 1), Vec3(0, 0, -1)};
  EXPECT_TRUE(picker.nearest(world, states, sound).has_value());
  EXPECT_FALSE(picker.nearest(world, {}, sound).has_value());
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(picker.nearest(world, states, {Vec3(0, bad, 1), Vec3(0, 0, -1)}).has_value());
    EXPECT_FALSE(picker.nearest(world, states, {Vec3(0, 0, 1), Vec3(0, bad, -1)}).has_value());
  }
  EXPECT_FALSE(picker.nearest(world, states, {Vec3(0, 0, 1), Vec3(0.0)}).has_value());
  EXPECT_FALSE(picker.nearest(world, states, {Vec3(0, 0, 1), Vec3(0, 0, 1)}).has_value());
  // Along the sheet, and from very far.
  (void)picker.nearest(world, states, {Vec3(-3, 0, 0), Vec3(1, 0, 0)});
  const auto far = picker.nearest(world, states, {Vec3(0.1, 0.2, 1e9), Vec3(0, 0, -1e-9)});
  ASSERT_TRUE(far.has_value());
  EXPECT_NEAR(far->place.z, 0, 1e-6);

  // A vertex that is no number takes its triangles along, not the others.
  auto broken = square();
  broken->meshes[0].positions[broken->meshes[0].triangles[0].x] = glm::vec3(kNan);
  broken->meshes[0].positions.push_back(glm::vec3(-1, -1, 0));
  broken->meshes[0].positions.push_back(glm::vec3(1, -1, 0));
  broken->meshes[0].positions.push_back(glm::vec3(0, 1, 0));
  broken->meshes[0].triangles.push_back({4, 5, 6});
  world.actors[0].model = broken;
  const auto rest = picker.nearest(world, states, sound);
  ASSERT_TRUE(rest.has_value());
  EXPECT_EQ(rest->triangle, broken->meshes[0].triangles.size() - 1);
  // A state that is no number, and one of another model.
  states[0].world_from_joint[0][3][1] = kNan;
  EXPECT_FALSE(picker.nearest(world, states, sound).has_value());
  states[0].world_from_joint.clear();
  EXPECT_FALSE(picker.nearest(world, states, sound).has_value());
  // Everything in one place.
  auto point = square();
  for (auto& p : point->meshes[0].positions) p = glm::vec3(0.1f, 0.2f, 0.0f);
  world.actors[0].model = point;
  world_state_at(world, 0, states);
  EXPECT_FALSE(picker.nearest(world, states, sound).has_value());
}

TEST(SurfacePicker, AgreesOnRealFigures) {
  const auto samples = samples_dir();
  if (samples.empty()) GTEST_SKIP() << samples_missing();
  int figures = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(samples / "humanoids")) {
    const auto extension = entry.path().extension();
    if (extension != ".glb" && extension != ".gltf") continue;
    SceneDescription description;
    description.character = entry.path();
    auto scene = open_scene(description);
    if (!scene.ok()) continue;
    SCOPED_TRACE(entry.path().filename());
    SurfacePicker picker;
    for (const double t : {0.0, 0.7}) compare(picker, scene->world, t, 60, 3, true);
    ++figures;
  }
  EXPECT_GT(figures, 0);
}

}  // namespace
}  // namespace elbowroom::test
