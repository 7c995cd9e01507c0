// SPDX-License-Identifier: MIT
#include "core/planning/planner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "core/planning/space_check.h"
#include "core/planning/tree.h"

namespace elbowroom {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// One run of Algorithm 1 on a query that has been checked.
class Search {
 public:
  Search(StateSpace& world, const PlannerQuery& query, const PlannerSettings& settings,
         double speed_share, std::stop_token stop, PlannerResult& result)
      : world_(world),
        settings_(settings),
        sampling_{query.space, query.init, query.goal, speed_share, query.reference},
        weights_{settings.time_weight * query.length_unit, settings.posture_weight},
        step_(settings.step * query.length_unit),
        stop_(std::move(stop)),
        result_(result),
        init_(Tree::Direction::forward, weights_),
        goal_(Tree::Direction::backward, weights_),
        random_(settings.seed),
        finer_paths_(settings.path_resolution.radians < settings.resolution.radians ||
                     settings.path_resolution.seconds < settings.resolution.seconds) {
    world_.metric_points(query.init, points_);
    init_.add(query.init, points_, -1);
    world_.metric_points(query.goal, points_);
    goal_.add(query.goal, points_, -1);
  }

  // Lines 2 to 12 once; true when a path was found.
  bool iterate(std::int64_t iteration) {
    Tree& tree_1 = swapped_ ? goal_ : init_;
    Tree& tree_2 = swapped_ ? init_ : goal_;
    swapped_ = !swapped_;  // line 12, early: nothing below looks at it again

    Configuration sample;
    if (!sample_configuration(world_, sampling_, settings_.sampling, iteration, random_, stop_,
                              sample, result_.stats.sampling, result_.stats.checks)) {
      return false;
    }
    world_.metric_points(sample, points_);
    const int node_1 = tree_1.nearest(sample.t, points_, settings_.smallest_time_step);
    const int node_2 = tree_2.nearest(sample.t, points_, settings_.smallest_time_step);
    if (node_1 < 0 || node_2 < 0) return false;
    if (connect(tree_1, node_1, node_2)) return true;
    if (tree_1.is_cut(node_1) || tree_2.is_cut(node_2)) return false;
    const int expanded = expand(tree_1, node_1, sample);
    return expanded >= 0 && connect(tree_1, expanded, node_2);
  }

  std::int64_t nodes_init() const { return init_.size(); }
  std::int64_t nodes_goal() const { return goal_.size(); }

 private:
  // INTERPOLATIONVALID between a node of tree_1 and one of the other tree, whichever of them grows
  // forward being the earlier; makes the path if it is.
  bool connect(const Tree& tree_1, int node_1, int node_2) {
    const bool forward = tree_1.direction() == Tree::Direction::forward;
    const int from = forward ? node_1 : node_2;
    const int to = forward ? node_2 : node_1;
    if (!failed_.insert((static_cast<std::uint64_t>(from) << 32) | static_cast<std::uint32_t>(to))
             .second) {
      return false;
    }
    const Configuration& a = init_.node(from);
    const Configuration& b = goal_.node(to);
    if (!(b.t - a.t >= settings_.smallest_time_step)) return false;
    if (!within_speed_limits(*sampling_.space, a, b, sampling_.speed_share)) return false;
    if (!interpolation_free(world_, settings_.resolution, a, b, stop_, result_.stats.checks)) {
      return false;
    }
    if (finer_paths_ &&
        (!verify(init_, verified_init_, from) || !verify(goal_, verified_goal_, to) ||
         !interpolation_free(world_, settings_.path_resolution, a, b, stop_,
                             result_.stats.checks))) {
      return false;
    }
    make_path(from, to);
    return true;
  }

  // The edges from a node to its root at the resolution of paths. One that fails is cut off.
  bool verify(Tree& tree, std::vector<bool>& verified, int i) {
    verified.resize(static_cast<std::size_t>(tree.size()), false);
    for (; tree.parent(i) >= 0; i = tree.parent(i)) {
      if (verified[static_cast<std::size_t>(i)]) continue;
      const Configuration& node = tree.node(i);
      const Configuration& parent = tree.node(tree.parent(i));
      const bool forward = tree.direction() == Tree::Direction::forward;
      if (!interpolation_free(world_, settings_.path_resolution, forward ? parent : node,
                              forward ? node : parent, stop_, result_.stats.checks)) {
        if (!stop_.stop_requested()) tree.cut(i);
        return false;
      }
      verified[static_cast<std::size_t>(i)] = true;
    }
    return true;
  }

  // MAKEPATH: the branch of T_init that ends in `from`, then that of T_goal from `to` to its root.
  void make_path(int from, int to) {
    std::vector<Configuration>& path = result_.path;
    path.clear();
    for (int i = from; i >= 0; i = init_.parent(i)) path.push_back(init_.node(i));
    std::reverse(path.begin(), path.end());
    for (int i = to; i >= 0; i = goal_.parent(i)) path.push_back(goal_.node(i));
  }

  // The sample as the speed limits let a node come to it in the time between them.
  Configuration slowed(const Configuration& node, const Configuration& sample) const {
    const DofSpace& space = *sampling_.space;
    const double dt = std::abs(sample.t - node.t);
    // DOF by DOF first: that way the result stays within reach of the other end, since of the
    // values reachable from there the interval is convex and holds both the sample's and one of the
    // node's future. A corner of the box may leave an ellipse; then all DOFs slow down alike.
    Configuration slow = sample;
    double share = 1;
    for (int i = 0; i < space.count(); ++i) {
      const double way =
          sampling_.speed_share * space.dofs[static_cast<std::size_t>(i)].speed_limit * dt;
      slow.q[i] = std::clamp(sample.q[i], node.q[i] - way, node.q[i] + way);
      const double wanted = std::abs(sample.q[i] - node.q[i]);
      if (wanted > way) share = std::min(share, way / wanted);
    }
    if (space.within_limits(slow.q)) return slow;
    slow = interpolate(node, sample, share);
    slow.t = sample.t;
    return slow;
  }

  // NODEEXPANSION, with the new node's index or -1 for null.
  int expand(Tree& tree, int from, const Configuration& sample) {
    const Configuration node = tree.node(from);
    const Configuration target = slowed(node, sample);
    world_.metric_points(node, node_points_);
    world_.metric_points(target, points_);
    const double d = metric_distance(weights_, node.t, node_points_, target.t, points_);
    if (!(d > 0) || !std::isfinite(d)) return -1;
    const Configuration grown = interpolate(node, target, std::min(1.0, step_ / d));
    if (!(std::abs(grown.t - node.t) >= settings_.smallest_time_step)) return -1;

    const bool forward = tree.direction() == Tree::Direction::forward;
    const Configuration& earlier = forward ? node : grown;
    const Configuration& later = forward ? grown : node;
    // A node from which the other end is out of reach leads nowhere; the speeds of its own edge
    // hold but for rounding, which is not to add up.
    const Configuration& end = forward ? sampling_.goal : sampling_.init;
    const double share = sampling_.speed_share;
    const DofSpace& space = *sampling_.space;
    if (!space.within_limits(grown.q) || !within_speed_limits(space, earlier, later, share) ||
        !(forward ? within_speed_limits(space, grown, end, share)
                  : within_speed_limits(space, end, grown, share))) {
      return -1;
    }
    ++result_.stats.checks.validity_checks;
    if (!world_.valid(grown)) return -1;
    if (!interpolation_free(world_, settings_.resolution, earlier, later, stop_,
                            result_.stats.checks)) {
      return -1;
    }
    world_.metric_points(grown, points_);
    return tree.add(grown, points_, from);
  }

  StateSpace& world_;
  const PlannerSettings& settings_;
  SamplingQuery sampling_;
  MetricWeights weights_;
  double step_;
  std::stop_token stop_;
  PlannerResult& result_;
  Tree init_, goal_;
  Random random_;
  bool swapped_ = false;
  bool finer_paths_ = true;                          // than the trees' edges
  std::vector<bool> verified_init_, verified_goal_;  // the edge to the parent holds for a path
  std::vector<Vec3> points_, node_points_;
  std::unordered_set<std::uint64_t> failed_;  // pairs of nodes whose connection was tested
};

// The share of the speed limits that the straight way from init to goal needs, and whose it is.
std::pair<double, int> speed_needed(const PlannerQuery& query) {
  std::pair<double, int> most{0, 0};
  for (int i = 0; i < query.space->count(); ++i) {
    const double speed =
        std::abs(query.goal.q[i] - query.init.q[i]) / (query.goal.t - query.init.t);
    const double share = speed / query.space->dofs[static_cast<std::size_t>(i)].speed_limit;
    if (share > most.first) most = {share, i};
  }
  return most;
}

std::string settings_fault(const PlannerSettings& s) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (!(s.time_weight >= 0) || !(s.posture_weight >= 0) || !std::isfinite(s.time_weight) ||
      !std::isfinite(s.posture_weight) || !(s.time_weight + s.posture_weight > 0)) {
    return "the weights of the metric are no proper weights";
  }
  if (!positive(s.step)) return "the step of the search is not positive";
  if (!positive(s.resolution.radians) || !positive(s.resolution.seconds) ||
      !positive(s.path_resolution.radians) || !positive(s.path_resolution.seconds)) {
    return "the resolution of the edge check is not positive";
  }
  if (!positive(s.speed_share)) return "the share of the speed limits is not positive";
  if (!positive(s.smallest_time_step)) return "the smallest time step is not positive";
  if (std::isnan(s.max_seconds)) return "the time budget is not a number";
  if (!std::isfinite(s.sampling.near_share) || !std::isfinite(s.sampling.near_reach) ||
      s.sampling.near_reach < 0) {
    return "the samples near the clip have no proper share or reach";
  }
  return {};
}

// Fills status and reason if the query cannot be searched; true if it can.
bool check_query(StateSpace& world, const PlannerQuery& query, const PlannerSettings& settings,
                 const std::stop_token& stop, PlannerResult& result) {
  const auto refuse = [&](PlannerStatus status, std::string reason) {
    result.status = status;
    result.reason = std::move(reason);
    return false;
  };
  if (!query.space) return refuse(PlannerStatus::invalid_query, "no DOF space is given");
  std::string fault = dof_space_fault(*query.space);
  if (fault.empty()) fault = settings_fault(settings);
  if (fault.empty() && (!std::isfinite(query.length_unit) || !(query.length_unit > 0))) {
    fault = "the length unit is not positive";
  }
  if (!fault.empty()) return refuse(PlannerStatus::invalid_query, fault);
  if (fault = configuration_fault(*query.space, query.init); !fault.empty()) {
    return refuse(PlannerStatus::invalid_query, "start: " + fault);
  }
  if (fault = configuration_fault(*query.space, query.goal); !fault.empty()) {
    return refuse(PlannerStatus::invalid_query, "goal: " + fault);
  }
  if (!(query.goal.t - query.init.t >= 2 * settings.smallest_time_step)) {
    return refuse(PlannerStatus::invalid_query, "the window is empty");
  }
  if (fault = limit_fault(*query.space, query.init.q); !fault.empty()) {
    return refuse(PlannerStatus::invalid_start, fault);
  }
  if (fault = limit_fault(*query.space, query.goal.q); !fault.empty()) {
    return refuse(PlannerStatus::invalid_goal, fault);
  }
  if (stop.stop_requested()) return refuse(PlannerStatus::cancelled, "cancelled");
  ++result.stats.checks.validity_checks;
  if (!world.valid(query.init)) {
    return refuse(PlannerStatus::invalid_start, "the limb collides at the start");
  }
  if (stop.stop_requested()) return refuse(PlannerStatus::cancelled, "cancelled");
  ++result.stats.checks.validity_checks;
  if (!world.valid(query.goal)) {
    return refuse(PlannerStatus::invalid_goal, "the limb collides at the goal");
  }
  return true;
}

}  // namespace

const char* planner_status_id(PlannerStatus status) {
  switch (status) {
    case PlannerStatus::solved:
      return "solved";
    case PlannerStatus::no_path:
      return "no_path";
    case PlannerStatus::cancelled:
      return "cancelled";
    case PlannerStatus::invalid_start:
      return "invalid_start";
    case PlannerStatus::invalid_goal:
      return "invalid_goal";
    case PlannerStatus::invalid_query:
      return "invalid_query";
  }
  return "unknown";
}

PlannerResult plan(StateSpace& world, const PlannerQuery& query, const PlannerSettings& settings,
                   std::stop_token stop, const ProgressSink& progress) {
  const Clock::time_point start = Clock::now();
  PlannerResult result;
  if (!check_query(world, query, settings, stop, result)) {
    result.milliseconds = 1e3 * seconds_since(start);
    return result;
  }
  const auto [needed, needed_by] = speed_needed(query);
  if (needed > 1 + 1e-9) {
    result.status = PlannerStatus::no_path;
    result.reason =
        "the window is too short: " + query.space->dofs[static_cast<std::size_t>(needed_by)].name +
        " would have to go beyond its speed limit";
    result.milliseconds = 1e3 * seconds_since(start);
    return result;
  }
  // A hair more than the straight way needs, so that reach never is a single point.
  const double share = std::min(1.0, std::max(settings.speed_share, needed * (1 + 1e-6)));

  Search search(world, query, settings, share, stop, result);
  Clock::time_point told = start;
  result.status = PlannerStatus::no_path;
  PlannerStats& stats = result.stats;
  while (stats.iterations < settings.max_iterations &&
         stats.checks.validity_checks < settings.max_validity_checks) {
    if (stop.stop_requested()) break;
    if (seconds_since(start) >= settings.max_seconds) break;
    const bool found = search.iterate(stats.iterations++);
    if (found) {
      result.status = PlannerStatus::solved;
      break;
    }
    if (progress && Clock::now() - told > std::chrono::milliseconds(20)) {
      told = Clock::now();
      const double by_count =
          static_cast<double>(stats.iterations) / static_cast<double>(settings.max_iterations);
      progress({"planning",
                std::min(1.0, std::max(by_count, seconds_since(start) / settings.max_seconds))});
    }
  }
  if (result.status != PlannerStatus::solved) {
    if (stop.stop_requested()) {
      result.status = PlannerStatus::cancelled;
      result.reason = "cancelled";
    } else {
      result.reason = "no path was found in " + std::to_string(stats.iterations) + " iterations";
    }
  }
  stats.nodes_init = search.nodes_init();
  stats.nodes_goal = search.nodes_goal();
  stats.landmarks = static_cast<std::int64_t>(result.path.size());
  result.milliseconds = 1e3 * seconds_since(start);
  return result;
}

}  // namespace elbowroom
