// SPDX-License-Identifier: MIT
#include "core/collision/near_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/collision/box_traversal.h"
#include "core/collision/mesh_data.h"

namespace elbowroom {
namespace {

constexpr std::size_t kMostListed = 256;
constexpr std::size_t kMostLookedAt = 4096;  // pairs of triangles, to make a list
constexpr double kTwiceAbout = 0.5;          // of the room: placements so near are worth a list

using Data = CollisionMesh::Data;

struct Listed {
  std::uint32_t a, b;
  double distance;
};

struct Gathering {
  const Data& a;
  const Data& b;
  const RigidTransform& a_from_b;
  const PatchFilter& filter;
  double reach;
  std::size_t looked_at = 0;
  std::vector<Listed> found;

  TrianglePoints triangle_b(std::uint32_t t) const {
    const TrianglePoints local = b.triangle(t);
    return {a_from_b * local[0], a_from_b * local[1], a_from_b * local[2]};
  }
};

bool gather(void* context, std::uint32_t one, const std::uint32_t* many, int count, bool one_is_a) {
  Gathering& g = *static_cast<Gathering*>(context);
  g.looked_at += static_cast<std::size_t>(count);
  if (g.looked_at > kMostLookedAt) return true;
  const TrianglePoints first = one_is_a ? g.a.triangle(one) : g.triangle_b(one);
  const double reach2 = g.reach * g.reach;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t ta = one_is_a ? one : many[i], tb = one_is_a ? many[i] : one;
    if (g.filter.allows(ta, tb)) continue;
    const TrianglePoints second = one_is_a ? g.triangle_b(tb) : g.a.triangle(ta);
    if (surely_apart(first, second, g.reach)) continue;
    const ClosestPoints closest = closest_points(first, second, 0, reach2);
    if (closest.distance2 < reach2) g.found.push_back({ta, tb, std::sqrt(closest.distance2)});
  }
  return false;
}

double ball_radius(const Data& mesh) {
  double most = 0;
  for (const glm::vec3& p : mesh.positions)
    most = std::max(most, glm::distance(Vec3(p), mesh.tree.origin));
  return most;
}

// How far at least the component of `inner` that is nearest to being held by the box of `outer` is
// from being so.
double outside(const Data& inner, const Data& outer, const RigidTransform& outer_from_inner) {
  double least = std::numeric_limits<double>::infinity();
  if (!outer.can_enclose) return least;
  for (const ComponentPlace& place : inner.places) {
    double out = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : place.extreme) {
      const Vec3 p = outer_from_inner * Vec3(inner.positions[v]);
      for (int k = 0; k < 3; ++k)
        out = std::max({out, static_cast<double>(outer.low[k]) - p[k],
                        p[k] - static_cast<double>(outer.high[k])});
    }
    least = std::min(least, out);
  }
  return least;
}

// No vector becomes longer by the difference of two rotations than this times its length: for
// rotations the norm is 2 sin(θ/2), and the Frobenius norm √2 times that.
double norm_of_difference(const Mat3& m) {
  double square = 0;
  for (int i = 0; i < 3; ++i) square += glm::dot(m[i], m[i]);
  // Rotations are ones within 1e-9 (Data::place_chain).
  return std::sqrt(0.5 * square) + 1e-7;
}

}  // namespace

NearLists::Shift NearLists::shift(const RigidTransform& from, const RigidTransform& to) const {
  Shift s;
  s.turn = to.rotation - from.rotation;
  s.way = s.turn * ball_a_.centre + (to.translation - from.translation);
  s.swing = norm_of_difference(s.turn);
  s.most = glm::length(s.way) + s.swing * ball_a_.radius;
  return s;
}

// Squares of differences of these are about those of how far a moves.
std::array<float, 12> NearLists::summary(const RigidTransform& b_from_a) const {
  std::array<float, 12> s;
  const Vec3 place = b_from_a * ball_a_.centre;
  const double turn = std::sqrt(0.5) * ball_a_.radius;
  for (int k = 0; k < 3; ++k) {
    s[static_cast<std::size_t>(k)] = static_cast<float>(place[k]);
    for (int j = 0; j < 3; ++j)
      s[static_cast<std::size_t>(3 + 3 * k + j)] =
          static_cast<float>(turn * b_from_a.rotation[k][j]);
  }
  return s;
}

std::size_t NearLists::nearest(const RigidTransform& b_from_a) {
  const std::size_t count = lists_.size();
  const std::array<float, 12> here = summary(b_from_a);
  apart_.assign(count, 0.0f);
  for (std::size_t k = 0; k < here.size(); ++k) {
    const float* column = summaries_[k].data();
    float* apart = apart_.data();
    for (std::size_t i = 0; i < count; ++i) {
      const float d = column[i] - here[k];
      apart[i] += d * d;
    }
  }
  return static_cast<std::size_t>(std::min_element(apart_.begin(), apart_.end()) - apart_.begin());
}

NearLists::Said NearLists::ask(std::size_t number, const RigidTransform& b_from_a,
                               double distance) {
  const List& list = lists_[number];
  moved_ = shift(list.b_from_a, b_from_a);
  const double most = distance + moved_.most + slack_;
  // A distance or a place that is no number is known to no list.
  if (!(most < list.reach)) return Said::nothing;
  // Those beyond are farther whatever moves.
  const std::size_t count = static_cast<std::size_t>(
      std::upper_bound(list.distance.begin(), list.distance.end(), most,
                       [](double d, float listed) { return d < static_cast<double>(listed); }) -
      list.distance.begin());
  marked_ = count;
  if (count == 0) return Said::apart;
  near_.resize(std::max(near_.size(), count));
  // In float, each of some dozen operations rounds by 2^-24 of what it is about, all of which is
  // smaller than a's ball or the reach; slack_ is more than that.
  float m[3][3], w[3];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[r][c] = static_cast<float>(moved_.turn[c][r]);
    w[r] = static_cast<float>(moved_.way[r]);
  }
  const auto swing = static_cast<float>(moved_.swing);
  const auto limit = static_cast<float>(distance + slack_);
  const float *x = list.x.data(), *y = list.y.data(), *z = list.z.data();
  const float *radius = list.radius.data(), *listed = list.distance.data();
  std::int32_t* near = near_.data();
  std::int32_t any = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float vx = m[0][0] * x[i] + m[0][1] * y[i] + m[0][2] * z[i] + w[0];
    const float vy = m[1][0] * x[i] + m[1][1] * y[i] + m[1][2] * z[i] + w[1];
    const float vz = m[2][0] * x[i] + m[2][1] * y[i] + m[2][2] * z[i] + w[2];
    const float left = listed[i] - swing * radius[i] - limit;
    // What is no number is near.
    const std::int32_t may = !(left > 0.0f) | !(vx * vx + vy * vy + vz * vz < left * left);
    near[i] = may;
    any |= may;
  }
  return any ? Said::perhaps : Said::apart;
}

NearLists::Said NearLists::ask_any(const RigidTransform& b_from_a, double distance) {
  if (lists_.empty()) return Said::nothing;
  Said said = ask(latest_, b_from_a, distance);
  if (said == Said::apart) return said;
  const std::size_t other = nearest(b_from_a);
  if (other == latest_) return said;
  const bool known = said != Said::nothing;
  said = ask(other, b_from_a, distance);
  // Lists differ in how far they reach.
  if (said == Said::nothing && known) return ask(latest_, b_from_a, distance);
  if (said != Said::nothing) latest_ = other;
  return said;
}

template <typename Test>
bool NearLists::any_marked(const Test& test) const {
  const List& list = lists_[latest_];
  for (std::size_t i = 0; i < marked_; ++i)
    if (near_[i] && test(list.a[i], list.b[i])) return true;
  return false;
}

std::optional<bool> NearLists::in_contact(const CollisionMesh& a, const CollisionMesh& b,
                                          const RigidTransform& a_from_b, double distance,
                                          const PatchFilter& filter, PairCache* cache) {
  const Said said = ask_any(inverse(a_from_b), distance);
  if (said == Said::nothing) return std::nullopt;
  const Data &da = a.data(), &db = b.data();
  const auto touch = [&](std::uint32_t ta, std::uint32_t tb) {
    const TrianglePoints local = db.triangle(tb);
    return triangles_touch(
        da.triangle(ta), {a_from_b * local[0], a_from_b * local[1], a_from_b * local[2]}, distance);
  };
  if (said == Said::perhaps) {
    // The pair that hit last is tried first.
    if (cache && cache->set && cache->triangle_a < da.triangles.size() &&
        cache->triangle_b < db.triangles.size() &&
        !filter.allows(cache->triangle_a, cache->triangle_b) &&
        touch(cache->triangle_a, cache->triangle_b))
      return true;
    if (any_marked([&](std::uint32_t ta, std::uint32_t tb) {
          if (!touch(ta, tb)) return false;
          if (cache) *cache = {ta, tb, true};
          return true;
        }))
      return true;
  }
  const List& list = lists_[latest_];
  if (moved_.most + slack_ < list.a_outside &&
      (std::isinf(list.b_outside) ||
       glm::distance(a_from_b * ball_b_.centre, list.a_from_b * ball_b_.centre) +
               moved_.swing * ball_b_.radius + slack_ <
           list.b_outside))
    return false;
  return in_one_another(a, b, a_from_b, filter);
}

std::optional<bool> NearLists::surely_farther(const CollisionMesh& a, const CollisionMesh& b,
                                              const RigidTransform& a_from_b, double distance) {
  const Said said = ask_any(inverse(a_from_b), distance);
  if (said == Said::nothing) return std::nullopt;
  if (said == Said::apart) return true;
  const Data &da = a.data(), &db = b.data();
  return !any_marked([&](std::uint32_t ta, std::uint32_t tb) {
    const TrianglePoints local = db.triangle(tb);
    return !surely_apart(da.triangle(ta),
                         {a_from_b * local[0], a_from_b * local[1], a_from_b * local[2]}, distance);
  });
}

bool NearLists::make_list(const CollisionMesh& a, const CollisionMesh& b,
                          const RigidTransform& a_from_b, double distance,
                          const PatchFilter& filter, List& list) {
  const Data &da = a.data(), &db = b.data();
  Gathering g{da, db, a_from_b, filter, distance + room_, 0, {}};
  if (visit_close_pairs(da.tree, db.tree, a_from_b, g.reach, filter.regions, gather, &g))
    return false;
  std::sort(g.found.begin(), g.found.end(), [](const Listed& p, const Listed& q) {
    if (p.distance != q.distance) return p.distance < q.distance;
    return p.a != q.a ? p.a < q.a : p.b < q.b;
  });
  list.reach = g.reach;
  if (g.found.size() > kMostListed) {
    list.reach = g.found[kMostListed].distance;
    g.found.resize(kMostListed);
  }
  list.a_from_b = a_from_b;
  list.b_from_a = inverse(a_from_b);
  list.a_outside = outside(da, db, list.b_from_a);
  list.b_outside = outside(db, da, a_from_b);
  for (const Listed& each : g.found) {
    const TrianglePoints t = da.triangle(each.a);
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0, at = middle - ball_a_.centre;
    double radius = 0;
    for (const Vec3& p : t) radius = std::max(radius, glm::distance(p, middle));
    list.x.push_back(static_cast<float>(at.x));
    list.y.push_back(static_cast<float>(at.y));
    list.z.push_back(static_cast<float>(at.z));
    list.radius.push_back(static_cast<float>(radius * (1 + 1e-6)));
    list.distance.push_back(static_cast<float>(each.distance * (1 - 1e-6)));
    list.a.push_back(each.a);
    list.b.push_back(each.b);
  }
  return true;
}

void NearLists::learn(const CollisionMesh& a, const CollisionMesh& b,
                      const RigidTransform& a_from_b, double distance, const PatchFilter& filter) {
  if (!(room_ > 0) || !is_finite(a_from_b) || !std::isfinite(distance)) return;
  if (!known_) {
    ball_a_ = {a.data().tree.origin, ball_radius(a.data())};
    ball_b_ = {b.data().tree.origin, ball_radius(b.data())};
    slack_ = 4e-6 * (ball_a_.radius + distance + room_);
    known_ = true;
  }
  const RigidTransform b_from_a = inverse(a_from_b);
  const std::size_t missed = std::min(missed_count_, kMissed);
  const bool again =
      std::any_of(missed_.begin(), missed_.begin() + static_cast<std::ptrdiff_t>(missed),
                  [&](const RigidTransform& other) {
                    return shift(other, b_from_a).most <= kTwiceAbout * room_;
                  });
  if (!again) {
    missed_[missed_count_++ % kMissed] = b_from_a;
    return;
  }

  List list;
  if (!make_list(a, b, a_from_b, distance, filter, list)) {
    // Too many triangles about: less far, or not at all.
    room_ *= 0.5;
    if (room_ < 100 * slack_) room_ = 0;
    return;
  }

  if (list.reach < distance + room_) room_ = std::max(0.5 * room_, list.reach - distance);
  const std::array<float, 12> here = summary(list.b_from_a);
  latest_ = next_;
  next_ = (next_ + 1) % kMostLists;
  if (latest_ == lists_.size()) {
    lists_.push_back(std::move(list));
    for (std::size_t k = 0; k < here.size(); ++k) summaries_[k].push_back(here[k]);
  } else {
    lists_[latest_] = std::move(list);
    for (std::size_t k = 0; k < here.size(); ++k) summaries_[k][latest_] = here[k];
  }
}

}  // namespace elbowroom
