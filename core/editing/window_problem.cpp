// SPDX-License-Identifier: MIT
#include "core/editing/window_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/editing/limb_keys.h"

namespace elbowroom {
namespace {

constexpr double kSpeedReserve = 1.05;  // over the clip's own peak speed, where that is the limit

constexpr double kMostClearance = 0.25;  // × height
constexpr double kStyleBlend = 0.35;     // s, from the clip's posture to the style asked for
constexpr double kStyleAir = 0.1;        // share of an interval, kept from its ends

double limb_length(const WindowProblem& p) {
  std::vector<ActorState> states;
  world_state_at(p.scene->world(), p.begin, states);
  const auto& globals = states[static_cast<std::size_t>(p.scene->actor())].world_from_joint;
  double length = 0;
  for (std::size_t j = 1; j < p.limb->joints.size(); ++j) {
    const auto a = globals[static_cast<std::size_t>(p.limb->joints[j - 1].joint)][3];
    const auto b = globals[static_cast<std::size_t>(p.limb->joints[j].joint)][3];
    length += glm::length(Vec3(b) - Vec3(a));
  }
  return length > 0 ? length : 0.3 * p.scene->height();
}

std::string degrees(double radians) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f°", radians * 180 / kPi);
  return text;
}

// Limits and speed limits that the clip itself exceeds are widened for this query.
void widen_limits(WindowProblem& p) {
  std::vector<bool> widened(static_cast<std::size_t>(p.space.count()), false);
  const int samples = std::max(2, static_cast<int>((p.end - p.begin) * 120));
  for (int i = 0; i <= samples; ++i) {
    const Dofs q = p.track->at(p.begin + (p.end - p.begin) * i / samples).q;
    for (const int d : p.space.widen_to(q)) widened[static_cast<std::size_t>(d)] = true;
  }
  for (const Dofs* q : {&p.postures.front().state.q, &p.postures.back().state.q})
    for (const int d : p.space.widen_to(*q)) widened[static_cast<std::size_t>(d)] = true;
  for (int d = 0; d < p.space.count(); ++d) {
    Dof& dof = p.space.dofs[static_cast<std::size_t>(d)];
    const double own = std::max({p.track->peak_speed()[d], std::abs(p.postures.front().velocity[d]),
                                 std::abs(p.postures.back().velocity[d])});
    const bool too_fast = own * kSpeedReserve > dof.speed_limit;
    if (too_fast) dof.speed_limit = own * kSpeedReserve;
    if (widened[static_cast<std::size_t>(d)]) p.limits_widened.push_back(dof.name);
    if (too_fast) p.limits_widened.push_back(dof.name + " (speed)");
  }
}

}  // namespace

Dofs WindowProblem::reference_at(double t) const {
  Dofs q = track->at(t).q;
  double nearest = end - begin;
  for (const PostureAt& posture : postures) nearest = std::min(nearest, std::abs(t - posture.time));
  const double u = std::clamp(nearest / std::min(kStyleBlend, 0.5 * (end - begin)), 0.0, 1.0);
  const double weight = u * u * u * (10 - 15 * u + 6 * u * u);  // C2 at both ends
  for (std::size_t d = 0; d < wanted.size(); ++d) {
    if (!wanted[d]) continue;
    const double air = kStyleAir * (wanted[d]->upper - wanted[d]->lower);
    double& value = q.value[d];
    value += weight * (std::clamp(value, wanted[d]->lower + air, wanted[d]->upper - air) - value);
  }
  return q;
}

std::array<Quat, 3> WindowProblem::residual_at(double t) const {
  const double u = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
  return residual_between(postures.front().state, postures.back().state, u);
}

WindowProblem window_problem(SceneCollision& scene, const std::shared_ptr<const Clip>& clip,
                             int limb, double begin, double end, const PlanningWishes& wishes) {
  WindowProblem p;
  p.scene = &scene;
  p.clip = clip;
  p.limb_index = limb;
  p.limb = &scene.limbs()[static_cast<std::size_t>(limb)];
  p.begin = begin;
  p.end = end;
  const Model& model = *scene.world().actors[static_cast<std::size_t>(scene.actor())].model;
  p.track = std::make_shared<const LimbTrack>(model, *clip, *p.limb, begin, end);
  // Where the clip begins or ends with the window there is no motion outside to meet: its own, seen
  // from inside, is met instead.
  const bool first = begin <= clip->begin, last = end >= clip->end;
  p.postures = {{begin, p.track->at(begin), p.track->rate(begin, first ? 1 : -1), {}},
                {end, p.track->at(end), p.track->rate(end, last ? -1 : 1), {}}};
  if (!first) p.postures.front().acceleration = p.track->acceleration(begin);
  if (!last) p.postures.back().acceleration = p.track->acceleration(end);
  p.space = p.limb->space;
  for (Dof& dof : p.space.dofs) {
    const auto wish = wishes.sampling.find(dof.name);
    p.wanted.emplace_back();
    if (wish == wishes.sampling.end()) continue;
    dof.sample_lower = std::clamp(wish->second.lower, dof.lower, dof.upper);
    dof.sample_upper = std::clamp(wish->second.upper, dof.sample_lower, dof.upper);
    p.wanted.back() = Interval{dof.sample_lower, dof.sample_upper};
  }
  widen_limits(p);
  p.length_unit = limb_length(p);
  return p;
}

Status check_wishes(const SceneCollision& scene, const std::vector<int>& limbs,
                    const PlanningWishes& wishes) {
  const double most = kMostClearance * scene.height();
  if (!(wishes.clearance >= 0 && wishes.clearance <= most))
    return Error{"a clearance of " + std::to_string(wishes.clearance) + " makes no sense here", "",
                 "give 0 (the default) or up to " + std::to_string(most) +
                     " scene units, a quarter of the character's height"};

  for (const auto& [name, interval] : wishes.sampling) {
    if (!(interval.lower <= interval.upper))
      return Error{"the sampling interval of \"" + name + "\" is empty or not a number", "",
                   "give the lower bound first"};
    std::string known;
    bool found = false;
    for (const int limb : limbs) {
      const LimbModel& model = scene.limbs()[static_cast<std::size_t>(limb)];
      for (const Dof& dof : model.space.dofs) {
        found = found || dof.name == name;
        if (known.find(dof.name) == std::string::npos)
          known += (known.empty() ? "" : "; ") + dof.name;
        if (dof.name == name && (interval.upper < dof.lower || interval.lower > dof.upper))
          return Error{"the sampling interval of \"" + name + "\" lies outside the limits of " +
                           model.limb.name,
                       "", "they are " + degrees(dof.lower) + " to " + degrees(dof.upper)};
      }
    }
    if (!found)
      return Error{"there is no DOF \"" + name + "\" to sample", "", "the limb's DOFs: " + known};
  }
  return Done{};
}

std::vector<std::string> wishes_cut(const SceneCollision& scene, const std::vector<int>& limbs,
                                    const PlanningWishes& wishes) {
  constexpr double kRounding = 1e-6;  // rad
  std::vector<std::string> cut;
  for (const int limb : limbs) {
    const LimbModel& model = scene.limbs()[static_cast<std::size_t>(limb)];
    for (const Dof& dof : model.space.dofs) {
      const auto wish = wishes.sampling.find(dof.name);
      if (wish == wishes.sampling.end()) continue;
      const Interval& interval = wish->second;
      if (interval.lower >= dof.lower - kRounding && interval.upper <= dof.upper + kRounding)
        continue;
      cut.push_back("the sampling interval of \"" + dof.name + "\" is cut to the limits of " +
                    model.limb.name + ", " + degrees(dof.lower) + " to " + degrees(dof.upper));
    }
  }
  return cut;
}

}  // namespace elbowroom
