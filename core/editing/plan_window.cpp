// SPDX-License-Identifier: MIT
#include "core/editing/plan_window.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/base/random.h"
#include "core/collision/certificate.h"
#include "core/collision/limb_planning_space.h"
#include "core/editing/limb_keys.h"
#include "core/editing/limb_track.h"
#include "core/editing/skin_planning_space.h"
#include "core/planning/curve_fit.h"
#include "core/planning/planner.h"
#include "core/planning/smoothing.h"

namespace elbowroom {
namespace {

constexpr double kVerifyRate = 240;        // Hz (DESIGN.md, "Results must meet")
constexpr std::size_t kVerifyStride = 32;  // samples between two words of progress
constexpr int kRandomTimes = 1000;
constexpr std::uint64_t kPartSeed = 15485863;
constexpr double kLeastKeyRate = 60;     // Hz
constexpr int kSeedsWithAPath = 2;       // for an attempt whose first path did not hold
constexpr int kTriesForAProof = 3;       // after a motion that is verified but not proven
constexpr double kClearanceReach = 0.1;  // × height: farther obstacles are not measured

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// One way of looking at the world while planning.
struct Attempt {
  bool on_skin = false;
  double clearance = 0;       // scene units
  double body_clearance = 0;  // from the character itself; on the skin the smaller of the two holds
  double margin = 0;
  double near_share = 0;  // of samples near the clip's own motion
};

// The curves between a window's postures; one where there are none between.
struct Motion {
  std::vector<Curve> curves;
  std::vector<double> until;  // end of each, seconds

  const Curve& at(double t) const {
    std::size_t i = 0;
    while (i + 1 < curves.size() && t > until[i]) ++i;
    return curves[i];
  }
};

// One verified candidate.
struct Candidate {
  Correction correction;
  std::shared_ptr<const Clip> clip;
  WindowReport report;
  double cost = 0;
  bool planned = false;  // a path was found, whatever became of it
};

std::string at_time(double t) {
  char text[32];
  std::snprintf(text, sizeof text, " at %.3f s", t);
  return text;
}

// The first contact over the verification times, or an empty string. Lowers min_clearance.
std::string verify(WindowProblem& p, const std::shared_ptr<const Clip>& clip,
                   const std::vector<float>& keys, std::uint64_t seed, const std::stop_token& stop,
                   const ProgressSink& progress, double& min_clearance) {
  SceneCollision& scene = *p.scene;
  scene.set_clip(clip);
  const double touching = scene.settings().epsilon * scene.height();
  std::vector<double> steps;
  for (const auto& actor : scene.world().actors)
    if (actor.clip)
      for (const double t : step_times(*actor.clip)) steps.push_back(t);
  // Every key of the clip, of whatever joint: where the body turns a corner.
  std::vector<float> all_keys = keys;
  for (const Channel& channel : clip->channels)
    for (const float t : channel.times)
      if (t > p.begin && t < p.end) all_keys.push_back(t);
  const auto times = verification_times(p.begin, p.end, all_keys, steps, seed);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    if (stop.stop_requested()) return "cancelled";
    if (progress && i % kVerifyStride == 0)
      progress({"checking the skin", static_cast<double>(i) / static_cast<double>(times.size())});
    if (scene.limb_in_contact(t, p.limb_index, touching)) {
      std::vector<ContactSample> contacts;
      scene.contacts_at(t, p.limb_index, false, contacts);
      return contacts.empty()
                 ? "contact" + at_time(t)
                 : contacts.front().part_a + " with " + contacts.front().part_b + at_time(t);
    }
  }
  const int samples = std::max(1, static_cast<int>((p.end - p.begin) * 120));
  for (int i = 0; i <= samples; ++i) {
    if (stop.stop_requested()) return "cancelled";
    const double t = p.begin + (p.end - p.begin) * i / samples;
    min_clearance = std::min(min_clearance, scene.limb_clearance(t, p.limb_index, min_clearance));
  }
  return {};
}

// A proof for all times of the window, of the keys that were just verified.
void certify(WindowProblem& p, const std::stop_token& stop, const ProgressSink& progress,
             WindowReport& report) {
  if (progress) progress({"proving the motion", -1});
  const auto start = Clock::now();
  Certificate certificate = certify_limb(*p.scene, p.limb_index, p.begin, p.end, {}, stop);
  report.certified = certificate.holds;
  report.depth_sampled = std::move(certificate.depth_sampled);
  report.not_certified.clear();
  if (!certificate.holds)
    report.not_certified =
        (certificate.part_a.empty() ? std::string("the motion")
                                    : certificate.part_a + " with " + certificate.part_b) +
        at_time(certificate.time) + ": " + certificate.reason;
  report.certify_ms += ms_since(start);
}

// How much an animator has to like it: mean squared distance from the clip's parameters (rad²), the
// acceleration beyond the clip's own, and nearness to what it avoids.
double motion_cost(const WindowProblem& p, const Motion& motion, double min_clearance) {
  double deviation = 0, acceleration = 0;
  const int samples = 120;
  for (int i = 0; i <= samples; ++i) {
    const double t = p.begin + (p.end - p.begin) * i / samples;
    const Curve& curve = motion.at(t);
    const Dofs q = curve.value(t), a = curve.second(t), r = p.track->at(t).q;
    for (int d = 0; d < q.count; ++d) {
      deviation += (q[d] - r[d]) * (q[d] - r[d]);
      acceleration += a[d] * a[d];
    }
  }
  const double wanted = p.scene->settings().clearance * p.scene->height();
  const double near = std::max(0.0, 1.0 - min_clearance / std::max(wanted, 1e-12));
  return deviation / samples + 1e-5 * acceleration / samples + near;
}

void measure_motion(const WindowProblem& p, const Motion& motion, WindowReport& report) {
  const int samples = std::max(8, static_cast<int>((p.end - p.begin) * kVerifyRate));
  for (int i = 0; i <= samples; ++i) {
    const double u = static_cast<double>(i) / samples;
    const double t = p.begin + (p.end - p.begin) * u;
    const Curve& curve = motion.at(t);
    const Dofs q = curve.value(t), v = curve.derivative(t), a = curve.second(t);
    const LimbState clip = p.track->at(t);
    const auto residual = residual_between(p.postures.front().state, p.postures.back().state, u);
    for (int d = 0; d < q.count; ++d) {
      report.peak_speed = std::max(report.peak_speed, std::abs(v[d]));
      report.peak_acceleration = std::max(report.peak_acceleration, std::abs(a[d]));
    }
    for (std::size_t j = 0; j < p.limb->joints.size(); ++j) {
      const JointModel& joint = p.limb->joints[j];
      const auto first = static_cast<std::size_t>(joint.first_dof);
      report.deviation_from_clip =
          std::max(report.deviation_from_clip,
                   angle_between(local_rotation(joint, &q.value[first], residual[j]),
                                 local_rotation(joint, &clip.q.value[first], clip.residual[j])));
    }
  }
}

// A path and its curve from one posture to the next; nothing, with report.reason and blocked_by, if
// there is none.
std::optional<Curve> plan_part(WindowProblem& p, const PostureAt& from, const PostureAt& to,
                               const Attempt& attempt, const PlanningWishes& wishes,
                               std::uint64_t seed, const std::stop_token& stop,
                               const ProgressSink& progress, WindowReport& report, bool& path_found,
                               int& landmarks) {
  std::unique_ptr<LimbPlanningSpace> rigid;
  std::unique_ptr<SkinPlanningSpace> skin;
  StateSpace* world = nullptr;
  if (attempt.on_skin) {
    skin = std::make_unique<SkinPlanningSpace>(*p.scene, p.limb_index, from.time, to.time,
                                               from.state, to.state, attempt.clearance);
    world = skin.get();
  } else {
    LimbPlanningSpace::Settings settings;
    settings.clearance = attempt.clearance;
    settings.margin = attempt.margin;
    settings.body_clearance = attempt.body_clearance;
    rigid = std::make_unique<LimbPlanningSpace>(*p.scene, p.limb_index, from.time, to.time,
                                                from.state, to.state, settings);
    world = rigid.get();
  }
  auto blocked = [&] {
    if (!rigid) return;
    const auto pair = rigid->most_blocking();
    if (!pair.first.empty()) report.blocked_by = pair.first + " with " + pair.second;
  };

  PlannerSettings planner;
  planner.seed = seed;
  planner.max_iterations =
      attempt.on_skin ? std::max(1, wishes.max_iterations / 10) : wishes.max_iterations;
  if (wishes.max_seconds > 0) planner.max_seconds = wishes.max_seconds;
  PlannerQuery query;
  query.space = &p.space;
  query.init = {from.state.q, from.time};
  query.goal = {to.state.q, to.time};
  query.length_unit = p.length_unit;
  query.reference = [&p](double t) { return p.reference_at(t); };
  planner.sampling.near_share = attempt.near_share;
  planner.sampling.max_tries = 16;
  const auto planned = plan(*world, query, planner, stop, progress);
  report.plan_ms += planned.milliseconds;
  report.iterations += planned.stats.iterations;
  report.validity_checks += planned.stats.checks.validity_checks;
  report.edge_checks += planned.stats.checks.edge_checks;
  if (planned.status != PlannerStatus::solved) {
    if (planned.status == PlannerStatus::cancelled) report.status = CorrectionStatus::cancelled;
    report.reason = planned.reason;
    blocked();
    return std::nullopt;
  }

  path_found = true;
  const auto smooth_start = Clock::now();
  SmoothingSettings smoothing;
  smoothing.seed = seed;
  const auto smoothed = smooth_path(*world, planned.path, smoothing, stop, progress);
  CurveQuery curve_query;
  curve_query.space = &p.space;
  curve_query.path = smoothed.path;
  curve_query.velocity_init = from.velocity;
  curve_query.velocity_goal = to.velocity;
  curve_query.reference = [&p](double t) { return p.reference_at(t); };
  CurveSettings curve_settings;
  curve_settings.seed = seed;
  if (attempt.on_skin) curve_settings.max_trials = 120;
  const auto fitted = fit_curve(*world, curve_query, curve_settings, stop, progress);
  report.smooth_ms += ms_since(smooth_start);
  report.validity_checks += smoothed.checks.validity_checks + fitted.checks.validity_checks;
  report.edge_checks += smoothed.checks.edge_checks + fitted.checks.edge_checks;
  landmarks = static_cast<int>(smoothed.path.size());
  if (fitted.status != CurveStatus::solved) {
    if (stop.stop_requested()) report.status = CorrectionStatus::cancelled;
    report.reason = fitted.reason;
    blocked();
    return std::nullopt;
  }
  return fitted.curve;
}

// One attempt with one seed. Returns true with a verified candidate; otherwise report.reason and
// blocked_by say why not.
bool plan_and_verify(WindowProblem& p, const Attempt& attempt, const PlanningWishes& wishes,
                     std::uint64_t seed, const std::stop_token& stop, const ProgressSink& progress,
                     Candidate& candidate) {
  WindowReport& report = candidate.report;
  report.seed = seed;
  p.scene->set_clip(p.clip);
  Motion motion;
  int landmarks = 0;
  for (std::size_t i = 0; i + 1 < p.postures.size(); ++i) {
    int part_landmarks = 0;
    const auto curve =
        plan_part(p, p.postures[i], p.postures[i + 1], attempt, wishes, seed + kPartSeed * i, stop,
                  progress, report, candidate.planned, part_landmarks);
    if (part_landmarks > 0) report.landmarks = landmarks += part_landmarks;
    if (!curve) return false;
    motion.until.push_back(p.postures[i + 1].time);
    motion.curves.push_back(*curve);
  }

  const auto verify_start = Clock::now();
  Correction& correction = candidate.correction;
  correction.limb = p.limb->limb.name;
  correction.begin = static_cast<float>(p.begin);
  correction.end = static_cast<float>(p.end);
  correction.made_with = wishes;
  correction.made_with.seed = seed;
  const auto& skeleton =
      p.scene->world().actors[static_cast<std::size_t>(p.scene->actor())].model->skeleton;
  std::vector<double> times;
  for (const PostureAt& posture : p.postures) times.push_back(posture.time);
  correction.joints = make_limb_keys(
      skeleton, *p.limb, [&](double t) { return motion.at(t).value(t); }, p.postures.front().state,
      p.postures.back().state, times, std::max(kLeastKeyRate, key_rate(*p.clip)));
  auto laid = lay_over(skeleton, *p.clip, {correction});
  if (!laid) {
    report.reason = laid.error().message();
    return false;
  }
  candidate.clip = std::make_shared<const Clip>(std::move(*laid));
  report.min_clearance = kClearanceReach * p.scene->height();
  const std::string hit = verify(p, candidate.clip, correction.joints.front().keys.times, seed,
                                 stop, progress, report.min_clearance);
  report.verify_ms += ms_since(verify_start);
  if (hit.empty()) certify(p, stop, progress, report);
  p.scene->set_clip(p.clip);
  if (!hit.empty()) {
    if (stop.stop_requested()) report.status = CorrectionStatus::cancelled;
    report.reason = "the planned motion touches on the deformed skin";
    report.blocked_by = hit;
    return false;
  }
  report.status = CorrectionStatus::corrected;
  report.reason.clear();
  report.blocked_by.clear();
  measure_motion(p, motion, report);
  candidate.cost = motion_cost(p, motion, report.min_clearance);
  return true;
}

// Takes over what attempts have cost so far, and what was said of them.
void take_costs(const WindowReport& spent, WindowReport& report) {
  report.attempts = spent.attempts;
  report.plan_ms = spent.plan_ms;
  report.smooth_ms = spent.smooth_ms;
  report.verify_ms = spent.verify_ms;
  report.certify_ms = spent.certify_ms;
  report.iterations = spent.iterations;
  report.validity_checks = spent.validity_checks;
  report.edge_checks = spent.edge_checks;
}

bool try_once(WindowProblem& p, const Attempt& attempt, const PlanningWishes& wishes,
              std::uint64_t seed, const std::stop_token& stop, const ProgressSink& progress,
              Candidate& candidate) {
  const bool found = plan_and_verify(p, attempt, wishes, seed, stop, progress, candidate);
  char text[160];
  std::snprintf(text, sizeof text,
                "%s, clearance %.3g, from the body %.3g, margin %.3g, %.0f %% near the clip: ",
                attempt.on_skin ? "deformed skin" : "rigid parts", attempt.clearance,
                attempt.body_clearance, attempt.margin, 100 * attempt.near_share);
  WindowReport& report = candidate.report;
  report.attempts.push_back(
      text +
      (found ? (report.certified ? "found and proven"
                                 : "found and verified, not proven; " + report.not_certified)
             : report.reason) +
      (report.blocked_by.empty() ? "" : "; " + report.blocked_by));
  return found;
}

}  // namespace

std::vector<double> verification_times(double begin, double end, const std::vector<float>& keys,
                                       const std::vector<double>& steps, std::uint64_t seed) {
  std::vector<double> times;
  const int samples = static_cast<int>(std::ceil((end - begin) * kVerifyRate));
  for (int i = 0; i <= samples; ++i) times.push_back(std::min(end, begin + i / kVerifyRate));
  times.push_back(end);
  for (const float key : keys) times.push_back(static_cast<double>(key));
  Random random(seed ^ 0x76657269667921ull);
  for (int i = 0; i < kRandomTimes; ++i) times.push_back(random.uniform(begin, end));
  for (const double step : steps)
    for (const double side :
         {std::nextafter(static_cast<float>(step), -1.0e30f), static_cast<float>(step)})
      if (side >= begin && side <= end) times.push_back(side);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

WindowPlan plan_window(SceneCollision& scene, const std::shared_ptr<const Clip>& clip, int limb,
                       double begin, double end, const PlanningWishes& wishes,
                       const std::stop_token& stop, const ProgressSink& progress) {
  return plan_window(window_problem(scene, clip, limb, begin, end, wishes), wishes, stop, progress);
}

WindowPlan plan_window(WindowProblem p, const PlanningWishes& wishes, const std::stop_token& stop,
                       const ProgressSink& progress) {
  const auto start = Clock::now();
  SceneCollision& scene = *p.scene;
  const std::shared_ptr<const Clip> clip = p.clip;
  const int limb = p.limb_index;
  const double begin = p.begin, end = p.end;
  WindowPlan result;
  WindowReport& report = result.report;
  report.limb = limb;
  report.begin = begin;
  report.end = end;
  report.seed = wishes.seed;
  report.limits_widened = p.limits_widened;

  const double touching = scene.settings().epsilon * scene.height();
  const double wanted =
      wishes.clearance > 0 ? wishes.clearance : scene.settings().clearance * scene.height();
  scene.set_clip(clip);
  for (const double t : {begin, end}) {
    if (!scene.limb_in_contact(t, limb, touching)) continue;
    std::vector<ContactSample> contacts;
    scene.contacts_at(t, limb, false, contacts);
    report.reason = "the limb is in contact at the window's " +
                    std::string(t == begin ? "begin" : "end") +
                    "; choose a window whose ends are free";
    if (!contacts.empty())
      report.blocked_by = contacts.front().part_a + " with " + contacts.front().part_b + at_time(t);
    report.total_ms = ms_since(start);
    return result;
  }

  const double skin = 0.01 * scene.height();
  const double little = 0.1 * wanted;
  // Where the animator has set sampling intervals, they alone say first where to search.
  const double near_first = wishes.sampling.empty() ? 0.25 : 0.0;
  const std::vector<Attempt> attempts = {
      {false, wanted, wanted, 0, near_first},
      {false, wanted, little, 0, 0.9},
      {false, wanted, little, skin, 0.9},
      {true, wanted, wanted, 0, 0.8},
      {true, little, little, 0, 0.9},
      {false, 2 * touching, 2 * touching, 0, 0.9},
      {true, 2 * touching, 2 * touching, 0, 0.9},
  };
  std::optional<Candidate> best;
  Candidate failed;  // gathers the counts and the last reason
  failed.report = report;
  // Proven motions come before those that are only verified, and then the cheaper ones.
  const auto better = [](const Candidate& a, const Candidate& b) {
    return a.report.certified != b.report.certified ? a.report.certified : a.cost < b.cost;
  };
  const int asked = std::max(1, wishes.alternatives);
  int tries_for_proof = kTriesForAProof;
  std::size_t best_attempt = 0;
  const auto enough = [&] { return best && (best->report.certified || tries_for_proof <= 0); };
  for (std::size_t k = 0; k < attempts.size() && !enough(); ++k) {
    // A path whose curve or keys did not hold is worth another one.
    int tries = asked;
    for (int alternative = 0; alternative < tries; ++alternative) {
      if (stop.stop_requested()) break;
      if (best && (k != best_attempt || alternative >= asked)) {
        if (enough()) break;
        --tries_for_proof;
      }
      Candidate candidate;
      candidate.report = failed.report;
      const std::uint64_t seed =
          wishes.seed + 1000003ull * k + 7919ull * static_cast<std::uint64_t>(alternative);
      if (try_once(p, attempts[k], wishes, seed, stop, progress, candidate)) {
        if (!best) best_attempt = k;
        if (!best || better(candidate, *best)) best = candidate;
        if (!best->report.certified) tries = std::max(tries, kSeedsWithAPath);
      } else if (candidate.planned && !best && alternative == 0) {
        tries = std::max(tries, kSeedsWithAPath);
      }
      // What an attempt cost is part of the whole, whether or not it is taken.
      const WindowReport& spent = candidate.report;
      take_costs(spent, failed.report);
      if (spent.status != CorrectionStatus::corrected) {
        failed.report.reason = spent.reason;
        failed.report.blocked_by = spent.blocked_by;
      }
    }
    if (stop.stop_requested()) break;
  }
  scene.set_clip(clip);
  if (best && !stop.stop_requested()) {
    report = best->report;
    take_costs(failed.report, report);
    result.correction = std::move(best->correction);
  } else {
    report = failed.report;
    report.status = stop.stop_requested() ? CorrectionStatus::cancelled : CorrectionStatus::failed;
  }
  report.total_ms = ms_since(start);
  return result;
}

}  // namespace elbowroom
