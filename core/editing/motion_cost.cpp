// SPDX-License-Identifier: MIT
#include "core/editing/motion_cost.h"

#include <algorithm>
#include <cmath>

#include "core/anatomy/limits.h"
#include "core/planning/smoothing.h"

namespace elbowroom {
namespace {

constexpr int kSamples = 120;
constexpr double kEffortTime = 0.1;         // s
constexpr double kAccelerationTime = 0.06;  // s
constexpr double kQuickMovement = 0.4;      // s

// Deviation and effort of what is at q(t).
template <typename Posture>
MotionCost from_reference(const WindowProblem& p, const Posture& posture) {
  MotionCost cost;
  const double span = (p.end - p.begin) / kSamples;
  Dofs last, last_reference;
  for (int i = 0; i <= kSamples; ++i) {
    const double t = p.begin + span * i;
    const Dofs q = posture(t), r = p.reference_at(t);
    for (int d = 0; d < q.count; ++d) {
      cost.deviation += (q[d] - r[d]) * (q[d] - r[d]);
      if (i == 0) continue;
      const double speed = (q[d] - last[d] - (r[d] - last_reference[d])) / span;
      cost.effort += speed * speed;
    }
    last = q;
    last_reference = r;
  }
  cost.deviation /= kSamples;
  cost.effort *= kEffortTime * kEffortTime / kSamples;
  return cost;
}

}  // namespace

MotionCost motion_cost(const WindowProblem& p, const WindowMotion& motion) {
  MotionCost cost = from_reference(p, [&](double t) { return motion.at(t).value(t); });
  double hurry = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double t = p.begin + (p.end - p.begin) * i / kSamples;
    const Dofs a = motion.at(t).second(t);
    for (int d = 0; d < a.count; ++d) {
      cost.acceleration += a[d] * a[d];
      hurry = std::max(
          hurry,
          std::abs(a[d]) / natural_acceleration(p.space.dofs[static_cast<std::size_t>(d)]) - 1);
    }
  }
  cost.acceleration *= std::pow(kAccelerationTime, 4) / kSamples;
  cost.hurry = hurry * hurry;
  return cost;
}

double path_cost(const WindowProblem& p, const WindowPaths& paths) {
  return from_reference(p,
                        [&](double t) {
                          std::size_t part = 0;
                          while (part + 1 < paths.parts.size() && t > paths.parts[part].back().t)
                            ++part;
                          return path_at(paths.parts[part], t).q;
                        })
      .total();
}

double nearness_cost(double clearance, double wanted) {
  if (!(wanted > 0)) return 0;
  const double missing = std::clamp(1 - clearance / wanted, 0.0, 1.0);
  return 0.1 * missing * missing;
}

double natural_acceleration(const Dof& dof) {
  return kMinimumJerkRatio / kQuickMovement * dof.speed_limit;
}

}  // namespace elbowroom
