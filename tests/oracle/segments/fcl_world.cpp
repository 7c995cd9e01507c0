// SPDX-License-Identifier: MIT
#include "tests/oracle/segments/fcl_world.h"

#include <fcl/fcl.h>

#include <map>
#include <vector>

namespace elbowroom::test {
namespace {

template <typename Box>
class FclWorldOf : public FclWorld {
 public:
  using Scalar = typename Box::S;
  using Model = fcl::BVHModel<Box>;

  explicit FclWorldOf(LimbPlanningSpace& space) : space_(space) {
    for (const auto& pair : space.pairs())
      if (!pair.filter.allowed) pairs_.push_back({pair.a, pair.b, model(pair.a), model(pair.b)});
    request_.num_max_contacts = 1;
    request_.enable_contact = false;
  }

  bool free(const Configuration& c) override {
    space_.placements(c, placements_);
    transforms_.resize(placements_.size());
    for (std::size_t i = 0; i < placements_.size(); ++i) {
      auto& x = transforms_[i];
      x.setIdentity();
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
          x.linear()(row, column) = static_cast<Scalar>(placements_[i].rotation[column][row]);
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
      result_.clear();
      if (fcl::collide(pair.model_a, to_a, pair.model_b, to_b, request_, result_) > 0) return false;
    }
    return true;
  }

 private:
  struct Pair {
    int a, b;
    const Model* model_a;
    const Model* model_b;
  };

  const Model* model(int part) {
    auto& slot = models_[part];
    if (slot) return slot.get();
    const CollisionMesh& mesh = *space_.parts()[static_cast<std::size_t>(part)].mesh;
    slot = std::make_unique<Model>();
    slot->beginModel();
    const auto corner = [&](std::uint32_t i) {
      const glm::vec3 v = mesh.positions()[i];
      return fcl::Vector3<Scalar>(static_cast<Scalar>(v.x), static_cast<Scalar>(v.y),
                                  static_cast<Scalar>(v.z));
    };
    for (const glm::uvec3& t : mesh.triangles())
      slot->addTriangle(corner(t.x), corner(t.y), corner(t.z));
    slot->endModel();
    slot->computeLocalAABB();
    return slot.get();
  }

  LimbPlanningSpace& space_;
  std::map<int, std::unique_ptr<Model>> models_;
  std::vector<Pair> pairs_;
  std::vector<RigidTransform> placements_;
  std::vector<fcl::Transform3<Scalar>> transforms_;
  fcl::CollisionRequest<Scalar> request_;
  fcl::CollisionResult<Scalar> result_;
};

}  // namespace

std::unique_ptr<FclWorld> make_fcl_world(LimbPlanningSpace& space, BoxKind kind) {
  if (kind == BoxKind::obbrss_double)
    return std::make_unique<FclWorldOf<fcl::OBBRSS<double>>>(space);
  return std::make_unique<FclWorldOf<fcl::OBB<float>>>(space);
}

}  // namespace elbowroom::test
