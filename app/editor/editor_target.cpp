// SPDX-License-Identifier: MIT
// The hand target: where a click puts it, and the posture that follows it.
#include "app/editor/editor.h"
#include "ui/scene_frame.h"

namespace elbowroom {
void Editor::target_changed() {
  targeting_.stop.request_stop();
  targeting_.ticket = next_ticket_++;  // what it has posted already is of the target before
  const auto& target = history_.document().draft.target;
  if (!target || state_.limb < 0 || !state_.clip) {
    state_.target = {};
    return;
  }
  TargetQuestion question{session_, state_.clip, state_.limb, *target, wishes().clearance};
  state_.target = posture_by_limits(question);
  if (state_.target.status != TargetView::Status::solved) return;
  // It may still run into something: the other thread looks, the newest question only.
  state_.target.status = TargetView::Status::solving;
  state_.target.text = "Reached; looking for contacts";
  targeting_.stop = target_thread_.run([this, work = target_work_, question = std::move(question),
                                        ticket = targeting_.ticket,
                                        mailbox = mailbox_](const std::stop_token& stop) {
    if (stop.stop_requested()) return;
    TargetView view = work->posture(question, stop);
    if (stop.stop_requested()) return;
    mailbox->post([this, ticket, view = std::move(view)] {
      if (ticket == targeting_.ticket) state_.target = view;
    });
  });
}

void Editor::target_from_posture() {
  const LimbModel* limb = state_.limb_model();
  if (!limb || !state_.clip) return;
  std::vector<ActorState> states;
  states_at(state_.clip, state_.time, states);
  const Mat4& end = states.front().world_from_joint[static_cast<std::size_t>(limb->limb.end)];
  HandTarget target;
  target.time = state_.time;
  target.position = Vec3(end[3]);
  target.orientation = rotation_of(end);
  edit("Hand target", Phase::committed,
       [&](Document& document) { document.draft.target = target; });
}

void Editor::keep_orientation(bool keep) {
  const LimbModel* limb = state_.limb_model();
  auto target = history_.document().draft.target;
  if (!limb || !state_.clip || !target || target->orientation.has_value() == keep) return;
  target->orientation.reset();
  if (keep) {
    std::vector<ActorState> states;
    states_at(state_.clip, target->time, states);
    target->orientation =
        rotation_of(states.front().world_from_joint[static_cast<std::size_t>(limb->limb.end)]);
  }
  edit(keep ? "Keep the orientation" : "Free the orientation", Phase::committed,
       [&](Document& document) { document.draft.target = target; });
}

// The palm on the surface if limits let it lie there, in any direction, else the wrist near it.
HandTarget Editor::target_on(const SurfacePoint& point, const LimbModel& limb,
                             const ActorState& figure) const {
  const double clearance = wishes().clearance > 0
                               ? wishes().clearance
                               : CollisionSettings{}.clearance * session_->character().height;
  const Mat4& end = figure.world_from_joint[static_cast<std::size_t>(limb.limb.end)];
  const double length = hand_length(session_->scene.model(), session_->character(), limb.limb);
  const auto targets = surface_targets(limb, end, point, clearance, length, state_.time);
  for (const HandTarget& target : targets) {
    const TargetQuestion question{session_, state_.clip, state_.limb, target, clearance};
    if (posture_by_limits(question).status == TargetView::Status::solved) return target;
  }
  return targets.back();
}

void Editor::click(const command::Click& click) {
  if (!session_ || !state_.clip) return;
  World world = session_->scene.world;
  world.actors.front().clip = view_.compare == Compare::before ? state_.source : state_.clip;
  std::vector<ActorState> states;
  world_state_at(world, state_.time, states);
  PickFilter filter;
  const LimbModel* limb = state_.limb_model();
  if (click.place_target && limb) {
    // The hand that is to go there is no surface to put it on.
    filter.through_actor = 0;
    filter.through_joints = SceneFrame::limb_nodes(session_->scene.model().skeleton, limb->limb);
  }
  const auto hit = picker_.nearest(world, states, {click.origin, click.direction}, filter);
  if (click.place_target) {
    if (!limb) return;
    if (!hit) {
      tell(Notice::Kind::warning, {"there is no surface under that click", "",
                                   "click a body or an object; drag the target from there"});
      return;
    }
    const HandTarget target = target_on({hit->place, hit->normal}, *limb, states.front());
    edit("Place hand target", Phase::committed,
         [&](Document& document) { document.draft.target = target; });
    return;
  }
  if (!hit || hit->actor != 0 || hit->joint < 0) return;
  const Skeleton& skeleton = session_->scene.model().skeleton;
  for (std::size_t i = 0; i < session_->limbs.size(); ++i)
    if (SceneFrame::limb_nodes(skeleton,
                               session_->limbs[i].limb)[static_cast<std::size_t>(hit->joint)])
      select_limb(static_cast<int>(i));
}

}  // namespace elbowroom
