// SPDX-License-Identifier: MIT
#include "core/collision/box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace elbowroom {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// From this depth on parts are halved, so that each level has at most an eighth of the triangles of
// the one above: kMaxDepth holds for any number of them.
constexpr int kHalvingDepth = 12;

struct Bounds {
  glm::vec3 low{kInfinity}, high{-kInfinity};
  void add(const Bounds& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  float area() const {
    const glm::vec3 d = high - low;
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

// Rounding outwards by at least, and little more than, one unit in the last place: what a number
// that was rounded once stands for lies within.
float down(float f) { return f - std::abs(f) * 0x1.0p-23f - std::numeric_limits<float>::min(); }
float up(float f) { return f + std::abs(f) * 0x1.0p-23f + std::numeric_limits<float>::min(); }
float up(double x) { return up(static_cast<float>(x)); }

// The triangle's box relative to the origin, which is a float: a difference is rounded once.
Bounds triangle_bounds(const glm::vec3& origin, std::span<const glm::vec3> positions,
                       const glm::uvec3& t) {
  const glm::vec3 &a = positions[t.x], &b = positions[t.y], &c = positions[t.z];
  Bounds bounds;
  for (int k = 0; k < 3; ++k) {
    bounds.low[k] = down(std::min(std::min(a[k], b[k]), c[k]) - origin[k]);
    bounds.high[k] = up(std::max(std::max(a[k], b[k]), c[k]) - origin[k]);
  }
  return bounds;
}

void set_center_half(const glm::vec3& low, const glm::vec3& high, float* center, float* half,
                     std::size_t stride) {
  for (int k = 0; k < 3; ++k) {
    const std::size_t at = static_cast<std::size_t>(k) * stride;
    const float c = 0.5f * (low[k] + high[k]);
    center[at] = c;
    half[at] = up(std::max(high[k] - c, c - low[k]));
  }
}

void set_slot(BoxTree::Node& node, int slot, const glm::vec3& low, const glm::vec3& high) {
  set_center_half(low, high, &node.center[0][slot], &node.half[0][slot], BoxTree::kWidth);
}

float girth(const BoxTree::Node& node, int slot) {
  return node.half[0][slot] + node.half[1][slot] + node.half[2][slot];
}

// Of a box of that girth and the node inside, whose boxes are set.
float shrinks(float whole, const BoxTree::Node& inside) {
  float sum = 0;
  for (int i = 0; i < inside.count; ++i) sum += girth(inside, i);
  return whole - sum / static_cast<float>(inside.count);
}

void set_shrinks(BoxTree& tree, BoxTree::Node& node, int slot) {
  const BoxTree::Ref ref = node.child[slot];
  node.shrinks[slot] = BoxTree::is_triangle(ref)
                           ? 0.0f
                           : shrinks(girth(node, slot), tree.nodes[static_cast<std::size_t>(ref)]);
}

void set_root(BoxTree& tree) {
  set_center_half(tree.low[0], tree.high[0], tree.root_center, tree.root_half, 1);
  tree.root_shrinks =
      shrinks(tree.root_half[0] + tree.root_half[1] + tree.root_half[2], tree.nodes.front());
}

void place_origin(BoxTree& tree, const glm::vec3& low, const glm::vec3& high) {
  tree.origin = Vec3(glm::vec3(0.5 * (Vec3(low) + Vec3(high))));
  tree.lower = Vec3(low) - tree.origin;
  tree.upper = Vec3(high) - tree.origin;
}

void place_origin(BoxTree& tree, std::span<const glm::vec3> positions,
                  std::span<const glm::uvec3> triangles) {
  Bounds all;
  for (const glm::uvec3& t : triangles)
    for (int i = 0; i < 3; ++i) all.add({positions[t[i]], positions[t[i]]});
  place_origin(tree, all.low, all.high);
}

using NormalSum = std::array<double, 6>;

// Larger parts bend too much for a slab to help, and cost too much to measure at every refit.
constexpr std::uint32_t kLargestSlab = 2048;

Vec3 triangle_normal(std::span<const glm::vec3> positions, const glm::uvec3& t) {
  const Vec3 a(positions[t.x]);
  return glm::cross(Vec3(positions[t.y]) - a, Vec3(positions[t.z]) - a);
}

// `unit` is the direction of n.
NormalSum normal_sum(const Vec3& n, const Vec3& unit) {
  return {unit.x * n.x, unit.y * n.y, unit.z * n.z, unit.x * n.y, unit.y * n.z, unit.z * n.x};
}

// The direction most normals of the sum share, whatever their signs: a few steps of power
// iteration. It need not be accurate: any direction gives a slab that holds.
Vec3 common_normal(const NormalSum& m) {
  Vec3 v(m[0] >= m[1] && m[0] >= m[2], m[1] > m[0] && m[1] >= m[2], m[2] > m[0] && m[2] > m[1]);
  for (int i = 0; i < 4; ++i) {
    const Vec3 next(m[0] * v.x + m[3] * v.y + m[5] * v.z, m[3] * v.x + m[1] * v.y + m[4] * v.z,
                    m[5] * v.x + m[4] * v.y + m[2] * v.z);
    const double length = glm::length(next);
    if (!(length > 0)) return Vec3(0.0);
    v = next / length;
  }
  return v;
}

void no_slab(BoxTree::Node::Slabs& slabs, int slot) {
  for (int k = 0; k < 3; ++k) slabs.normal[k][slot] = 0;
  slabs.middle[slot] = slabs.thickness[slot] = 0;
}

// Slab of some triangles across `normal`.
void set_slab(BoxTree::Node::Slabs& slabs, int slot, const BoxTree& tree, const Vec3& normal,
              std::span<const std::uint32_t> some, std::span<const glm::vec3> positions,
              std::span<const glm::uvec3> triangles) {
  const glm::vec3 n(normal);
  const Vec3 rounded(n);
  const double base = glm::dot(rounded, tree.origin);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  if (normal != Vec3(0.0)) {
    for (const std::uint32_t t : some) {
      const glm::uvec3& corners = triangles[t];
      const double h0 = glm::dot(rounded, Vec3(positions[corners.x])) - base;
      const double h1 = glm::dot(rounded, Vec3(positions[corners.y])) - base;
      const double h2 = glm::dot(rounded, Vec3(positions[corners.z])) - base;
      low = std::min(std::min(low, h0), std::min(h1, h2));
      high = std::max(std::max(high, h0), std::max(h1, h2));
    }
  } else {
    low = high = 0;
  }
  const auto middle = static_cast<float>(0.5 * (low + high));
  for (int k = 0; k < 3; ++k) slabs.normal[k][slot] = n[k];
  slabs.middle[slot] = middle;
  slabs.thickness[slot] =
      up(std::max(high - static_cast<double>(middle), static_cast<double>(middle) - low));
}

// The direction that some triangles' corners extend along most, across `normal`; 0 if there is
// none.
Vec3 long_direction(const Vec3& normal, std::span<const std::uint32_t> some,
                    std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
  const Vec3 first(positions[triangles[some.front()].x]);
  Vec3 sum(0.0);
  NormalSum squares{};
  for (const std::uint32_t t : some) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = Vec3(positions[triangles[t][i]]) - first;
      sum += p;
      const NormalSum own = normal_sum(p, p);
      for (std::size_t k = 0; k < 6; ++k) squares[k] += own[k];
    }
  }
  const Vec3 mean = sum / (3.0 * static_cast<double>(some.size()));
  const NormalSum whole = normal_sum(sum, mean);
  for (std::size_t k = 0; k < 6; ++k) squares[k] -= whole[k];
  const Vec3 direction = common_normal(squares);
  const Vec3 across = direction - glm::dot(direction, normal) * normal;
  const double length = glm::length(across);
  return length > 1e-6 ? across / length : Vec3(0.0);
}

// A second slab, across the first and along the triangles, if it is much thinner than the box is
// that way.
void set_second_slab(BoxTree::Node& node, int slot, const BoxTree& tree,
                     std::span<const std::uint32_t> some, std::span<const glm::vec3> positions,
                     std::span<const glm::uvec3> triangles) {
  constexpr float kThinner = 0.6f;
  BoxTree::Node::Slabs& second = node.slab[1];
  no_slab(second, slot);
  const auto& first = node.slab[0].normal;
  const Vec3 normal(first[0][slot], first[1][slot], first[2][slot]);
  if (normal == Vec3(0.0)) return;
  const Vec3 along = long_direction(normal, some, positions, triangles);
  const Vec3 across = glm::cross(normal, along);
  const double length = glm::length(across);
  if (!(length > 0.5)) return;
  set_slab(second, slot, tree, across / length, some, positions, triangles);
  float box = 0;
  for (int k = 0; k < 3; ++k) box += std::abs(second.normal[k][slot]) * node.half[k][slot];
  if (second.thickness[slot] < kThinner * box)
    node.slabs = 2;
  else
    no_slab(second, slot);
}

class Builder {
 public:
  Builder(BoxTree& tree, std::vector<Bounds> bounds) : tree_(tree), bounds_(std::move(bounds)) {
    order_.resize(bounds_.size());
    std::iota(order_.begin(), order_.end(), 0u);
  }

  void run() {
    make_node(0, order_.size(), 0);
    tree_.order = std::move(order_);
  }

 private:
  struct Part {
    std::size_t begin, end;
    float cost;  // what splitting it promises: area × triangles
  };

  float center(std::uint32_t triangle, int axis) const {
    const Bounds& b = bounds_[triangle];
    return 0.5f * b.low[axis] + 0.5f * b.high[axis];
  }

  Part part(std::size_t begin, std::size_t end) const {
    Bounds all;
    for (std::size_t i = begin; i < end; ++i) all.add(bounds_[order_[i]]);
    return {begin, end, all.area() * static_cast<float>(end - begin)};
  }

  // Halves at the median of the longest axis of the centres: for deep or hopeless parts.
  std::size_t split_at_median(std::size_t begin, std::size_t end, int axis) {
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + static_cast<std::ptrdiff_t>(begin),
                     order_.begin() + static_cast<std::ptrdiff_t>(middle),
                     order_.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const float ca = center(a, axis), cb = center(b, axis);
                       return ca != cb ? ca < cb : a < b;
                     });
    return middle;
  }

  // Surface area heuristic over 16 bins of the best axis.
  std::size_t split(std::size_t begin, std::size_t end, int depth) {
    glm::vec3 low(kInfinity), high(-kInfinity);
    for (std::size_t i = begin; i < end; ++i) {
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], center(order_[i], k));
        high[k] = std::max(high[k], center(order_[i], k));
      }
    }
    const glm::vec3 extent = high - low;
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (extent[k] > extent[longest]) longest = k;
    }
    if (depth >= kHalvingDepth || !(extent[longest] > 0))
      return split_at_median(begin, end, longest);

    constexpr int kBins = 16;
    float best_cost = kInfinity;
    int best_axis = -1, best_bin = 0;
    const auto bin_of = [&](std::uint32_t triangle, int axis) {
      const float u = (center(triangle, axis) - low[axis]) / extent[axis];
      return std::clamp(static_cast<int>(u * kBins), 0, kBins - 1);
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!(extent[axis] > 0)) continue;
      std::array<Bounds, kBins> bin;
      std::array<std::size_t, kBins> count{};
      for (std::size_t i = begin; i < end; ++i) {
        const auto b = static_cast<std::size_t>(bin_of(order_[i], axis));
        bin[b].add(bounds_[order_[i]]);
        ++count[b];
      }
      std::array<float, kBins> right{};
      Bounds all;
      std::size_t n = 0;
      for (std::size_t b = kBins; b-- > 1;) {
        all.add(bin[b]);
        n += count[b];
        right[b] = n ? all.area() * static_cast<float>(n) : 0.0f;
      }
      all = Bounds();
      n = 0;
      for (std::size_t b = 0; b + 1 < kBins; ++b) {
        all.add(bin[b]);
        n += count[b];
        if (n == 0 || n == end - begin) continue;
        const float cost = all.area() * static_cast<float>(n) + right[b + 1];
        if (cost < best_cost) {
          best_cost = cost;
          best_axis = axis;
          best_bin = static_cast<int>(b);
        }
      }
    }
    if (best_axis < 0) return split_at_median(begin, end, longest);
    const auto middle =
        std::stable_partition(order_.begin() + static_cast<std::ptrdiff_t>(begin),
                              order_.begin() + static_cast<std::ptrdiff_t>(end),
                              [&](std::uint32_t t) { return bin_of(t, best_axis) <= best_bin; });
    return static_cast<std::size_t>(middle - order_.begin());
  }

  BoxTree::Ref make_node(std::size_t begin, std::size_t end, int depth) {
    const std::size_t index = tree_.nodes.size();
    tree_.nodes.emplace_back();
    tree_.begin.push_back(static_cast<std::uint32_t>(begin));
    tree_.end.push_back(static_cast<std::uint32_t>(end));
    std::vector<Part> parts = {part(begin, end)};
    while (parts.size() < BoxTree::kWidth) {
      // Parts that fit one leaf node are split last, so that leaf nodes come out full.
      std::size_t pick = parts.size();
      bool pick_large = false;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t n = parts[i].end - parts[i].begin;
        if (n < 2) continue;
        const bool large = n > BoxTree::kWidth;
        // Deep down the largest part goes first whatever its cost: that bounds the depth.
        const auto urgency = [&](const Part& p) {
          return depth >= kHalvingDepth ? static_cast<float>(p.end - p.begin) : p.cost;
        };
        if (pick == parts.size() || (large && !pick_large) ||
            (large == pick_large && urgency(parts[i]) > urgency(parts[pick]))) {
          pick = i;
          pick_large = large;
        }
      }
      if (pick == parts.size()) break;
      if (!pick_large && end - begin > BoxTree::kWidth) break;
      const Part whole = parts[pick];
      const std::size_t middle = split(whole.begin, whole.end, depth);
      parts[pick] = part(whole.begin, middle);
      parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(pick) + 1, part(middle, whole.end));
    }
    tree_.nodes[index].count = static_cast<std::int32_t>(parts.size());
    for (std::size_t i = 0; i < BoxTree::kWidth; ++i) {
      BoxTree::Ref ref = 0;
      if (i < parts.size()) {
        ref = parts[i].end - parts[i].begin == 1
                  ? ~static_cast<BoxTree::Ref>(order_[parts[i].begin])
                  : make_node(parts[i].begin, parts[i].end, depth + 1);
      }
      tree_.nodes[index].child[i] = ref;
    }
    return static_cast<BoxTree::Ref>(index);
  }

  BoxTree& tree_;
  std::vector<Bounds> bounds_;
  std::vector<std::uint32_t> order_;
};

// Boxes and slabs of a tree whose shape stands.
void fit(BoxTree& tree, std::span<const glm::vec3> positions,
         std::span<const glm::uvec3> triangles) {
  place_origin(tree, positions, triangles);
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    BoxTree::Node& node = tree.nodes[n];
    Bounds all;
    NormalSum all_normals{};
    node.slabs = 1;
    for (int i = 0; i < BoxTree::kWidth; ++i) {
      if (i >= node.count) {
        for (int k = 0; k < 3; ++k) {
          node.center[k][i] = 0;
          node.half[k][i] = -1e30f;
        }
        node.shrinks[i] = 0;
        for (BoxTree::Node::Slabs& slabs : node.slab) no_slab(slabs, i);
        continue;
      }
      const BoxTree::Ref ref = node.child[i];
      Bounds b;
      NormalSum normals;
      if (BoxTree::is_triangle(ref)) {
        const std::uint32_t t = BoxTree::triangle_of(ref);
        b = triangle_bounds(glm::vec3(tree.origin), positions, triangles[t]);
        const Vec3 normal = triangle_normal(positions, triangles[t]);
        const double square = glm::dot(normal, normal);
        const Vec3 unit = square > 0 ? normal * (1 / std::sqrt(square)) : Vec3(0.0);
        normals = normal_sum(normal, unit);
        set_slot(node, i, b.low, b.high);
        set_slab(node.slab[0], i, tree, unit, {&t, 1}, positions, triangles);
        set_second_slab(node, i, tree, {&t, 1}, positions, triangles);
      } else {
        const auto child = static_cast<std::size_t>(ref);
        b.low = tree.low[child];
        b.high = tree.high[child];
        normals = tree.normals[child];
        const auto some = std::span<const std::uint32_t>(tree.order)
                              .subspan(tree.begin[child], tree.end[child] - tree.begin[child]);
        set_slot(node, i, b.low, b.high);
        set_slab(node.slab[0], i, tree,
                 some.size() <= kLargestSlab ? common_normal(normals) : Vec3(0.0), some, positions,
                 triangles);
        set_second_slab(node, i, tree, some, positions, triangles);
      }
      set_shrinks(tree, node, i);
      all.add(b);
      for (std::size_t k = 0; k < 6; ++k) all_normals[k] += normals[k];
    }
    tree.low[n] = all.low;
    tree.high[n] = all.high;
    tree.normals[n] = all_normals;
  }
  set_root(tree);
}

}  // namespace

BoxTree build_box_tree(std::span<const glm::vec3> positions,
                       std::span<const glm::uvec3> triangles) {
  BoxTree tree;
  if (triangles.empty()) return tree;
  place_origin(tree, positions, triangles);
  std::vector<Bounds> bounds(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    bounds[i] = triangle_bounds(glm::vec3(tree.origin), positions, triangles[i]);
  }
  Builder(tree, std::move(bounds)).run();
  tree.nodes.shrink_to_fit();
  tree.low.resize(tree.nodes.size());
  tree.high.resize(tree.nodes.size());
  tree.normals.resize(tree.nodes.size());
  fit(tree, positions, triangles);
  return tree;
}

void refit_box_tree(BoxTree& tree, const glm::vec3& low, const glm::vec3& high,
                    std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
  if (tree.empty()) return;
  place_origin(tree, low, high);
  const glm::vec3 origin(tree.origin);
  const bool has_slabs = !tree.was_refit;
  tree.was_refit = true;
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    BoxTree::Node& node = tree.nodes[n];
    Bounds all;
    node.slabs = 1;
    for (int i = 0; i < node.count; ++i) {
      const BoxTree::Ref ref = node.child[i];
      Bounds b;
      if (BoxTree::is_triangle(ref)) {
        b = triangle_bounds(origin, positions, triangles[BoxTree::triangle_of(ref)]);
      } else {
        const auto child = static_cast<std::size_t>(ref);
        b.low = tree.low[child];
        b.high = tree.high[child];
      }
      if (has_slabs)
        for (BoxTree::Node::Slabs& slabs : node.slab) no_slab(slabs, i);
      set_slot(node, i, b.low, b.high);
      set_shrinks(tree, node, i);
      all.add(b);
    }
    tree.low[n] = all.low;
    tree.high[n] = all.high;
  }
  set_root(tree);
}

}  // namespace elbowroom
