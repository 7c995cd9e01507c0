// SPDX-License-Identifier: MIT
// One thing that is tested as a whole: a piece of a character's deforming skin, or a rigid mesh;
// its collision mesh, where it stands at time t, and what its triangles belong to.
//
// Space: a query origin near the action, in double, is taken off before anything becomes float, so
// that a world far from 0 keeps its millimetres. Skin is refit in that space; a rigid thing keeps
// its mesh, with scale, shear and mirror baked in, and moves by a RigidTransform.
//
// place() is a pure function of state and origin: what was asked before does not show. One thread
// at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/collision/mesh_pair.h"
#include "core/collision/motion_bound.h"
#include "core/scene/world.h"

namespace elbowroom {

struct Box {
  Vec3 low{0.0}, high{0.0};  // low > high: empty
  bool empty() const { return low.x > high.x; }
  bool within(const Box& other, double distance) const {
    return !empty() && !other.empty() && low.x <= other.high.x + distance &&
           other.low.x <= high.x + distance && low.y <= other.high.y + distance &&
           other.low.y <= high.y + distance && low.z <= other.high.z + distance &&
           other.low.z <= high.z + distance;
  }
};

// A triangle of a body: where it comes from and which part it is reported as.
struct BodyTriangle {
  int mesh = -1;               // in the actor's model
  std::uint32_t triangle = 0;  // in that mesh
  int part = -1;               // the owner's numbering
  int joint = -1;              // the node it follows
};

class CollisionBody {
 public:
  // `deforms`: skinned (or morphing) meshes; else rigid with respect to `frame_node`. Patches are
  // cut in the state given. Error: a position or matrix that is not finite.
  static Result<CollisionBody> build(const Actor& actor, int actor_index, bool deforms,
                                     int frame_node, std::vector<BodyTriangle> triangles,
                                     const ActorState& state, double patch_diameter,
                                     double weld_tolerance);

  // Brings the body to its actor's state. Does nothing if it stands there already.
  void place(const ActorState& state, const Vec3& origin);

  int actor() const { return actor_; }
  int frame_node() const { return frame_node_; }
  bool deforms() const { return deforms_; }
  const Model& model() const { return *model_; }
  // Refit on the first look after a change: most bodies are known to be apart by their boxes.
  const CollisionMesh& mesh() const {
    if (stale_) {
      mesh_->refit(scratch_);
      stale_ = false;
    }
    return *mesh_;
  }
  // Takes mesh() to the query space (world minus origin); the identity for a deforming body.
  const RigidTransform& query_from_body() const { return query_from_body_; }
  // Of a rigid body: where the mesh's own origin is in the frame node's rigid frame.
  const Vec3& centre() const { return centre_; }
  const Box& box() const { return box_; }  // in the query space

  const std::vector<BodyTriangle>& triangles() const { return triangles_; }
  struct VertexSource {
    int mesh = -1;
    std::uint32_t vertex = 0;
  };
  const std::vector<VertexSource>& vertices() const { return vertices_; }

  const std::vector<std::uint16_t>& patch_of() const { return patch_of_; }
  int patch_count() const { return patch_count_; }
  // Triangles of one patch, their vertices, each once, and the patches that share a point with it
  // (itself not included).
  std::span<const std::uint32_t> triangles_of_patch(int patch) const;
  std::span<const std::uint32_t> vertices_of_patch(int patch) const;
  std::span<const std::uint16_t> neighbours_of_patch(int patch) const;
  // 1 where the file's winding looks outward, -1 where it looks inward (a mirrored mesh).
  double winding(std::uint32_t triangle) const { return winding_[triangle]; }

  // Bounds of how far the body gets during an interval from where it is at the interval's middle
  // (motion_bound.h), in the frame that `by_node` is in; `state` is its actor's at the middle. A
  // skinned vertex travels at most the weighted sum of what its joints make it travel; a triangle,
  // whose points lie between its corners, at most as far as the farthest of them. Of all of it:
  // from its joints alone, no vertex is looked at.
  double most_travel(const ActorState& state, const MotionBound& bound,
                     const std::vector<PointTravel>& by_node) const;
  // By triangle; rounded up. O(n).
  void triangle_travel(const ActorState& state, const MotionBound& bound,
                       const std::vector<PointTravel>& by_node, std::vector<float>& out) const;

 private:
  CollisionBody() = default;
  Status bake(const ActorState& state);
  void skin(const ActorState& state, const Vec3& origin);
  void cut(double patch_diameter, double weld_tolerance);

  struct Slot {  // one joint with its inverse bind matrix
    int joint;
    Mat4 inverse_bind;
  };
  struct Weight {
    std::uint32_t slot;
    double weight;
  };
  struct Morph {  // an offset of one vertex
    std::uint32_t target;
    Vec3 offset;
  };
  struct Source {  // one mesh this body draws from
    int mesh;
    std::uint32_t first_vertex;  // its vertices in this body are contiguous
  };
  struct MorphReach {  // of one vertex: how far morphs have moved it, and may yet
    double now = 0, change = 0;
  };
  void measure_radii();
  MorphReach morph_reach(const ActorState& state, const MotionBound& bound,
                         std::uint32_t vertex) const;

  int actor_ = -1, frame_node_ = -1;
  bool deforms_ = false;
  std::shared_ptr<const Model> model_;
  std::vector<BodyTriangle> triangles_;
  std::vector<VertexSource> vertices_;
  std::vector<Source> sources_;
  std::vector<Vec3> base_;  // by vertex, the mesh's own space
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> weight_begin_;
  std::vector<Weight> weights_;
  std::vector<std::uint32_t> morph_begin_;  // empty if nothing morphs
  std::vector<Morph> morphs_;
  // Distances from the origin of what a vertex follows, in its units, before morphs: by weight (by
  // vertex for a rigid body), and the largest by slot (by source).
  std::vector<float> radius_;
  std::vector<double> largest_radius_, bind_stretch_;
  std::vector<std::uint32_t> source_of_;  // by vertex, if anything morphs

  std::unique_ptr<CollisionMesh> mesh_;
  mutable bool stale_ = false;  // mesh_ does not have the places of scratch_ yet
  RigidTransform query_from_body_;
  Box box_;
  std::vector<glm::vec3> scratch_;

  // Deforming: what the mesh was refit to last.
  std::vector<Mat4> world_from_bind_;
  std::vector<double> morph_weights_;
  Vec3 origin_{0.0};
  bool placed_ = false;

  // Rigid: the baking of the build and the one in use.
  struct Baking {
    std::vector<Mat4> body_from_mesh;  // by source
    std::vector<double> morph_weights;
  };
  Baking built_, used_;
  Vec3 centre_{0.0};  // of the geometry in the frame node's rigid frame
  Vec3 local_low_{0.0}, local_high_{0.0};

  std::vector<std::uint16_t> patch_of_;
  int patch_count_ = 0;
  std::vector<std::uint32_t> patch_begin_, patch_triangles_;
  std::vector<std::uint32_t> patch_vertex_begin_, patch_vertices_;
  std::vector<std::uint32_t> neighbour_begin_;
  std::vector<std::uint16_t> neighbours_;
  std::vector<double> winding_;
};

// The rigid frame of a node: its place and its rotation, without scale and mirror.
RigidTransform rigid_frame(const Mat4& world_from_node);

}  // namespace elbowroom
