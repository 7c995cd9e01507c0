// SPDX-License-Identifier: MIT
// The world as the planner sees it: one limb's rigid body parts (and what it carries) against all
// other parts, at any (q, t) of a window. Fast and approximate where skin deforms; the final word
// is SceneCollision's.
//
// A part is what moves as one over the window: a joint's skin with that of joints that keep still
// to it (a fist), an object, a carried thing. Parts of the character itself may do to each other
// what SceneCollision allows, and be as near as they are while the limb follows the clip. valid()
// samples no clip: the world's placements are kept at 240 Hz and interpolated (frame_tracks.h
// states the error, some tenths of a millimetre; it belongs into the clearance).
//
// certified_free() proves that every configuration of an edge is valid() (limb_motion.h has the
// bound): intervals of time are halved, largest first and in each the pairs that hit last, until
// the clearance at their middle exceeds what both parts of each pair can travel. An edge is refused
// as soon as a middle is not valid, and where a pair comes nearer to its clearance than 0.25 ‰ of
// the height (0.4 mm) and the base's own curvature (LimbMotion::flex, some hundredths of a
// millimetre); so every edge that keeps 2 mm more than its clearance at 1.75 m is free. Both ends
// have to be valid: what lies inside what does not change where surfaces never touch.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/collision/scene_collision.h"
#include "core/planning/state_space.h"

namespace elbowroom {

class LimbPlanningSpace : public StateSpace {
 public:
  // A margin for two parts of the scene, by their names in contact reports, in either order: where
  // it has been seen what the skin does between them.
  struct PairMargin {
    std::string part_a, part_b;
    double margin = 0;  // scene units, added to what is kept between them
  };
  struct Settings {
    double clearance = 0;  // scene units, kept from everything that is not allowed
    double margin = 0;  // scene units, added where one of the two is skin, which leaves its rigid
                        // part; measure_skin_deviation (skin_deviation.h) tells by how much
    // Kept between the limb and the rest of its own body, where less is natural (an upper arm
    // hangs against its chest); negative: `clearance`.
    double body_clearance = -1;
    std::vector<PairMargin> pair_margins{};
  };
  // `at_init`, `at_goal`: the limb's states in the clip at the window's ends; the residual goes
  // from one to the other by slerp (DESIGN.md, "Residual"). Keeps a reference to `scene`,
  // whose clip must be the one that is planned against; asking `scene` meanwhile is allowed.
  LimbPlanningSpace(const SceneCollision& scene, int limb, double t_init, double t_goal,
                    const LimbState& at_init, const LimbState& at_goal, const Settings& settings);
  ~LimbPlanningSpace() override;

  bool valid(const Configuration& c) override;
  void metric_points(const Configuration& c, std::vector<Vec3>& points) override;
  const std::vector<double>& step_times() const override;
  std::optional<bool> certified_free(
      const Configuration& from, const Configuration& to, std::int64_t& looks,
      std::int64_t most_looks = std::numeric_limits<std::int64_t>::max()) override;

  // Residuals at time t of the window.
  std::array<Quat, 3> residual_at(double t) const;
  // The pair of parts that made valid() say no most often, for reports; empty if none did.
  std::pair<std::string, std::string> most_blocking() const;

  // The least margin, beyond what is kept already, that would make valid() say no to c for the sake
  // of two parts of those names, within a sixteenth; nothing where at_most would not (they are far
  // apart, or may be near each other there).
  std::optional<double> margin_to_refuse(const Configuration& c, const std::string& part_a,
                                         const std::string& part_b, double at_most);

  // For benchmarks: the same geometry for another library. Parts in their own frames and their
  // placements at (q, t); `limb` tells the two sides apart.
  struct Part {
    const CollisionMesh* mesh;
    std::string name;
    bool limb;
  };
  const std::vector<Part>& parts() const;
  void placements(const Configuration& c, std::vector<RigidTransform>& world_from_part);
  // Pairs of part indices that valid() tests, with their filters.
  struct Pair {
    int a, b;
    PatchFilter filter;
  };
  const std::vector<Pair>& pairs() const;

  struct Data;

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace elbowroom
