// SPDX-License-Identifier: MIT
#include "tests/oracle/mesh_pair/judge.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

namespace elbowroom::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using FclModel = fcl::BVHModel<fcl::OBBRSS<double>>;

Point to_point(const Vec3& p) { return Point(p.x, p.y, p.z); }

struct Component {
  std::vector<Triangle> triangles;
  std::vector<Vec3> vertices;
  bool closed = false;
  CGAL::Bbox_3 box;
  std::unique_ptr<Tree> tree;
};

bool inside(const Component& outer, const Vec3& p) {
  const CGAL::Bbox_3& box = outer.box;
  if (p.x < box.xmin() || p.x > box.xmax() || p.y < box.ymin() || p.y > box.ymax() ||
      p.z < box.zmin() || p.z > box.zmax()) {
    return false;
  }
  const double away =
      3 * std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
  int votes = 0;
  for (const Vec3& d :
       {Vec3(0.31, 0.87, -0.41), Vec3(-0.77, 0.13, 0.61), Vec3(0.07, -0.53, -0.83)}) {
    const Kernel::Segment_3 ray(to_point(p), to_point(p + away * d));
    votes += outer.tree->number_of_intersected_primitives(ray) % 2;
  }
  return votes >= 2;
}

}  // namespace

struct JudgedMesh::Data {
  std::vector<Triangle> triangles;
  std::unique_ptr<Tree> tree;
  std::shared_ptr<FclModel> fcl;
  std::vector<Component> components;
};

JudgedMesh::JudgedMesh(std::string its_name, const Shape& given)
    : name(std::move(its_name)), data(std::make_unique<Data>()) {
  shape.positions = given.positions;
  const auto point = [&](std::uint32_t v) { return to_point(Vec3(given.positions[v])); };
  for (const auto& t : given.triangles) {
    if (CGAL::collinear(point(t.x), point(t.y), point(t.z))) continue;
    shape.triangles.push_back(t);
    data->triangles.emplace_back(point(t.x), point(t.y), point(t.z));
  }
  data->tree = std::make_unique<Tree>(data->triangles.cbegin(), data->triangles.cend());
  data->tree->build();

  data->fcl = std::make_shared<FclModel>();
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const auto& p : shape.positions) vertices.emplace_back(p.x, p.y, p.z);
  for (const auto& t : shape.triangles) triangles.emplace_back(t.x, t.y, t.z);
  data->fcl->beginModel();
  data->fcl->addSubModel(vertices, triangles);
  data->fcl->endModel();

  Vec3 low(1e30), high(-1e30);
  for (const auto& t : shape.triangles) {
    for (int k = 0; k < 3; ++k) {
      low = glm::min(low, Vec3(shape.positions[t[k]]));
      high = glm::max(high, Vec3(shape.positions[t[k]]));
    }
  }
  middle = 0.5 * (low + high);
  radius = 0.5 * glm::length(high - low);

  // Components by equal positions; closed if every edge of its distinct triangles is used evenly.
  using Place = std::array<float, 3>;
  std::map<Place, int> place_index;
  std::vector<int> parent;
  const auto index = [&](const glm::vec3& p) {
    const Place key = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
    const auto [it, is_new] = place_index.try_emplace(key, static_cast<int>(parent.size()));
    if (is_new) parent.push_back(it->second);
    return it->second;
  };
  const std::function<int(int)> root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
    return i;
  };
  std::vector<std::array<int, 3>> corners;
  for (const auto& t : shape.triangles) {
    corners.push_back(
        {index(shape.positions[t.x]), index(shape.positions[t.y]), index(shape.positions[t.z])});
    const int a = root(corners.back()[0]), b = root(corners.back()[1]);
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    const int c = root(corners.back()[2]), d = root(a);
    parent[static_cast<std::size_t>(std::max(c, d))] = std::min(c, d);
  }
  std::map<int, std::size_t> component_of;
  std::vector<std::map<std::pair<int, int>, int>> edge_uses;
  std::set<std::array<int, 3>> seen;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [it, is_new] =
        component_of.try_emplace(root(corners[i][0]), data->components.size());
    if (is_new) {
      data->components.emplace_back();
      edge_uses.emplace_back();
    }
    Component& component = data->components[it->second];
    for (int k = 0; k < 3; ++k) {
      component.vertices.push_back(Vec3(shape.positions[shape.triangles[i][k]]));
    }
    auto key = corners[i];
    std::sort(key.begin(), key.end());
    if (!seen.insert(key).second) continue;
    component.triangles.push_back(data->triangles[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = corners[i][k], b = corners[i][(k + 1) % 3];
      ++edge_uses[it->second][{std::min(a, b), std::max(a, b)}];
    }
  }
  for (std::size_t c = 0; c < data->components.size(); ++c) {
    Component& component = data->components[c];
    component.closed = std::all_of(edge_uses[c].begin(), edge_uses[c].end(),
                                   [](const auto& entry) { return entry.second % 2 == 0; });
    component.tree =
        std::make_unique<Tree>(component.triangles.cbegin(), component.triangles.cend());
    component.tree->build();
    component.box = component.tree->bbox();
  }
}

JudgedMesh::JudgedMesh(JudgedMesh&&) noexcept = default;
JudgedMesh::~JudgedMesh() = default;

bool fcl_collides(const JudgedMesh& a, const JudgedMesh& b, const RigidTransform& a_from_b) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.linear()(i, j) = a_from_b.rotation[j][i];
    pose.translation()[i] = a_from_b.translation[i];
  }
  fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  return fcl::collide<double>(a.data->fcl.get(), fcl::Transform3d::Identity(), b.data->fcl.get(),
                              pose, request, result) > 0;
}

bool exact_surfaces_meet(const JudgedMesh& a, const JudgedMesh& b, const RigidTransform& a_from_b) {
  std::vector<Point> placed;
  placed.reserve(b.shape.positions.size());
  for (const auto& p : b.shape.positions) placed.push_back(to_point(a_from_b * Vec3(p)));
  const CGAL::Bbox_3 box = a.data->tree->bbox();
  for (const auto& t : b.shape.triangles) {
    const Triangle triangle(placed[t.x], placed[t.y], placed[t.z]);
    if (!CGAL::do_overlap(triangle.bbox(), box)) continue;
    if (a.data->tree->do_intersect(triangle)) return true;
  }
  return false;
}

bool exact_contained(const JudgedMesh& a, const JudgedMesh& b, const RigidTransform& a_from_b) {
  for (const bool a_is_outer : {true, false}) {
    const auto& outer = a_is_outer ? a : b;
    const auto& inner = a_is_outer ? b : a;
    const RigidTransform place = a_is_outer ? a_from_b : inverse(a_from_b);
    for (const Component& o : outer.data->components) {
      if (!o.closed) continue;
      for (const Component& i : inner.data->components) {
        if (inside(o, place * i.vertices[0])) return true;
      }
    }
  }
  return false;
}

}  // namespace elbowroom::test
