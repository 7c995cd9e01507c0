// SPDX-License-Identifier: MIT
// Implicit shapes to model a body with: negative inside, about the distance to the surface near it
// (good to a few per cent, which is all that polygonizing and projection need). Metres.
#pragma once

#include <vector>

#include "core/base/math.h"

namespace elbowroom::demo {

// Smooth union and intersection (quadratic): equal to min and max where |a - b| ≥ k.
double smooth_union(double a, double b, double k);
double smooth_intersection(double a, double b, double k);

// A capsule whose radius goes from ra at a to rb at b.
double tapered_capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb);

// Axis-parallel ellipsoid.
double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii);

// A stack of rounded sections along a straight axis, their numbers interpolated by a smooth curve:
// what a draughtsman gives as sections of a limb or trunk.
struct Section {
  double at;                        // along the axis from its origin
  double half_u, half_v;            // half widths
  double shift_u = 0, shift_v = 0;  // of the section's centre off the axis
};

class Loft {
 public:
  // Axis, u and v orthonormal. `sections` ascend by `at`, at least two. Squareness 0 gives
  // ellipses, 1 sections like rounded boxes.
  Loft(const Vec3& origin, const Vec3& axis, const Vec3& u, std::vector<Section> sections,
       double squareness = 0.0);
  double operator()(const Vec3& p) const;

 private:
  Vec3 origin_, axis_, u_, v_;
  std::vector<Section> sections_;
  std::vector<Section> slopes_;  // d/d(at) of each number at each section
  double squareness_;
};

// A box outside which a group of shapes is too far away to matter.
struct Bounds {
  Vec3 low{1e9}, high{-1e9};
  void add(const Vec3& p, double radius);
  double distance(const Vec3& p) const;  // 0 inside
};

}  // namespace elbowroom::demo
