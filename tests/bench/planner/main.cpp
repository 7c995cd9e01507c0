// SPDX-License-Identifier: MIT
// elbowroom_bench [--seeds N] [--problem NAME] [--range R] [--ours] [--verbose]: our planner beside
// OMPL RRTConnect + FCL; with --ours alone, for profiles and digests.
//
// One thread, one run, one seed a row's sample. Both sides get the same parts, pairs, placements,
// limits, speed limits and, in the row "like for like", edge resolution and (no) clearance; the row
// "as shipped" keeps the clearance and tests found paths more finely. "Truly free" is FCL's verdict
// (OBBRSS, double) on the rigid parts every millisecond. Milliseconds are the thread's computing
// time.
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/planning/curve_energy.h"
#include "core/planning/curve_fit.h"
#include "core/planning/planner.h"
#include "core/planning/smoothing.h"
#include "problems.h"
#include "tests/bench/peer/cpu_clock.h"
#include "tests/bench/peer/peer.h"

namespace elbowroom::bench {
namespace {

using test::AllowedPairs;
using test::BoxKind;

struct Options {
  int seeds = 100;
  std::string problem;
  double range = 0.8;
  bool ours = false;
  bool verbose = false;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto k = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  return values[k];
}

// One planner on one problem, over all seeds.
struct Row {
  std::string name;
  int runs = 0, solved = 0, first_free = 0, smooth_free = 0, curves = 0, curves_free = 0;
  std::vector<double> checks_first, checks_smooth, ms_first, ms_smooth;  // smooth: first included
  std::vector<double> checks_curve, ms_curve;                            // all three included
  std::vector<double> acceleration, deviation;  // of the curve: peak, rad/s²; mean square, rad
  std::vector<double> peak_jump;  // of velocity, rad/s, at the smoothed path's corners and ends
  std::uint64_t digest = 0;       // of all that was delivered: the same bytes, the same digest
};

void add_to(std::uint64_t& digest, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  digest = (digest ^ bits) * 0x9e3779b97f4a7c15u;
  digest ^= digest >> 29;
}

void add_to(std::uint64_t& digest, const std::vector<Configuration>& path) {
  for (const Configuration& c : path) {
    for (int i = 0; i < c.q.count; ++i) add_to(digest, c.q[i]);
    add_to(digest, c.t);
  }
}

bool truly_free(FclWorld& judge, double begin, double end,
                const std::function<Dofs(double)>& motion) {
  const int n = static_cast<int>((end - begin) * 1000);
  for (int k = 0; k <= n; ++k) {
    const double t = begin + (end - begin) * k / std::max(1, n);
    if (!judge.free({motion(t), t})) return false;
  }
  return true;
}

bool path_free(FclWorld& judge, const std::vector<Configuration>& path) {
  return truly_free(judge, path.front().t, path.back().t,
                    [&path](double t) { return path_at(path, t).q; });
}

double velocity_jump(const Problem& p, const std::vector<Configuration>& path) {
  double most = 0;
  const auto slope = [&](std::size_t i, int d) {  // of the edge that ends in landmark i
    if (i == 0) return p.velocity_init[d];
    if (i == path.size()) return p.velocity_goal[d];
    return (path[i].q[d] - path[i - 1].q[d]) / (path[i].t - path[i - 1].t);
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (int d = 0; d < p.space.count(); ++d) {
      most = std::max(most, std::abs(slope(i + 1, d) - slope(i, d)));
    }
  }
  return most;
}

// What one check costs on configurations about the clip: a random one of the window's times, the
// parameters off the clip's by up to `spread` rad each, inside the limits.
std::vector<Configuration> configurations_about_clip(const Problem& p, int count, double spread) {
  Random random(1);
  std::vector<Configuration> all;
  while (static_cast<int>(all.size()) < count) {
    Configuration c;
    c.t = random.uniform(p.begin, p.end);
    c.q = p.track->at(c.t).q;
    for (int d = 0; d < c.q.count; ++d) c.q[d] += random.uniform(-spread, spread);
    if (p.space.within_limits(c.q)) all.push_back(c);
  }
  return all;
}

struct CheckCost {
  int free = 0, colliding = 0;
  double us_free = 0, us_colliding = 0;  // mean
};

CheckCost check_cost(const std::vector<Configuration>& all,
                     const std::function<bool(const Configuration&)>& free) {
  for (const Configuration& c : all) free(c);  // warms caches of all kinds
  // The quickest of a few rounds for each: others may work on the machine.
  std::vector<double> us(all.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> is_free(all.size());
  for (int round = 0; round < 9; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto start = std::chrono::steady_clock::now();
      is_free[i] = free(all[i]);
      us[i] = std::min(
          us[i], std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
                     .count());
    }
  }
  CheckCost cost;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ++(is_free[i] ? cost.free : cost.colliding);
    (is_free[i] ? cost.us_free : cost.us_colliding) += us[i];
  }
  cost.us_free /= std::max(1, cost.free);
  cost.us_colliding /= std::max(1, cost.colliding);
  return cost;
}

void print_check_costs(const Problem& p, const Options& options) {
  const auto all = configurations_about_clip(p, 3000, 0.6);
  const auto line = [&](const char* name, const std::function<bool(const Configuration&)>& free) {
    const CheckCost cost = check_cost(all, free);
    std::printf("  a check by %-22s %6.1f us free (%d), %6.1f us colliding (%d)\n", name,
                cost.us_free, cost.free, cost.us_colliding, cost.colliding);
  };
  const auto space = p.planning_space(0);
  line("ours", [&](const Configuration& c) { return space->valid(c); });
  if (options.ours) return;
  const auto boxes =
      make_fcl_world(*space, BoxKind::obbrss_double, AllowedPairs::without_concerned);
  line("FCL OBBRSS double", [&](const Configuration& c) { return boxes->free(c); });
  const auto floats = make_fcl_world(*space, BoxKind::obb_float, AllowedPairs::without_concerned);
  line("FCL OBB float", [&](const Configuration& c) { return floats->free(c); });
  std::vector<RigidTransform> placements;
  line("placing the parts alone", [&](const Configuration& c) {
    space->placements(c, placements);
    return true;
  });
}

// `alike`: everything at the resolution of the peer's edges; otherwise as our settings have it.
Row run_ours(const Problem& p, const std::string& name, double clearance, bool alike,
             FclWorld& judge, const Options& options) {
  Row row;
  row.name = name;
  const auto world = p.planning_space(clearance);
  for (int seed = 1; seed <= options.seeds; ++seed) {
    ++row.runs;
    PlannerSettings settings;
    settings.seed = static_cast<std::uint64_t>(seed);
    if (alike) {
      settings.speed_share = 1;
      settings.path_resolution = settings.resolution;
    }
    PlannerQuery question{&p.space, p.init(), p.goal(), p.length_unit, {}};
    if (!alike) {  // as `correct` asks at first
      settings.sampling.near_share = 0.25;
      question.reference = [&p](double t) { return p.track->at(t).q; };
    }
    double ms = 0, ms_smooth = 0, ms_curve = 0;
    const PlannerResult found = timed(ms, [&] { return plan(*world, question, settings); });
    if (found.status != PlannerStatus::solved) continue;
    ++row.solved;
    SmoothingSettings smoothing;
    smoothing.seed = settings.seed;
    if (alike) smoothing.resolution = settings.resolution;
    const SmoothingResult smooth =
        timed(ms_smooth, [&] { return smooth_path(*world, found.path, smoothing); });
    CurveQuery query;
    query.space = &p.space;
    query.path = smooth.path;
    query.velocity_init = p.velocity_init;
    query.velocity_goal = p.velocity_goal;
    query.reference = [&p](double t) { return p.track->at(t).q; };
    CurveSettings curve_settings;
    curve_settings.seed = settings.seed;
    const CurveResult fitted =
        timed(ms_curve, [&] { return fit_curve(*world, query, curve_settings); });

    double checks = static_cast<double>(found.stats.checks.validity_checks);
    row.checks_first.push_back(checks);
    row.ms_first.push_back(ms);
    row.checks_smooth.push_back(checks += static_cast<double>(smooth.checks.validity_checks));
    row.ms_smooth.push_back(ms += ms_smooth);
    row.checks_curve.push_back(checks += static_cast<double>(fitted.checks.validity_checks));
    row.ms_curve.push_back(ms += ms_curve);
    add_to(row.digest, found.path);
    add_to(row.digest, smooth.path);
    for (const Dofs& q : fitted.curve.control)
      for (int i = 0; i < q.count; ++i) add_to(row.digest, q[i]);
    row.peak_jump.push_back(velocity_jump(p, smooth.path));
    if (!options.ours) {
      row.first_free += path_free(judge, found.path);
      row.smooth_free += path_free(judge, smooth.path);
    }
    if (fitted.status != CurveStatus::solved && options.verbose) {
      std::printf("  %s, seed %d: %s\n", name.c_str(), seed, fitted.reason.c_str());
    }
    if (fitted.status == CurveStatus::solved) {
      ++row.curves;
      row.acceleration.push_back(fitted.peak_acceleration);
      double square = 0;
      for (int k = 0; k <= 500; ++k) {
        const double t = p.begin + (p.end - p.begin) * k / 500.0;
        const Dofs q = fitted.curve.value(t), r = p.track->at(t).q;
        for (int d = 0; d < q.count; ++d) square += (q[d] - r[d]) * (q[d] - r[d]) / 501;
      }
      row.deviation.push_back(std::sqrt(square));
      row.curves_free += !options.ours && truly_free(judge, p.begin, p.end, [&](double t) {
        return fitted.curve.value(t);
      });
    }
  }
  return row;
}

Row run_theirs(const Problem& p, const std::string& name, BoxKind kind, FclWorld& judge,
               const Options& options) {
  Row row;
  row.name = name;
  const auto space = p.planning_space(0);
  const auto world = make_fcl_world(*space, kind, AllowedPairs::without_concerned);
  for (int seed = 1; seed <= options.seeds; ++seed) {
    ++row.runs;
    PeerSettings settings;
    settings.range = options.range;
    settings.resolution = PlannerSettings{}.resolution;
    settings.seed = static_cast<std::uint64_t>(seed);
    const PeerRun run =
        run_peer({&p.space, p.init(), p.goal(), space->step_times()}, *world, settings);
    if (!run.solved) continue;
    ++row.solved;
    row.checks_first.push_back(static_cast<double>(run.checks_plan));
    row.ms_first.push_back(run.ms_plan);
    row.checks_smooth.push_back(static_cast<double>(run.checks_plan + run.checks_smooth));
    row.ms_smooth.push_back(run.ms_plan + run.ms_smooth);
    row.first_free += path_free(judge, run.first);
    row.smooth_free += path_free(judge, run.smooth);
    row.peak_jump.push_back(velocity_jump(p, run.smooth));
  }
  return row;
}

// The clip's own peak acceleration over the window, low-passed at 12 Hz, rad/s².
double clip_acceleration(const Problem& p) {
  std::vector<double> breakpoints;
  const int spans = std::max(4, static_cast<int>((p.end - p.begin) * 120));
  for (int i = 0; i <= spans; ++i) breakpoints.push_back(p.begin + (p.end - p.begin) * i / spans);
  Curve clip;
  clip.knots = clamped_knots(breakpoints);
  clip.control = smoothing_spline(
      clip.knots, [&](double t) { return p.track->at(t).q; }, p.space.count(), 1 / (2 * kPi * 12));
  double most = 0;
  for (std::size_t k = 3; k + 3 < clip.knots.size() && !clip.empty(); ++k) {
    const Dofs a = clip.second(clip.knots[k]);
    for (int d = 0; d < a.count; ++d) most = std::max(most, std::abs(a[d]));
  }
  return most;
}

void print(const std::vector<Row>& rows) {
  std::printf("  %-26s %7s  %15s  %15s  %17s  %17s  %8s\n", "", "solved", "free at 1 ms",
              "checks, median", "first path, ms", "smoothed, ms", "v jump");
  std::printf("  %-26s %7s  %7s %7s  %7s %7s  %8s %8s  %8s %8s  %8s\n", "", "", "first", "smooth",
              "first", "smooth", "median", "p95", "median", "p95", "rad/s");
  for (const Row& r : rows) {
    std::printf("  %-26s %3d/%-3d  %7d %7d  %7.0f %7.0f  %8.2f %8.2f  %8.2f %8.2f  %8.2f\n",
                r.name.c_str(), r.solved, r.runs, r.first_free, r.smooth_free,
                quantile(r.checks_first, 0.5), quantile(r.checks_smooth, 0.5),
                quantile(r.ms_first, 0.5), quantile(r.ms_first, 0.95), quantile(r.ms_smooth, 0.5),
                quantile(r.ms_smooth, 0.95), quantile(r.peak_jump, 0.5));
  }
  for (const Row& r : rows) {
    if (r.checks_curve.empty()) continue;
    std::printf(
        "  %-26s with its C2 curve: %d/%d, free at 1 ms %d; %.0f checks, %.2f ms median, "
        "%.2f ms p95;\n  %26s peak acceleration %.1f rad/s2 median, %.1f p95; off the clip by %.3f "
        "rad median, %.3f p95\n",
        r.name.c_str(), r.curves, r.runs, r.curves_free, quantile(r.checks_curve, 0.5),
        quantile(r.ms_curve, 0.5), quantile(r.ms_curve, 0.95), "", quantile(r.acceleration, 0.5),
        quantile(r.acceleration, 0.95), quantile(r.deviation, 0.5), quantile(r.deviation, 0.95));
  }
  for (const Row& r : rows) {
    if (r.digest) std::printf("  %-26s digest %016" PRIx64 "\n", r.name.c_str(), r.digest);
  }
  const Row& ours = rows.front();
  for (const Row& r : rows) {
    if (!r.checks_curve.empty()) continue;
    std::printf(
        "  %s takes %.2f times as long as ours (like for like) to the first path, %.2f times "
        "to the smoothed one (p95: %.2f, %.2f)\n",
        r.name.c_str(), quantile(r.ms_first, 0.5) / quantile(ours.ms_first, 0.5),
        quantile(r.ms_smooth, 0.5) / quantile(ours.ms_smooth, 0.5),
        quantile(r.ms_first, 0.95) / quantile(ours.ms_first, 0.95),
        quantile(r.ms_smooth, 0.95) / quantile(ours.ms_smooth, 0.95));
  }
  std::printf("\n");
}

int run(const Options& options) {
  bool failed = false;
  for (const std::string& name : problem_names()) {
    if (!options.problem.empty() && name != options.problem) continue;
    const auto entry = make_problem(name);
    if (!entry) {
      std::printf("%s\n\n", entry.error().message().c_str());
      failed = true;
      continue;
    }
    const Problem& p = *entry;
    const auto space = p.planning_space(0);
    std::printf(
        "%s: %s\n  window %.3f to %.3f s, %d DOFs, %zu parts, %zu pairs, %zu triangles of "
        "limb and load against %zu\n",
        p.name.c_str(), p.about.c_str(), p.begin, p.end, p.space.count(), space->parts().size(),
        space->pairs().size(), p.triangles_limb, p.triangles_rest);
    const auto judge =
        make_fcl_world(*space, BoxKind::obbrss_double, AllowedPairs::without_concerned);
    int hits = 0, ours_says = 0;
    for (int k = 0; k <= 1000; ++k) {
      const double t = p.begin + (p.end - p.begin) * k / 1000.0;
      const Configuration c{p.track->at(t).q, t};
      hits += !judge->free(c);
      ours_says += !space->valid(c);
    }
    std::printf("  the clip itself collides in %d of 1001 samples by FCL, %d by ours\n", hits,
                ours_says);
    const double clearance = p.scene->settings().clearance * p.scene->height();
    std::vector<Row> rows;
    std::printf("  the clip's own peak acceleration is %.1f rad/s2\n", clip_acceleration(p));
    print_check_costs(p, options);
    rows.push_back(run_ours(p, "ours, like for like", 0, true, *judge, options));
    rows.push_back(run_ours(p, "ours, as shipped", clearance, false, *judge, options));
    if (!options.ours) {
      rows.push_back(
          run_theirs(p, "OMPL + FCL OBBRSS double", BoxKind::obbrss_double, *judge, options));
      rows.push_back(run_theirs(p, "OMPL + FCL OBB float", BoxKind::obb_float, *judge, options));
    }
    print(rows);
    std::fflush(stdout);
  }
  return failed ? 1 : 0;
}

}  // namespace
}  // namespace elbowroom::bench

int main(int argc, char** argv) {
  elbowroom::bench::Options options;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (more && std::strcmp(argv[i], "--seeds") == 0) {
      options.seeds = std::max(1, std::atoi(argv[++i]));
    } else if (more && std::strcmp(argv[i], "--problem") == 0) {
      options.problem = argv[++i];
    } else if (more && std::strcmp(argv[i], "--range") == 0) {
      options.range = std::atof(argv[++i]);
    } else if (std::strcmp(argv[i], "--ours") == 0) {
      options.ours = true;
    } else if (std::strcmp(argv[i], "--verbose") == 0) {
      options.verbose = true;
    } else {
      std::fprintf(stderr,
                   "usage: elbowroom_bench [--seeds N] [--problem NAME] [--range R] [--ours] "
                   "[--verbose]\n");
      return 1;
    }
  }
  return elbowroom::bench::run(options);
}
