// SPDX-License-Identifier: MIT
// Do two sets of triangles meet? Boxes first, then CGAL's exact predicates on the doubles as they
// are; FCL on the same triangles says it a second time, and where the two differ the exact one
// holds.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace judge {

using Corners = std::array<glm::dvec3, 3>;

// True if the closed triangles share a point; needles and points are taken as what they are. Exact.
bool triangles_meet(const Corners& a, const Corners& b);

struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Box& box) {
    add(box.low);
    add(box.high);
  }
  bool meets(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
           other.low.y <= high.y && low.z <= other.high.z && other.low.z <= high.z;
  }
  bool holds(const glm::dvec3& p) const { return Box{p, p}.meets(*this); }
};

// A tree of boxes over triangles whose points may move: refit after each move.
class BoxTree {
 public:
  // `triangles` index into `points`.
  BoxTree(std::vector<glm::uvec3> triangles, const std::vector<glm::dvec3>& points);
  void refit(const std::vector<glm::dvec3>& points);
  // Calls visit(triangle) for each triangle whose box meets `box`, until it returns true.
  bool visit(const Box& box, const std::function<bool(int)>& visit) const;
  const Box& bounds() const { return nodes_.front().box; }
  const std::vector<glm::uvec3>& triangles() const { return triangles_; }

 private:
  struct Node {
    Box box;
    int left = -1, right = -1;  // leaf: left = -1
    int begin = 0, end = 0;     // leaf: in order_
  };
  int build(int begin, int end, const std::vector<glm::dvec3>& centres);

  std::vector<glm::uvec3> triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  std::vector<Box> boxes_;  // by triangle
};

// The same triangles in FCL.
class FclMesh {
 public:
  FclMesh(const std::vector<glm::uvec3>& triangles, const std::vector<glm::dvec3>& points);
  ~FclMesh();
  FclMesh(FclMesh&&) noexcept;
  void refit(const std::vector<glm::dvec3>& points);
  // FCL's verdict; both meshes in one space.
  bool collides(const FclMesh& other) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

// Pieces that hang together through corners at the same place: by triangle the number of its piece.
std::vector<int> pieces(const std::vector<glm::uvec3>& triangles,
                        const std::vector<glm::dvec3>& points, int& count);

// How many times the triangles wrap round p, counterclockwise seen from outside positive: 1 inside
// a closed surface, 0 outside, between for open ones [Jacobson et al. 2013].
double winding_number(const std::vector<glm::uvec3>& triangles,
                      const std::vector<glm::dvec3>& points, const glm::dvec3& p);

}  // namespace judge
