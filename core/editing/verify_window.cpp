// SPDX-License-Identifier: MIT
#include "core/editing/verify_window.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/base/random.h"
#include "core/base/stopwatch.h"
#include "core/collision/certificate.h"
#include "core/editing/following_keys.h"
#include "core/editing/limb_keys.h"

namespace elbowroom {
namespace {

constexpr double kVerifyRate = 240;        // Hz (DESIGN.md, "Results must meet")
constexpr double kGlanceRate = 60;         // Hz
constexpr double kClearanceRate = 120;     // Hz
constexpr std::size_t kVerifyStride = 32;  // samples between two words of progress
constexpr int kRandomTimes = 1000;
constexpr double kFineStep = 1e-4;        // s, between looks at what is not proven
constexpr double kLookBelow = 1.0 / 240;  // s, of the intervals that are looked at so
constexpr double kAllButTouching = 4;     // × ε, where a proof gives up: nearer is contact
constexpr double kLeastKeyRate = 60;      // Hz
constexpr double kClearanceReach = 0.1;   // × height: farther obstacles are not measured

using Clock = std::chrono::steady_clock;

std::string at_time(double t) {
  char text[32];
  std::snprintf(text, sizeof text, " at %.3f s", t);
  return text;
}

SeenContact cancelled() { return {"cancelled", 0}; }

// What touches at t, within `distance`.
SeenContact touched_at(SceneCollision& scene, int limb, double t, double distance) {
  if (!scene.limb_in_contact(t, limb, distance)) return {};
  std::vector<ContactSample> contacts;
  scene.contacts_at(t, limb, false, contacts);
  const std::string pair =
      contacts.empty() ? "contact" : contacts.front().part_a + " with " + contacts.front().part_b;
  return {pair + at_time(t), t};
}

// A contact at a few times all over the window: most motions that are no good show it, at a
// fraction of what all times cost.
SeenContact glance(WindowProblem& p, const std::stop_token& stop) {
  SceneCollision& scene = *p.scene;
  const double touching = scene.settings().epsilon * scene.height();
  const int steps = std::max(1, static_cast<int>(std::ceil((p.end - p.begin) * kGlanceRate)));
  for (int i = 0; i <= steps; ++i) {
    if (stop.stop_requested()) return cancelled();
    const SeenContact hit =
        touched_at(scene, p.limb_index, p.begin + (p.end - p.begin) * i / steps, touching);
    if (!hit.none()) return hit;
  }
  return {};
}

// The first contact over the verification times of what the scene plays.
SeenContact look(WindowProblem& p, const std::vector<float>& keys, std::uint64_t seed,
                 const std::stop_token& stop, const ProgressSink& progress) {
  SceneCollision& scene = *p.scene;
  const Clip& clip = *scene.world().actors[static_cast<std::size_t>(scene.actor())].clip;
  const double touching = scene.settings().epsilon * scene.height();
  std::vector<double> steps;
  for (const auto& actor : scene.world().actors)
    if (actor.clip)
      for (const double t : step_times(*actor.clip)) steps.push_back(t);
  // Every key of the clip, of whatever joint: where the body turns a corner.
  std::vector<float> all_keys = keys;
  for (const Channel& channel : clip.channels)
    for (const float t : channel.times)
      if (t > p.begin && t < p.end) all_keys.push_back(t);
  const auto times = verification_times(p.begin, p.end, all_keys, steps, seed);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    if (stop.stop_requested()) return cancelled();
    if (progress && i % kVerifyStride == 0)
      progress({"checking the skin", static_cast<double>(i) / static_cast<double>(times.size())});
    const SeenContact hit = touched_at(scene, p.limb_index, t, touching);
    if (!hit.none()) return hit;
  }
  return {};
}

// Lowers clearances to what is seen; a contact, should there be one.
SeenContact measure_clearance(WindowProblem& p, const std::stop_token& stop, double& min_clearance,
                              double& scene_clearance) {
  SceneCollision& scene = *p.scene;
  const double touching = scene.settings().epsilon * scene.height();
  const int samples = std::max(1, static_cast<int>((p.end - p.begin) * kClearanceRate));
  for (int i = 0; i <= samples; ++i) {
    if (stop.stop_requested()) return cancelled();
    const double t = p.begin + (p.end - p.begin) * i / samples;
    min_clearance = std::min(min_clearance, scene.limb_clearance(t, p.limb_index, min_clearance));
    scene_clearance = std::min(scene_clearance,
                               scene.limb_clearance_from_scene(t, p.limb_index, scene_clearance));
    if (min_clearance <= touching) return touched_at(scene, p.limb_index, t, touching);
  }
  return {};
}

// A proof for all times of the window, of the keys that the scene plays. Where there is none, a
// motion may touch between the times it is looked at: then what stands in the way of the proof is
// looked at at close times, and what is found is returned.
SeenContact certify(WindowProblem& p, const std::stop_token& stop, const ProgressSink& progress,
                    WindowReport& report) {
  if (progress) progress({"proving the motion", -1});
  const auto start = Clock::now();
  SceneCollision& scene = *p.scene;
  Certificate certificate = certify_limb(scene, p.limb_index, p.begin, p.end, {}, stop);
  report.certified = certificate.holds;
  report.depth_sampled = std::move(certificate.depth_sampled);
  report.not_certified.clear();
  SeenContact hit;
  const auto pair_of = [](const Certificate& c) {
    return c.part_a.empty() ? std::string("the motion") : c.part_a + " with " + c.part_b;
  };
  if (!certificate.holds && !stop.stop_requested()) {
    report.not_certified =
        pair_of(certificate) + at_time(certificate.time) + ": " + certificate.reason;
    if (certificate.beside_clip_contacts)
      report.not_certified += ", beside where the clip has them in contact";
    const double touching = scene.settings().epsilon * scene.height();
    // What is near beside contacts of the clip is not all but touching.
    scene.allow_beside_clip_contacts(true);
    hit = touched_at(scene, p.limb_index, certificate.time, kAllButTouching * touching);
    scene.allow_beside_clip_contacts(false);
    if (hit.none()) {
      if (progress) progress({"looking closely at what is not proven", -1});
      CertificateSettings closely;
      closely.look_below = kLookBelow;
      closely.look_step = kFineStep;
      const Certificate looked = certify_limb(scene, p.limb_index, p.begin, p.end, closely, stop);
      if (!looked.holds) hit = {pair_of(looked) + at_time(looked.time), looked.time};
      for (const std::string& pair : looked.depth_sampled)
        if (std::find(report.depth_sampled.begin(), report.depth_sampled.end(), pair) ==
            report.depth_sampled.end())
          report.depth_sampled.push_back(pair);
    }
  }
  report.certify_ms += ms_since(start);
  return hit;
}

}  // namespace

Result<KeyedMotion> key_motion(const WindowProblem& p, const WindowMotion& motion) {
  KeyedMotion keyed;
  keyed.correction.limb = p.limb->limb.name;
  keyed.correction.begin = static_cast<float>(p.begin);
  keyed.correction.end = static_cast<float>(p.end);
  const Model& model = *p.scene->world().actors[static_cast<std::size_t>(p.scene->actor())].model;
  const Skeleton& skeleton = model.skeleton;
  std::vector<double> times;
  for (const PostureAt& posture : p.postures) times.push_back(posture.time);
  keyed.correction.joints = make_limb_keys(
      skeleton, *p.limb, [&](double t) { return motion.at(t).value(t); }, p.postures.front().state,
      p.postures.back().state, times, std::max(kLeastKeyRate, key_rate(*p.clip)));
  if (Status followed = add_following_keys(model, *p.limb, *p.clip, keyed.correction); !followed)
    return followed.error();
  auto laid = lay_over(skeleton, *p.clip, {keyed.correction});
  if (!laid) return laid.error();
  keyed.clip = std::make_shared<const Clip>(std::move(*laid));
  return keyed;
}

SeenContact verify_keys(WindowProblem& p, const KeyedMotion& keyed, std::uint64_t seed,
                        const std::stop_token& stop, const ProgressSink& progress,
                        WindowReport& report) {
  const auto start = Clock::now();
  p.scene->set_clip(keyed.clip);
  p.scene->allow_beside_clip_contacts(false);
  report.min_clearance = report.scene_clearance = kClearanceReach * p.scene->height();
  SeenContact hit = glance(p, stop);
  report.verify_ms += ms_since(start);
  if (hit.none()) {
    hit = certify(p, stop, progress, report);
    const auto looking = Clock::now();
    // A proof is of all times; what it leaves to samples is looked at.
    if (hit.none() && (!report.certified || !report.depth_sampled.empty()))
      hit = look(p, keyed.correction.joints.front().keys.times, seed, stop, progress);
    if (hit.none()) hit = measure_clearance(p, stop, report.min_clearance, report.scene_clearance);
    report.verify_ms += ms_since(looking);
  }
  p.scene->set_clip(p.clip);
  p.scene->allow_beside_clip_contacts(true);
  return stop.stop_requested() ? cancelled() : hit;
}

bool touches_at_a_glance(WindowProblem& p, const KeyedMotion& keyed, const std::stop_token& stop) {
  p.scene->set_clip(keyed.clip);
  p.scene->allow_beside_clip_contacts(false);
  const bool touches = !glance(p, stop).none();
  p.scene->set_clip(p.clip);
  p.scene->allow_beside_clip_contacts(true);
  return touches && !stop.stop_requested();
}

std::vector<GlancedContact> contacts_at_a_glance(WindowProblem& p, const KeyedMotion& keyed,
                                                 const std::stop_token& stop) {
  SceneCollision& scene = *p.scene;
  const double touching = scene.settings().epsilon * scene.height();
  std::vector<GlancedContact> seen;
  std::vector<ContactSample> contacts;
  scene.set_clip(keyed.clip);
  scene.allow_beside_clip_contacts(false);
  for (const double rate : {kGlanceRate, kVerifyRate}) {
    const int steps = std::max(1, static_cast<int>(std::ceil((p.end - p.begin) * rate)));
    for (int i = 0; i <= steps && !stop.stop_requested(); ++i) {
      const double t = p.begin + (p.end - p.begin) * i / steps;
      if (!scene.limb_in_contact(t, p.limb_index, touching)) continue;
      contacts.clear();
      scene.contacts_at(t, p.limb_index, false, contacts);
      for (const ContactSample& contact : contacts)
        seen.push_back({t, contact.part_a, contact.part_b});
    }
    if (!seen.empty()) break;
  }
  scene.set_clip(p.clip);
  scene.allow_beside_clip_contacts(true);
  return seen;
}

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

void measure_motion(const WindowProblem& p, const WindowMotion& motion, WindowReport& report) {
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

}  // namespace elbowroom
