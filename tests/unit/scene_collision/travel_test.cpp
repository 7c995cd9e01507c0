// SPDX-License-Identifier: MIT
// How far bodies are said to get, at most, against where a player puts their vertices.
#include <gtest/gtest.h>

#include "tests/support/figure_travel.h"
#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

Channel channel_of(int joint, Path path, Interpolation interpolation, double size, Random& random) {
  Channel channel;
  channel.joint = joint;
  channel.path = path;
  channel.interpolation = interpolation;
  channel.components = path == Path::rotation ? 4 : 3;
  Quat turn(1, 0, 0, 0);
  for (double t = random.uniform(-0.1, 0); t < 1.1; t += random.uniform(0.02, 0.06)) {
    channel.times.push_back(static_cast<float>(t));
    const auto any = [&] { return random.uniform(-size, size); };
    turn = turn * quat_from_rotation_vector({any(), any(), any()});
    const double rotation[4] = {turn.x, turn.y, turn.z, turn.w};
    const double base = path == Path::scale ? 1.0 : 0.0;
    const bool cubic = interpolation == Interpolation::cubic_spline;
    const double even = any();
    for (int part = cubic ? 0 : 1; part < (cubic ? 3 : 2); ++part)
      for (int c = 0; c < channel.components; ++c)
        channel.values.push_back(static_cast<float>(part != 1 ? 3 * any()
                                                    : path == Path::rotation
                                                        ? rotation[c]
                                                        : base + (c == 0 ? even : any())));
  }
  return channel;
}

enum class Scales { none, by_axis };

// A figure that walks and waves wildly, a sword in its hand, a thing that its hand carries and that
// moves by itself, and a ball that flies by.
World wild_world(Scales scales, double placement, Random& random) {
  FigureOptions options;
  options.sword = true;
  const auto figure = make_figure(options);
  // Two morph targets that are played, on skin and on the rigid sword.
  auto clip = std::make_shared<Clip>();
  for (Mesh& mesh : figure->meshes) {
    for (int target = 0; target < 2; ++target) {
      MorphTarget morph;
      for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        morph.offsets.emplace_back(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 0);
      mesh.morphs.push_back(morph);
    }
    mesh.morph_weights = {0.2, 0.4};
    Channel weights = channel_of(mesh.node, Path::weights, Interpolation::linear, 0.5, random);
    weights.components = 2;
    weights.values.resize(2 * weights.times.size());
    clip->channels.push_back(weights);
  }
  clip->begin = 0;
  clip->end = 1;
  for (int joint = 0; joint < figure->skeleton.size(); ++joint)
    clip->channels.push_back(channel_of(
        joint, Path::rotation,
        random.below(2) ? Interpolation::linear : Interpolation::cubic_spline, 0.1, random));
  clip->channels.push_back(
      channel_of(kHips, Path::translation, Interpolation::linear, 0.3, random));
  clip->channels.push_back(
      channel_of(kFore, Path::translation, Interpolation::cubic_spline, 0.02, random));
  if (scales == Scales::by_axis)
    clip->channels.push_back(channel_of(kHand, Path::scale, Interpolation::linear, 0.2, random));
  const auto moving = [&](const char* name, const Vec3& at) {
    auto model = make_object(name, sphere_shape(0.1f, 6, 8));
    model->objects.front().animated = true;
    Actor thing = actor(std::string(name) + ".glb", model, at);
    auto own = std::make_shared<Clip>();
    own->channels.push_back(channel_of(0, Path::rotation, Interpolation::linear, 0.2, random));
    own->channels.push_back(
        channel_of(0, Path::translation, Interpolation::cubic_spline, 0.2, random));
    thing.clip = own;
    return thing;
  };
  Actor carried = moving("Thing", Vec3(0.0));
  carried.attachment = Attachment{0, kHand, {}, -1, 2};
  carried.attachment->joint_from_object.translation = Vec3(0.1, 0.05, 0);
  carried.attachment->joint_from_object.scale = Vec3(1.5);
  World world = world_of(figure, clip, {moving("Ball", Vec3(0.5, 1.2, 0.4)), carried});
  world.actors[0].world_from_file = glm::translate(Mat4(1.0), Vec3(3, 0, -2)) *
                                    glm::mat4_cast(quat_from_rotation_vector({0.3, 1, 0.2})) *
                                    glm::scale(Mat4(1.0), Vec3(placement));
  return world;
}

void look(Scales scales, double placement, double least_median) {
  Random random(17);
  Tightness world_frame, own_frame;
  for (int i = 0; i < 12; ++i) {
    const World world = wild_world(scales, placement, random);
    SceneCollision scene = scene_of(world, 0, 0);  // what may touch is of no matter here
    expect_travel_is_bounded(scene, {}, 0, 1, 10, random, world_frame);
    for (const int node : {kHips, kUpper, kFore})
      expect_travel_is_bounded(scene, {0, node}, 0, 1, 4, random, own_frame);
  }
  std::printf(
      "  travel / bound of bodies: median %.3f in the world, %.3f in a joint's frame; of "
      "the farthest triangle %.3f, %.3f\n",
      world_frame.median(), own_frame.median(), world_frame.median_of_most(),
      own_frame.median_of_most());
  EXPECT_GT(world_frame.median(), least_median);
}

TEST(Travel, OfBodiesIsBounded) { look(Scales::none, 1.0, 0.3); }
TEST(Travel, OfBodiesInOtherUnitsIsBounded) { look(Scales::none, 0.01, 0.3); }
TEST(Travel, UnderAScaleByAxisIsBounded) { look(Scales::by_axis, 1.0, 0.1); }

}  // namespace
}  // namespace elbowroom::test
