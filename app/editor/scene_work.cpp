// SPDX-License-Identifier: MIT
#include "app/editor/scene_work.h"

#include <algorithm>
#include <utility>

#include "core/editing/plan_window.h"
#include "core/editing/reach.h"
#include "core/editing/suggestions.h"

namespace elbowroom {
namespace {

PlanFailure failure_of(const Task& task, const WindowReport& report) {
  PlanFailure failure;
  failure.limb = task.limb;
  failure.reason = report.reason;
  failure.blocked_by = report.blocked_by;
  failure.begin = report.begin;
  failure.end = report.end;
  failure.suggestions = report.suggestions;
  failure.hopeless = report.attempts.empty();
  failure.reach = task.kind == TaskKind::reach;
  failure.turning = task.target && task.target->orientation && !report.out_of_reach;
  return failure;
}

}  // namespace

Status SceneWork::prepare(std::shared_ptr<const Session> session, const std::stop_token& stop) {
  scene_.reset();
  session_ = std::move(session);
  auto scene = contacts_of(*session_, stop);
  if (!scene) return scene.error();
  scene_ = std::move(*scene);
  return Done{};
}

CollisionStrip SceneWork::look(std::shared_ptr<const Clip> clip, std::stop_token stop,
                               const StripSink& grown) {
  const double begin = clip->begin, end = clip->end;
  scene_->set_clip(std::move(clip));
  return make_collision_strip(*scene_, begin, end, stop, grown);
}

CollisionStrip SceneWork::look_again(std::shared_ptr<const Clip> clip, const CollisionStrip& before,
                                     double from, double to, std::stop_token stop) {
  scene_->set_clip(std::move(clip));
  return renew_collision_strip(*scene_, before, from, to, stop);
}

PlanOutcome SceneWork::plan(std::shared_ptr<const Clip> clip, int limb, const Task& task,
                            std::stop_token stop, const ProgressSink& progress) {
  PlanOutcome outcome;
  if (Status sound = check_wishes(*scene_, {limb}, task.wishes); !sound) {
    outcome.error = sound.error();
    return outcome;
  }
  scene_->set_clip(clip);
  WindowPlan plan;
  if (task.kind == TaskKind::reach) {
    auto reached = plan_reach(*scene_, limb, task, stop, progress);
    if (!reached) {
      outcome.error = reached.error();
      return outcome;
    }
    plan = std::move(*reached);
  } else {
    plan = plan_window(
        window_problem(*scene_, clip, limb, task.window->lower, task.window->upper, task.wishes),
        task.wishes, stop, progress);
    if (!plan.correction && !stop.stop_requested())
      try_suggestions(*scene_, plan.report, task.wishes, stop, [&](const Progress& p) {
        progress({"trying what would do instead", p.fraction});
      });
  }
  if (stop.stop_requested()) return outcome;
  if (!plan.correction) {
    outcome.failure = failure_of(task, plan.report);
    return outcome;
  }
  add_way(outcome, clip, limb, task, std::move(plan.report), std::move(*plan.correction), stop);
  for (auto& other : plan.alternatives)
    add_way(outcome, clip, limb, task, std::move(other.report), std::move(other.correction), stop);
  return outcome;
}

void SceneWork::add_way(PlanOutcome& outcome, const std::shared_ptr<const Clip>& clip, int limb,
                        const Task& task, WindowReport report, Correction correction,
                        const std::stop_token& stop) {
  if (outcome.error || stop.stop_requested()) return;
  const Skeleton& skeleton = session_->scene.model().skeleton;
  auto laid = lay_over(skeleton, *clip, {correction});
  if (!laid) {
    outcome.error = laid.error();
    return;
  }
  Candidate candidate;
  candidate.task = task;
  // The task is what makes the same correction again: with the window that was planned.
  candidate.task.window =
      Interval{static_cast<double>(correction.begin), static_cast<double>(correction.end)};
  candidate.correction = std::move(correction);
  candidate.report = std::move(report);
  candidate.clip = std::make_shared<const Clip>(std::move(*laid));
  scene_->set_clip(candidate.clip);
  const double reach = kStripReach * scene_->height();
  candidate.scene_clearance = reach;
  const double begin = candidate.task.window->lower, end = candidate.task.window->upper;
  const int samples = std::max(1, static_cast<int>((end - begin) * kStripRate));
  for (int i = 0; i <= samples && !stop.stop_requested(); ++i) {
    StripSample at;
    at.t = begin + (end - begin) * i / samples;
    at.clearance = scene_->limb_clearance_from_scene(at.t, limb, reach);
    candidate.scene_clearance = std::min(candidate.scene_clearance, at.clearance);
    candidate.room.push_back(at);
  }
  if (!stop.stop_requested()) outcome.ways.push_back(std::move(candidate));
}

}  // namespace elbowroom
