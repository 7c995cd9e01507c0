// SPDX-License-Identifier: MIT
#include "app/editor/target_work.h"

#include <algorithm>
#include <cctype>

#include "core/editing/target_posture.h"
#include "core/editing/wrist_target.h"

namespace elbowroom {
namespace {

// While the mouse moves, an answer in time is worth more than the last posture of the circle.
constexpr int kMostChecks = 60;

TargetView view_of(const IkResult& result, const LimbModel& limb) {
  TargetView view;
  view.state = result.state;
  switch (result.status) {
    case IkStatus::solved:
      view.status = TargetView::Status::solved;
      view.text = "Reached, free of contacts";
      return view;
    case IkStatus::out_of_reach:
      view.status = TargetView::Status::out_of_reach;
      break;
    case IkStatus::at_limit:
      view.status = TargetView::Status::at_limit;
      break;
    case IkStatus::in_collision:
      view.status = TargetView::Status::in_collision;
      break;
  }
  view.text = ik_reason(result, limb);
  if (!view.text.empty()) view.text[0] = static_cast<char>(std::toupper(view.text[0]));
  return view;
}

// The IK of the limb at the target's time, as the clip has the rest of the body, and what it is
// to reach.
struct Aim {
  LimbIk ik;
  IkTarget target;
};
Result<Aim> aim_at(const TargetQuestion& question, const LimbModel& limb) {
  const Model& model = question.session->scene.model();
  World world;
  world.actors.push_back(question.session->scene.world.actors.front());
  world.actors.front().clip = question.clip;
  std::vector<ActorState> states;
  world_state_at(world, question.target.time, states);
  const ActorState& figure = states.front();
  const int parent = model.skeleton.joints[static_cast<std::size_t>(limb.limb.root)].parent;
  const Mat4 world_from_parent = parent >= 0
                                     ? figure.world_from_joint[static_cast<std::size_t>(parent)]
                                     : world.actors.front().world_from_file;
  auto ik = LimbIk::build(limb, model.skeleton, figure.pose, world_from_parent,
                          limb_state(limb, figure.pose).residual);
  if (!ik) return ik.error();
  const auto end = static_cast<std::size_t>(limb.limb.end);
  const auto target = wrist_target(*ik, figure.world_from_joint[end], question.target);
  if (!target) return target.error();
  return Aim{std::move(*ik), *target};
}

SwivelSearch search_in(const DofSpace& limits) {
  SwivelSearch search;
  search.limits = &limits;
  return search;
}

// What the clip itself does is within limits.
DofSpace limits_for(const LimbModel& limb, const LimbIk& ik) {
  DofSpace limits = limb.space;
  limits.widen_to(ik.current());
  return limits;
}

TargetView no_question(const Error& error) {
  TargetView view;
  view.status = TargetView::Status::out_of_reach;
  view.text = error.message();
  return view;
}

}  // namespace

TargetView posture_by_limits(const TargetQuestion& question) {
  const LimbModel& limb = question.session->limbs[static_cast<std::size_t>(question.limb)];
  const auto aim = aim_at(question, limb);
  if (!aim) return no_question(aim.error());
  const DofSpace limits = limits_for(limb, aim->ik);
  return view_of(search_swivel(aim->ik, aim->target, search_in(limits)), limb);
}

TargetView TargetWork::posture(const TargetQuestion& question, const std::stop_token& stop) {
  if (!scene_ || session_ != question.session) {
    session_ = question.session;
    scene_.reset();
    auto scene = contacts_of(*session_, abandoned_.get_token());
    if (!scene) {
      TargetView view = posture_by_limits(question);
      view.text += "; contacts are unknown: " + scene.error().what;
      return view;
    }
    scene_ = std::move(*scene);
  }
  scene_->set_clip(question.clip);
  const double clearance =
      question.clearance > 0 ? question.clearance : scene_->settings().clearance * scene_->height();
  const double touching = scene_->settings().epsilon * scene_->height();
  const LimbModel& limb = scene_->limbs()[static_cast<std::size_t>(question.limb)];
  const auto aim = aim_at(question, limb);
  if (!aim) return no_question(aim.error());
  const DofSpace limits = limits_for(limb, aim->ik);
  SwivelSearch search = search_in(limits);
  search.max_checks = kMostChecks;
  // With room to spare if there is such a posture, else one that merely does not touch.
  TargetView view;
  for (const double distance : {clearance, touching}) {
    view = view_of(search_free_posture(*scene_, question.limb, aim->ik, question.target.time,
                                       aim->target, search, distance, stop),
                   limb);
    if (view.status != TargetView::Status::in_collision) break;
  }
  if (view.status == TargetView::Status::in_collision && view.state) {
    scene_->pose_limb(question.limb, &*view.state);
    std::vector<ContactSample> contacts;
    scene_->contacts_at(question.target.time, question.limb, false, contacts);
    if (!contacts.empty())
      view.text = "Collides: " + contacts.front().part_a + " with " + contacts.front().part_b;
  }
  scene_->pose_limb(question.limb, nullptr);
  return view;
}

}  // namespace elbowroom
