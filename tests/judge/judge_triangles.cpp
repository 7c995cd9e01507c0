// SPDX-License-Identifier: MIT
#include "tests/judge/judge_triangles.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <fcl/fcl.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace judge {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point point(const glm::dvec3& p) { return Point(p.x, p.y, p.z); }

// What is left of three corners: a triangle, or the segment that holds them if they are in line (of
// no length if they are one point).
struct Shape {
  bool flat = false;
  Kernel::Triangle_3 triangle;
  Kernel::Segment_3 segment;

  explicit Shape(const Corners& c) {
    const Point p[3] = {point(c[0]), point(c[1]), point(c[2])};
    flat = CGAL::collinear(p[0], p[1], p[2]);
    if (!flat) {
      triangle = Kernel::Triangle_3(p[0], p[1], p[2]);
    } else {
      // Of points in line the lexicographic ends are the segment's.
      const auto [least, most] = std::minmax_element(p, p + 3);
      segment = Kernel::Segment_3(*least, *most);
    }
  }
};

bool flat_meets(const Kernel::Segment_3& s, const Shape& other) {
  if (!other.flat) {
    return s.is_degenerate() ? other.triangle.has_on(s.source())
                             : CGAL::do_intersect(s, other.triangle);
  }
  const Kernel::Segment_3& o = other.segment;
  if (s.is_degenerate()) return o.is_degenerate() ? s.source() == o.source() : o.has_on(s.source());
  return o.is_degenerate() ? s.has_on(o.source()) : CGAL::do_intersect(s, o);
}

Box box_of(const glm::uvec3& t, const std::vector<glm::dvec3>& points) {
  Box box;
  for (int k = 0; k < 3; ++k) box.add(points[t[k]]);
  return box;
}

}  // namespace

bool triangles_meet(const Corners& a, const Corners& b) {
  const Shape sa(a), sb(b);
  if (sa.flat) return flat_meets(sa.segment, sb);
  if (sb.flat) return flat_meets(sb.segment, sa);
  return CGAL::do_intersect(sa.triangle, sb.triangle);
}

BoxTree::BoxTree(std::vector<glm::uvec3> triangles, const std::vector<glm::dvec3>& points)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<glm::dvec3> centres;
  for (const glm::uvec3& t : triangles_) {
    centres.push_back(points[t[0]] + points[t[1]] + points[t[2]]);
  }
  build(0, static_cast<int>(triangles_.size()), centres);
  boxes_.resize(triangles_.size());
  refit(points);
}

int BoxTree::build(int begin, int end, const std::vector<glm::dvec3>& centres) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  nodes_.back().begin = begin;
  nodes_.back().end = end;
  if (end - begin <= 4) return index;
  Box box;
  for (int i = begin; i < end; ++i)
    box.add(centres[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])]);
  const glm::dvec3 extent = box.high - box.low;
  const int axis =
      extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) {
                     return std::pair(centres[static_cast<std::size_t>(a)][axis], a) <
                            std::pair(centres[static_cast<std::size_t>(b)][axis], b);
                   });
  const int left = build(begin, middle, centres), right = build(middle, end, centres);
  nodes_[static_cast<std::size_t>(index)].left = left;
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

void BoxTree::refit(const std::vector<glm::dvec3>& points) {
  for (std::size_t i = 0; i < triangles_.size(); ++i) boxes_[i] = box_of(triangles_[i], points);
  // Children stand behind their parents.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    node.box = Box();
    if (node.left >= 0) {
      node.box.add(nodes_[static_cast<std::size_t>(node.left)].box);
      node.box.add(nodes_[static_cast<std::size_t>(node.right)].box);
    } else {
      for (int k = node.begin; k < node.end; ++k) {
        node.box.add(boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
      }
    }
  }
}

bool BoxTree::visit(const Box& box, const std::function<bool(int)>& visit) const {
  int stack[128];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
    if (!node.box.meets(box)) continue;
    if (node.left >= 0) {
      stack[depth++] = node.right;
      stack[depth++] = node.left;
      continue;
    }
    for (int k = node.begin; k < node.end; ++k) {
      const int triangle = order_[static_cast<std::size_t>(k)];
      if (boxes_[static_cast<std::size_t>(triangle)].meets(box) && visit(triangle)) return true;
    }
  }
  return false;
}

struct FclMesh::Model {
  fcl::BVHModel<fcl::AABB<double>> bvh;
};

namespace {
std::vector<fcl::Vector3<double>> fcl_points(const std::vector<glm::dvec3>& points) {
  std::vector<fcl::Vector3<double>> all;
  all.reserve(points.size());
  for (const glm::dvec3& p : points) all.emplace_back(p.x, p.y, p.z);
  return all;
}
}  // namespace

FclMesh::FclMesh(const std::vector<glm::uvec3>& triangles, const std::vector<glm::dvec3>& points)
    : model_(std::make_unique<Model>()) {
  std::vector<fcl::Triangle> all;
  for (const glm::uvec3& t : triangles) all.emplace_back(t[0], t[1], t[2]);
  model_->bvh.beginModel();
  model_->bvh.addSubModel(fcl_points(points), all);
  model_->bvh.endModel();
}
FclMesh::~FclMesh() = default;
FclMesh::FclMesh(FclMesh&&) noexcept = default;

void FclMesh::refit(const std::vector<glm::dvec3>& points) {
  model_->bvh.beginReplaceModel();
  model_->bvh.replaceSubModel(fcl_points(points));
  model_->bvh.endReplaceModel(true, true);
}

bool FclMesh::collides(const FclMesh& other) const {
  fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  const fcl::Transform3<double> same = fcl::Transform3<double>::Identity();
  return fcl::collide(&model_->bvh, same, &other.model_->bvh, same, request, result) > 0;
}

std::vector<int> pieces(const std::vector<glm::uvec3>& triangles,
                        const std::vector<glm::dvec3>& points, int& count) {
  std::map<std::tuple<double, double, double>, int> welded;
  std::vector<int> parent;
  const std::function<int(int)> root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      i = parent[static_cast<std::size_t>(i)] =
          parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
    }
    return i;
  };
  const auto corner = [&](unsigned index) {
    const glm::dvec3& p = points[index];
    const auto [at, fresh] =
        welded.emplace(std::tuple(p.x, p.y, p.z), static_cast<int>(parent.size()));
    if (fresh) parent.push_back(at->second);
    return at->second;
  };
  for (const glm::uvec3& t : triangles) {
    const int a = root(corner(t[0]));
    for (int k = 1; k < 3; ++k) parent[static_cast<std::size_t>(root(corner(t[k])))] = a;
  }
  std::map<int, int> numbers;
  std::vector<int> piece;
  for (const glm::uvec3& t : triangles) {
    piece.push_back(
        numbers.emplace(root(corner(t[0])), static_cast<int>(numbers.size())).first->second);
  }
  count = static_cast<int>(numbers.size());
  return piece;
}

double winding_number(const std::vector<glm::uvec3>& triangles,
                      const std::vector<glm::dvec3>& points, const glm::dvec3& p) {
  double sum = 0;
  for (const glm::uvec3& t : triangles) {
    const glm::dvec3 a = points[t[0]] - p, b = points[t[1]] - p, c = points[t[2]] - p;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    // Solid angle [van Oosterom and Strackee 1983].
    sum += std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                         glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (2 * 3.14159265358979323846);
}

}  // namespace judge
