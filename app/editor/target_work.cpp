// SPDX-License-Identifier: MIT
#include "app/editor/target_work.h"

#include <algorithm>
#include <cstdio>

#include "core/ik/swivel_search.h"

namespace elbowroom {
namespace {

// While the mouse moves, an answer in time is worth more than the last posture of the circle.
constexpr int kMostChecks = 60;

std::string percent_of(double miss, double length) {
  char text[96];
  std::snprintf(text, sizeof text, "Out of reach by %.3g m (%.0f %% of the limb's length)", miss,
                length > 0 ? 100 * miss / length : 0.0);
  return text;
}

TargetView view_of(const IkResult& result, const LimbIk& ik) {
  TargetView view;
  view.state = result.state;
  switch (result.status) {
    case IkStatus::solved:
      view.status = TargetView::Status::solved;
      view.text = "Reached, free of contacts";
      break;
    case IkStatus::out_of_reach:
      view.status = TargetView::Status::out_of_reach;
      view.text = percent_of(result.miss, ik.length());
      break;
    case IkStatus::at_limit: {
      view.status = TargetView::Status::at_limit;
      const auto& dofs = ik.limb().space.dofs;
      char text[160];
      const bool known = result.dof >= 0 && result.dof < static_cast<int>(dofs.size());
      std::snprintf(text, sizeof text, "At the limit of %s, by %.0f°",
                    known ? dofs[static_cast<std::size_t>(result.dof)].name.c_str() : "a joint",
                    result.excess * 180 / kPi);
      view.text = text;
      break;
    }
    case IkStatus::in_collision:
      view.status = TargetView::Status::in_collision;
      view.text = "Every posture that reaches it collides";
      break;
  }
  return view;
}

// The IK of the limb at the target's time, as the clip has the rest of the body.
Result<LimbIk> ik_at(const TargetQuestion& question, const LimbModel& limb) {
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
  return LimbIk::build(limb, model.skeleton, figure.pose, world_from_parent,
                       limb_state(limb, figure.pose).residual);
}

TargetView solve(const TargetQuestion& question, const PostureCheck& valid) {
  const LimbModel& limb = question.session->limbs[static_cast<std::size_t>(question.limb)];
  const auto ik = ik_at(question, limb);
  TargetView view;
  if (!ik) {
    view.status = TargetView::Status::out_of_reach;
    view.text = ik.error().message();
    return view;
  }
  DofSpace limits = limb.space;
  limits.widen_to(ik->current());  // what the clip itself does is allowed
  SwivelSearch search;
  search.limits = &limits;
  search.max_checks = valid ? kMostChecks : 0;
  const IkTarget target{question.target.position, question.target.orientation};
  return view_of(search_swivel(*ik, target, search, valid), *ik);
}

}  // namespace

TargetView posture_by_limits(const TargetQuestion& question) { return solve(question, {}); }

TargetView TargetWork::posture(const TargetQuestion& question) {
  if (!scene_ || session_ != question.session) {
    session_ = question.session;
    scene_.reset();
    auto scene = contacts_of(*session_);
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
  // With room to spare if there is such a posture, else one that merely does not touch.
  TargetView view;
  for (const double distance : {clearance, touching}) {
    view = solve(question, [&](const LimbState& state) {
      scene_->pose_limb(question.limb, &state);
      return !scene_->limb_in_contact(question.target.time, question.limb, distance);
    });
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
