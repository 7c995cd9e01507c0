// SPDX-License-Identifier: MIT
// The mannequin's body as one implicit surface in the bind pose, symmetric in x; and for any place,
// which part of the body it belongs to and how fine its triangles should be.
#pragma once

#include <memory>

#include "core/base/math.h"

namespace elbowroom::demo {

enum class BodyPart { trunk, arm, leg };  // the trunk has the head

class BodyShape {
 public:
  BodyShape();
  ~BodyShape();
  // About the signed distance, metres, negative inside.
  double operator()(const Vec3& p) const;
  // Outward, unit, by central differences.
  Vec3 normal(const Vec3& p) const;
  // The nearest point of the surface for a p close to it.
  Vec3 project(Vec3 p) const;
  // Of the part whose own surface is nearest.
  BodyPart part(const Vec3& p) const;
  // Wanted edge length of triangles at p, metres.
  double edge_length(const Vec3& p) const;

  Vec3 low() const { return {-0.80, -0.02, -0.22}; }  // the body's box, with room to spare
  Vec3 high() const { return {0.80, 1.79, 0.28}; }

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom::demo
