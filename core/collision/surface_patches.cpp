// SPDX-License-Identifier: MIT
#include "core/collision/surface_patches.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <utility>

namespace elbowroom {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (const std::int64_t v : c) {
      h ^= static_cast<std::uint64_t>(v);
      h *= 0xff51afd7ed558ccdull;
      h ^= h >> 33;
    }
    return static_cast<std::size_t>(h);
  }
};

Cell cell_of(const Vec3& p, const Vec3& origin, double size) {
  // Kept inside int64 for any finite place and size.
  const auto index = [size](double x) {
    return static_cast<std::int64_t>(std::clamp(std::floor(x / size), -4e18, 4e18));
  };
  return {index(p.x - origin.x), index(p.y - origin.y), index(p.z - origin.z)};
}

struct DisjointSets {
  std::vector<std::uint32_t> parent;
  explicit DisjointSets(std::size_t n) : parent(n) {
    std::iota(parent.begin(), parent.end(), std::uint32_t{0});
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  // The lower number leads, so that the first vertex of a place is its point.
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
};

Vec3 centroid(const WeldedSurface& s, const glm::uvec3& t) {
  return (s.points[t.x] + s.points[t.y] + s.points[t.z]) / 3.0;
}

// Patches by place alone: triangles of one group whose centroids share a cell.
Patches gather_by_place(const WeldedSurface& surface, std::span<const int> group, double size,
                        int most) {
  Patches patches;
  const std::size_t n = surface.triangles.size();
  patches.of_triangle.assign(n, 0);
  const Vec3 origin = surface.points.empty() ? Vec3(0.0) : surface.points.front();
  // The number of groups may itself be too large; at the last all share cells, and in the end one.
  for (int round = 0;; ++round, size *= 2) {
    std::map<std::pair<int, Cell>, int> numbers;
    bool fits = true;
    for (std::size_t i = 0; i < n && fits; ++i) {
      const Cell cell =
          round > 40 ? Cell{} : cell_of(centroid(surface, surface.triangles[i]), origin, size);
      const auto [at, fresh] =
          numbers.try_emplace({round > 20 ? 0 : group[i], cell}, static_cast<int>(numbers.size()));
      patches.of_triangle[i] = static_cast<std::uint16_t>(at->second);
      fits = !fresh || at->second < most;
    }
    if (fits) {
      patches.count = static_cast<int>(numbers.size());
      return patches;
    }
  }
}

}  // namespace

WeldedSurface weld(std::span<const Vec3> positions, std::span<const glm::uvec3> triangles,
                   double tolerance) {
  WeldedSurface surface;
  const std::size_t n = positions.size();
  const double size = std::max(2.0 * tolerance, std::numeric_limits<double>::min());
  const Vec3 origin = n == 0 ? Vec3(0.0) : positions[0];
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
  cells.reserve(n);
  DisjointSets sets(n);
  for (std::uint32_t v = 0; v < n; ++v) {
    // With cells twice as wide as the tolerance a neighbour is looked for only across the sides
    // that are nearer than it.
    const Vec3 shifted = positions[v] - Vec3(tolerance);
    const Cell low = cell_of(shifted, origin, size);
    const Cell high = cell_of(positions[v] + Vec3(tolerance), origin, size);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto found = cells.find({x, y, z});
          if (found == cells.end()) continue;
          for (const std::uint32_t other : found->second)
            if (glm::distance(positions[v], positions[other]) <= tolerance) sets.join(v, other);
        }
    // A vertex that stands exactly on an earlier one of its cell need not be found again.
    auto& cell = cells[cell_of(positions[v], origin, size)];
    const bool known = std::any_of(cell.begin(), cell.end(), [&](std::uint32_t other) {
      return positions[other] == positions[v];
    });
    if (known) continue;
    // A crowd this dense is far below the tolerance; looking at all of it would be quadratic.
    constexpr std::size_t kCrowd = 64;
    if (cell.size() >= kCrowd)
      sets.join(v, cell.front());
    else
      cell.push_back(v);
  }

  surface.point_of.resize(n);
  for (std::uint32_t v = 0; v < n; ++v) {
    const std::uint32_t leader = sets.find(v);
    if (leader == v) {
      surface.point_of[v] = static_cast<std::uint32_t>(surface.points.size());
      surface.points.push_back(positions[v]);
    } else {
      surface.point_of[v] = surface.point_of[leader];  // leaders are lower, so already numbered
    }
  }
  surface.triangles.reserve(triangles.size());
  for (const glm::uvec3& t : triangles)
    surface.triangles.emplace_back(surface.point_of[t.x], surface.point_of[t.y],
                                   surface.point_of[t.z]);

  surface.fan_begin.assign(surface.points.size() + 1, 0);
  for (const glm::uvec3& t : surface.triangles)
    for (int k = 0; k < 3; ++k) ++surface.fan_begin[t[k] + 1];
  for (std::size_t i = 1; i < surface.fan_begin.size(); ++i)
    surface.fan_begin[i] += surface.fan_begin[i - 1];
  surface.fan.resize(surface.fan_begin.back());
  std::vector<std::uint32_t> next(surface.fan_begin.begin(), surface.fan_begin.end() - 1);
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) surface.fan[next[surface.triangles[i][k]]++] = i;
  return surface;
}

Patches cut_into_patches(const WeldedSurface& surface, std::span<const int> group, double diameter,
                         int most) {
  Patches patches;
  const std::size_t n = surface.triangles.size();
  constexpr int kNone = -1;
  std::vector<int> number(n, kNone);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t seed = 0; seed < n; ++seed) {
    if (number[seed] != kNone) continue;
    if (patches.count == most) return gather_by_place(surface, group, diameter, most);
    const Vec3 centre = centroid(surface, surface.triangles[seed]);
    number[seed] = patches.count;
    queue.assign(1, seed);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const glm::uvec3& t = surface.triangles[queue[head]];
      for (int k = 0; k < 3; ++k)
        for (std::uint32_t f = surface.fan_begin[t[k]]; f < surface.fan_begin[t[k] + 1]; ++f) {
          const std::uint32_t other = surface.fan[f];
          if (number[other] != kNone || group[other] != group[seed]) continue;
          if (glm::distance(centroid(surface, surface.triangles[other]), centre) > 0.5 * diameter)
            continue;
          number[other] = patches.count;
          queue.push_back(other);
        }
    }
    ++patches.count;
  }
  patches.of_triangle.assign(number.begin(), number.end());
  return patches;
}

std::vector<double> distance_along(const WeldedSurface& surface,
                                   std::span<const std::uint32_t> sources, double limit) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> distance(surface.points.size(), kFar);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const std::uint32_t s : sources) {
    if (distance[s] == 0) continue;
    distance[s] = 0;
    queue.emplace(0.0, s);
  }
  while (!queue.empty()) {
    const auto [d, p] = queue.top();
    queue.pop();
    if (d > distance[p]) continue;
    for (std::uint32_t f = surface.fan_begin[p]; f < surface.fan_begin[p + 1]; ++f) {
      const glm::uvec3& t = surface.triangles[surface.fan[f]];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t other = t[k];
        const double reached = d + glm::distance(surface.points[p], surface.points[other]);
        if (reached <= limit && reached < distance[other]) {
          distance[other] = reached;
          queue.emplace(reached, other);
        }
      }
    }
  }
  return distance;
}

std::vector<int> connected_components(const WeldedSurface& surface) {
  DisjointSets sets(surface.points.size());
  for (const glm::uvec3& t : surface.triangles) sets.join(t.x, t.y), sets.join(t.x, t.z);
  std::vector<int> component(surface.points.size(), -1);
  int count = 0;
  for (std::uint32_t p = 0; p < surface.points.size(); ++p) {
    const std::uint32_t leader = sets.find(p);
    component[p] = leader == p ? count++ : component[leader];
  }
  return component;
}

}  // namespace elbowroom
