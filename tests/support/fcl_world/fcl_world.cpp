// SPDX-License-Identifier: MIT
#include "tests/support/fcl_world/fcl_world.h"

// All of FCL takes minutes to compile.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace elbowroom::test {
namespace {

template <typename Box>
struct NodeFor;
template <typename S>
struct NodeFor<fcl::OBB<S>> {
  using Type = fcl::detail::MeshCollisionTraversalNodeOBB<S>;
};
template <typename S>
struct NodeFor<fcl::OBBRSS<S>> {
  using Type = fcl::detail::MeshCollisionTraversalNodeOBBRSS<S>;
};

template <typename Box>
class FclWorldOf : public FclWorld {
 public:
  using Scalar = typename Box::S;
  using Model = fcl::BVHModel<Box>;

  FclWorldOf(LimbPlanningSpace& space, AllowedPairs allowed) : space_(space) {
    for (const auto& pair : space.pairs()) {
      const auto& a = *space.parts()[static_cast<std::size_t>(pair.a)].mesh;
      const auto& b = *space.parts()[static_cast<std::size_t>(pair.b)].mesh;
      const auto all = [](std::uint32_t) { return true; };
      if (!pair.filter.allowed) {
        add(pair.a, pair.b, model(pair.a, a, all), model(pair.b, b, all));
        continue;
      }
      if (allowed == AllowedPairs::left_out) continue;
      // Triangles that some allowance concerns are tested against those of the other part that none
      // does, and these against everything.
      const std::vector<bool> concerned_a = concerned(pair.filter, a, true);
      const std::vector<bool> concerned_b = concerned(pair.filter, b, false);
      const auto open_a = model(pair.a, a, [&](std::uint32_t t) { return !concerned_a[t]; });
      const auto shut_a = model(pair.a, a, [&](std::uint32_t t) { return concerned_a[t]; });
      const auto open_b = model(pair.b, b, [&](std::uint32_t t) { return !concerned_b[t]; });
      const auto all_b = model(pair.b, b, all);
      add(pair.a, pair.b, open_a, all_b);
      add(pair.a, pair.b, shut_a, open_b);
    }
    request_.num_max_contacts = 1;
    request_.enable_contact = false;
  }

  bool free(const Configuration& c) override {
    space_.placements(c, placements_);
    const std::size_t parts = placements_.size();
    transforms_.resize(parts);
    for (std::size_t i = 0; i < parts; ++i) {
      fcl::Transform3<Scalar>& x = transforms_[i];
      x.setIdentity();
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
          x.linear()(row, column) = static_cast<Scalar>(placements_[i].rotation[column][row]);
        }
        x.translation()[row] = static_cast<Scalar>(placements_[i].translation[row]);
      }
    }
    for (const Pair& pair : pairs_) {
      const auto& to_a = transforms_[static_cast<std::size_t>(pair.a)];
      const auto& to_b = transforms_[static_cast<std::size_t>(pair.b)];
      // What a broad phase would do: spheres about the two models first.
      const Scalar reach = pair.model_a->aabb_radius + pair.model_b->aabb_radius;
      const fcl::Vector3<Scalar> apart =
          to_a * pair.model_a->aabb_center - to_b * pair.model_b->aabb_center;
      if (apart.squaredNorm() > reach * reach) continue;
      if (collide(*pair.model_a, to_a, *pair.model_b, to_b)) return false;
    }
    return true;
  }

 private:
  struct Pair {
    int a, b;
    const Model* model_a;
    const Model* model_b;
  };

  // What fcl::collide() does for two models of these boxes.
  bool collide(const Model& a, const fcl::Transform3<Scalar>& to_a, const Model& b,
               const fcl::Transform3<Scalar>& to_b) {
    result_.clear();
    typename NodeFor<Box>::Type node;
    fcl::detail::initialize(node, a, to_a, b, to_b, request_, result_);
    fcl::detail::collide(&node);
    return result_.numContacts() > 0;
  }

  static std::vector<bool> concerned(const PatchFilter& filter, const CollisionMesh& mesh,
                                     bool first) {
    const auto& allowed = *filter.allowed;
    const std::size_t patches_b = static_cast<std::size_t>(filter.patches_b);
    const std::size_t patches_a = patches_b > 0 ? allowed.size() / patches_b : 0;
    std::vector<bool> patch(first ? patches_a : patches_b, false);
    for (std::size_t p = 0; p < patches_a; ++p) {
      for (std::size_t q = 0; q < patches_b; ++q) {
        if (allowed[p * patches_b + q]) patch[first ? p : q] = true;
      }
    }
    std::vector<bool> triangles(mesh.triangles().size(), false);
    const std::uint16_t* patch_of = first ? filter.patch_of_a : filter.patch_of_b;
    for (std::size_t t = 0; t < triangles.size(); ++t) triangles[t] = patch[patch_of[t]];
    return triangles;
  }

  // A model of the triangles picked; null if there are none.
  template <typename Pick>
  const Model* model(int part, const CollisionMesh& mesh, Pick&& pick) {
    std::vector<bool> picked;
    for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) picked.push_back(pick(t));
    auto& slot = models_[{part, picked}];
    if (slot || std::find(picked.begin(), picked.end(), true) == picked.end()) return slot.get();
    auto built = std::make_unique<Model>();
    built->beginModel();
    const auto corner = [&](std::uint32_t i) {
      const glm::vec3 v = mesh.positions()[i];
      return fcl::Vector3<Scalar>(static_cast<Scalar>(v.x), static_cast<Scalar>(v.y),
                                  static_cast<Scalar>(v.z));
    };
    for (std::uint32_t t = 0; t < picked.size(); ++t) {
      if (!picked[t]) continue;
      const glm::uvec3 v = mesh.triangles()[t];
      built->addTriangle(corner(v.x), corner(v.y), corner(v.z));
    }
    built->endModel();
    built->computeLocalAABB();
    slot = std::move(built);
    return slot.get();
  }

  void add(int a, int b, const Model* model_a, const Model* model_b) {
    if (model_a && model_b) pairs_.push_back({a, b, model_a, model_b});
  }

  LimbPlanningSpace& space_;
  std::map<std::pair<int, std::vector<bool>>, std::unique_ptr<Model>> models_;
  std::vector<Pair> pairs_;
  std::vector<RigidTransform> placements_;
  std::vector<fcl::Transform3<Scalar>> transforms_;
  fcl::CollisionRequest<Scalar> request_;
  fcl::CollisionResult<Scalar> result_;
};

}  // namespace

std::unique_ptr<FclWorld> make_fcl_world(LimbPlanningSpace& space, BoxKind kind,
                                         AllowedPairs allowed) {
  if (kind == BoxKind::obbrss_double)
    return std::make_unique<FclWorldOf<fcl::OBBRSS<double>>>(space, allowed);
  return std::make_unique<FclWorldOf<fcl::OBB<float>>>(space, allowed);
}

}  // namespace elbowroom::test
