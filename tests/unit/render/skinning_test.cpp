// SPDX-License-Identifier: MIT
// What the GPU deforms is what core's deform() says, and lands where the camera projects it.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "core/io/gltf_reader.h"
#include "render/gpu_model.h"
#include "tests/support/samples.h"
#include "tests/unit/render/gl_fixture.h"
#include "tests/unit/render/scenes.h"

namespace elbowroom::test {
namespace {

class SkinningTest : public GlTest {
 protected:
  // Greatest distance of the GPU's vertices from deform()'s, over all triangles' corners.
  double deviation(const World& world, double t) {
    std::vector<ActorState> states;
    world_state_at(world, t, states);
    Frame frame;
    frame.world = &world;
    frame.states = &states;
    const Camera camera = framed({}, bounds_over(world, {t}), 1.0);
    renderer().pick_all(frame, camera, {32, 32});
    double worst = 0;
    std::vector<Vec3> expected;
    for (std::size_t a = 0; a < world.actors.size(); ++a) {
      const Model& model = *world.actors[a].model;
      for (std::size_t m = 0; m < model.meshes.size(); ++m) {
        const Mesh& mesh = model.meshes[m];
        deform(model, mesh, states[a].pose, states[a].world_from_joint, expected);
        const auto found = renderer().read_positions(static_cast<int>(a), static_cast<int>(m));
        if (found.size() != expected.size()) return std::numeric_limits<double>::infinity();
        for (const auto& triangle : mesh.triangles) {
          for (int k = 0; k < 3; ++k) {
            const double d = glm::length(found[triangle[k]] - expected[triangle[k]]);
            if (!(d <= worst)) worst = d;
          }
        }
      }
    }
    return worst;
  }
};

TEST_F(SkinningTest, AnyNumberOfInfluences) {
  for (const int influences : {1, 2, 4, 5, 8, 12}) {
    auto model = bending_character(12, influences);
    World world;
    world.actors.push_back(actor_of(model));
    world.actors[0].clip = bending_clip(*model, 2.0);
    EXPECT_LT(deviation(world, 0.8), 2e-6) << influences;
  }
}

TEST_F(SkinningTest, MirroredScaledAndFarAway) {
  auto model = bending_character(4, 3);
  World world;
  const Mat4 places[] = {glm::scale(Mat4(1.0), Vec3(-1, 1, 1)),
                         glm::scale(Mat4(1.0), Vec3(0.01, 0.02, 0.005)),
                         glm::translate(Mat4(1.0), Vec3(3e6, -1e6, 2e6))};
  const double tolerances[] = {2e-6, 1e-7, 2e-6};
  for (int i = 0; i < 3; ++i) {
    world.actors = {actor_of(model, places[i])};
    world.actors[0].clip = bending_clip(*model, 1.0);
    EXPECT_LT(deviation(world, 0.6), tolerances[i]) << i;
  }
}

TEST_F(SkinningTest, MorphTargetsBeforeSkinning) {
  auto model = bending_character(4, 3);
  Mesh& mesh = model->meshes[0];
  for (int target = 0; target < 3; ++target) {
    MorphTarget morph;
    if (target != 1) {  // the second target moves no position
      for (const auto& p : mesh.positions) {
        morph.offsets.push_back(0.1f * glm::vec3(std::sin(7 * p.y), p.x, target));
      }
    }
    mesh.morphs.push_back(morph);
  }
  mesh.morph_weights = {0.3, 0.5, 0.0};
  World world;
  world.actors.push_back(actor_of(model));
  world.actors[0].clip = bending_clip(*model, 1.0);
  EXPECT_LT(deviation(world, 0.5), 2e-6);
  auto clip = std::make_shared<Clip>(*world.actors[0].clip);
  Channel channel;
  channel.joint = mesh.node;
  channel.path = Path::weights;
  channel.components = 3;
  channel.times = {0, 1};
  channel.values = {0, 0, 0, 0.5f, 1, -2};
  clip->channels.push_back(channel);
  world.actors[0].clip = clip;
  EXPECT_LT(deviation(world, 0.7), 2e-6);
}

TEST_F(SkinningTest, TheSilhouetteHoldsTheProjectedVertices) {
  auto model = bending_character(6, 5);
  World world;
  world.actors.push_back(actor_of(model));
  world.actors[0].clip = bending_clip(*model, 1.7);
  std::vector<ActorState> states;
  world_state_at(world, 1, states);
  Frame frame;
  frame.world = &world;
  frame.states = &states;
  Camera camera = with_preset({}, ViewPreset::three_quarter);
  std::vector<Vec3> points;
  body_points(world.actors[0], states[0], {0}, 0, points);
  camera = framed(camera, points, 1.0, 0.1);
  const int side = 256;
  const auto picks = renderer().pick_all(frame, camera, {side, side});
  // Every projected vertex lies on the figure or within a pixel of it...
  int outside = 0;
  double left = 1, right = 0, top = 1, bottom = 0;
  for (const auto& p : points) {
    const Vec3 at = project(camera, 1.0, p);
    left = std::min(left, at.x), right = std::max(right, at.x);
    top = std::min(top, at.y), bottom = std::max(bottom, at.y);
    bool near = false;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = static_cast<int>(at.x * side) + dx, y = static_cast<int>(at.y * side) + dy;
        if (x < 0 || y < 0 || x >= side || y >= side) continue;
        near = near || picks[static_cast<std::size_t>(y * side + x)].hit();
      }
    }
    if (!near) ++outside;
  }
  EXPECT_EQ(outside, 0);
  // ... and the figure reaches no further than they do.
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (!picks[static_cast<std::size_t>(y * side + x)].hit()) continue;
      EXPECT_GE(x + 1.0, left * side);
      EXPECT_LE(x, right * side);
      EXPECT_GE(y + 1.0, top * side);
      EXPECT_LE(y, bottom * side);
    }
  }
}

TEST_F(SkinningTest, RealCharacters) {
  const auto samples = samples_dir();
  if (samples.empty()) GTEST_SKIP() << samples_missing();
  int tried = 0;
  for (const char* name :
       {"humanoids/khronos/CesiumMan.glb", "humanoids/khronos/RiggedFigure.glb",
        "humanoids/kaykit/Knight.glb", "humanoids/quaternius/RobotExpressive.glb",
        "humanoids/quaternius/Men_Worker.glb", "humanoids/vrm/Godette_vrm_v4.vrm"}) {
    if (!std::filesystem::exists(samples / name)) continue;
    const auto model = read_gltf(samples / name);
    ASSERT_TRUE(model.ok()) << model.error().message();
    World world;
    world.actors.push_back(actor_of(*model));
    double t = 0;
    if (!(*model)->clips.empty()) {
      const Clip& clip = (*model)->clips.back();
      world.actors[0].clip = std::make_shared<Clip>(clip);
      t = clip.begin + 0.37 * clip.duration();
    }
    EXPECT_LT(deviation(world, t), 3e-6 * scene_size(world)) << name;
    const Camera camera =
        framed(with_preset({}, ViewPreset::three_quarter), bounds_over(world, {t}), 4.0 / 3.0);
    const Picture picture = draw(world, t, camera);
    const Picture empty = draw(Frame{}, camera);
    EXPECT_GT(difference(picture, empty), 4.0) << name << " gives an empty picture";
    ++tried;
  }
  EXPECT_GT(tried, 0);
}

}  // namespace
}  // namespace elbowroom::test
