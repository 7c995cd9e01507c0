// SPDX-License-Identifier: MIT
#include "core/editing/accepted.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/stopwatch.h"
#include "core/editing/key_time.h"
#include "core/editing/missed_target.h"
#include "core/editing/verify_window.h"

namespace elbowroom {
namespace {

constexpr double kMeasureRate = 240;  // Hz

using Clock = std::chrono::steady_clock;

// A correction with what it is looked at with.
struct Entry {
  Correction correction;
  const Task* task = nullptr;  // none is kept
  int limb = -1;
  std::string why;  // it does not hold; empty while it does
};

// What can be told without the scene, or an empty string.
std::string unfit(const Entry& entry, const LimbModel& limb, const Skeleton& skeleton) {
  const Correction& correction = entry.correction;
  if (correction.joints.empty()) return "it has no keys";
  for (const JointKeys& keys : correction.joints) {
    const bool own = std::any_of(limb.joints.begin(), limb.joints.end(),
                                 [&](const JointModel& joint) { return joint.joint == keys.node; });
    if (!(own || limb.limb.follows(keys.node)) ||
        skeleton.joints[static_cast<std::size_t>(keys.node)].name != keys.joint)
      return "its keys are of " + keys.joint + ", which is no joint of " + limb.limb.name;
  }
  for (const FollowingJoint& follower : limb.limb.following)
    if (std::none_of(correction.joints.begin(), correction.joints.end(),
                     [&](const JointKeys& keys) { return keys.node == follower.joint; }))
      return "it has no keys of " + skeleton.joints[static_cast<std::size_t>(follower.joint)].name +
             ", which follows " + limb.limb.name;
  return {};
}

// How the task asks for something else than the correction was made with, or an empty string.
std::string changed_task(const Entry& entry, const Session& session, const Clip& clip) {
  if (entry.task == nullptr) return {};
  const Task& task = *entry.task;
  const Correction& correction = entry.correction;
  const auto limbs = limbs_named(session, task.limb);
  if (!limbs || std::find(limbs->begin(), limbs->end(), entry.limb) == limbs->end())
    return "its task is of another limb now";
  if (task.window) {
    const double begin = as_float32(std::max(task.window->lower, clip.begin));
    const double end = as_float32(std::min(task.window->upper, clip.end));
    if (begin != static_cast<double>(correction.begin) ||
        end != static_cast<double>(correction.end))
      return "its task is of another window now";
  }
  PlanningWishes wishes = task.wishes;
  wishes.seed = correction.made_with.seed;
  if (wishes != correction.made_with) return "its task is to be planned in another way now";
  return {};
}

// What a plan's report says of its curve, of keys: `shown` is what they do with the limb. Peaks of
// acceleration are those that an eye sees (LimbTrack::acceleration).
void measure_keys(const WindowProblem& problem, const Model& model, const Clip& clip,
                  const LimbTrack& shown, WindowReport& report) {
  for (int d = 0; d < shown.peak_speed().count; ++d)
    report.peak_speed = std::max(report.peak_speed, shown.peak_speed()[d]);
  Pose below = rest_pose(model.skeleton), over = below;
  const double length = problem.end - problem.begin;
  const int samples = std::max(8, static_cast<int>(length * kMeasureRate));
  for (int i = 0; i <= samples; ++i) {
    const double t = problem.begin + length * i / samples;
    const Dofs a = shown.acceleration(t);
    for (int d = 0; d < a.count; ++d)
      report.peak_acceleration = std::max(report.peak_acceleration, std::abs(a[d]));
    sample_clip(*problem.clip, t, below);
    sample_clip(clip, t, over);
    for (const JointModel& joint : problem.limb->joints) {
      const auto index = static_cast<std::size_t>(joint.joint);
      report.deviation_from_clip =
          std::max(report.deviation_from_clip,
                   angle_between(below.local[index].rotation, over.local[index].rotation));
    }
  }
}

class Keeper {
 public:
  Keeper(SceneCollision& scene, const Session& session, const std::stop_token& stop,
         const ProgressSink& progress)
      : scene_(scene),
        session_(session),
        stop_(stop),
        progress_(progress),
        actor_(scene.world().actors[static_cast<std::size_t>(scene.actor())]),
        model_(*actor_.model),
        source_(actor_.clip) {}

  Accepted run(const std::vector<Correction>& corrections, const std::vector<Task>& tasks) {
    for (const Correction& correction : corrections) {
      if (correction.muted || !session_.is_of_clip(correction.clip)) continue;
      Entry entry{correction, nullptr, -1, {}};
      for (const Task& task : tasks)
        if (entry.task == nullptr && !task.name.empty() && task.name == correction.task)
          entry.task = &task;
      const auto limbs = limbs_named(session_, correction.limb);
      if (limbs && limbs->size() == 1) {
        entry.limb = limbs->front();
        const auto& limb = scene_.limbs()[static_cast<std::size_t>(entry.limb)];
        entry.why = unfit(entry, limb, model_.skeleton);
        if (entry.why.empty()) entry.why = changed_task(entry, session_, *source_);
      } else {
        entry.why = limbs ? "it names no limb" : limbs.error().what;
      }
      entries_.push_back(std::move(entry));
    }
    Accepted accepted;
    while (!stop_.stop_requested() && !all_hold(accepted)) accepted = {};
    for (const Entry& entry : entries_)
      if (!entry.why.empty()) accepted.dropped.push_back({entry.correction, entry.why});
    if (!accepted.clip) accepted.clip = source_;
    scene_.set_clip(accepted.clip);
    return accepted;
  }

 private:
  // Lays over what is thought to hold and looks at it; false if something does not.
  bool all_hold(Accepted& accepted) {
    // What each lies over, and the whole.
    std::vector<std::shared_ptr<const Clip>> below;
    std::vector<Entry*> laid;
    std::shared_ptr<const Clip> clip = source_;
    for (Entry& entry : entries_) {
      if (!entry.why.empty()) continue;
      auto over = lay_over(model_.skeleton, *clip, {entry.correction});
      if (!over) {
        entry.why = over.error().message();
        return false;
      }
      below.push_back(clip);
      laid.push_back(&entry);
      clip = std::make_shared<const Clip>(std::move(*over));
    }
    bool all = true;
    for (std::size_t i = 0; i < laid.size() && !stop_.stop_requested(); ++i) {
      if (progress_) progress_({"checking " + laid[i]->correction.name, -1});
      WindowReport report = look(*laid[i], below[i], clip);
      all = all && laid[i]->why.empty();
      accepted.kept.push_back({laid[i]->correction, std::move(report)});
    }
    if (all && !stop_.stop_requested()) accepted.clip = clip;
    return all;
  }

  WindowReport look(Entry& entry, const std::shared_ptr<const Clip>& below,
                    const std::shared_ptr<const Clip>& clip) {
    const auto start = Clock::now();
    const Correction& correction = entry.correction;
    scene_.set_clip(below);
    WindowProblem problem =
        window_problem(scene_, below, entry.limb, static_cast<double>(correction.begin),
                       static_cast<double>(correction.end), correction.made_with);
    WindowReport report;
    report.accepted = true;
    report.limb = entry.limb;
    report.begin = problem.begin;
    report.end = problem.end;
    report.seed = correction.made_with.seed;
    report.limits_widened = problem.limits_widened;
    if (entry.task != nullptr && entry.task->kind == TaskKind::reach)
      entry.why = entry.task->target ? missed_target(problem, *entry.task->target, clip)
                                     : "its task has no target";
    if (entry.why.empty())
      entry.why =
          verify_keys(problem, {correction, clip}, report.seed, stop_, progress_, report).text;
    report.status = entry.why.empty()        ? CorrectionStatus::corrected
                    : stop_.stop_requested() ? CorrectionStatus::cancelled
                                             : CorrectionStatus::failed;
    if (entry.why.empty())
      measure_keys(problem, model_, *clip,
                   LimbTrack(model_, *clip, *problem.limb, problem.begin, problem.end), report);
    report.total_ms = ms_since(start);
    return report;
  }

  SceneCollision& scene_;
  const Session& session_;
  const std::stop_token& stop_;
  const ProgressSink& progress_;
  const Actor& actor_;
  const Model& model_;
  std::shared_ptr<const Clip> source_;
  std::vector<Entry> entries_;
};

}  // namespace

Accepted keep_accepted(SceneCollision& scene, const Session& session,
                       const std::vector<Correction>& corrections, const std::vector<Task>& tasks,
                       const std::stop_token& stop, const ProgressSink& progress) {
  return Keeper(scene, session, stop, progress).run(corrections, tasks);
}

}  // namespace elbowroom
