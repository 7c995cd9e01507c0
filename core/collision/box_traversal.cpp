// SPDX-License-Identifier: MIT
#include "core/collision/box_traversal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/collision/box_traversal.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef ELBOWROOM_BOX_TRAVERSAL_ONCE
#define ELBOWROOM_BOX_TRAVERSAL_ONCE
namespace elbowroom {
namespace {

struct Box {
  float center[3], half[3];
  struct Slab {
    float normal[3], middle, thickness;
  };
  Slab slab[2];
  int slabs;      // of them in use
  int long_axis;  // one that it is much longer along than along the others, or -1
};

// What it takes to bring a box of the other tree into this tree's local frame.
struct Frame {
  const BoxTree* tree;
  float r[3][3], abs_r[3][3];  // this_from_other, [row][column]
  float t[3];                  // the other's origin
};

// A direction in this tree's frame and in the other's.
struct Axis {
  float here[3], abs_here[3], abs_there[3];
};

struct Entry {
  BoxTree::Ref open;      // node of tree `side` whose children are tested
  BoxTree::Ref against;   // node or triangle of the other tree
  Box box;                // of `against`, in its own frame
  float shrinks;          // of `box`
  float bound;            // lower bound of the distance; visit_closest_pairs only
  std::uint64_t classes;  // of patches, of `against` (patch_regions.h)
  int side;
};

// Every pop pushes at most 16 and goes one level down in one of the trees.
constexpr int kStack = 2 * BoxTree::kMaxDepth * BoxTree::kWidth + BoxTree::kWidth;

struct Pair {
  Frame frame[2];
  const std::uint64_t* classes[2];  // of patches, by box; both null: nothing is allowed
  std::uint64_t all_classes[2];
  double slack;  // more than all rounding of a test, and R's distance from a rotation
  bool aligned;  // the trees' axes are the same, and there are no slabs: two pieces of skin
};

void set_frame(Frame& frame, const BoxTree& tree, const Mat3& rotation, const Vec3& origin) {
  frame.tree = &tree;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      frame.r[i][j] = static_cast<float>(rotation[j][i]);
      frame.abs_r[i][j] = std::abs(frame.r[i][j]);
    }
    frame.t[i] = static_cast<float>(origin[i]);
  }
}

// False if spheres around the two meshes are farther apart than `distance`.
bool set_pair(Pair& pair, const BoxTree& a, const BoxTree& b, const RigidTransform& a_from_b,
              double distance, const PatchRegions* regions) {
  const Vec3 offset = a_from_b * b.origin - a.origin;
  const double reach = a.radius() + b.radius();
  const double length = glm::length(offset);
  // Translations far larger than the meshes carry rounding of their own.
  const double coarse =
      glm::length(a_from_b.translation) + glm::length(a.origin) + glm::length(b.origin);
  const Vec3 &x = a_from_b.rotation[0], &y = a_from_b.rotation[1], &z = a_from_b.rotation[2];
  double defect = std::max(
      {std::abs(glm::dot(x, x) - 1), std::abs(glm::dot(y, y) - 1), std::abs(glm::dot(z, z) - 1)});
  defect = std::max(
      {defect, std::abs(glm::dot(x, y)), std::abs(glm::dot(y, z)), std::abs(glm::dot(z, x))});
  if (length > (reach + distance) * (1 + 1e-9) + 1e-14 * coarse + 4 * defect * (reach + coarse)) {
    return false;
  }
  pair.aligned = a.was_refit && b.was_refit && a_from_b.rotation == Mat3(1.0);
  const bool fit = regions && regions->fit(a, b);
  pair.classes[0] = fit ? regions->of_a.data() : nullptr;
  pair.classes[1] = fit ? regions->of_b.data() : nullptr;
  pair.all_classes[0] = fit ? regions->all_a : ~std::uint64_t{0};
  pair.all_classes[1] = fit ? regions->all_b : ~std::uint64_t{0};
  const Mat3 back = glm::transpose(a_from_b.rotation);
  set_frame(pair.frame[0], a, a_from_b.rotation, offset);
  set_frame(pair.frame[1], b, back, -(back * offset));
  // The longest test, of a slab, rounds about 15 times by 2^-24 of numbers no larger than length +
  // reach: 0.9e-6 of that. Twice as much is allowed for.
  pair.slack =
      2e-6 * (length + reach) + 1e-14 * coarse + 4 * defect * (length + reach + coarse) + 1e-36;
  return true;
}

// The distance as a float not below it. Infinity is a distance too.
float widened(double distance, double slack) {
  const double sum = distance + slack;
  const auto f = static_cast<float>(sum);
  return static_cast<double>(f) < sum ? std::nextafter(f, std::numeric_limits<float>::infinity())
                                      : f;
}

}  // namespace
}  // namespace elbowroom
#endif  // ELBOWROOM_BOX_TRAVERSAL_ONCE

HWY_BEFORE_NAMESPACE();
namespace elbowroom {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, BoxTree::kWidth>;
using Vector = hn::Vec<Lanes>;

// The box's slab in this tree's frame, and how far each of 16 boxes is from it.
struct SlabHere {
  float normal[3], middle, thickness;
};

HWY_INLINE SlabHere slab_here(const Frame& f, const Box::Slab& slab) {
  SlabHere here;
  here.middle = slab.middle;
  here.thickness = slab.thickness;
  for (int i = 0; i < 3; ++i) {
    here.normal[i] =
        f.r[i][0] * slab.normal[0] + f.r[i][1] * slab.normal[1] + f.r[i][2] * slab.normal[2];
    here.middle += here.normal[i] * f.t[i];
  }
  return here;
}

HWY_INLINE Vector gap_from_slab(const BoxTree::Node& node, int first, const Vector half[3],
                                const SlabHere& slab) {
  const Lanes d;
  const Vector along =
      hn::Add(hn::Add(hn::Mul(hn::Load(d, node.center[0] + first), hn::Set(d, slab.normal[0])),
                      hn::Mul(hn::Load(d, node.center[1] + first), hn::Set(d, slab.normal[1]))),
              hn::Mul(hn::Load(d, node.center[2] + first), hn::Set(d, slab.normal[2])));
  const Vector span = hn::Add(hn::Add(hn::Mul(half[0], hn::Set(d, std::abs(slab.normal[0]))),
                                      hn::Mul(half[1], hn::Set(d, std::abs(slab.normal[1])))),
                              hn::Mul(half[2], hn::Set(d, std::abs(slab.normal[2]))));
  return hn::Sub(hn::Abs(hn::Sub(along, hn::Set(d, slab.middle))),
                 hn::Add(span, hn::Set(d, slab.thickness)));
}

// How far the box, whose centre in this frame is c, is from the slabs of 16.
HWY_INLINE Vector gap_from_slabs(const BoxTree::Node::Slabs& slabs, int first, const Frame& f,
                                 const Box& box, const float c[3]) {
  const Lanes d;
  const Vector n[3] = {hn::Load(d, slabs.normal[0] + first), hn::Load(d, slabs.normal[1] + first),
                       hn::Load(d, slabs.normal[2] + first)};
  Vector span = hn::Load(d, slabs.thickness + first);
  for (int j = 0; j < 3; ++j) {
    const Vector dot =
        hn::Add(hn::Add(hn::Mul(n[0], hn::Set(d, f.r[0][j])), hn::Mul(n[1], hn::Set(d, f.r[1][j]))),
                hn::Mul(n[2], hn::Set(d, f.r[2][j])));
    span = hn::Add(span, hn::Mul(hn::Abs(dot), hn::Set(d, box.half[j])));
  }
  const Vector along =
      hn::Add(hn::Add(hn::Mul(n[0], hn::Set(d, c[0])), hn::Mul(n[1], hn::Set(d, c[1]))),
              hn::Mul(n[2], hn::Set(d, c[2])));
  return hn::Sub(hn::Abs(hn::Sub(along, hn::Load(d, slabs.middle + first))), span);
}

// The six face normals, the normals of the slabs of both sides, and of the nine axes across pairs
// of edges those of the box's long axis if it has one: rods pass each other there. All nine,
// measured, save as much work below as they cost here.
//
// Bit i: the box of child i is not surely farther than `margin` from `box`. `bounds` gets a lower
// bound of each child's distance with kBound; without, its largest gap along any face's normal:
// the lower, the deeper the two boxes lie in one another.
template <bool kBound>
HWY_INLINE std::uint32_t overlaps(const BoxTree::Node& node, const Frame& f, const Box& box,
                                  float margin, float slack, const Axis* axis, float* bounds) {
  const Lanes d;
  float c[3], reach[3];
  for (int i = 0; i < 3; ++i) {
    c[i] =
        f.r[i][0] * box.center[0] + f.r[i][1] * box.center[1] + f.r[i][2] * box.center[2] + f.t[i];
    reach[i] =
        f.abs_r[i][0] * box.half[0] + f.abs_r[i][1] * box.half[1] + f.abs_r[i][2] * box.half[2];
  }
  const SlabHere slab = slab_here(f, box.slab[0]);
  SlabHere second;
  if (box.slabs > 1) second = slab_here(f, box.slab[1]);
  std::uint32_t bits = 0;
  const int step = static_cast<int>(hn::Lanes(d));
  for (int first = 0; first < node.count; first += step) {
    Vector dist[3], half[3], gap[3];
    for (int i = 0; i < 3; ++i) {
      dist[i] = hn::Sub(hn::Load(d, node.center[i] + first), hn::Set(d, c[i]));
      half[i] = hn::Load(d, node.half[i] + first);
      gap[i] = hn::Sub(hn::Abs(dist[i]), hn::Add(half[i], hn::Set(d, reach[i])));
    }
    const Vector limit = hn::Set(d, margin);
    // A separating axis must show itself: comparisons with NaN keep the pair.
    // The slabs of `box` across all of these boxes.
    Vector slab_gap = gap_from_slab(node, first, half, slab);
    if (box.slabs > 1) slab_gap = hn::Max(slab_gap, gap_from_slab(node, first, half, second));
    const Vector widest = hn::Max(hn::Max(gap[0], gap[1]), hn::Max(gap[2], slab_gap));
    auto apart = hn::Gt(widest, limit);
    if (!kBound && hn::AllTrue(d, apart)) continue;
    Vector other_gap[3];
    for (int j = 0; j < 3; ++j) {
      const Vector along = hn::Add(
          hn::Add(hn::Mul(dist[0], hn::Set(d, f.r[0][j])), hn::Mul(dist[1], hn::Set(d, f.r[1][j]))),
          hn::Mul(dist[2], hn::Set(d, f.r[2][j])));
      const Vector span = hn::Add(hn::Add(hn::Mul(half[0], hn::Set(d, f.abs_r[0][j])),
                                          hn::Mul(half[1], hn::Set(d, f.abs_r[1][j]))),
                                  hn::Mul(half[2], hn::Set(d, f.abs_r[2][j])));
      other_gap[j] = hn::Sub(hn::Abs(along), hn::Add(span, hn::Set(d, box.half[j])));
    }
    // `box` across each of their slabs.
    Vector own_gap = gap_from_slabs(node.slab[0], first, f, box, c);
    if (node.slabs > 1) own_gap = hn::Max(own_gap, gap_from_slabs(node.slab[1], first, f, box, c));
    const Vector widest_of_other =
        hn::Max(hn::Max(other_gap[0], other_gap[1]), hn::Max(other_gap[2], own_gap));
    apart = hn::Or(apart, hn::Gt(widest_of_other, limit));
    if constexpr (kBound) {
      const Vector zero = hn::Zero(d);
      Vector square[2] = {zero, zero};
      for (int i = 0; i < 3; ++i) {
        const Vector g = hn::Max(gap[i], zero), h = hn::Max(other_gap[i], zero);
        square[0] = hn::Add(square[0], hn::Mul(g, g));
        square[1] = hn::Add(square[1], hn::Mul(h, h));
      }
      const Vector along = hn::Add(hn::Add(hn::Mul(dist[0], hn::Set(d, axis->here[0])),
                                           hn::Mul(dist[1], hn::Set(d, axis->here[1]))),
                                   hn::Mul(dist[2], hn::Set(d, axis->here[2])));
      const Vector span = hn::Add(hn::Add(hn::Mul(half[0], hn::Set(d, axis->abs_here[0])),
                                          hn::Mul(half[1], hn::Set(d, axis->abs_here[1]))),
                                  hn::Mul(half[2], hn::Set(d, axis->abs_here[2])));
      const float constant = axis->abs_there[0] * box.half[0] + axis->abs_there[1] * box.half[1] +
                             axis->abs_there[2] * box.half[2];
      const Vector axis_gap = hn::Sub(hn::Abs(along), hn::Add(span, hn::Set(d, constant)));
      const Vector bound =
          hn::Sub(hn::Max(hn::Max(hn::Sqrt(hn::Max(square[0], square[1])), axis_gap),
                          hn::Max(slab_gap, own_gap)),
                  hn::Set(d, slack));
      hn::Store(bound, d, bounds + first);
      apart = hn::Or(apart, hn::Gt(bound, limit));
    } else {
      if (hn::AllTrue(d, apart)) continue;
      if (box.long_axis >= 0) {
        // Across this tree's axis k and the box's long one, e: k × e is no longer than 1, so a gap
        // along it is no larger than the one along its unit vector.
        const int e = box.long_axis, e1 = (e + 1) % 3, e2 = (e + 2) % 3;
        for (int k = 0; k < 3; ++k) {
          const int m = (k + 1) % 3, n = (k + 2) % 3;
          const float x = -f.r[n][e], y = f.r[m][e];
          const float own = box.half[e1] * std::abs(x * f.r[m][e1] + y * f.r[n][e1]) +
                            box.half[e2] * std::abs(x * f.r[m][e2] + y * f.r[n][e2]);
          const Vector along =
              hn::Add(hn::Mul(dist[m], hn::Set(d, x)), hn::Mul(dist[n], hn::Set(d, y)));
          const Vector span = hn::Add(hn::Mul(half[m], hn::Set(d, std::abs(x))),
                                      hn::Mul(half[n], hn::Set(d, std::abs(y))));
          apart =
              hn::Or(apart, hn::Gt(hn::Sub(hn::Abs(along), hn::Add(span, hn::Set(d, own))), limit));
        }
        if (hn::AllTrue(d, apart)) continue;
      }
      hn::Store(hn::Max(widest, widest_of_other), d, bounds + first);
    }
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::Not(apart), bytes);
    bits |= (static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8)
            << first;
  }
  return bits & ((1u << node.count) - 1u);
}

// The same where the axes of both trees are the same and boxes are all there is.
HWY_INLINE std::uint32_t overlaps_aligned(const BoxTree::Node& node, const Frame& f, const Box& box,
                                          float margin, float* gaps) {
  const Lanes d;
  std::uint32_t bits = 0;
  const int step = static_cast<int>(hn::Lanes(d));
  for (int first = 0; first < node.count; first += step) {
    Vector widest = hn::Set(d, -std::numeric_limits<float>::infinity());
    for (int i = 0; i < 3; ++i) {
      const Vector dist =
          hn::Sub(hn::Load(d, node.center[i] + first), hn::Set(d, box.center[i] + f.t[i]));
      const Vector reach = hn::Add(hn::Load(d, node.half[i] + first), hn::Set(d, box.half[i]));
      widest = hn::Max(widest, hn::Sub(hn::Abs(dist), reach));
    }
    // A separating axis must show itself: comparisons with NaN keep the pair.
    const auto apart = hn::Gt(widest, hn::Set(d, margin));
    if (hn::AllTrue(d, apart)) continue;
    hn::Store(widest, d, gaps + first);
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::Not(apart), bytes);
    bits |= (static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8)
            << first;
  }
  return bits & ((1u << node.count) - 1u);
}

HWY_INLINE void find_long_axis(Box& box) {
  box.long_axis = -1;
  for (int i = 0; i < 3; ++i)
    if (box.half[i] > 3 * std::max(box.half[(i + 1) % 3], box.half[(i + 2) % 3])) box.long_axis = i;
}

HWY_INLINE void root_entry(const Pair& pair, Entry& entry) {
  const BoxTree &a = *pair.frame[0].tree, &b = *pair.frame[1].tree;
  entry.side = a.root_shrinks >= b.root_shrinks ? 0 : 1;
  const BoxTree& other = entry.side == 0 ? b : a;
  entry.open = 0;
  entry.against = 0;
  for (int k = 0; k < 3; ++k) {
    entry.box.center[k] = other.root_center[k];
    entry.box.half[k] = other.root_half[k];
    entry.box.slab[0].normal[k] = 0;
  }
  entry.box.slab[0].middle = entry.box.slab[0].thickness = 0;
  entry.box.slabs = 1;
  find_long_axis(entry.box);
  entry.shrinks = other.root_shrinks;
  entry.bound = 0;
  entry.classes = pair.all_classes[1 - entry.side];
}

HWY_INLINE void child_box(const BoxTree::Node& node, int i, Box& box) {
  for (int k = 0; k < 3; ++k) {
    box.center[k] = node.center[k][i];
    box.half[k] = node.half[k][i];
  }
  box.slabs = node.slabs;
  for (int s = 0; s < node.slabs; ++s) {
    for (int k = 0; k < 3; ++k) box.slab[s].normal[k] = node.slab[s].normal[k][i];
    box.slab[s].middle = node.slab[s].middle[i];
    box.slab[s].thickness = node.slab[s].thickness[i];
  }
  find_long_axis(box);
}

// Of the children in `bits`, those that hold more than allowed pairs with the entry's box.
HWY_INLINE std::uint32_t not_allowed(const Pair& pair, const Entry& entry, std::uint32_t bits) {
  const std::uint64_t* classes = pair.classes[entry.side];
  if (!classes) return bits;
  classes += static_cast<std::size_t>(entry.open) * BoxTree::kWidth;
  std::uint32_t left = 0;
  for (; bits != 0; bits &= bits - 1)
    if (classes[__builtin_ctz(bits)] & entry.classes) left |= bits & (~bits + 1);
  return left;
}

// The next test for child i of `node` against what `from` holds.
HWY_INLINE void descend(const Pair& pair, const BoxTree::Node& node, int i, const Entry& from,
                        Entry& to) {
  const BoxTree::Ref child = node.child[i];
  // Open the one that shrinks more; a triangle cannot be opened.
  if (BoxTree::is_triangle(from.against) ||
      (!BoxTree::is_triangle(child) && node.shrinks[i] >= from.shrinks)) {
    to.open = child;
    to.against = from.against;
    to.box = from.box;
    to.shrinks = from.shrinks;
    to.side = from.side;
    to.classes = from.classes;
  } else {
    to.open = from.against;
    to.against = child;
    child_box(node, i, to.box);
    to.shrinks = node.shrinks[i];
    to.side = 1 - from.side;
    const std::uint64_t* classes = pair.classes[from.side];
    to.classes = classes ? classes[static_cast<std::size_t>(from.open) * BoxTree::kWidth +
                                   static_cast<std::size_t>(i)]
                         : ~std::uint64_t{0};
  }
}

// `axis` is in a's frame.
HWY_INLINE Axis axis_in(const Frame& frame, int side, const Vec3& axis) {
  Axis out;
  for (int i = 0; i < 3; ++i) {
    // Frame of side 0 holds a_from_b, of side 1 its transpose.
    float there = 0;
    for (int j = 0; j < 3; ++j) {
      there += static_cast<float>(axis[j]) * (side == 0 ? frame.r[j][i] : frame.r[i][j]);
    }
    const auto here = static_cast<float>(axis[i]);
    out.here[i] = side == 0 ? here : there;
    out.abs_here[i] = std::abs(out.here[i]);
    out.abs_there[i] = std::abs(side == 0 ? there : here);
  }
  return out;
}

bool VisitClose(const Pair& pair, double distance, PairVisitor visitor, void* context,
                Apart& apart) {
  const float margin = widened(distance, pair.slack);
  Entry stack[kStack];
  int count = 1;
  root_entry(pair, stack[0]);
  // That the box of one is apart from all boxes of the other's root keeps these outside of it, but
  // not the one out of what these surround.
  bool root = true;
  while (count > 0) {
    const Entry entry = stack[--count];
    const Frame& frame = pair.frame[entry.side];
    const BoxTree::Node& node = frame.tree->nodes[static_cast<std::size_t>(entry.open)];
    alignas(64) float gaps[BoxTree::kWidth];
    std::uint32_t bits = pair.aligned
                             ? overlaps_aligned(node, frame, entry.box, margin, gaps)
                             : overlaps<false>(node, frame, entry.box, margin, 0.0f, nullptr, gaps);
    if (root && bits == 0) (entry.side == 0 ? apart.a_outside_b : apart.b_outside_a) = true;
    root = false;
    bits = not_allowed(pair, entry, bits);
    std::uint32_t many[BoxTree::kWidth];
    int leaves = 0, deepest = count;
    float deepest_gap = std::numeric_limits<float>::infinity(), deepest_leaf = deepest_gap;
    const bool against_triangle = BoxTree::is_triangle(entry.against);
    while (bits != 0) {
      const int i = __builtin_ctz(bits);
      bits &= bits - 1;
      if (against_triangle && BoxTree::is_triangle(node.child[i])) {
        many[leaves++] = BoxTree::triangle_of(node.child[i]);
        if (gaps[i] < deepest_leaf) {
          deepest_leaf = gaps[i];
          std::swap(many[0], many[leaves - 1]);
        }
      } else {
        if (gaps[i] < deepest_gap) {
          deepest_gap = gaps[i];
          deepest = count;
        }
        descend(pair, node, i, entry, stack[count++]);
      }
    }
    // The deepest pair goes on top, and first: surfaces that cross are found soonest there.
    if (deepest + 1 < count) std::swap(stack[deepest], stack[count - 1]);
    if (leaves > 0 &&
        visitor(context, BoxTree::triangle_of(entry.against), many, leaves, entry.side == 1)) {
      return true;
    }
  }
  return false;
}

bool VisitClosest(const Pair& pair, const ClosestSoFar& so_far, PairVisitor visitor,
                  void* context) {
  const float slack = widened(0, pair.slack);
  Entry stack[kStack];
  int count = 1;
  root_entry(pair, stack[0]);
  while (count > 0) {
    const Entry entry = stack[--count];
    const float margin = widened(so_far.distance, pair.slack);
    if (entry.bound > margin) continue;
    const Frame& frame = pair.frame[entry.side];
    const BoxTree::Node& node = frame.tree->nodes[static_cast<std::size_t>(entry.open)];
    alignas(64) float bounds[BoxTree::kWidth];
    const Axis axis = axis_in(frame, entry.side, so_far.axis);
    std::uint32_t bits = overlaps<true>(node, frame, entry.box, margin, slack, &axis, bounds);
    bits = not_allowed(pair, entry, bits);
    const bool against_triangle = BoxTree::is_triangle(entry.against);
    // Nearest first: leaves are visited in that order, entries pushed so that the nearest is on
    // top.
    int order[BoxTree::kWidth];
    int n = 0;
    while (bits != 0) {
      const int i = __builtin_ctz(bits);
      bits &= bits - 1;
      int at = n++;
      while (at > 0 && bounds[order[at - 1]] > bounds[i]) {
        order[at] = order[at - 1];
        --at;
      }
      order[at] = i;
    }
    if (against_triangle) {
      for (int k = 0; k < n; ++k) {
        const BoxTree::Ref child = node.child[order[k]];
        if (!BoxTree::is_triangle(child)) continue;
        if (bounds[order[k]] > widened(so_far.distance, pair.slack)) break;
        const std::uint32_t many = BoxTree::triangle_of(child);
        if (visitor(context, BoxTree::triangle_of(entry.against), &many, 1, entry.side == 1)) {
          return true;
        }
      }
    }
    for (int k = n; k-- > 0;) {
      if (against_triangle && BoxTree::is_triangle(node.child[order[k]])) continue;
      descend(pair, node, order[k], entry, stack[count]);
      stack[count++].bound = bounds[order[k]];
    }
  }
  return false;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace elbowroom
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace elbowroom {

HWY_EXPORT(VisitClose);
HWY_EXPORT(VisitClosest);

bool is_finite(const RigidTransform& t) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(t.translation[i])) return false;
    for (int j = 0; j < 3; ++j) {
      if (!std::isfinite(t.rotation[i][j])) return false;
    }
  }
  return true;
}

bool visit_close_pairs(const BoxTree& a, const BoxTree& b, const RigidTransform& a_from_b,
                       double distance, const PatchRegions* regions, PairVisitor visitor,
                       void* context, Apart* apart) {
  Apart seen{true, true};
  Pair pair;
  bool stopped = false;
  if (!a.empty() && !b.empty() && set_pair(pair, a, b, a_from_b, distance, regions)) {
    seen = {};
    stopped = HWY_DYNAMIC_DISPATCH(VisitClose)(pair, distance, visitor, context, seen);
  }
  if (apart) *apart = seen;
  return stopped;
}

bool visit_closest_pairs(const BoxTree& a, const BoxTree& b, const RigidTransform& a_from_b,
                         const ClosestSoFar& so_far, const PatchRegions* regions,
                         PairVisitor visitor, void* context) {
  Pair pair;
  if (a.empty() || b.empty() || !set_pair(pair, a, b, a_from_b, so_far.distance, regions)) {
    return false;
  }
  return HWY_DYNAMIC_DISPATCH(VisitClosest)(pair, so_far, visitor, context);
}

}  // namespace elbowroom
#endif  // HWY_ONCE
