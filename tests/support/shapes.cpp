// SPDX-License-Identifier: MIT
#include "tests/support/shapes.h"

#include <cmath>
#include <functional>

#include "core/base/math.h"

namespace elbowroom::test {
namespace {

// A surface of revolution about z: rings of `segments` vertices at (radius, height, angle), closed
// by fans at both ends if asked for.
Shape revolve(int rings, int segments, bool closed,
              const std::function<glm::vec3(int ring, double angle)>& at, float bottom, float top) {
  Shape shape;
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) shape.positions.push_back(at(r, 2 * kPi * s / segments));
  }
  const auto index = [&](int r, int s) {
    return static_cast<std::uint32_t>(r * segments + s % segments);
  };
  for (int r = 0; r + 1 < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      shape.triangles.push_back({index(r, s), index(r, s + 1), index(r + 1, s + 1)});
      shape.triangles.push_back({index(r, s), index(r + 1, s + 1), index(r + 1, s)});
    }
  }
  if (closed) {
    const auto south = static_cast<std::uint32_t>(shape.positions.size());
    shape.positions.push_back({0, 0, bottom});
    shape.positions.push_back({0, 0, top});
    for (int s = 0; s < segments; ++s) {
      shape.triangles.push_back({south, index(0, s + 1), index(0, s)});
      shape.triangles.push_back({south + 1, index(rings - 1, s), index(rings - 1, s + 1)});
    }
  }
  return shape;
}

glm::vec3 around(double radius, double angle, double height) {
  return glm::vec3(static_cast<float>(radius * std::cos(angle)),
                   static_cast<float>(radius * std::sin(angle)), static_cast<float>(height));
}

}  // namespace

Shape box_shape(const glm::vec3& half) {
  Shape shape;
  for (int i = 0; i < 8; ++i) {
    shape.positions.push_back(half * glm::vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  }
  shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

Shape sphere_shape(float radius, int rings, int segments) {
  return revolve(
      rings, segments, true,
      [&](int r, double angle) {
        const double polar = kPi * (r + 1) / (rings + 1);
        return around(radius * std::sin(polar), angle, -radius * std::cos(polar));
      },
      -radius, radius);
}

Shape tube_shape(float radius, float half_length, int rings, int segments, bool closed) {
  return revolve(
      rings, segments, closed,
      [&](int r, double angle) {
        return around(radius, angle, half_length * (2.0 * r / (rings - 1) - 1.0));
      },
      -half_length, half_length);
}

Shape sheet_shape(float half, int n) {
  Shape shape;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      shape.positions.push_back({half * (2.0f * static_cast<float>(x) / static_cast<float>(n) - 1),
                                 half * (2.0f * static_cast<float>(y) / static_cast<float>(n) - 1),
                                 0.0f});
    }
  }
  const auto index = [&](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      shape.triangles.push_back({index(x, y), index(x + 1, y), index(x + 1, y + 1)});
      shape.triangles.push_back({index(x, y), index(x + 1, y + 1), index(x, y + 1)});
    }
  }
  return shape;
}

Shape limb_shape(float radius, float half_length, int rings, int segments, Random& random) {
  return revolve(
      rings, segments, true,
      [&](int r, double angle) {
        const double u = 2.0 * r / (rings - 1) - 1.0;
        const double girth =
            radius * (0.6 + 0.4 * std::cos(1.5 * u)) * (1 + 0.02 * random.uniform(-1.0, 1.0));
        return around(girth, angle, half_length * u);
      },
      -half_length * 1.02f, half_length * 1.02f);
}

Shape needle_shape(float radius, float half_length, int segments) {
  Shape shape = revolve(
      1, segments, true, [&](int, double angle) { return around(radius, angle, -half_length); },
      -half_length, half_length);
  return shape;
}

void append(Shape& to, const Shape& shape, const glm::vec3& offset) {
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  for (const glm::vec3& p : shape.positions) to.positions.push_back(p + offset);
  for (const glm::uvec3& t : shape.triangles) to.triangles.push_back(t + glm::uvec3(base));
}

}  // namespace elbowroom::test
