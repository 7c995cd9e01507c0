// SPDX-License-Identifier: MIT
// Edges past thin things, still and moving: what is certified is free at a hundredth of the usual
// step before FCL; what is refused though free has little room; and what both cost beside FCL's
// check at the usual step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "core/base/random.h"
#include "core/planning/interpolation.h"
#include "tests/support/fcl_world/fcl_world.h"
#include "tests/unit/scene_collision/figure.h"

namespace elbowroom::test {
namespace {

constexpr double kStep = 0.032;          // rad, of the unsafe check
constexpr double kUsualStep = 1 / 60.0;  // s
constexpr int kFiner = 100;
constexpr std::array<double, 5> kClearances = {0.00025, 0.0005, 0.001, 0.002, 0.004};

using Clock = std::chrono::steady_clock;

double ns_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

Quat any_turn(Random& random) {
  return quat_from_rotation_vector(
      {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)});
}

// Plates 3 mm thick and wires 6 mm thick about the shoulder at (0.2, 1.4, 0), within reach.
Actor thin_thing(bool moves, Random& random) {
  const bool wire = random.below(2) == 0;
  const auto model =
      make_object(wire ? "Wire" : "Plate", wire ? tube_shape(0.003f, 0.25f, 12, 8, true)
                                                : box_shape({0.08f, 0.08f, 0.0015f}));
  model->objects.front().animated = moves;
  Vec3 at;
  do {
    at = Vec3(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8));
  } while (glm::length(at) < 0.25 || glm::length(at) > 0.85);
  Actor thing = actor(wire ? "wire.glb" : "plate.glb", model);
  const Quat turn = any_turn(random);
  thing.world_from_file = glm::translate(Mat4(1.0), Vec3(0.2, 1.4, 0) + at) * glm::mat4_cast(turn);
  if (!moves) return thing;
  auto clip = std::make_shared<Clip>();
  Channel place, rotation;
  place.joint = rotation.joint = 0;
  place.path = Path::translation;
  place.components = 3;
  place.interpolation = Interpolation::linear;
  Quat now(1, 0, 0, 0);
  for (int k = 0; k <= 10; ++k) {
    const auto t = static_cast<float>(0.1 * k);
    place.times.push_back(t);
    rotation.times.push_back(t);
    for (int c = 0; c < 3; ++c)
      place.values.push_back(static_cast<float>(random.uniform(-0.12, 0.12)));
    now = now * quat_from_rotation_vector(0.15 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1),
                                                      random.uniform(-1, 1)));
    for (const double v : {now.x, now.y, now.z, now.w})
      rotation.values.push_back(static_cast<float>(v));
  }
  clip->channels = {place, rotation};
  clip->begin = 0;
  clip->end = 1;
  thing.clip = clip;
  return thing;
}

World thin_world(bool moving, Random& random) {
  std::vector<Actor> things;
  for (int i = 0; i < 24; ++i) things.push_back(thin_thing(moving && i % 2 == 0, random));
  auto clip = std::make_shared<Clip>(*swing_clip({0, 1}, {-0.3, -0.8}));
  if (moving) {  // and the body walks and turns
    Channel walk;
    walk.joint = kHips;
    walk.path = Path::translation;
    walk.components = 3;
    walk.times = {0, 0.5f, 1};
    walk.values = {0, 1, -0.2f, 0.05f, 1.02f, 0, 0, 1, 0.2f};
    Channel turn;
    turn.joint = kHips;
    turn.times = {0, 1};
    const auto half = static_cast<float>(0.15);
    turn.values = {0, -std::sin(half), 0, std::cos(half), 0, std::sin(half), 0, std::cos(half)};
    clip->channels.push_back(walk);
    clip->channels.push_back(turn);
  }
  return world_of(make_figure(), clip, things);
}

LimbState state_at(const SceneCollision& scene, double t) {
  std::vector<ActorState> states;
  world_state_at(scene.world(), t, states);
  return limb_state(scene.limbs()[0], states[0].pose);
}

double length_of(const Configuration& a, const Configuration& b) {
  double square = 0;
  for (int i = 0; i < a.q.count; ++i) square += (b.q[i] - a.q[i]) * (b.q[i] - a.q[i]);
  return std::sqrt(square);
}

// Steps of an edge at a resolution `finer` times the usual one.
std::int64_t steps_of(const Configuration& a, const Configuration& b, double finer) {
  const double n = std::max(length_of(a, b) / kStep, (b.t - a.t) / kUsualStep) * finer;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(n)));
}

template <typename Free>
bool sampled_free(const Configuration& a, const Configuration& b, double finer, Free&& free) {
  const std::int64_t n = steps_of(a, b, finer);
  return visit_by_bisection(n, [&](std::int64_t k) {
    return free(interpolate(a, b, static_cast<double>(k) / static_cast<double>(n)));
  });
}

struct Edge {
  Configuration from, to;
};

struct Tally {
  long edges = 0, certified = 0, truly_free = 0, missed = 0, looks = 0;
  long fcl_passed = 0, fcl_missed = 0;         // of the unsafe check, and what of it collides
  std::array<long, 6> refused_by_clearance{};  // truly free ones, by the greatest that they keep
  std::array<long, 6> free_by_clearance{};
  double ns_certified = 0, ns_sampled = 0, ns_fcl_double = 0, ns_fcl_float = 0;
  double ns_once = 0, ns_certified_free = 0, ns_fcl_float_free = 0, ns_fcl_double_free = 0;
};

void look_at_world(bool moving, int edges, Random& random, Tally& tally) {
  SceneCollision scene = scene_of(thin_world(moving, random), 0, 0);
  const LimbState at_init = state_at(scene, 0), at_goal = state_at(scene, 1);
  const auto space_of = [&](double clearance) {
    return LimbPlanningSpace(scene, 0, 0, 1, at_init, at_goal, {clearance, 0.0, -1.0});
  };
  LimbPlanningSpace space = space_of(0);
  const auto judge = make_fcl_world(space, BoxKind::obbrss_double, AllowedPairs::left_out);
  const auto judge_float = make_fcl_world(space, BoxKind::obb_float, AllowedPairs::left_out);
  std::vector<std::unique_ptr<LimbPlanningSpace>> with_clearance;
  for (const double clearance : kClearances)
    with_clearance.push_back(std::make_unique<LimbPlanningSpace>(
        scene, 0, 0.0, 1.0, at_init, at_goal, LimbPlanningSpace::Settings{clearance, 0.0, -1.0}));

  // Most edges are to have something near them: what keeps 1 cm all the way is taken one time in
  // ten. (Of those that come within 3 cm of something that stands still, too few collide.)
  LimbPlanningSpace wide = space_of(0.01);
  std::vector<Edge> list;
  while (static_cast<int>(list.size()) < edges) {
    Edge edge;
    edge.from.q.count = 7;
    for (int i = 0; i < 7; ++i) edge.from.q[i] = random.uniform(-1.3, 1.3);
    edge.from.q[3] = random.uniform(0, 1.8);
    edge.from.t = random.uniform(0, 0.7);
    edge.to = edge.from;
    edge.to.t += random.uniform(0.03, 0.3);
    double direction[7], square = 0;
    for (double& d : direction) d = random.uniform(-1, 1), square += d * d;
    const double length = 0.8 * random.uniform();
    for (int i = 0; i < 7; ++i) edge.to.q[i] += length * direction[i] / std::sqrt(square);
    if (!space.valid(edge.from) || !space.valid(edge.to) || !judge->free(edge.from)) continue;
    const bool far =
        wide.valid(edge.from) && wide.valid(edge.to) &&
        sampled_free(edge.from, edge.to, 1, [&](const auto& c) { return wide.valid(c); });
    if (!far || random.below(10) == 0) list.push_back(edge);
  }

  // What is made once for a world and not for an edge: rows of the tracks, sums over them.
  std::int64_t looks = 0;
  auto start = Clock::now();
  space.certified_free({list.front().from.q, 0}, {list.front().to.q, 1}, looks);
  tally.ns_once += ns_since(start);
  std::vector<bool> certified;
  looks = 0;
  start = Clock::now();
  std::vector<double> ns;
  for (const Edge& edge : list) {
    const auto one = Clock::now();
    const auto free = space.certified_free(edge.from, edge.to, looks);
    ns.push_back(ns_since(one));
    ASSERT_TRUE(free.has_value());
    certified.push_back(*free);
  }
  tally.ns_certified += ns_since(start);
  tally.looks += looks;
  start = Clock::now();
  long sampled = 0;
  for (const Edge& edge : list)
    sampled += sampled_free(edge.from, edge.to, 1, [&](const auto& c) { return space.valid(c); });
  tally.ns_sampled += ns_since(start);
  std::vector<bool> passed;
  std::vector<double> ns_double, ns_float;
  start = Clock::now();
  for (const Edge& edge : list) {
    const auto one = Clock::now();
    passed.push_back(
        sampled_free(edge.from, edge.to, 1, [&](const auto& c) { return judge->free(c); }));
    ns_double.push_back(ns_since(one));
  }
  tally.ns_fcl_double += ns_since(start);
  start = Clock::now();
  for (const Edge& edge : list) {
    const auto one = Clock::now();
    sampled_free(edge.from, edge.to, 1, [&](const auto& c) { return judge_float->free(c); });
    ns_float.push_back(ns_since(one));
  }
  tally.ns_fcl_float += ns_since(start);

  for (std::size_t i = 0; i < list.size(); ++i) {
    const Edge& edge = list[i];
    ++tally.edges;
    // What FCL found to collide already needs no closer look.
    const bool free = passed[i] && sampled_free(edge.from, edge.to, kFiner,
                                                [&](const auto& c) { return judge->free(c); });
    if (passed[i]) ++tally.fcl_passed;
    if (passed[i] && !free) ++tally.fcl_missed;
    if (certified[i]) ++tally.certified;
    if (certified[i] && !free) ++tally.missed;
    if (!free) continue;
    ++tally.truly_free;
    tally.ns_certified_free += ns[i];
    tally.ns_fcl_double_free += ns_double[i];
    tally.ns_fcl_float_free += ns_float[i];
    std::size_t keeps = 0;
    for (; keeps < kClearances.size(); ++keeps) {
      LimbPlanningSpace& wider = *with_clearance[keeps];
      const auto valid = [&](const auto& c) { return wider.valid(c); };
      // Of what was refused as closely as the judge looks: between coarser samples a thing that
      // moves comes nearer than at any of them.
      if (!valid(edge.from) || !valid(edge.to) ||
          !sampled_free(edge.from, edge.to, certified[i] ? 4 : kFiner, valid))
        break;
    }
    ++tally.free_by_clearance[keeps];
    if (!certified[i]) ++tally.refused_by_clearance[keeps];
  }
}

// As many as the tier looks at, or as the environment says.
int edges_asked() {
  const char* asked = std::getenv("ELBOWROOM_SEGMENTS");
  const int number = asked ? std::atoi(asked) : ELBOWROOM_SEGMENTS;
  return std::max(40, number);
}

void look(bool moving) {
  Random random(moving ? 77 : 33);
  Tally tally;
  const int worlds = 10;
  for (int w = 0; w < worlds; ++w) look_at_world(moving, edges_asked() / 2 / worlds, random, tally);
  const auto n = static_cast<double>(tally.edges), free = static_cast<double>(tally.truly_free);
  std::printf("  %s: %ld edges, %ld free, %ld certified, %ld of them collide; %.1f looks each\n",
              moving ? "moving" : "still", tally.edges, tally.truly_free, tally.certified,
              tally.missed, static_cast<double>(tally.looks) / n);
  std::printf("  FCL at %.3f rad passes %ld, %ld of them collide\n", kStep, tally.fcl_passed,
              tally.fcl_missed);
  std::printf("  us an edge            all    free\n");
  std::printf("  once a world       %7.0f\n", tally.ns_once / 1e3 / worlds);
  const auto row = [&](const char* name, double ns, double ns_free) {
    std::printf("  %-18s %7.2f %7.2f   of ours %.2f, %.2f\n", name, ns / n / 1e3,
                ns_free / free / 1e3, ns / tally.ns_certified, ns_free / tally.ns_certified_free);
  };
  row("certified", tally.ns_certified, tally.ns_certified_free);
  row("FCL OBBRSS double", tally.ns_fcl_double, tally.ns_fcl_double_free);
  row("FCL OBB float", tally.ns_fcl_float, tally.ns_fcl_float_free);
  row("valid() sampled", tally.ns_sampled, 0);
  std::printf("  free edges by the clearance they keep, and refused of them:\n");
  const char* names[] = {"< 0.25 mm", "< 0.5 mm", "< 1 mm", "< 2 mm", "< 4 mm", "more"};
  for (std::size_t k = 0; k < tally.free_by_clearance.size(); ++k)
    std::printf("  %-10s %6ld %6ld\n", names[k], tally.free_by_clearance[k],
                tally.refused_by_clearance[k]);
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.refused_by_clearance[4], 0);
  EXPECT_EQ(tally.refused_by_clearance[5], 0);
  // The problem is one: thin things are passed by the unsafe check, and there is much that is free.
  EXPECT_GT(tally.truly_free, tally.edges / 5);
  EXPECT_GT(tally.edges - tally.truly_free, tally.edges / 20);
  if (tally.edges >= 500) {
    EXPECT_GT(tally.fcl_missed, 0);
  }
}

TEST(CertifiedEdges, PastThinThingsThatStandStill) { look(false); }
TEST(CertifiedEdges, PastThinThingsThatMove) { look(true); }

}  // namespace
}  // namespace elbowroom::test
