// SPDX-License-Identifier: MIT
#include "assets/generator/outfit.h"

#include <algorithm>

#include "assets/generator/figure.h"

namespace elbowroom::demo {

namespace {

// Fields whose zero lines are the hems; positive on the side named. Bind pose, either side.

// Bare above a round neckline: inside an upright cylinder about the neck, and the whole head.
double above_neckline(const Vec3& p) {
  const double cylinder = 0.079 - std::sqrt(p.x * p.x + (p.z + 0.026) * (p.z + 0.026));
  return std::max(std::min(cylinder, p.y - 1.36), p.y - 1.515);
}

// Bare below a sleeve that ends above the elbow.
double below_sleeve(const Vec3& p) {
  static const Figure figure = make_figure();
  static const Vec3 shoulder =
      figure.joints[static_cast<std::size_t>(figure.find("LeftUpperArm"))].position;
  static const Vec3 elbow =
      figure.joints[static_cast<std::size_t>(figure.find("LeftLowerArm"))].position;
  const Vec3 left(std::abs(p.x), p.y, p.z);
  const double along = glm::dot(left - shoulder, glm::normalize(elbow - shoulder));
  return std::min(along - 0.195, left.x - 0.22);
}

double above_waist(const Vec3& p) { return std::max(p.y - 1.030, std::abs(p.x) - 0.215); }

double above_shoe(const Vec3& p) { return p.y - 0.090 + 0.12 * p.z; }

}  // namespace

Surface cut_outfit(const Surface& surface, const BodyShape& shape) {
  Surface cut = surface;
  for (const auto& field : {above_neckline, below_sleeve, above_waist, above_shoe})
    cut = cut_along(cut, shape, field);
  return cut;
}

std::vector<GlbMaterial> outfit_materials() {
  return {{"Skin", {0.56f, 0.41f, 0.31f}, 0.60f, 0.0f, false},
          {"Shirt", {0.58f, 0.57f, 0.54f}, 0.85f, 0.0f, false},
          {"Trousers", {0.085f, 0.125f, 0.18f}, 0.85f, 0.0f, false},
          {"Shoes", {0.30f, 0.17f, 0.09f}, 0.55f, 0.0f, false}};
}

int outfit_material(const Vec3& p) {
  if (above_neckline(p) > 0 || below_sleeve(p) > 0) return 0;
  if (above_waist(p) > 0) return 1;
  return above_shoe(p) > 0 ? 2 : 3;
}

}  // namespace elbowroom::demo
