// SPDX-License-Identifier: MIT
#include "core/planning/sampler.h"

#include <algorithm>
#include <cmath>

namespace elbowroom {
namespace {

double progress_of(std::int64_t iteration, std::int64_t iterations) {
  if (iterations <= 0) return 1;
  return std::clamp(static_cast<double>(iteration) / static_cast<double>(iterations), 0.0, 1.0);
}

bool inside_swings(const DofSpace& space, const Dofs& q) {
  for (const EllipseLimit& e : space.ellipses) {
    const double x = q[e.first] / e.half_first;
    const double y = q[e.second] / e.half_second;
    if (!(x * x + y * y <= 1)) return false;
  }
  for (const PolygonLimit& polygon : space.polygons) {
    if (!(polygon.gauge(q[polygon.first], q[polygon.second]) <= 1)) return false;
  }
  return true;
}

// The reference at the sample's time, one to three DOFs of it moved, all brought inside their
// ranges. False if the reference has no such values.
bool draw_near_reference(const SamplingQuery& query, const SamplingSettings& settings,
                         Random& random, Configuration& c) {
  const DofSpace& space = *query.space;
  c.q = query.reference(c.t);
  if (c.q.count != space.count()) return false;
  const int moved = 1 + static_cast<int>(random.below(3));
  for (int k = 0; k < moved; ++k) {
    const int i = static_cast<int>(random.below(static_cast<std::uint64_t>(space.count())));
    // Small moves as often as large ones.
    const double reach = settings.near_reach * random.uniform();
    c.q[i] += random.uniform(-reach, reach);
  }
  for (int i = 0; i < space.count(); ++i) {
    if (!std::isfinite(c.q[i])) return false;
    const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
    c.q[i] = std::clamp(c.q[i], dof.lower, dof.upper);
  }
  return true;
}

}  // namespace

SamplingInterval sampling_interval(const SamplingQuery& query, const SamplingSettings& settings,
                                   std::int64_t iteration, int i, double t) {
  const Dof& dof = query.space->dofs[static_cast<std::size_t>(i)];
  const double width = dof.sample_upper - dof.sample_lower;
  if (dof.role == DofRole::flexion) {
    const double from =
        settings.flexion_from * (1 - progress_of(iteration, settings.flexion_iterations));
    return {dof.sample_lower + std::clamp(from, 0.0, 1.0) * width, dof.sample_upper};
  }
  if (dof.role == DofRole::secondary_swing) {
    const double share =
        settings.secondary_from + (settings.secondary_to - settings.secondary_from) *
                                      progress_of(iteration, settings.secondary_iterations);
    if (share >= 1) return {dof.sample_lower, dof.sample_upper};
    // A window about the straight way's value, moved (not cut) where it would leave the interval.
    const double half = 0.5 * std::max(share, 0.0) * width;
    const double middle = std::clamp(interpolate_at(query.init, query.goal, t).q[i],
                                     dof.sample_lower + half, dof.sample_upper - half);
    return {middle - half, middle + half};
  }
  return {dof.sample_lower, dof.sample_upper};
}

Configuration pull_into_reach(const SamplingQuery& query, const Configuration& c) {
  const double after = c.t - query.init.t;
  const double left = query.goal.t - c.t;
  const Configuration straight = interpolate_at(query.init, query.goal, c.t);
  // For each DOF the reachable values form an interval with the straight way's value inside; s is
  // the largest share of the way from there to c that stays in all of them.
  double s = 1;
  for (int i = 0; i < c.q.count; ++i) {
    const double speed =
        query.speed_share * query.space->dofs[static_cast<std::size_t>(i)].speed_limit;
    const double lower = std::max(query.init.q[i] - speed * after, query.goal.q[i] - speed * left);
    const double upper = std::min(query.init.q[i] + speed * after, query.goal.q[i] + speed * left);
    const double way = c.q[i] - straight.q[i];
    if (way > 0 && straight.q[i] + s * way > upper) s = (upper - straight.q[i]) / way;
    if (way < 0 && straight.q[i] + s * way < lower) s = (lower - straight.q[i]) / way;
  }
  if (s >= 1) return c;
  Configuration pulled = interpolate(straight, c, std::max(s, 0.0));
  pulled.t = c.t;
  return pulled;
}

bool sample_configuration(StateSpace& world, const SamplingQuery& query,
                          const SamplingSettings& settings, std::int64_t iteration, Random& random,
                          const std::stop_token& stop, Configuration& sample,
                          SamplingCounters& sampling, CheckCounters& checks) {
  const DofSpace& space = *query.space;
  for (int attempt = 0; attempt < settings.max_tries; ++attempt) {
    if (stop.stop_requested()) return false;
    ++sampling.draws;
    Configuration c;
    c.q.count = space.count();
    c.t = random.uniform(query.init.t, query.goal.t);
    if (settings.near_share > 0 && query.reference && random.uniform() < settings.near_share) {
      if (!draw_near_reference(query, settings, random, c)) {
        ++sampling.outside_limits;
        continue;
      }
    } else {
      for (int i = 0; i < space.count(); ++i) {
        const SamplingInterval interval = sampling_interval(query, settings, iteration, i, c.t);
        c.q[i] = random.uniform(interval.lower, interval.upper);
      }
    }
    if (!inside_swings(space, c.q)) {
      ++sampling.outside_limits;
      continue;
    }
    c = pull_into_reach(query, c);
    ++checks.validity_checks;
    if (world.valid(c)) {
      sample = c;
      return true;
    }
    ++sampling.in_collision;
  }
  return false;
}

}  // namespace elbowroom
