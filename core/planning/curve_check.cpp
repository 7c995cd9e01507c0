// SPDX-License-Identifier: MIT
#include "core/planning/curve_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/planning/curve_fit.h"

namespace elbowroom {
namespace {

// The curve's greatest speed on span s, at most, rad/s: its derivative is a quadratic B-spline and
// lies in the hull of three differences.
double speed_bound(const Curve& curve, int s) {
  double most = 0;
  for (int i = s - 3; i < s; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double span = curve.knots[k + 4] - curve.knots[k + 1];
    double square = 0;
    for (int a = 0; a < curve.control[k].count; ++a) {
      const double d = 3 * (curve.control[k + 1][a] - curve.control[k][a]) / span;
      square += d * d;
    }
    most = std::max(most, square);
  }
  return std::sqrt(most);
}

// Number of equal pieces of a span of that length and speed; 0 if no resolution allows it.
std::int64_t pieces(double seconds, double speed, const EdgeResolution& resolution) {
  if (!(resolution.radians > 0) || !(resolution.seconds > 0)) return 0;
  const double n = std::max(seconds / resolution.seconds, seconds * speed / resolution.radians);
  return n < 1e8 ? std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(n))) : 0;
}

void add_steps(double begin, double end, const std::vector<double>& steps,
               std::vector<double>& times) {
  for (auto step = std::lower_bound(steps.begin(), steps.end(), begin);
       step != steps.end() && *step <= end; ++step) {
    const double before = std::nextafter(*step, -std::numeric_limits<double>::infinity());
    if (before > begin) times.push_back(before);
    times.push_back(*step);
  }
}

bool test_in_bisection_order(StateSpace& world, const Curve& curve,
                             const std::vector<double>& times, const std::stop_token& stop,
                             CheckCounters& counters, double& collision) {
  const auto free_at = [&](double t) {
    if (stop.stop_requested()) {
      collision = std::numeric_limits<double>::quiet_NaN();
      return false;
    }
    ++counters.validity_checks;
    if (world.valid({curve.value(t), t})) return true;
    collision = t;
    return false;
  };
  if (times.empty()) return true;
  if (!free_at(times.front()) || (times.size() > 1 && !free_at(times.back()))) return false;
  return visit_by_bisection(static_cast<std::int64_t>(times.size()) - 1, [&](std::int64_t k) {
    return free_at(times[static_cast<std::size_t>(k)]);
  });
}

}  // namespace

bool curve_test_times(const Curve& curve, int first, int last, const EdgeResolution& resolution,
                      const std::vector<double>& steps, std::vector<double>& times) {
  times.clear();
  for (int s = first; s <= last; ++s) {
    const double begin = curve.knots[static_cast<std::size_t>(s)];
    const double end = curve.knots[static_cast<std::size_t>(s) + 1];
    const std::int64_t n = pieces(end - begin, speed_bound(curve, s), resolution);
    if (n == 0) return false;
    for (std::int64_t k = 0; k < n; ++k) {
      times.push_back(begin + (end - begin) * static_cast<double>(k) / static_cast<double>(n));
    }
    if (s == last) times.push_back(end);
  }
  const std::size_t regular = times.size();
  if (regular > 0) add_steps(times.front(), times.back(), steps, times);
  if (times.size() > regular) {
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
  }
  return true;
}

bool curve_span_free(StateSpace& world, const Curve& curve, int first, int last,
                     const EdgeResolution& resolution, const std::vector<double>& suspects,
                     const std::stop_token& stop, CheckCounters& counters, double& collision) {
  ++counters.edge_checks;
  const double begin = curve.knots[static_cast<std::size_t>(first)];
  const double end = curve.knots[static_cast<std::size_t>(last) + 1];
  for (const double t : suspects) {
    if (t < begin || t > end || stop.stop_requested()) continue;
    ++counters.validity_checks;
    if (!world.valid({curve.value(t), t})) {
      collision = t;
      return false;
    }
  }
  std::vector<double> times;
  if (!curve_test_times(curve, first, last, resolution, world.step_times(), times)) {
    collision = begin;
    return false;
  }
  return test_in_bisection_order(world, curve, times, stop, counters, collision);
}

bool curve_free(StateSpace& world, const Curve& curve, double begin, double end,
                const EdgeResolution& resolution, const std::stop_token& stop,
                CheckCounters& counters) {
  ++counters.edge_checks;
  if (curve.empty() || !(begin <= end) || !(resolution.radians > 0) || !(resolution.seconds > 0)) {
    return false;
  }
  begin = std::max(begin, curve.t_begin());
  end = std::min(end, curve.t_end());
  if (!(begin <= end)) return false;
  std::vector<double> all, times{begin};
  if (!curve_test_times(curve, curve_span(curve.knots, begin), curve_span(curve.knots, end),
                        resolution, world.step_times(), all)) {
    return false;
  }
  for (const double t : all) {
    if (t > begin && t < end) times.push_back(t);
  }
  if (end > begin) times.push_back(end);
  double collision = 0;
  return test_in_bisection_order(world, curve, times, stop, counters, collision);
}

}  // namespace elbowroom
