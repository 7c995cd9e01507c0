// SPDX-License-Identifier: MIT
#include "core/collision/mesh_pair.h"

#include <algorithm>

#include "core/collision/box_traversal.h"
#include "core/collision/containment.h"
#include "core/collision/edge_rays.h"
#include "core/collision/mesh_data.h"

namespace elbowroom {
namespace {

using Data = CollisionMesh::Data;

struct Query {
  const Data& a;
  const Data& b;
  const RigidTransform& a_from_b;
  double distance;
  const PatchFilter& filter;

  TrianglePoints triangle_a(std::uint32_t t) const { return a.triangle(t); }
  TrianglePoints triangle_b(std::uint32_t t) const {
    const TrianglePoints local = b.triangle(t);
    return {a_from_b * local[0], a_from_b * local[1], a_from_b * local[2]};
  }
};

// Looks for the first contact. What decides:
//  * each pair of triangles that culling leaves, the predicate: measured, it costs less (about
//    60 ns) than an edge's share of a ray packet about the contact (90 ns), and it is needed anyway
//    where rays are not to be trusted or do not reach, near pairs above all;
//  * where a first kPairsBeforeRays pairs have decided nothing, and after every doubling of them,
//    packets of edge rays: deep in one another, large meshes have thousands of near pairs that do
//    not cross, and a ray looks at the whole mesh at once.
struct Search {
  static constexpr std::size_t kPairsBeforeRays = 256;

  const Query& query;
  PairCache* cache;
  std::size_t undecided = 0;
  std::size_t rays_at = kPairsBeforeRays;
  TrianglePair last[kPairsBeforeRays];  // undecided pairs, a ring

  Search(const Query& its_query, PairCache* its_cache) : query(its_query), cache(its_cache) {}

  bool found(const TrianglePair& pair) const {
    if (cache) *cache = {pair.a, pair.b, true};
    return true;
  }
};

bool visit_search(void* context, std::uint32_t one, const std::uint32_t* many, int count,
                  bool one_is_a) {
  Search& search = *static_cast<Search*>(context);
  const Query& q = search.query;
  const TrianglePoints first = one_is_a ? q.triangle_a(one) : q.triangle_b(one);
  for (int i = 0; i < count; ++i) {
    const TrianglePair pair = one_is_a ? TrianglePair{one, many[i]} : TrianglePair{many[i], one};
    if (q.filter.allows(pair.a, pair.b)) continue;
    const bool touch = one_is_a ? triangles_touch(first, q.triangle_b(pair.b), q.distance)
                                : triangles_touch(q.triangle_a(pair.a), first, q.distance);
    if (touch) return search.found(pair);
    search.last[search.undecided++ % Search::kPairsBeforeRays] = pair;
  }
  if (search.undecided >= search.rays_at) {
    search.rays_at *= 2;
    TrianglePair pair;
    if (edges_cross(q.a, q.b, q.a_from_b, search.last, q.filter, pair)) return search.found(pair);
  }
  return false;
}

// Looks for the first pair within its own distance.
struct ReachSearch {
  const Query& query;
  const TriangleReach& reach;
  PairCache* cache;
};

bool visit_reach(void* context, std::uint32_t one, const std::uint32_t* many, int count,
                 bool one_is_a) {
  ReachSearch& search = *static_cast<ReachSearch*>(context);
  const Query& q = search.query;
  const TrianglePoints first = one_is_a ? q.triangle_a(one) : q.triangle_b(one);
  for (int i = 0; i < count; ++i) {
    const std::uint32_t ta = one_is_a ? one : many[i], tb = one_is_a ? many[i] : one;
    if (q.filter.allows(ta, tb)) continue;
    const double distance = search.reach.apart + static_cast<double>(search.reach.of_a[ta]) +
                            static_cast<double>(search.reach.of_b[tb]);
    const bool near = one_is_a ? triangles_touch(first, q.triangle_b(tb), distance)
                               : triangles_touch(q.triangle_a(ta), first, distance);
    if (!near) continue;
    if (search.cache) *search.cache = {ta, tb, true};
    return true;
  }
  return false;
}

// Collects all contacts, or one of each two patches.
struct Collection {
  const Query& query;
  std::vector<TriangleContact>& out;
  std::vector<bool> seen{};  // by pair of patches, where these are all that is asked; else empty

  std::size_t patches_of(std::uint32_t ta, std::uint32_t tb) const {
    return static_cast<std::size_t>(query.filter.patch_of_a[ta]) *
               static_cast<std::size_t>(query.filter.patches_b) +
           query.filter.patch_of_b[tb];
  }
};

bool visit_collection(void* context, std::uint32_t one, const std::uint32_t* many, int count,
                      bool one_is_a) {
  Collection& collection = *static_cast<Collection*>(context);
  const Query& q = collection.query;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t ta = one_is_a ? one : many[i], tb = one_is_a ? many[i] : one;
    if (q.filter.allows(ta, tb)) continue;
    if (!collection.seen.empty() && collection.seen[collection.patches_of(ta, tb)]) continue;
    const TrianglePoints pa = q.triangle_a(ta), pb = q.triangle_b(tb);
    if (!triangles_touch(pa, pb, q.distance)) continue;
    TriangleContact contact;
    contact.triangle_a = ta;
    contact.triangle_b = tb;
    if (!collection.seen.empty()) {
      collection.seen[collection.patches_of(ta, tb)] = true;
      collection.out.push_back(contact);
      continue;
    }
    if (triangles_intersect(pa, pb)) {
      contact.place = intersection_point(pa, pb);
    } else {
      const ClosestPoints closest = closest_points(pa, pb);
      contact.place = 0.5 * (closest.on_a + closest.on_b);
    }
    collection.out.push_back(contact);
  }
  return false;
}

// Do two components cross, allowed or not?
struct Crossing {
  const Query& query;
  std::uint32_t component_a, component_b;
};

bool visit_crossing(void* context, std::uint32_t one, const std::uint32_t* many, int count,
                    bool one_is_a) {
  const Crossing& crossing = *static_cast<Crossing*>(context);
  const Query& q = crossing.query;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t ta = one_is_a ? one : many[i], tb = one_is_a ? many[i] : one;
    if (q.a.topology.component[ta] != crossing.component_a ||
        q.b.topology.component[tb] != crossing.component_b) {
      continue;
    }
    if (triangles_intersect(q.triangle_a(ta), q.triangle_b(tb))) return true;
  }
  return false;
}

bool components_cross(const Query& q, std::uint32_t component_a, std::uint32_t component_b) {
  Crossing crossing{q, component_a, component_b};
  return visit_close_pairs(q.a.tree, q.b.tree, q.a_from_b, 0.0, nullptr, visit_crossing, &crossing);
}

struct Containment {
  std::uint32_t inner, outer;  // components
  Vec3 place;                  // a vertex of the inner one, in the outer mesh's frame
};

// Axis by axis: most are outside on the first.
bool inside_box(const RigidTransform& t, const glm::vec3& point, const glm::vec3& low,
                const glm::vec3& high) {
  const Vec3 v(point);
  for (int k = 0; k < 3; ++k) {
    const double p =
        t.rotation[0][k] * v.x + t.rotation[1][k] * v.y + t.rotation[2][k] * v.z + t.translation[k];
    if (!(p >= static_cast<double>(low[k]) && p <= static_cast<double>(high[k]))) return false;
  }
  return true;
}

// Components of `inner` with a vertex inside a component of `outer` whose box holds them. Boxes
// settle nearly all; the rest is asked with rays.
void find_containments(const Data& inner, const Data& outer, const RigidTransform& outer_from_inner,
                       std::vector<Containment>& out) {
  out.clear();
  if (!outer.can_enclose) return;
  std::vector<Vec3> points;
  std::vector<std::uint32_t> component_of;
  const glm::vec3 *low = nullptr, *high = nullptr;
  const auto held = [&](const ComponentPlace& place) {
    return std::all_of(std::begin(place.extreme), std::end(place.extreme), [&](std::uint32_t v) {
      return inside_box(outer_from_inner, inner.positions[v], *low, *high);
    });
  };
  for (std::uint32_t c = 0; c < inner.places.size(); ++c) {
    low = &outer.low;
    high = &outer.high;
    if (!held(inner.places[c])) continue;
    for (std::uint32_t o = 0; o < outer.places.size(); ++o) {
      if (!outer.topology.components[o].encloses) continue;
      low = &outer.places[o].low;
      high = &outer.places[o].high;
      if (!held(inner.places[c])) continue;
      points.push_back(outer_from_inner * Vec3(inner.positions[inner.places[c].extreme[0]]));
      component_of.push_back(c);
      break;
    }
  }
  if (points.empty()) return;
  std::vector<Enclosure> enclosures;
  find_enclosures(outer, points, enclosures);
  for (const Enclosure& e : enclosures) {
    const std::uint32_t c = component_of[e.point];
    low = &outer.places[e.component].low;
    high = &outer.places[e.component].high;
    if (held(inner.places[c])) out.push_back({c, e.component, points[e.point]});
  }
}

// Calls `found(component of a, component of b, a's is the inner one, place in a's frame)` for each
// containment that no crossing and no filter takes back, until it returns true.
template <typename Found>
bool for_containments(const Query& q, const Apart& apart, bool surfaces_may_cross,
                      const Found& found) {
  if (!q.a.can_enclose && !q.b.can_enclose) return false;
  std::vector<Containment> containments;
  for (const bool a_is_inner : {true, false}) {
    if (a_is_inner ? apart.a_outside_b : apart.b_outside_a) continue;
    const Data& inner = a_is_inner ? q.a : q.b;
    const Data& outer = a_is_inner ? q.b : q.a;
    if (!outer.can_enclose) continue;
    const RigidTransform to_outer = a_is_inner ? inverse(q.a_from_b) : q.a_from_b;
    find_containments(inner, outer, to_outer, containments);
    for (const Containment& c : containments) {
      const std::uint32_t ca = a_is_inner ? c.inner : c.outer, cb = a_is_inner ? c.outer : c.inner;
      if (surfaces_may_cross && components_cross(q, ca, cb)) continue;
      if (q.filter.allowed) {
        const std::uint32_t first = outer.topology.components[c.outer].first_triangle;
        bool all = true;
        for (std::uint32_t t = 0; t < inner.triangles.size() && all; ++t) {
          if (inner.topology.component[t] != c.inner) continue;
          all = a_is_inner ? q.filter.allows(t, first) : q.filter.allows(first, t);
        }
        if (all) continue;
      }
      if (found(ca, cb, a_is_inner, a_is_inner ? q.a_from_b * c.place : c.place)) return true;
    }
  }
  return false;
}

double usable_distance(double distance) { return distance > 0 ? distance : 0.0; }

}  // namespace

bool in_contact(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
                double distance, const PatchFilter& filter, PairCache* cache) {
  const Query query{a.data(), b.data(), a_from_b, usable_distance(distance), filter};
  if (query.a.tree.empty() || query.b.tree.empty()) return false;
  if (!is_finite(a_from_b)) return true;
  if (cache && cache->set && cache->triangle_a < query.a.triangles.size() &&
      cache->triangle_b < query.b.triangles.size()) {
    Search again(query, nullptr);
    if (visit_search(&again, cache->triangle_a, &cache->triangle_b, 1, true)) return true;
  }
  Search search(query, cache);
  Apart apart;
  if (visit_close_pairs(query.a.tree, query.b.tree, a_from_b, query.distance, filter.regions,
                        visit_search, &search, &apart)) {
    return true;
  }
  // No contact was found, so only allowed pairs can cross.
  return for_containments(query, apart, filter.allowed != nullptr,
                          [](std::uint32_t, std::uint32_t, bool, const Vec3&) { return true; });
}

bool reach_each_other(const CollisionMesh& a, const CollisionMesh& b,
                      const RigidTransform& a_from_b, const TriangleReach& reach,
                      const PatchFilter& filter, PairCache* cache) {
  const Query query{a.data(), b.data(), a_from_b, usable_distance(reach.most + reach.apart),
                    filter};
  if (query.a.tree.empty() || query.b.tree.empty()) return false;
  // A reach that is no number proves nothing.
  if (!is_finite(a_from_b) || !(reach.most + reach.apart >= 0)) return true;
  ReachSearch search{query, reach, cache};
  if (cache && cache->set && cache->triangle_a < query.a.triangles.size() &&
      cache->triangle_b < query.b.triangles.size()) {
    if (visit_reach(&search, cache->triangle_a, &cache->triangle_b, 1, true)) return true;
  }
  return visit_close_pairs(query.a.tree, query.b.tree, a_from_b, query.distance, filter.regions,
                           visit_reach, &search);
}

namespace {

void collect(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
             double distance, const PatchFilter& filter, bool patches_only,
             std::vector<TriangleContact>& out) {
  std::vector<TriangleContact> earlier;
  earlier.swap(out);
  const Query query{a.data(), b.data(), a_from_b, usable_distance(distance), filter};
  if (query.a.tree.empty() || query.b.tree.empty() || !is_finite(a_from_b)) return;
  Collection collection{query, out};
  if (patches_only && filter.allowed) {
    collection.seen.assign(filter.allowed->size(), false);
    for (const TriangleContact& c : earlier)
      if (c.triangle_a < query.a.triangles.size() && c.triangle_b < query.b.triangles.size())
        visit_collection(&collection, c.triangle_a, &c.triangle_b, 1, true);
  }
  visit_close_pairs(query.a.tree, query.b.tree, a_from_b, query.distance, filter.regions,
                    visit_collection, &collection);
  std::sort(out.begin(), out.end(), [](const TriangleContact& x, const TriangleContact& y) {
    return x.triangle_a != y.triangle_a ? x.triangle_a < y.triangle_a : x.triangle_b < y.triangle_b;
  });
  for_containments(
      query, {}, true, [&](std::uint32_t ca, std::uint32_t cb, bool a_is_inner, const Vec3& place) {
        const Data& inner = a_is_inner ? query.a : query.b;
        const Data& outer = a_is_inner ? query.b : query.a;
        const std::uint32_t component = a_is_inner ? ca : cb;
        const std::uint32_t first = outer.topology.components[a_is_inner ? cb : ca].first_triangle;
        for (std::uint32_t t = 0; t < inner.triangles.size(); ++t) {
          if (inner.topology.component[t] != component) continue;
          if (a_is_inner ? filter.allows(t, first) : filter.allows(first, t)) continue;
          TriangleContact contact;
          contact.triangle_a = a_is_inner ? t : first;
          contact.triangle_b = a_is_inner ? first : t;
          contact.place = place;
          contact.contained = true;
          out.push_back(contact);
        }
        return false;
      });
}

}  // namespace

void find_contacts(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
                   double distance, const PatchFilter& filter, std::vector<TriangleContact>& out) {
  collect(a, b, a_from_b, distance, filter, false, out);
}

void find_patch_contacts(const CollisionMesh& a, const CollisionMesh& b,
                         const RigidTransform& a_from_b, double distance, const PatchFilter& filter,
                         std::vector<TriangleContact>& out) {
  collect(a, b, a_from_b, distance, filter, true, out);
}

}  // namespace elbowroom
