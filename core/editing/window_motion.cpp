// SPDX-License-Identifier: MIT
#include "core/editing/window_motion.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/base/stopwatch.h"
#include "core/collision/limb_planning_space.h"
#include "core/editing/skin_planning_space.h"
#include "core/planning/curve_fit.h"
#include "core/planning/planner.h"
#include "core/planning/smoothing.h"

namespace elbowroom {
namespace {

constexpr std::uint64_t kPartSeed = 15485863;
constexpr int kSkinTrials = 120;   // of fairing, and half as many for accelerations
constexpr int kBlendMoments = 60;  // of a window
constexpr double kBlends[] = {0.5, 0.25, 0.75};

using Clock = std::chrono::steady_clock;

// The curve through a path. It meets the clip's accelerations too where that leaves room; where it
// doesn't, its velocities.
CurveResult curve_of(StateSpace& space, CurveQuery query, const CurveSettings& settings,
                     const std::stop_token& stop, const ProgressSink& progress) {
  CurveResult fitted = fit_curve(space, query, settings, stop, progress);
  const bool bound = query.acceleration_init || query.acceleration_goal;
  if (fitted.status != CurveStatus::no_curve || !bound) return fitted;
  query.acceleration_init.reset();
  query.acceleration_goal.reset();
  CurveResult looser = fit_curve(space, query, settings, stop, progress);
  looser.checks.validity_checks += fitted.checks.validity_checks;
  looser.checks.edge_checks += fitted.checks.edge_checks;
  return looser;
}

std::uint64_t part_seed(std::uint64_t seed, std::size_t part) { return seed + kPartSeed * part; }

// Whether every blend of a motion and another, `other(part, t)`, is free.
template <typename Other>
bool blends_free(PlanningWorld& world, const WindowProblem& p, const WindowMotion& motion,
                 const Other& other) {
  for (std::size_t part = 0; part < motion.curves.size(); ++part) {
    StateSpace& space = world.part(part);
    const double begin = p.postures[part].time, end = p.postures[part + 1].time;
    for (const double u : kBlends)
      for (int i = 1; i < kBlendMoments; ++i) {
        const double t = begin + (end - begin) * i / kBlendMoments;
        Configuration blend{motion.curves[part].value(t), t};
        const Dofs to = other(part, t);
        for (int d = 0; d < blend.q.count; ++d) blend.q[d] += u * (to[d] - blend.q[d]);
        if (!space.valid(blend)) return false;
      }
  }
  return true;
}

}  // namespace

void PlanningCosts::add(const CheckCounters& checks) {
  validity_checks += checks.validity_checks;
  edge_checks += checks.edge_checks;
}

const Curve& WindowMotion::at(double t) const {
  std::size_t i = 0;
  while (i + 1 < curves.size() && t > until[i]) ++i;
  return curves[i];
}

PlanningWorld::PlanningWorld(WindowProblem& problem, const PlanningView& view)
    : problem_(problem), view_(view) {
  parts_.resize(problem.postures.size() - 1);
  rigid_.resize(parts_.size(), nullptr);
}
PlanningWorld::~PlanningWorld() = default;

StateSpace& PlanningWorld::part(std::size_t index) {
  if (parts_[index]) return *parts_[index];
  const PostureAt& from = problem_.postures[index];
  const PostureAt& to = problem_.postures[index + 1];
  if (view_.on_skin) {
    using Beside = SkinPlanningSpace::BesideClipContacts;
    // It poses the scene's limb while it lives.
    for (auto& other : parts_) other.reset();
    parts_[index] = std::make_unique<SkinPlanningSpace>(
        *problem_.scene, problem_.limb_index, from.time, to.time, from.state, to.state,
        view_.clearance, view_.body_clearance,
        view_.as_verified ? Beside::as_verified : Beside::slides, view_.moments);
  } else {
    LimbPlanningSpace::Settings settings;
    settings.clearance = view_.clearance;
    settings.margin = view_.margin;
    settings.body_clearance = view_.body_clearance;
    settings.pair_margins = view_.pair_margins;
    auto space = std::make_unique<LimbPlanningSpace>(
        *problem_.scene, problem_.limb_index, from.time, to.time, from.state, to.state, settings);
    rigid_[index] = space.get();
    parts_[index] = std::move(space);
  }
  return *parts_[index];
}

std::string PlanningWorld::blocked_by() const {
  for (const LimbPlanningSpace* space : rigid_) {
    if (space == nullptr) continue;
    const auto pair = space->most_blocking();
    if (!pair.first.empty()) return pair.first + " with " + pair.second;
  }
  return {};
}

WindowPaths plan_paths(const WindowProblem& p, PlanningWorld& world, const PlanningWishes& wishes,
                       std::uint64_t seed, const std::stop_token& stop,
                       const ProgressSink& progress, PlanningCosts& costs) {
  const PlanningView& view = world.view();
  WindowPaths result;
  result.seed = seed;
  for (std::size_t i = 0; i + 1 < p.postures.size(); ++i) {
    const PostureAt& from = p.postures[i];
    const PostureAt& to = p.postures[i + 1];
    StateSpace& space = world.part(i);

    PlannerSettings planner;
    planner.seed = part_seed(seed, i);
    planner.max_iterations =
        std::max(1, static_cast<int>(std::lround(view.effort * wishes.max_iterations)));
    planner.max_validity_checks = view.most_checks;
    if (wishes.max_seconds > 0) planner.max_seconds = wishes.max_seconds;
    planner.sampling.near_share = view.near_share;
    planner.sampling.max_tries = 16;
    PlannerQuery query;
    query.space = &p.space;
    query.init = {from.state.q, from.time};
    query.goal = {to.state.q, to.time};
    query.length_unit = p.length_unit;
    query.reference = [&p](double t) { return p.reference_at(t); };
    const auto planned = plan(space, query, planner, stop, progress);
    costs.plan_ms += planned.milliseconds;
    costs.iterations += planned.stats.iterations;
    costs.add(planned.stats.checks);
    if (planned.status != PlannerStatus::solved) {
      result.parts.clear();
      result.reason = planned.reason;
      return result;
    }

    const auto smooth_start = Clock::now();
    SmoothingSettings smoothing;
    smoothing.seed = part_seed(seed, i);
    auto smoothed = smooth_path(space, planned.path, smoothing, stop, progress);
    costs.smooth_ms += ms_since(smooth_start);
    costs.add(smoothed.checks);
    result.parts.push_back(std::move(smoothed.path));
  }
  return result;
}

MotionResult fit_motion(const WindowProblem& p, PlanningWorld& world, const WindowPaths& paths,
                        const std::stop_token& stop, const ProgressSink& progress,
                        PlanningCosts& costs) {
  MotionResult result;
  for (std::size_t i = 0; i < paths.parts.size(); ++i) {
    const PostureAt& from = p.postures[i];
    const PostureAt& to = p.postures[i + 1];
    const auto start = Clock::now();
    CurveQuery query;
    query.space = &p.space;
    query.path = paths.parts[i];
    query.velocity_init = from.velocity;
    query.velocity_goal = to.velocity;
    query.acceleration_init = from.acceleration;
    query.acceleration_goal = to.acceleration;
    query.reference = [&p](double t) { return p.reference_at(t); };
    CurveSettings settings;
    settings.seed = part_seed(paths.seed, i);
    if (world.view().on_skin) {
      settings.max_trials = kSkinTrials;
      settings.max_relief_trials = kSkinTrials / 2;
    }
    const auto fitted = curve_of(world.part(i), query, settings, stop, progress);
    costs.smooth_ms += ms_since(start);
    costs.add(fitted.checks);
    result.landmarks += static_cast<int>(paths.parts[i].size());
    if (fitted.status != CurveStatus::solved) {
      result.motion = {};
      result.reason = fitted.reason;
      return result;
    }
    const auto name = [&p](const CurveLimits::Excess& excess) {
      return p.space.dofs[static_cast<std::size_t>(excess.dof)].name;
    };
    for (const auto& excess : fitted.limit_excess) result.limits_widened.push_back(name(excess));
    for (const auto& excess : fitted.speed_excess)
      result.limits_widened.push_back(name(excess) + " (speed)");
    for (const auto& excess : fitted.acceleration_excess)
      result.limits_widened.push_back(name(excess) + " (acceleration)");
    result.keeps_accelerations = result.keeps_accelerations && fitted.acceleration_kept;
    result.motion.curves.push_back(fitted.curve);
    result.motion.until.push_back(to.time);
  }
  return result;
}

bool same_way_around(PlanningWorld& world, const WindowProblem& p, const WindowMotion& a,
                     const WindowMotion& b) {
  return blends_free(world, p, a,
                     [&](std::size_t part, double t) { return b.curves[part].value(t); });
}

bool same_way_around(PlanningWorld& world, const WindowProblem& p, const WindowMotion& a,
                     const WindowPaths& b) {
  return blends_free(world, p, a,
                     [&](std::size_t part, double t) { return path_at(b.parts[part], t).q; });
}

}  // namespace elbowroom
