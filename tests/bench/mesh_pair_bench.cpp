// SPDX-License-Identifier: MIT
// in_contact() beside FCL on the same triangles and placements, in the same run: a limb of 5,000
// triangles about a body of 30,000 (and of a million), free and colliding. One thread.
//
//   elbowroom_bench_mesh_pair [placements] [--quick]
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <vector>

#include "core/base/random.h"
#include "core/collision/mesh_pair.h"
#include "tests/support/shapes.h"

namespace elbowroom::test {
namespace {

template <typename Box>
std::shared_ptr<fcl::BVHModel<Box>> fcl_model(const Shape& shape) {
  using S = typename Box::S;
  auto model = std::make_shared<fcl::BVHModel<Box>>();
  std::vector<fcl::Vector3<S>> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const auto& p : shape.positions) {
    vertices.emplace_back(static_cast<S>(p.x), static_cast<S>(p.y), static_cast<S>(p.z));
  }
  for (const auto& t : shape.triangles) triangles.emplace_back(t.x, t.y, t.z);
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

template <typename Box>
bool fcl_collides(const fcl::BVHModel<Box>& a, const fcl::BVHModel<Box>& b,
                  const RigidTransform& t) {
  using S = typename Box::S;
  fcl::Transform3<S> pose = fcl::Transform3<S>::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.linear()(i, j) = static_cast<S>(t.rotation[j][i]);
    pose.translation()[i] = static_cast<S>(t.translation[i]);
  }
  fcl::CollisionRequest<S> request;
  fcl::CollisionResult<S> result;
  return fcl::collide<S>(&a, fcl::Transform3<S>::Identity(), &b, pose, request, result) > 0;
}

double thread_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Microseconds of this thread's computing a placement; the best of several rounds, since whatever
// else the machine does only ever adds.
template <typename Check>
double time_of(const std::vector<RigidTransform>& placements, int rounds, const Check& check) {
  double best = 1e30;
  long sum = 0;
  for (int r = 0; r < rounds; ++r) {
    const double begin = thread_seconds();
    for (const auto& t : placements) sum += check(t);
    best =
        std::min(best, 1e6 * (thread_seconds() - begin) / static_cast<double>(placements.size()));
  }
  if (sum < 0) std::abort();
  return best;
}

void run(const char* name, const Shape& limb, const Shape& body, int count, bool with_fcl) {
  auto a = CollisionMesh::build(body.positions, body.triangles);
  auto b = CollisionMesh::build(limb.positions, limb.triangles);
  if (!a.ok() || !b.ok()) std::abort();
  // The limb about the body as an arm about its trunk. Free placements by how near they are: those
  // farther away than 5 cm are settled by a few boxes, by anyone.
  Random random(1);
  const auto wanted = static_cast<std::size_t>(count);
  std::vector<RigidTransform> lists[3];  // near, far, colliding
  while (lists[0].size() < wanted || lists[1].size() < wanted || lists[2].size() < wanted) {
    const RigidTransform t{
        glm::mat3_cast(quat_from_rotation_vector(
            {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)})),
        {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.6, 0.6)}};
    auto& list = lists[in_contact(*a, *b, t, 0) ? 2 : in_contact(*a, *b, t, 0.05) ? 0 : 1];
    if (list.size() < wanted) list.push_back(t);
  }
  std::printf("%s: body %zu triangles, limb %zu, %d placements each\n", name, body.triangles.size(),
              limb.triangles.size(), count);
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSS<double>>> da, db;
  std::shared_ptr<fcl::BVHModel<fcl::OBB<float>>> fa, fb;
  if (with_fcl) {
    da = fcl_model<fcl::OBBRSS<double>>(body);
    db = fcl_model<fcl::OBBRSS<double>>(limb);
    fa = fcl_model<fcl::OBB<float>>(body);
    fb = fcl_model<fcl::OBB<float>>(limb);
  }
  const char* const names[3] = {"free <5cm", "free >5cm", "colliding"};
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const auto& placements = lists[kind];
    const int rounds = 7;
    const double ours =
        time_of(placements, rounds, [&](const auto& t) { return in_contact(*a, *b, t, 0); });
    const double clear =
        time_of(placements, rounds, [&](const auto& t) { return in_contact(*a, *b, t, 0.005); });
    PairCache cache;
    const double cached = time_of(
        placements, rounds, [&](const auto& t) { return in_contact(*a, *b, t, 0, {}, &cache); });
    const double distance = time_of(
        placements, 3, [&](const auto& t) { return surface_distance(*a, *b, t, 0.1) > 0.05; });
    std::printf(
        "  %-9s ours %.2f us, with 5 mm clearance %.2f, with cache %.2f; distance %.1f us\n",
        names[kind], ours, clear, cached, distance);
    if (!with_fcl) continue;
    const double obbrss =
        time_of(placements, rounds, [&](const auto& t) { return fcl_collides(*da, *db, t); });
    const double obb =
        time_of(placements, rounds, [&](const auto& t) { return fcl_collides(*fa, *fb, t); });
    std::printf("            FCL OBBRSS<double> %.2f us (%.1fx), FCL OBB<float> %.2f us (%.1fx)\n",
                obbrss, obbrss / ours, obb, obb / ours);
  }
}

}  // namespace
}  // namespace elbowroom::test

int main(int argc, char** argv) {
  using namespace elbowroom;
  using namespace elbowroom::test;
  int count = 2000;
  bool quick = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) {
      quick = true;
    } else {
      count = std::max(1, std::atoi(argv[i]));
    }
  }
  Random random(7);
  const Shape limb = limb_shape(0.05f, 0.3f, 80, 32, random);
  const Shape body = limb_shape(0.2f, 0.45f, 151, 100, random);
  run("trunk", limb, body, count, true);
  Shape posts;  // a scene of separate things
  for (int i = 0; i < 60; ++i) {
    append(
        posts, limb_shape(0.02f, 0.3f, 16, 16, random),
        glm::vec3(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)));
  }
  run("posts", limb, posts, count, true);
  if (!quick) run("million", limb, limb_shape(0.2f, 0.45f, 1001, 500, random), count, false);
  return 0;
}
