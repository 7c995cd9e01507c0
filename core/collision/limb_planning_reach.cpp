// SPDX-License-Identifier: MIT
// What the limb's side can meet at a time, and the spheres that settle most pairs of parts: some
// two hundred of a configuration, eight at a time.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "core/collision/limb_motion.h"
#include "core/collision/limb_planning_data.h"
#include "core/collision/mesh_data.h"

namespace elbowroom {

// Which parts of the world the limb's side can meet in a cell, whatever its DOFs.
void LimbPlanningSpace::Data::find_reachable(const FrameTracks::Cell& cell) {
  reach_known[cell.row] = 1;
  const Segment& segment = segments[static_cast<std::size_t>(cell.segment)];
  double reach = 0, largest = 0;
  Vec3 root[2];
  for (int end = 0; end < 2; ++end) {
    const std::uint32_t row = cell.row + static_cast<std::uint32_t>(end);
    const Mat4& parent = tracks->parent(row);
    root[end] = Vec3(parent * glm::dvec4(tracks->local(row, 0).translation, 1.0));
    // No node is farther from the root than the bones on the way are long.
    std::vector<double> stretch(chain.nodes.size()), from_root(chain.nodes.size(), 0.0);
    const auto longest = [](const Mat3& m) {
      return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
    };
    // Column lengths bound a rotation with scale; the Frobenius norm bounds anything.
    const auto bound = [&](const Mat3& m) {
      const double x = glm::dot(m[0], m[0]), y = glm::dot(m[1], m[1]), z = glm::dot(m[2], m[2]);
      const double tiny = 1e-9 * (x + y + z);
      const bool plain = std::abs(x - y) <= tiny && std::abs(x - z) <= tiny;
      return plain ? std::sqrt(x) * (1 + 1e-6) : longest(m);
    };
    for (std::size_t n = 0; n < chain.nodes.size(); ++n) {
      const Transform& local = tracks->local(row, n);
      const int up = chain.nodes[n].parent;
      const double above = up < 0 ? bound(Mat3(parent)) : stretch[static_cast<std::size_t>(up)];
      const double size =
          std::max({std::abs(local.scale.x), std::abs(local.scale.y), std::abs(local.scale.z)});
      stretch[n] = above * size;
      if (up >= 0)
        from_root[n] =
            from_root[static_cast<std::size_t>(up)] + above * glm::length(local.translation);
    }
    for (const int p : segment.moving) {
      const PlanningPart& piece = pieces[static_cast<std::size_t>(p)];
      const int node = segment.chain_of[static_cast<std::size_t>(p)];
      const Vec3 centre = segment.chain_from_part[static_cast<std::size_t>(p)] * piece.centre;
      reach = std::max(
          reach, from_root[static_cast<std::size_t>(node)] + glm::length(centre) + piece.radius);
    }
  }
  for (const PairState& state : pair_states) largest = std::max(largest, state.distance);
  const Vec3 middle = 0.5 * (root[0] + root[1]);
  const double drift = 0.5 * glm::distance(root[0], root[1]);
  Reach& near_by = reachable[cell.row];
  near_by = {};
  near_by.origin = middle;
  for (std::size_t s = 0; s < segment.still.size(); ++s) {
    const auto p = static_cast<std::size_t>(segment.still[s]);
    const Vec3 at = pieces[p].node_from_part * pieces[p].centre;
    const NodeFrame &f0 = tracks->frame(cell.row, track_of[p]),
                    &f1 = tracks->frame(cell.row + 1, track_of[p]);
    const Vec3 turned[2] = {f0.rotation * at, f1.rotation * at};
    const Vec3 ends[2] = {f0.place + turned[0], f1.place + turned[1]};
    // Turning between two rows leaves the chord by at most the chord's length.
    const double leaves = glm::distance(turned[0], turned[1]);
    const double moves = 0.5 * glm::distance(ends[0], ends[1]);
    const double radius = pieces[p].radius + leaves + largest;
    if (glm::distance(0.5 * (ends[0] + ends[1]), middle) > reach + drift + radius + moves) continue;
    near_by.still.push_back(static_cast<std::uint32_t>(s));
    const glm::vec3 from(ends[0] - middle), way(ends[1] - ends[0]);
    near_by.x.push_back(from.x);
    near_by.y.push_back(from.y);
    near_by.z.push_back(from.z);
    near_by.dx.push_back(way.x);
    near_by.dy.push_back(way.y);
    near_by.dz.push_back(way.z);
    near_by.radius.push_back(static_cast<float>(radius));
    for (int k = 0; k < 3; ++k)
      near_by.largest = std::max(near_by.largest, std::abs(from[k]) + std::abs(way[k]));
  }
  near_by.list = reach_lists.try_emplace(near_by.still, reach_lists.size()).first->second;
  while (near_by.x.size() % kSpheres != 0) {
    near_by.x.push_back(1e30f);
    for (auto* list :
         {&near_by.y, &near_by.z, &near_by.dx, &near_by.dy, &near_by.dz, &near_by.radius})
      list->push_back(0.0f);
  }
}

void LimbPlanningSpace::Data::place_spheres(const FrameTracks::Cell& cell, const Segment& segment) {
  const Reach& near_by = reachable[cell.row];
  const std::size_t count = near_by.x.size();
  sphere_x.resize(count);
  sphere_y.resize(count);
  sphere_z.resize(count);
  sphere_near.resize(count);
  for (std::size_t i = 0; i < segment.moving.size(); ++i) {
    const auto p = static_cast<std::size_t>(segment.moving[i]);
    moving_centre[p] =
        links[static_cast<std::size_t>(segment.chain_of[p])].frame * segment.centre[i];
  }
  const auto u = static_cast<float>(cell.u);
  for (std::size_t s = 0; s < count; ++s) {
    sphere_x[s] = near_by.x[s] + u * near_by.dx[s];
    sphere_y[s] = near_by.y[s] + u * near_by.dy[s];
    sphere_z[s] = near_by.z[s] + u * near_by.dz[s];
  }
}

float LimbPlanningSpace::Data::find_near(const FrameTracks::Cell& cell, int part,
                                         const float* more) {
  const Reach& near_by = reachable[cell.row];
  const auto p = static_cast<std::size_t>(part);
  const glm::vec3 c(moving_centre[p] - near_by.origin);
  // Coordinates and their differences round a dozen times by 2^-24 of their size; squares of
  // distances and their comparison by a few more of theirs.
  const float size = near_by.largest + std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  const float slack = 4e-6f * size;
  const float own = static_cast<float>(pieces[p].radius) * (1 + 2e-6f) + slack;
  const auto look = [&](auto&& extra) {
    for (std::size_t s = 0; s < near_by.x.size(); ++s) {
      const float x = sphere_x[s] - c.x, y = sphere_y[s] - c.y, z = sphere_z[s] - c.z;
      const float sum = near_by.radius[s] * (1 + 2e-6f) + own + extra(s);
      // What is no number is near.
      sphere_near[s] = !(x * x + y * y + z * z > sum * sum);
    }
  };
  if (more)
    look([more](std::size_t s) { return more[s] * (1 + 2e-6f); });
  else
    look([](std::size_t) { return 0.0f; });
  return slack;
}

bool LimbPlanningSpace::Data::clear_of_still(const FrameTracks::Cell& cell,
                                             const Segment& segment) {
  const Reach& near_by = reachable[cell.row];
  place_spheres(cell, segment);
  for (std::size_t i = 0; i < segment.moving.size(); ++i) {
    const PlanningPart& piece = pieces[static_cast<std::size_t>(segment.moving[i])];
    const float slack = find_near(cell, segment.moving[i], nullptr);
    const auto& with = segment.pair_with[i];
    for (std::size_t s = 0; s < near_by.still.size(); ++s) {
      if (!sphere_near[s]) continue;
      const int pair = with[near_by.still[s]];
      if (pair < 0) continue;
      // The part's box, and what fills it: large bulky things (an umbrella) fill little of theirs.
      const RigidTransform& placed_part = place(cell, segment, segment.moving[i]);
      const Vec3 apart =
          Vec3(sphere_x[s], sphere_y[s], sphere_z[s]) - (placed_part.translation - near_by.origin);
      const Vec3 centre = apart * placed_part.rotation;
      const double radius = static_cast<double>(near_by.radius[s] * (1 + 2e-6f) + slack);
      double out2 = 0;
      for (int k = 0; k < 3; ++k) {
        const double out = std::abs(centre[k] - piece.centre[k]) - piece.half[k];
        if (out > 0) out2 += out * out;
      }
      if (out2 > radius * radius || !piece.mesh->data().sphere_may_meet(centre, radius)) continue;
      if (touches(pair, cell, segment)) return false;
    }
  }
  return true;
}

bool LimbPlanningSpace::Data::clear_of_itself(const FrameTracks::Cell& cell,
                                              const Segment& segment) {
  for (const int number : segment.inner_pairs) {
    const auto k = static_cast<std::size_t>(number);
    const auto a = static_cast<std::size_t>(pairs[k].a), b = static_cast<std::size_t>(pairs[k].b);
    const Vec3 apart = moving_centre[a] - moving_centre[b];
    const double sum = pieces[a].radius + pieces[b].radius + pair_states[k].distance;
    if (glm::dot(apart, apart) > sum * sum) continue;
    if (touches(number, cell, segment)) return false;
  }
  return true;
}

void LimbPlanningSpace::Data::find_reached(const FrameTracks::Cell& first, std::uint32_t last_row) {
  reached.clear();
  const Reach* before = nullptr;
  for (FrameTracks::Cell cell = first; cell.row <= last_row; ++cell.row) {
    if (!reach_known[cell.row]) find_reachable(cell);
    const Reach& here = reachable[cell.row];
    if (before && before->list == here.list) continue;
    before = &here;
    if (reached.empty()) {
      reached = here.still;
      continue;
    }
    const auto known = static_cast<std::ptrdiff_t>(reached.size());
    std::set_difference(here.still.begin(), here.still.end(), reached.begin(),
                        reached.begin() + known, std::back_inserter(reached_more));
    reached.insert(reached.end(), reached_more.begin(), reached_more.end());
    reached_more.clear();
    std::inplace_merge(reached.begin(), reached.begin() + known, reached.end());
  }
}

void LimbPlanningSpace::Data::open_near_pairs(const FrameTracks::Cell& cell,
                                              const Segment& segment) {
  const Reach& near_by = reachable[cell.row];
  const std::size_t count = near_by.x.size();
  open_pairs.clear();
  place_spheres(cell, segment);
  world_travel.assign(count, 0.0f);
  base_travel.assign(count, 0.0f);
  for (std::size_t s = 0; s < near_by.still.size(); ++s) {
    const LimbMotion::Travel travel = motion->still_travel(segment.still[near_by.still[s]]);
    world_travel[s] = static_cast<float>(travel.in_world);
    base_travel[s] = static_cast<float>(travel.in_base);
  }
  more_travel.resize(count);
  for (std::size_t i = 0; i < segment.moving.size(); ++i) {
    const LimbMotion::Travel travel = motion->moving_travel(segment.moving[i]);
    const auto in_world = static_cast<float>(travel.in_world),
               in_base = static_cast<float>(travel.in_base);
    for (std::size_t s = 0; s < count; ++s)
      more_travel[s] = std::min(in_world + world_travel[s], in_base + base_travel[s]);
    find_near(cell, segment.moving[i], more_travel.data());
    const auto& with = segment.pair_with[i];
    std::size_t s = 0;
    for (const std::uint32_t still : reached) {
      const bool here = s < near_by.still.size() && near_by.still[s] == still;
      // What cannot be met at this time may be at another one of the interval.
      if ((!here || sphere_near[s]) && with[still] >= 0) open_pairs.push_back(with[still]);
      s += here ? 1 : 0;
    }
  }
  open_pairs.insert(open_pairs.end(), segment.inner_pairs.begin(), segment.inner_pairs.end());
}

}  // namespace elbowroom
