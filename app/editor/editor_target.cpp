// SPDX-License-Identifier: MIT
// The hand target: where a click puts it, and the posture that follows it.
#include <algorithm>
#include <cmath>

#include "app/editor/editor.h"
#include "ui/scene_frame.h"

namespace elbowroom {
namespace {

// How far the hand's (foot's) skin goes beyond the end joint in the bind pose: the room that a
// target on a surface leaves for it. Scene units.
double end_length(const Session& session, const Limb& limb) {
  const Model& model = session.scene.model();
  const Character& character = session.character();
  const auto globals = bind_globals(model, character);
  const Vec3 from(globals[static_cast<std::size_t>(limb.end)][3]);
  double length = 0;
  std::vector<Vec3> positions;
  const Pose pose = rest_pose(model.skeleton);
  for (const int m : character.meshes) {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(m)];
    if (mesh.skin < 0) continue;
    deform(model, mesh, pose, globals, positions);
    for (std::size_t v = 0; v + 1 < mesh.influence_begin.size(); ++v) {
      const Influence* heaviest = nullptr;
      for (std::uint32_t i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i)
        if (!heaviest || mesh.influences[i].weight > heaviest->weight)
          heaviest = &mesh.influences[i];
      if (heaviest && model.skeleton.is_within(heaviest->joint, limb.end))
        length = std::max(length, glm::length(positions[v] - from));
    }
  }
  return length;
}

}  // namespace

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
    HandTarget target;
    target.time = state_.time;
    target.position = hit->place + hit->normal * end_length(*session_, limb->limb);
    edit("Place hand target", Phase::committed,
         [&](Document& document) { document.draft.target = target; });
    return;
  }
  if (!hit || hit->actor != 0 || hit->joint < 0) return;
  for (std::size_t i = 0; i < session_->limbs.size(); ++i)
    if (session_->scene.model().skeleton.is_within(hit->joint, session_->limbs[i].limb.root))
      select_limb(static_cast<int>(i));
}

}  // namespace elbowroom
