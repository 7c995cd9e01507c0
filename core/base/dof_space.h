// SPDX-License-Identifier: MIT
// The DOFs of a limb as plain numbers, and the convex set of their limits. Shared by anatomy, which
// makes them, and planning, which searches in them and knows no joint.
//
// Angles are radians. Limits are convex in the parameters, so that an edge between two allowed ends
// keeps them (DESIGN.md, "Interpolation").
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace elbowroom {

inline constexpr int kMaxDofs = 16;

struct Dofs {
  std::array<double, kMaxDofs> value{};
  int count = 0;

  double& operator[](int i) { return value[static_cast<std::size_t>(i)]; }
  double operator[](int i) const { return value[static_cast<std::size_t>(i)]; }
};

// What a DOF is to the sampling heuristics of [SKF07 4.2].
enum class DofRole { swing, twist, flexion, secondary_swing };

struct Dof {
  std::string name;  // anatomical, for people: "Elbow, flexion"
  DofRole role = DofRole::swing;
  double lower = 0, upper = 0;                // limit
  double sample_lower = 0, sample_upper = 0;  // sampling interval, inside the limit
  double speed_limit = 0;                     // |dq/dt|, rad/s
  // |d²q/dt²|, rad/s², of the curve that comes out; a search of landmarks knows no acceleration.
  double acceleration_limit = std::numeric_limits<double>::infinity();
};

// (q[first]/half_first)² + (q[second]/half_second)² ≤ 1: the spherical ellipse of a swing
// [SKF07 4.2, Grassia 1998].
struct EllipseLimit {
  int first = 0, second = 0;
  double half_first = 0, half_second = 0;
};

// A swing's limit as a spherical polygon: its corners are swings (q[first], q[second]), radians, in
// counter-clockwise order; convex, with the zero pose inside. Its edges are straight in the
// parameters, which is what keeps limits convex in them; as arcs on the sphere of the bone's
// directions they are those of the swing's own chart, straight through the zero pose.
struct PolygonLimit {
  int first = 0, second = 0;
  std::vector<std::array<double, 2>> corners;

  // By how much (a, b) is out along its ray from zero: 1 on the border, below 1 inside. Infinite
  // for what is no number or no polygon.
  double gauge(double a, double b) const;
};

// The corners in order if they make such a polygon: at least three, finite, convex, with zero
// inside. Corners on an edge are left out. Error: what is wrong with them.
Result<PolygonLimit> make_polygon_limit(int first, int second,
                                        std::vector<std::array<double, 2>> corners);

struct DofSpace {
  std::vector<Dof> dofs;
  std::vector<EllipseLimit> ellipses;
  std::vector<PolygonLimit> polygons;

  int count() const { return static_cast<int>(dofs.size()); }
  // All ranges, ellipses and polygons hold within `tolerance` (radians; for an ellipse or a
  // polygon, on its value).
  bool within_limits(const Dofs& q, double tolerance = 1e-9) const;
  // Widens ranges, ellipses and polygons (to their convex hull with q) just enough to hold q;
  // returns the indices of DOFs widened.
  std::vector<int> widen_to(const Dofs& q);
};

}  // namespace elbowroom
