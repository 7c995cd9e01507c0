// SPDX-License-Identifier: MIT
#include "tests/bench/peer/peer.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>

#include "tests/bench/peer/cpu_clock.h"

namespace elbowroom::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Vector = ob::RealVectorStateSpace::StateType;

// Parameters first, time last.
Configuration configuration_of(const ob::State* state, int dofs) {
  const auto* v = state->as<Vector>();
  Configuration c;
  c.q.count = dofs;
  for (int i = 0; i < dofs; ++i) c.q[i] = v->values[i];
  c.t = v->values[dofs];
  return c;
}

class Checker : public ob::StateValidityChecker {
 public:
  Checker(const ob::SpaceInformationPtr& si, const DofSpace& space, FclWorld& world)
      : ob::StateValidityChecker(si), space_(space), world_(world) {}

  bool isValid(const ob::State* state) const override {
    const Configuration c = configuration_of(state, space_.count());
    if (!space_.within_limits(c.q)) return false;
    ++checks;
    return world_.free(c);
  }

  mutable std::int64_t checks = 0;

 private:
  const DofSpace& space_;
  FclWorld& world_;
};

class DirectedMotions : public ob::MotionValidator {
 public:
  DirectedMotions(const ob::SpaceInformationPtr& si, const DofSpace& space,
                  const EdgeResolution& resolution, const std::vector<double>& steps)
      : ob::MotionValidator(si),
        space_(space),
        resolution_(resolution),
        steps_(steps),
        scratch_(si->allocState()) {}
  ~DirectedMotions() override { si_->freeState(scratch_); }

  bool checkMotion(const ob::State* s1, const ob::State* s2) const override {
    const int dofs = space_.count();
    const Configuration a = configuration_of(s1, dofs), b = configuration_of(s2, dofs);
    if (!within_speed_limits(space_, a, b)) return false;
    if (!si_->isValid(s2)) return false;
    double square = 0;
    for (int i = 0; i < dofs; ++i) square += (b.q[i] - a.q[i]) * (b.q[i] - a.q[i]);
    const auto n = static_cast<std::int64_t>(std::ceil(
        std::max(std::sqrt(square) / resolution_.radians, (b.t - a.t) / resolution_.seconds)));
    for (const double step : steps_) {
      if (step <= a.t || step >= b.t) continue;
      if (!valid_at(s1, s2, (std::nextafter(step, a.t) - a.t) / (b.t - a.t)) ||
          !valid_at(s1, s2, (step - a.t) / (b.t - a.t))) {
        return false;
      }
    }
    return visit_by_bisection(n, [&](std::int64_t k) {
      return valid_at(s1, s2, static_cast<double>(k) / static_cast<double>(n));
    });
  }

  bool checkMotion(const ob::State* s1, const ob::State* s2,
                   std::pair<ob::State*, double>& last) const override {
    const bool free = checkMotion(s1, s2);
    if (!free) {
      last.second = 0;
      if (last.first) si_->copyState(last.first, s1);
    }
    return free;
  }

 private:
  bool valid_at(const ob::State* s1, const ob::State* s2, double u) const {
    si_->getStateSpace()->interpolate(s1, s2, u, scratch_);
    return si_->isValid(scratch_);
  }

  const DofSpace& space_;
  EdgeResolution resolution_;
  const std::vector<double>& steps_;
  ob::State* scratch_;
};

std::vector<Configuration> configurations_of(const og::PathGeometric& path, int dofs) {
  std::vector<Configuration> all;
  for (std::size_t i = 0; i < path.getStateCount(); ++i) {
    all.push_back(configuration_of(path.getState(static_cast<unsigned>(i)), dofs));
  }
  return all;
}

}  // namespace

PeerRun run_peer(const PeerProblem& problem, FclWorld& world, const PeerSettings& settings) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  // Generators made from here on get seeds that follow from this one.
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(settings.seed));
  const DofSpace& limits = *problem.space;
  const int dofs = limits.count();
  auto space = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(dofs + 1));
  ob::RealVectorBounds bounds(static_cast<unsigned>(dofs + 1));
  for (int i = 0; i < dofs; ++i) {
    const Dof& dof = limits.dofs[static_cast<std::size_t>(i)];
    bounds.setLow(static_cast<unsigned>(i), dof.lower);
    bounds.setHigh(static_cast<unsigned>(i), dof.upper);
  }
  bounds.setLow(static_cast<unsigned>(dofs), problem.init.t);
  bounds.setHigh(static_cast<unsigned>(dofs), problem.goal.t);
  space->setBounds(bounds);

  auto si = std::make_shared<ob::SpaceInformation>(space);
  auto checker = std::make_shared<Checker>(si, limits, world);
  si->setStateValidityChecker(checker);
  si->setMotionValidator(
      std::make_shared<DirectedMotions>(si, limits, settings.resolution, problem.steps));
  si->setup();

  ob::ScopedState<ob::RealVectorStateSpace> start(space), goal(space);
  for (int i = 0; i < dofs; ++i) {
    start->values[i] = problem.init.q[i];
    goal->values[i] = problem.goal.q[i];
  }
  start->values[dofs] = problem.init.t;
  goal->values[dofs] = problem.goal.t;
  auto definition = std::make_shared<ob::ProblemDefinition>(si);
  definition->setStartAndGoalStates(start, goal);

  og::RRTConnect planner(si);
  planner.setRange(settings.range);
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
  planner.setProblemDefinition(definition);
  planner.setup();

  PeerRun run;
  double begin = cpu_milliseconds();
  const ob::PlannerStatus status =
      planner.solve(ob::timedPlannerTerminationCondition(settings.max_seconds));
  run.ms_plan = cpu_milliseconds() - begin;
  run.checks_plan = checker->checks;
  run.solved = status == ob::PlannerStatus::EXACT_SOLUTION;
  if (!run.solved) return run;

  auto path = *definition->getSolutionPath()->as<og::PathGeometric>();
  run.first = configurations_of(path, dofs);
  begin = cpu_milliseconds();
  og::PathSimplifier simplifier(si);
  simplifier.shortcutPath(path, static_cast<unsigned>(settings.shortcuts),
                          static_cast<unsigned>(settings.shortcuts), 0.33, 0.005);
  run.ms_smooth = cpu_milliseconds() - begin;
  run.checks_smooth = checker->checks - run.checks_plan;
  run.smooth = configurations_of(path, dofs);
  return run;
}

}  // namespace elbowroom::bench
