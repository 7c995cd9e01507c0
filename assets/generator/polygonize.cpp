// SPDX-License-Identifier: MIT
#include <cmath>
#include <unordered_map>

#include "assets/generator/surface.h"

namespace elbowroom::demo {

namespace {

constexpr int kBlock = 8;  // cells a side

// Kuhn's six tetrahedra of a cube about its diagonal, corners as bits x, y, z: neighbouring cubes
// agree on the diagonals of their shared face.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                   {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

}  // namespace

Surface polygonize(const BodyShape& shape, double cell) {
  const Vec3 low = shape.low();
  const glm::ivec3 blocks(glm::ceil((shape.high() - low) / (cell * kBlock)));
  const glm::ivec3 points = blocks * kBlock + 1;
  Surface surface;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_of_edge;  // looked up, never walked

  const auto place = [&](const glm::ivec3& i) { return low + cell * Vec3(i); };
  const auto index = [&](const glm::ivec3& i) {
    return (static_cast<std::uint64_t>(i.z) * static_cast<std::uint64_t>(points.y) +
            static_cast<std::uint64_t>(i.y)) *
               static_cast<std::uint64_t>(points.x) +
           static_cast<std::uint64_t>(i.x);
  };

  constexpr int kSide = kBlock + 1;
  std::vector<double> value(kSide * kSide * kSide);
  const auto local = [](int x, int y, int z) {
    return static_cast<std::size_t>((z * kSide + y) * kSide + x);
  };

  for (int bz = 0; bz < blocks.z; ++bz)
    for (int by = 0; by < blocks.y; ++by)
      for (int bx = 0; bx < blocks.x; ++bx) {
        const glm::ivec3 corner = glm::ivec3(bx, by, bz) * kBlock;
        // The shape's value may exceed the distance, so blocks are skipped with a wide margin.
        const double reach = 0.5 * std::sqrt(3.0) * cell * kBlock;
        if (std::abs(shape(place(corner) + Vec3(0.5 * cell * kBlock))) > 2.5 * reach) continue;
        for (int z = 0; z < kSide; ++z)
          for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
              double f = shape(place(corner + glm::ivec3(x, y, z)));
              // No grid point exactly on the surface: crossings stay inside edges.
              if (std::abs(f) < 1e-7) f = 1e-7;
              value[local(x, y, z)] = f;
            }
        for (int z = 0; z < kBlock; ++z)
          for (int y = 0; y < kBlock; ++y)
            for (int x = 0; x < kBlock; ++x) {
              double f[8];
              glm::ivec3 at[8];
              int inside = 0;
              for (int c = 0; c < 8; ++c) {
                const glm::ivec3 d(c & 1, (c >> 1) & 1, (c >> 2) & 1);
                f[c] = value[local(x + d.x, y + d.y, z + d.z)];
                at[c] = corner + glm::ivec3(x, y, z) + d;
                inside += f[c] < 0;
              }
              if (inside == 0 || inside == 8) continue;

              const auto crossing = [&](int a, int b) {
                if (a > b) std::swap(a, b);
                const std::uint64_t key = index(at[a]) * 8 + static_cast<std::uint64_t>(a ^ b);
                const auto [found, fresh] = vertex_of_edge.try_emplace(
                    key, static_cast<std::uint32_t>(surface.positions.size()));
                if (fresh) {
                  const double t = f[a] / (f[a] - f[b]);
                  surface.positions.push_back(glm::mix(place(at[a]), place(at[b]), t));
                }
                return found->second;
              };
              for (const auto& tet : kTetrahedra) {
                int in[4], out[4], ins = 0, outs = 0;
                for (const int c : tet) (f[c] < 0 ? in[ins++] : out[outs++]) = c;
                const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                  // Outside is where the field grows: from an inner to an outer corner.
                  const Vec3 &p = surface.positions[a], &q = surface.positions[b],
                             &r = surface.positions[c];
                  const Vec3 outward = Vec3(at[out[0]]) - Vec3(at[in[0]]);
                  if (glm::dot(glm::cross(q - p, r - p), outward) < 0) std::swap(b, c);
                  surface.triangles.push_back({a, b, c});
                };
                if (ins == 1) {
                  emit(crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[0], out[2]));
                } else if (ins == 3) {
                  emit(crossing(in[0], out[0]), crossing(in[1], out[0]), crossing(in[2], out[0]));
                } else if (ins == 2) {
                  const std::uint32_t a = crossing(in[0], out[0]), b = crossing(in[0], out[1]),
                                      c = crossing(in[1], out[1]), d = crossing(in[1], out[0]);
                  emit(a, b, c);
                  emit(a, c, d);
                }
              }
            }
      }
  return surface;
}

}  // namespace elbowroom::demo
