// SPDX-License-Identifier: MIT
#include "core/planning/interpolation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elbowroom {
namespace {

// Samples of an edge before a proof is asked for, and edges too short to ask.
constexpr std::int64_t kBeforeAProof = 1;
constexpr std::int64_t kWorthAProof = 6;
// A proof that needs more looks than this share of the samples is not worth it: where the world is
// near it would go on for hundreds.
constexpr std::int64_t kShareForAProof = 2;

// Both sides of every step in (a.t, b.t]; the end b itself is tested by whoever made it, but as
// seen from after the step, so its near side is tested here too.
bool free_at_steps(StateSpace& world, const Configuration& a, const Configuration& b,
                   const std::stop_token& stop, CheckCounters& counters) {
  const std::vector<double>& steps = world.step_times();
  for (auto step = std::upper_bound(steps.begin(), steps.end(), a.t);
       step != steps.end() && *step <= b.t; ++step) {
    const double before = std::nextafter(*step, -std::numeric_limits<double>::infinity());
    for (const double t : {before, *step}) {
      if (t <= a.t || t >= b.t) continue;
      if (stop.stop_requested()) return false;
      ++counters.validity_checks;
      if (!world.valid(interpolate_at(a, b, t))) return false;
    }
  }
  return true;
}

}  // namespace

Configuration interpolate(const Configuration& a, const Configuration& b, double u) {
  if (u <= 0) return a;
  if (u >= 1) return b;
  Configuration c;
  c.q.count = a.q.count;
  for (int i = 0; i < a.q.count; ++i) c.q[i] = a.q[i] + u * (b.q[i] - a.q[i]);
  c.t = a.t + u * (b.t - a.t);
  return c;
}

Configuration interpolate_at(const Configuration& a, const Configuration& b, double t) {
  if (t <= a.t) return a;
  if (t >= b.t) return b;
  Configuration c = interpolate(a, b, (t - a.t) / (b.t - a.t));
  c.t = t;
  return c;
}

bool within_speed_limits(const DofSpace& space, const Configuration& a, const Configuration& b,
                         double share) {
  const double dt = b.t - a.t;
  if (!(dt > 0)) return false;
  for (int i = 0; i < space.count(); ++i) {
    const double speed = share * space.dofs[static_cast<std::size_t>(i)].speed_limit;
    if (!(std::abs(b.q[i] - a.q[i]) <= speed * dt * (1 + 1e-9) + 1e-12)) return false;
  }
  return true;
}

bool interpolation_free(StateSpace& world, const EdgeResolution& resolution, const Configuration& a,
                        const Configuration& b, const std::stop_token& stop,
                        CheckCounters& counters) {
  ++counters.edge_checks;
  double square = 0;
  for (int i = 0; i < a.q.count; ++i) square += (b.q[i] - a.q[i]) * (b.q[i] - a.q[i]);
  const double pieces =
      std::max(std::sqrt(square) / resolution.radians, (b.t - a.t) / resolution.seconds);
  // A resolution that is no positive number, or so fine that no search could end, is refused.
  if (!(resolution.radians > 0) || !(resolution.seconds > 0) || !(pieces < 1e9)) return false;
  if (!free_at_steps(world, a, b, stop, counters)) return false;
  const auto n = static_cast<std::int64_t>(std::ceil(pieces));
  // The middle finds most collisions; what it leaves, a proof settles, cheaper than the rest of
  // the samples and for all configurations between; where it is refused, the rest decides.
  std::int64_t samples = 0;
  bool asked = n < kWorthAProof, proven = false;
  const bool free = visit_by_bisection(n, [&](std::int64_t k) {
    if (stop.stop_requested()) return false;
    if (!asked && samples == kBeforeAProof) {
      asked = true;
      std::int64_t looks = 0;
      proven = world.certified_free(a, b, looks, n / kShareForAProof).value_or(false);
      counters.validity_checks += looks;
      if (proven) return false;
    }
    ++samples;
    ++counters.validity_checks;
    return world.valid(interpolate(a, b, static_cast<double>(k) / static_cast<double>(n)));
  });
  return free || proven;
}

}  // namespace elbowroom
