// SPDX-License-Identifier: MIT
#include "core/collision/allowed_patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/collision/surface_patches.h"
#include "core/collision/triangle_predicates.h"

namespace elbowroom {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
// The part of a limb's cross-section about a joint that creases as it bends.
constexpr double kCrossSections = 1.25;

// Mean distance of the seam's points from their middle: the limb's radius where it is cut.
double seam_radius(const WeldedSurface& surface, const std::vector<std::uint32_t>& seam) {
  Vec3 middle(0.0);
  for (const std::uint32_t p : seam) middle += surface.points[p];
  middle /= static_cast<double>(seam.size());
  double sum = 0;
  for (const std::uint32_t p : seam) sum += glm::distance(surface.points[p], middle);
  return sum / static_cast<double>(seam.size());
}

// The same for a link that is no part of a common surface: mean distance from the bone of the
// vertices beside its first quarter.
double link_radius(const CollisionBody& child, const SharedJoint& joint) {
  const double length = glm::length(joint.bone);
  if (!(length > 0)) return 0;
  const Vec3 along = joint.bone / length;
  double sum = 0, count = 0;
  for (const glm::vec3& p : child.mesh().positions()) {
    const Vec3 from = child.query_from_body() * Vec3(p) - joint.place;
    const double on = glm::dot(from, along);
    if (on < -0.25 * length || on > 0.25 * length) continue;
    sum += glm::length(from - on * along);
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

// By patch, the distance from the joint; infinity where it is no side of it.
std::vector<double> patch_distances(const JoinedSurface& whole, std::size_t number,
                                    const CollisionBody& body, const std::vector<double>& along,
                                    const std::vector<bool>& joined_component,
                                    const SharedJoint& joint, bool is_parent, double radius) {
  const auto count = static_cast<std::size_t>(body.patch_count());
  std::vector<double> sum(count, 0.0), triangles(count, 0.0), nearest(count, kFar);
  for (std::uint32_t t = 0; t < body.triangles().size(); ++t) {
    const std::size_t patch = body.patch_of()[t];
    const glm::uvec3& corner = whole.surface.triangles[whole.first_triangle[number] + t];
    if (joined_component[static_cast<std::size_t>(whole.component[corner.x])]) {
      double mean = 0;
      for (int k = 0; k < 3; ++k) {
        const double d = std::min(along[corner[k]], 4.0 * radius);
        mean += d / 3.0;
        // What touches the seam touches the other side there in every pose.
        if (d == 0) nearest[patch] = 0;
      }
      sum[patch] += mean;
      triangles[patch] += 1;
      continue;
    }
    if (joint.joint < 0) continue;
    const int follows = body.triangles()[t].joint;
    if (is_parent &&
        std::find(joint.carriers.begin(), joint.carriers.end(), follows) == joint.carriers.end())
      continue;
    TrianglePoints points;
    for (int k = 0; k < 3; ++k)
      points[static_cast<std::size_t>(k)] = whole.surface.points[corner[k]];
    nearest[patch] =
        std::min(nearest[patch], glm::distance(joint.place, closest_point(joint.place, points)));
  }
  for (std::size_t p = 0; p < count; ++p)
    if (triangles[p] > 0) nearest[p] = std::min(nearest[p], sum[p] / triangles[p]);
  return nearest;
}

}  // namespace

AllowedPatches::AllowedPatches(int count_a, int count_b) : patches_a(count_a), patches_b(count_b) {
  const std::size_t n = static_cast<std::size_t>(count_a) * static_cast<std::size_t>(count_b);
  reasons.assign(n, 0);
  always.assign(n, false);
  any.assign(n, false);
}

void AllowedPatches::allow(int patch_a, int patch_b, std::uint8_t reason) {
  const std::size_t at = static_cast<std::size_t>(patch_a) * static_cast<std::size_t>(patches_b) +
                         static_cast<std::size_t>(patch_b);
  if ((reason & kClip) && !(reasons[at] & kClip))
    clip_pairs.push_back(static_cast<std::uint32_t>(at));
  reasons[at] |= reason;
  any[at] = true;
  if (reason & (kShared | kBind)) always[at] = true;
  regions_ = {};
}

void AllowedPatches::allow_touched(const CollisionBody& a, const CollisionBody& b,
                                   const std::vector<ClipTouching::Parts>& touched) {
  touching = ClipTouching(a, b, always, touched);
  for (const ClipTouching::Pieces& parts : touching.parts())
    for (const std::uint16_t p : parts.a)
      for (const std::uint16_t q : parts.b) allow(p % patches_a, q % patches_b, kClip);
  regions_ = {};
}

double AllowedPatches::depth_about(int part_a, int part_b, double t, double memory) const {
  const auto known = clip_depths.find({part_a, part_b});
  if (known == clip_depths.end()) return -1;
  double deepest = -1;
  auto at = std::lower_bound(known->second.begin(), known->second.end(), t - memory,
                             [](const DepthAt& d, double time) { return d.time < time; });
  for (; at != known->second.end() && at->time <= t + memory; ++at)
    deepest = std::max(deepest, at->depth);
  return deepest;
}

bool AllowedPatches::clip_touches(int part_a, int part_b, double from, double to,
                                  double memory) const {
  const auto known = clip_depths.find({part_a, part_b});
  if (known == clip_depths.end()) return false;
  const auto at = std::lower_bound(known->second.begin(), known->second.end(), to - memory,
                                   [](const DepthAt& d, double time) { return d.time < time; });
  return at != known->second.end() && at->time <= from + memory;
}

bool AllowedPatches::empty() const {
  return std::all_of(reasons.begin(), reasons.end(), [](std::uint8_t r) { return r == 0; });
}

PatchFilter AllowedPatches::filter(const CollisionBody& a, const CollisionBody& b,
                                   Reasons which) const {
  PatchFilter filter = which == Reasons::touched && !touching.empty()
                           ? touching.filter()
                           : patch_filter(a, b, which == Reasons::all ? any : always);
  const auto i = static_cast<std::size_t>(which);
  if (!regions_.known[i]) regions_.of[i] = patch_regions(a.mesh(), b.mesh(), filter);
  regions_.known[i] = true;
  filter.regions = regions_.of[i].get();
  return filter;
}

PatchFilter patch_filter(const CollisionBody& a, const CollisionBody& b,
                         const std::vector<bool>& allowed) {
  return {a.patch_of().data(), b.patch_of().data(), b.patch_count(), &allowed};
}

JoinedSurface join_bodies(const std::vector<const CollisionBody*>& bodies, double weld_tolerance) {
  JoinedSurface whole;
  std::vector<Vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (const CollisionBody* body : bodies) {
    whole.first_triangle.push_back(static_cast<std::uint32_t>(triangles.size()));
    const auto base = static_cast<std::uint32_t>(positions.size());
    for (const glm::vec3& p : body->mesh().positions())
      positions.push_back(body->query_from_body() * Vec3(p));
    for (const glm::uvec3& t : body->mesh().triangles()) triangles.push_back(t + base);
  }
  whole.surface = weld(positions, triangles, weld_tolerance);
  whole.component = connected_components(whole.surface);
  return whole;
}

void allow_shared_joint(const JoinedSurface& whole, const std::vector<const CollisionBody*>& bodies,
                        int child, int parent, const SharedJoint& joint, double radius,
                        bool swapped, AllowedPatches& allowed) {
  const WeldedSurface& surface = whole.surface;
  const auto child_number = static_cast<std::size_t>(child);
  const auto parent_number = static_cast<std::size_t>(parent);
  const CollisionBody& child_body = *bodies[child_number];
  const CollisionBody& parent_body = *bodies[parent_number];

  std::vector<std::uint8_t> uses(surface.points.size(), 0);
  const auto mark = [&](std::size_t number, const CollisionBody& body, std::uint8_t bit) {
    for (std::size_t t = 0; t < body.triangles().size(); ++t) {
      const glm::uvec3& corner = surface.triangles[whole.first_triangle[number] + t];
      for (int k = 0; k < 3; ++k) uses[corner[k]] |= bit;
    }
  };
  mark(child_number, child_body, 1);
  mark(parent_number, parent_body, 2);
  std::vector<std::uint32_t> seam;
  for (std::uint32_t p = 0; p < surface.points.size(); ++p)
    if (uses[p] == 3) seam.push_back(p);
  if (seam.empty() && joint.joint < 0) return;

  const double own = seam.empty() ? link_radius(child_body, joint) : seam_radius(surface, seam);
  double reach = std::max(radius, kCrossSections * own);
  // A shallow cut through something large (a cloak) must not set a whole arm free.
  if (joint.limb_length > 0) reach = std::max(radius, std::min(reach, 0.5 * joint.limb_length));

  const std::vector<double> along = distance_along(surface, seam, 2.0 * reach);
  std::vector<bool> joined(surface.points.size() + 1, false);
  for (const std::uint32_t p : seam) joined[static_cast<std::size_t>(whole.component[p])] = true;

  const auto child_distance =
      patch_distances(whole, child_number, child_body, along, joined, joint, false, reach);
  const auto parent_distance =
      patch_distances(whole, parent_number, parent_body, along, joined, joint, true, reach);
  for (int p = 0; p < child_body.patch_count(); ++p) {
    if (!(child_distance[static_cast<std::size_t>(p)] <= reach)) continue;
    for (int q = 0; q < parent_body.patch_count(); ++q)
      if (parent_distance[static_cast<std::size_t>(q)] <= reach)
        swapped ? allowed.allow(q, p, AllowedPatches::kShared)
                : allowed.allow(p, q, AllowedPatches::kShared);
  }
}

}  // namespace elbowroom
