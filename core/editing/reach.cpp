// SPDX-License-Identifier: MIT
#include "core/editing/reach.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/editing/key_time.h"
#include "core/editing/plan_window.h"
#include "core/scene/placeable.h"

namespace elbowroom {
namespace {

constexpr double kHalfWindow = 0.8;     // s, before and after the target's time
constexpr double kShortestHalf = 0.15;  // s
constexpr double kLongestHalf = 2.5;    // s
constexpr double kHalfStep = 0.05;      // s, in moving an end
constexpr double kRateStep = 1e-3;      // s, of the holding velocity
constexpr double kSpeedShare = 0.9;     // of the speed limits that the holding velocity may have
constexpr double kWayFactor = 2;        // a smooth way there peaks at about twice its mean speed
constexpr double kAtLimit = 1e-3;       // rad
// Checks of the skin in one search: at the clearance, and then without touching. Where neither
// finds a posture each check costs, so the wish for room gets the smaller share.
constexpr int kChecksAtClearance = 200;
constexpr int kChecksTouching = 600;
constexpr int kPostures = 3;                     // planned to, one after the other
constexpr double kSwivelApart = 20 * kPi / 180;  // of them

// The window's ends nearest to the usual ones at which the limb is free with `clearance` (or, with
// none, does not touch), at least `least` from t_b; nothing if there is none within the clip.
std::optional<double> free_end(SceneCollision& scene, int limb, double t_b, double direction,
                               double bound, double least, double clearance,
                               const std::stop_token& stop) {
  const double touching = scene.settings().epsilon * scene.height();
  const double room = std::min(kLongestHalf, std::abs(bound - t_b));
  const double usual = std::min(std::max(kHalfWindow, least), room);
  for (const double distance : {clearance, touching}) {
    for (int i = 0; i < 2 * static_cast<int>(kLongestHalf / kHalfStep); ++i) {
      if (stop.stop_requested()) return std::nullopt;
      // Outward and inward in turn.
      const double half = usual + (i % 2 == 0 ? 1 : -1) * ((i + 1) / 2) * kHalfStep;
      if (half > room + 1e-9 || half < std::min({least, usual, room}) - 1e-9) continue;
      const double t =
          as_float32(half >= room - 1e-9 && room < kLongestHalf ? bound : t_b + direction * half);
      if (!(direction * (t - t_b) > 0)) continue;
      if (!scene.limb_in_contact(t, limb, distance)) return t;
    }
  }
  return std::nullopt;
}

// Seconds that the speed limits ask for between two postures.
double time_for(const DofSpace& space, const Dofs& a, const Dofs& b) {
  double seconds = 0;
  for (int d = 0; d < a.count; ++d)
    seconds = std::max(seconds, kWayFactor * std::abs(a[d] - b[d]) /
                                    space.dofs[static_cast<std::size_t>(d)].speed_limit);
  return seconds;
}

// Parameters' velocity at t_b of an end held still in the world, at constant swivel.
Dofs holding_velocity(const WindowProblem& p, const IkTarget& target, double t_b,
                      const IkResult& posture) {
  const auto held_at = [&](double t) -> std::optional<Dofs> {
    if (t <= p.begin || t >= p.end) return std::nullopt;
    const auto ik = limb_ik_at(*p.scene, p.limb_index, t, p.residual_at(t));
    if (!ik) return std::nullopt;
    const auto solutions = ik->solve_at_swivel(target, posture.swivel, posture.state.q);
    std::optional<Dofs> best;
    double least = 0.5;  // rad: farther is another branch
    for (int i = 0; i < solutions.count; ++i) {
      const auto& one = solutions.one[static_cast<std::size_t>(i)];
      double distance = 0;
      for (int d = 0; d < one.q.count; ++d)
        distance = std::max(distance, std::abs(one.q[d] - posture.state.q[d]));
      if (one.miss != 0 || distance >= least) continue;
      least = distance;
      best = one.q;
    }
    return best;
  };
  const auto before = held_at(t_b - kRateStep), after = held_at(t_b + kRateStep);
  Dofs velocity;
  velocity.count = posture.state.q.count;
  const Dofs& low = before ? *before : posture.state.q;
  const Dofs& high = after ? *after : posture.state.q;
  const double span = (before ? kRateStep : 0) + (after ? kRateStep : 0);
  if (span == 0) return velocity;
  double scale = 1;
  for (int d = 0; d < velocity.count; ++d) {
    const Dof& dof = p.space.dofs[static_cast<std::size_t>(d)];
    velocity[d] = (high[d] - low[d]) / span;
    // Through a limit there is no way.
    if (posture.state.q[d] < dof.lower + kAtLimit || posture.state.q[d] > dof.upper - kAtLimit)
      velocity[d] = 0;
    if (std::abs(velocity[d]) > kSpeedShare * dof.speed_limit)
      scale = std::min(scale, kSpeedShare * dof.speed_limit / std::abs(velocity[d]));
  }
  for (const EllipseLimit& ellipse : p.space.ellipses) {
    const double a = posture.state.q[ellipse.first] / ellipse.half_first;
    const double b = posture.state.q[ellipse.second] / ellipse.half_second;
    if (a * a + b * b > 1 - kAtLimit) velocity[ellipse.first] = velocity[ellipse.second] = 0;
  }
  for (const PolygonLimit& polygon : p.space.polygons) {
    if (polygon.gauge(posture.state.q[polygon.first], posture.state.q[polygon.second]) >
        1 - kAtLimit)
      velocity[polygon.first] = velocity[polygon.second] = 0;
  }
  for (int d = 0; d < velocity.count; ++d) velocity[d] *= scale;
  return velocity;
}

// The first pair that a posture has in contact.
std::string contact_of(SceneCollision& scene, int limb, double t, const LimbState& state) {
  scene.pose_limb(limb, &state);
  std::vector<ContactSample> contacts;
  scene.contacts_at(t, limb, false, contacts);
  scene.pose_limb(limb, nullptr);
  if (contacts.empty()) return "less than the clearance to something";
  return contacts.front().part_a + " with " + contacts.front().part_b;
}

Status check_task(const SceneCollision& scene, int limb, const Task& task, const Clip* clip,
                  const Model& model) {
  const std::string where = model.path.string();
  if (clip == nullptr)
    return Error{"the character has no clip", where, "give a file with an animation"};
  if (limb < 0 || limb >= static_cast<int>(scene.limbs().size()))
    return Error{"the scene has no such limb", where, "name one that was found"};
  if (!task.target) return Error{"the task has no target", where, "give a position and a time"};
  const HandTarget& target = *task.target;
  const Vec3& p = target.position;
  bool finite = std::isfinite(p.x + p.y + p.z) && std::isfinite(target.time);
  if (target.orientation) {
    const double length = glm::length(*target.orientation);
    finite = finite && std::isfinite(length) && length > 1e-6;
  }
  if (!finite)
    return Error{"the target's place or time is not a number", where, "give finite numbers"};
  if (!is_placeable(p))
    return Error{"the target is too far away", where, "give a place near the character"};
  const double t = as_float32(target.time);
  if (!(t > as_float32(clip->begin) && t < as_float32(clip->end)))
    return Error{"the target's time is not inside the clip", where,
                 "the clip runs from " + std::to_string(clip->begin) + " to " +
                     std::to_string(clip->end) + " s, and there must be motion before and after"};
  if (task.window && !(as_float32(task.window->lower) < t && t < as_float32(task.window->upper)))
    return Error{"the target's time is not inside the window", where,
                 "begin the window before it and end it after it"};
  return check_wishes(scene, {limb}, task.wishes);
}

// Window, posture and plan; report and correction.
class Reach {
 public:
  Reach(SceneCollision& scene, int limb, const Task& task, std::shared_ptr<const Clip> clip,
        const std::stop_token& stop, const ProgressSink& progress)
      : scene_(scene),
        limb_(limb),
        task_(task),
        clip_(std::move(clip)),
        stop_(stop),
        progress_(progress),
        t_b_(as_float32(task.target->time)),
        clearance_(task.wishes.clearance > 0 ? task.wishes.clearance
                                             : scene.settings().clearance * scene.height()) {}

  WindowPlan run() {
    tell("looking for a posture");
    double least_before = kShortestHalf, least_after = kShortestHalf;
    // The posture hardly depends on the window (by the residual), the window on the posture by the
    // time its way takes: a few rounds.
    for (int round = 0; round < 4; ++round) {
      if (!choose_window(least_before, least_after)) return failed();
      if (!find_posture()) return failed();
      if (task_.window) break;
      const Dofs& q = posture_.state.q;
      const double before = time_for(problem_.space, problem_.postures.front().state.q, q);
      const double after = time_for(problem_.space, q, problem_.postures.back().state.q);
      const bool enough = (t_b_ - problem_.begin >= before || !can_widen(-1)) &&
                          (problem_.end - t_b_ >= after || !can_widen(1));
      if (enough) break;
      least_before = std::max(least_before, before);
      least_after = std::max(least_after, after);
    }
    return plan_through_postures();
  }

 private:
  void tell(const std::string& phase) const {
    if (progress_) progress_({phase, -1});
  }

  // To the posture found, and where there is no way to it, to others that reach the target, each
  // the farthest in swivel from those tried.
  WindowPlan plan_through_postures() {
    std::vector<double> tried;
    std::vector<std::string> attempts;
    for (;;) {
      PostureAt held;
      held.time = t_b_;
      held.state = posture_.state;
      held.velocity = holding_velocity(problem_, goal_, t_b_, posture_);
      // The two parts meet in it without a jerk.
      held.acceleration.emplace().count = held.velocity.count;
      WindowProblem problem = problem_;
      problem.postures.insert(problem.postures.begin() + 1, held);
      WindowPlan plan = plan_window(std::move(problem), task_.wishes, stop_, progress_);
      tried.push_back(posture_.swivel);
      if (tried.size() > 1) {
        char text[80];
        std::snprintf(text, sizeof text, "posture %zu, swivel %.0f°: ", tried.size(),
                      posture_.swivel * 180 / kPi);
        for (std::string& attempt : plan.report.attempts) attempt.insert(0, text);
      }
      attempts.insert(attempts.end(), plan.report.attempts.begin(), plan.report.attempts.end());
      plan.report.attempts = attempts;
      if (plan.correction || stop_.stop_requested() || tried.size() == kPostures) return plan;
      // The report is the last one's, which failed as the others did.
      if (!find_other_posture(tried)) return plan;
    }
  }

  // A free posture away from the swivels tried.
  bool find_other_posture(const std::vector<double>& tried) {
    const auto ik = limb_ik_at(scene_, limb_, t_b_, problem_.residual_at(t_b_));
    if (!ik) return false;
    const auto distance = [&](double swivel) {
      double least = 2 * kPi;
      for (const double other : tried)
        least = std::min(least, std::abs(std::remainder(swivel - other, 2 * kPi)));
      return least;
    };
    SwivelSearch settings;
    settings.near = problem_.track->at(t_b_).q;
    settings.limits = &problem_.space;
    settings.max_checks = kChecksAtClearance;
    // The middle of the widest gap between them.
    double start = 0, farthest = -1;
    for (int i = 0; i < 72; ++i) {
      const double swivel = -kPi + 2 * kPi * i / 72;
      if (distance(swivel) <= farthest + 1e-9) continue;
      farthest = distance(swivel);
      start = swivel;
    }
    settings.initial = start;
    const double touching = 2 * scene_.settings().epsilon * scene_.height();
    const double width = farthest - kSwivelApart;
    if (!(width > 0)) return false;
    settings.lower = start - width;
    settings.upper = start + width;
    for (const double clearance : {clearance_, touching}) {
      IkResult other =
          search_free_posture(scene_, limb_, *ik, t_b_, goal_, settings, clearance, stop_);
      if (!other.solved() || distance(other.swivel) < kSwivelApart) continue;
      posture_ = std::move(other);
      return true;
    }
    return false;
  }

  bool can_widen(int direction) const {
    const double end = direction < 0 ? problem_.begin : problem_.end;
    const double bound = as_float32(direction < 0 ? clip_->begin : clip_->end);
    return end != bound && std::abs(end - t_b_) < kLongestHalf - kHalfStep;
  }

  bool choose_window(double least_before, double least_after) {
    double begin = as_float32(clip_->begin), end = as_float32(clip_->end);
    scene_.set_clip(clip_);
    if (task_.window) {
      begin = std::max(begin, as_float32(task_.window->lower));
      end = std::min(end, as_float32(task_.window->upper));
    } else {
      const auto free_begin =
          free_end(scene_, limb_, t_b_, -1, begin, least_before, clearance_, stop_);
      const auto free_finish =
          free_end(scene_, limb_, t_b_, 1, end, least_after, clearance_, stop_);
      if (!free_begin || !free_finish) {
        reason_ = "the limb is in contact all the time " +
                  std::string(!free_begin ? "before" : "after") + " the target's";
        problem_.begin = std::max(begin, t_b_ - kHalfWindow);
        problem_.end = std::min(end, t_b_ + kHalfWindow);
        return false;
      }
      begin = *free_begin;
      end = *free_finish;
    }
    problem_ = window_problem(scene_, clip_, limb_, begin, end, task_.wishes);
    return true;
  }

  // The end joint by the clip.
  Mat4 end_at(double t) const {
    std::vector<ActorState> states;
    actor_state_at(scene_.world(), scene_.actor(), t, states);
    return states[static_cast<std::size_t>(scene_.actor())]
        .world_from_joint[static_cast<std::size_t>(problem_.limb->limb.end)];
  }

  bool find_posture() {
    const auto ik = limb_ik_at(scene_, limb_, t_b_, problem_.residual_at(t_b_));
    if (!ik) {
      reason_ = ik.error().message();
      return false;
    }
    const auto goal = wrist_target(*ik, end_at(t_b_), *task_.target);
    if (!goal) {
      reason_ = goal.error().message();
      return false;
    }
    goal_ = *goal;
    SwivelSearch settings;
    settings.near = problem_.track->at(t_b_).q;
    settings.limits = &problem_.space;
    const double touching = 2 * scene_.settings().epsilon * scene_.height();
    for (const double clearance : {clearance_, touching}) {
      settings.max_checks = clearance == clearance_ ? kChecksAtClearance : kChecksTouching;
      posture_ = search_free_posture(scene_, limb_, *ik, t_b_, goal_, settings, clearance, stop_);
      if (posture_.status != IkStatus::in_collision) break;
    }
    if (posture_.solved()) {
      if (posture_.orientation_served) return true;
      reason_ = "the end of " + problem_.limb->limb.name + " can't be turned to an orientation";
      return false;
    }
    reason_ = ik_reason(posture_, *problem_.limb);
    // Of the wrist's own place; the palm's depends on how the hand is turned.
    out_of_reach_ = posture_.status == IkStatus::out_of_reach && !task_.target->grasp;
    if (posture_.status == IkStatus::in_collision)
      blocked_by_ = contact_of(scene_, limb_, t_b_, posture_.state);
    return false;
  }

  WindowPlan failed() {
    scene_.set_clip(clip_);
    WindowPlan plan;
    plan.report.status =
        stop_.stop_requested() ? CorrectionStatus::cancelled : CorrectionStatus::failed;
    plan.report.limb = limb_;
    plan.report.begin = problem_.begin;
    plan.report.end = problem_.end;
    plan.report.seed = task_.wishes.seed;
    plan.report.reason = reason_;
    plan.report.blocked_by = blocked_by_;
    plan.report.out_of_reach = out_of_reach_;
    plan.report.limits_widened = problem_.limits_widened;
    return plan;
  }

  SceneCollision& scene_;
  int limb_;
  const Task& task_;
  std::shared_ptr<const Clip> clip_;
  const std::stop_token& stop_;
  const ProgressSink& progress_;
  double t_b_, clearance_;
  WindowProblem problem_;
  IkTarget goal_;
  IkResult posture_;
  std::string reason_, blocked_by_;
  bool out_of_reach_ = false;
};

}  // namespace

Result<WindowPlan> plan_reach(SceneCollision& scene, int limb, const Task& task,
                              const std::stop_token& stop, const ProgressSink& progress) {
  const Actor& actor = scene.world().actors[static_cast<std::size_t>(scene.actor())];
  if (Status sound = check_task(scene, limb, task, actor.clip.get(), *actor.model); !sound)
    return sound.error();
  const std::shared_ptr<const Clip> clip = actor.clip;
  WindowPlan plan = Reach(scene, limb, task, clip, stop, progress).run();
  if (plan.report.ends_touch) plan.report.reason += "; choose a window whose ends are free";
  if (!plan.correction && task.window && !plan.report.out_of_reach && !stop.stop_requested()) {
    // With a window of its own choosing?
    Task freely = task;
    freely.window.reset();
    scene.set_clip(clip);
    const WindowPlan other = Reach(scene, limb, freely, clip, stop, progress).run();
    const Interval tried{other.report.begin, other.report.end};
    if (!stop.stop_requested() && !(tried == Interval{plan.report.begin, plan.report.end}))
      plan.report.suggestions.push_back({Suggestion::Kind::wider_window,
                                         other.correction.has_value(), tried,
                                         scene.limbs()[static_cast<std::size_t>(limb)].limb.name});
  }
  if (plan.correction) {
    plan.correction->name = scene.limbs()[static_cast<std::size_t>(limb)].limb.name + " reaches";
    plan.correction->task = task.name;
  }
  return plan;
}

Result<CorrectionOutcome> reach(SceneCollision& scene, int limb, const Task& task,
                                std::stop_token stop, const ProgressSink& progress) {
  const Actor& actor = scene.world().actors[static_cast<std::size_t>(scene.actor())];
  const std::shared_ptr<const Clip> source = actor.clip;
  const std::shared_ptr<const Model> model = actor.model;
  if (Status sound = check_task(scene, limb, task, source.get(), *model); !sound)
    return sound.error();

  CorrectionOutcome outcome;
  outcome.clip = source;
  if (progress) progress({"looking for contacts", -1});
  look_at_contacts(scene, {limb}, outcome.before, &outcome.other, stop);
  auto planned = plan_reach(scene, limb, task, stop, progress);
  if (!planned) return planned.error();
  WindowPlan& plan = *planned;
  outcome.windows.push_back(plan.report);
  outcome.interrupted = stop.stop_requested();
  if (plan.correction) {
    auto laid = lay_over(model->skeleton, *source, {*plan.correction});
    if (!laid) return laid.error();
    outcome.clip = std::make_shared<const Clip>(std::move(*laid));
    outcome.corrections.push_back(std::move(*plan.correction));
  }
  scene.set_clip(outcome.clip);
  if (outcome.corrections.empty()) {
    outcome.after = outcome.before;
    return outcome;
  }
  if (progress) progress({"looking at the result", -1});
  look_at_contacts(scene, {limb}, outcome.after, nullptr, stop);
  outcome.interrupted = stop.stop_requested();
  return outcome;
}

}  // namespace elbowroom
