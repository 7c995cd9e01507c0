// SPDX-License-Identifier: MIT
// Two independent judges of mesh contact: FCL (fast, double, sees surfaces only) and CGAL (exact
// predicates on the same doubles; parity of rays for containment).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/collision/collision_mesh.h"
#include "tests/support/shapes.h"

namespace elbowroom::test {

class JudgedMesh {
 public:
  // Triangles without area are left out: CGAL's predicates ask for that.
  JudgedMesh(std::string name, const Shape& shape);
  JudgedMesh(JudgedMesh&&) noexcept;
  ~JudgedMesh();

  std::string name;
  Shape shape;
  double radius = 0;  // around the middle of the box
  Vec3 middle{0.0};

  struct Data;
  std::unique_ptr<Data> data;
};

bool fcl_collides(const JudgedMesh& a, const JudgedMesh& b, const RigidTransform& a_from_b);

// Some triangles share a point. b's vertices are placed in double as the contract says.
bool exact_surfaces_meet(const JudgedMesh& a, const JudgedMesh& b, const RigidTransform& a_from_b);

// A component of one lies inside a closed component of the other, surfaces not meeting at all.
bool exact_contained(const JudgedMesh& a, const JudgedMesh& b, const RigidTransform& a_from_b);

}  // namespace elbowroom::test
