// SPDX-License-Identifier: MIT
#include "core/collision/pair_clearance.h"

#include <cmath>

#include "core/collision/box_traversal.h"
#include "core/collision/mesh_data.h"

namespace elbowroom {
namespace {

struct Question {
  const CollisionMesh::Data& a;
  const CollisionMesh::Data& b;
  const RigidTransform& a_from_b;
  double distance;
  const PatchFilter& filter;

  TrianglePoints triangle_a(std::uint32_t t) const { return a.triangle(t); }
  TrianglePoints triangle_b(std::uint32_t t) const {
    const TrianglePoints local = b.triangle(t);
    return {a_from_b * local[0], a_from_b * local[1], a_from_b * local[2]};
  }
};

bool visit_near(void* context, std::uint32_t one, const std::uint32_t* many, int count,
                bool one_is_a) {
  const Question& q = *static_cast<const Question*>(context);
  const TrianglePoints first = one_is_a ? q.triangle_a(one) : q.triangle_b(one);
  for (int i = 0; i < count; ++i) {
    if (one_is_a ? q.filter.allows(one, many[i]) : q.filter.allows(many[i], one)) continue;
    if (!surely_apart(first, one_is_a ? q.triangle_b(many[i]) : q.triangle_a(many[i]), q.distance))
      return true;
  }
  return false;
}

}  // namespace

bool surely_farther(const CollisionMesh& a, const CollisionMesh& b, const RigidTransform& a_from_b,
                    double distance, const PatchFilter& filter) {
  if (!is_finite(a_from_b) || !std::isfinite(distance)) return false;
  Question question{a.data(), b.data(), a_from_b, distance > 0 ? distance : 0.0, filter};
  return !visit_close_pairs(question.a.tree, question.b.tree, a_from_b, question.distance,
                            filter.regions, visit_near, &question);
}

}  // namespace elbowroom
