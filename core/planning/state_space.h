// SPDX-License-Identifier: MIT
// What the planner asks of the world. The planner knows no character, mesh or document; it searches
// space-time configurations (q, t) [SKF07 3] and asks one object whether they are valid.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/dof_space.h"
#include "core/base/math.h"

namespace elbowroom {

// A space-time configuration [SKF07 3].
struct Configuration {
  Dofs q;
  double t = 0;  // seconds, the clip's clock
};

class StateSpace {
 public:
  virtual ~StateSpace() = default;

  // Collision-free in w(t) with at least the planning clearance. Limits are the planner's own
  // matter (DofSpace). One call at a time per object; may keep caches.
  virtual bool valid(const Configuration& c) = 0;

  // The points whose greatest distance is the posture part of the metric [SKF07 4.1]: positions of
  // the limb's joints, its end effector's and the carried object's extreme points. World space,
  // scene units; always the same number of them.
  virtual void metric_points(const Configuration& c, std::vector<Vec3>& points) = 0;

  // A proof, or its refusal, for every configuration of the straight edge between two valid ones,
  // from.t < to.t: true if all of them are valid, false if that is not so or could not be shown.
  // Nothing: this world proves nothing, and an edge has to be sampled. `looks` grows by the
  // configurations that were looked at; what is not shown by `most_looks` of them is not.
  virtual std::optional<bool> certified_free(
      const Configuration& from, const Configuration& to, std::int64_t& looks,
      std::int64_t most_looks = std::numeric_limits<std::int64_t>::max()) {
    (void)from, (void)to, (void)looks, (void)most_looks;
    return std::nullopt;
  }

  // Instants at which the world steps, ascending; an edge that spans one tests both its sides.
  virtual const std::vector<double>& step_times() const = 0;
};

}  // namespace elbowroom
