// SPDX-License-Identifier: MIT
#include "core/editing/window_motion.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "core/collision/limb_planning_space.h"
#include "core/editing/skin_planning_space.h"
#include "core/planning/curve_fit.h"
#include "core/planning/planner.h"
#include "core/planning/smoothing.h"

namespace elbowroom {
namespace {

constexpr std::uint64_t kPartSeed = 15485863;
constexpr int kSkinShare = 10;     // a check on the skin costs so many times more
constexpr int kSkinTrials = 120;   // of fairing
constexpr int kBlendMoments = 60;  // of a window
constexpr double kBlends[] = {0.5, 0.25, 0.75};

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

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

}  // namespace

std::string PlanningView::text() const {
  char text[160];
  std::snprintf(text, sizeof text,
                "%s, clearance %.3g, from the body %.3g, margin %.3g, %.0f %% near the clip",
                on_skin ? "deformed skin" : "rigid parts", clearance, body_clearance, margin,
                100 * near_share);
  return text;
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
    // It poses the scene's limb while it lives.
    for (auto& other : parts_) other.reset();
    parts_[index] =
        std::make_unique<SkinPlanningSpace>(*problem_.scene, problem_.limb_index, from.time,
                                            to.time, from.state, to.state, view_.clearance);
  } else {
    LimbPlanningSpace::Settings settings;
    settings.clearance = view_.clearance;
    settings.margin = view_.margin;
    settings.body_clearance = view_.body_clearance;
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

MotionResult plan_motion(WindowProblem& p, PlanningWorld& world, const PlanningWishes& wishes,
                         std::uint64_t seed, const std::stop_token& stop,
                         const ProgressSink& progress, PlanningCosts& costs) {
  const PlanningView& view = world.view();
  MotionResult result;
  for (std::size_t i = 0; i + 1 < p.postures.size(); ++i) {
    const PostureAt& from = p.postures[i];
    const PostureAt& to = p.postures[i + 1];
    StateSpace& space = world.part(i);
    const std::uint64_t part_seed = seed + kPartSeed * i;

    PlannerSettings planner;
    planner.seed = part_seed;
    planner.max_iterations =
        view.on_skin ? std::max(1, wishes.max_iterations / kSkinShare) : wishes.max_iterations;
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
    costs.validity_checks += planned.stats.checks.validity_checks;
    costs.edge_checks += planned.stats.checks.edge_checks;
    if (planned.status != PlannerStatus::solved) {
      result.motion = {};
      result.cancelled = planned.status == PlannerStatus::cancelled;
      result.reason = planned.reason;
      return result;
    }
    result.path_found = true;

    const auto smooth_start = Clock::now();
    SmoothingSettings smoothing;
    smoothing.seed = part_seed;
    const auto smoothed = smooth_path(space, planned.path, smoothing, stop, progress);
    CurveQuery curve_query;
    curve_query.space = &p.space;
    curve_query.path = smoothed.path;
    curve_query.velocity_init = from.velocity;
    curve_query.velocity_goal = to.velocity;
    curve_query.acceleration_init = from.acceleration;
    curve_query.acceleration_goal = to.acceleration;
    curve_query.reference = [&p](double t) { return p.reference_at(t); };
    CurveSettings curve_settings;
    curve_settings.seed = part_seed;
    if (view.on_skin) curve_settings.max_trials = kSkinTrials;
    const auto fitted = curve_of(space, curve_query, curve_settings, stop, progress);
    costs.smooth_ms += ms_since(smooth_start);
    costs.validity_checks += smoothed.checks.validity_checks + fitted.checks.validity_checks;
    costs.edge_checks += smoothed.checks.edge_checks + fitted.checks.edge_checks;
    result.landmarks += static_cast<int>(smoothed.path.size());
    if (fitted.status != CurveStatus::solved) {
      result.motion = {};
      result.cancelled = stop.stop_requested();
      result.reason = fitted.reason;
      return result;
    }
    const auto name = [&p](const CurveResult::Excess& excess) {
      return p.space.dofs[static_cast<std::size_t>(excess.dof)].name;
    };
    for (const auto& excess : fitted.limit_excess) result.limits_widened.push_back(name(excess));
    for (const auto& excess : fitted.speed_excess)
      result.limits_widened.push_back(name(excess) + " (speed)");
    result.motion.curves.push_back(fitted.curve);
    result.motion.until.push_back(to.time);
  }
  return result;
}

bool same_way_around(PlanningWorld& world, const WindowProblem& p, const WindowMotion& a,
                     const WindowMotion& b) {
  for (std::size_t part = 0; part < a.curves.size(); ++part) {
    StateSpace& space = world.part(part);
    const double begin = p.postures[part].time, end = p.postures[part + 1].time;
    for (const double u : kBlends)
      for (int i = 1; i < kBlendMoments; ++i) {
        const double t = begin + (end - begin) * i / kBlendMoments;
        Configuration blend{a.curves[part].value(t), t};
        const Dofs other = b.curves[part].value(t);
        for (int d = 0; d < blend.q.count; ++d) blend.q[d] += u * (other[d] - blend.q[d]);
        if (!space.valid(blend)) return false;
      }
  }
  return true;
}

}  // namespace elbowroom
