// SPDX-License-Identifier: MIT
// Travel bounds of a scene's bodies held against vertices that are posed and skinned anew at random
// times, by deform().
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "core/base/random.h"
#include "core/collision/scene_collision_data.h"
#include "core/collision/world_steps.h"

namespace elbowroom::test {

// Seen travel over bound: of every vertex, and of each body's farthest triangle.
struct Tightness {
  std::vector<double> of_vertices, of_most;
  static double middle(std::vector<double> v) {
    if (v.empty()) return 0;
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
  }
  double median() const { return middle(of_vertices); }
  double median_of_most() const { return middle(of_most); }
};

// Places of all triangles' corners of a body at time t, in the rigid frame of the reference.
inline std::vector<Vec3> corners_at(const SceneCollision::Data& data, const CollisionBody& body,
                                    const NodeReference& from,
                                    const std::vector<ActorState>& states) {
  RigidTransform frame;
  if (from.actor >= 0)
    frame = inverse(rigid_frame(states[static_cast<std::size_t>(from.actor)]
                                    .world_from_joint[static_cast<std::size_t>(from.node)]));
  const ActorState& state = states[static_cast<std::size_t>(body.actor())];
  const Model& model = *data.world.actors[static_cast<std::size_t>(body.actor())].model;
  std::vector<Vec3> places, corners;
  int deformed = -1;
  for (const BodyTriangle& t : body.triangles()) {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(t.mesh)];
    if (t.mesh != deformed) deform(model, mesh, state.pose, state.world_from_joint, places);
    deformed = t.mesh;
    for (int k = 0; k < 3; ++k) corners.push_back(frame * places[mesh.triangles[t.triangle][k]]);
  }
  return corners;
}

inline void expect_travel_is_bounded(SceneCollision& scene, const NodeReference& from, double begin,
                                     double end, int intervals, Random& random, Tightness& tight) {
  SceneCollision::Data& data = scene.data();
  MotionBound bound(data.world);
  const std::vector<double> steps = world_steps(data.world, begin, end);
  std::vector<ActorState> states;
  for (int i = 0; i < intervals; ++i) {
    const double length = (end - begin) * 0.3 * random.uniform() * random.uniform();
    double a = random.uniform(begin, end - length), b = a + length;
    for (const double step : steps)
      if (step > a && step <= b) b = just_before(step);
    const double middle = 0.5 * (a + b);
    data.pose(middle);
    bound.set(data.world, a, b, middle, data.states);
    std::vector<std::vector<Vec3>> at_middle;
    std::vector<std::vector<float>> allowed;
    std::vector<double> most_seen(data.bodies.size(), 0.0), most_allowed;
    for (const CollisionBody& body : data.bodies) {
      const ActorState& state = data.states[static_cast<std::size_t>(body.actor())];
      std::vector<PointTravel> by_node;
      bound.travel(body.actor(), from, by_node);
      at_middle.push_back(corners_at(data, body, from, data.states));
      allowed.emplace_back();
      body.triangle_travel(state, bound, by_node, allowed.back());
      most_allowed.push_back(body.most_travel(state, bound, by_node));
    }
    std::vector<std::vector<double>> seen(data.bodies.size());
    for (std::size_t n = 0; n < data.bodies.size(); ++n) seen[n].assign(at_middle[n].size(), 0.0);
    for (int s = 0; s < 6; ++s) {
      const double t = s == 0 ? a : s == 1 ? b : random.uniform(a, b);
      world_state_at(data.world, t, states);
      for (std::size_t n = 0; n < data.bodies.size(); ++n) {
        const auto now = corners_at(data, data.bodies[n], from, states);
        for (std::size_t c = 0; c < now.size(); ++c)
          seen[n][c] = std::max(seen[n][c], glm::distance(now[c], at_middle[n][c]));
      }
    }
    for (std::size_t n = 0; n < data.bodies.size(); ++n) {
      long beyond = 0;
      double most_of_bound = 0;
      for (std::size_t c = 0; c < seen[n].size(); ++c) {
        const double limit = static_cast<double>(allowed[n][c / 3]);
        if (!(seen[n][c] <= limit + 1e-8 * data.height)) ++beyond;
        EXPECT_LE(limit, most_allowed[n] * (1 + 1e-6));
        most_seen[n] = std::max(most_seen[n], seen[n][c]);
        most_of_bound = std::max(most_of_bound, limit);
        if (limit > 1e-4 * data.height) tight.of_vertices.push_back(seen[n][c] / limit);
      }
      if (most_of_bound > 1e-4 * data.height) tight.of_most.push_back(most_seen[n] / most_of_bound);
      EXPECT_EQ(beyond, 0) << "body " << n << " of [" << a << ", " << b << "]";
    }
  }
}

}  // namespace elbowroom::test
