// SPDX-License-Identifier: MIT
#include "ui/scene_frame.h"

#include <algorithm>
#include <cmath>

#include "render/bounds.h"
#include "render/limit_cone.h"
#include "render/style.h"

namespace elbowroom {
namespace {

const Style kStyle;

constexpr float kLimbStrength = 0.30f;  // of the selected limb's own tone
constexpr float kGhostOpacity = 0.62f;
constexpr float kSourceOpacity = 0.30f;
constexpr double kTrailStep = 1.0 / 60;  // s
constexpr int kMostTrailPoints = 600;
constexpr std::size_t kFramingPoints = 300;  // a mesh

bool same_time(double a, double b, double frame_rate) {
  return std::abs(a - b) <= 0.5 / std::max(frame_rate, 1.0);
}

// Whether an actor follows a node of the mask, perhaps by way of another carried one.
bool carried_by(const World& world, std::size_t actor, const std::vector<float>& parts) {
  for (int depth = 0; depth < 8; ++depth) {
    const auto& attachment = world.actors[actor].attachment;
    if (!attachment || attachment->actor < 0) return false;
    if (attachment->actor == 0)
      return attachment->joint >= 0 && static_cast<std::size_t>(attachment->joint) < parts.size() &&
             parts[static_cast<std::size_t>(attachment->joint)] > 0;
    actor = static_cast<std::size_t>(attachment->actor);
  }
  return false;
}

}  // namespace

std::vector<std::uint8_t> SceneFrame::limb_nodes(const Skeleton& skeleton, const Limb& limb) {
  std::vector<std::uint8_t> nodes(static_cast<std::size_t>(skeleton.size()), 0);
  for (const int node : skeleton.order) {
    const int parent = skeleton.joints[static_cast<std::size_t>(node)].parent;
    nodes[static_cast<std::size_t>(node)] =
        node == limb.root || limb.follows(node) ||
        (parent >= 0 && nodes[static_cast<std::size_t>(parent)]);
  }
  return nodes;
}

void SceneFrame::begin_session(const EditorState& state) {
  session_ = state.session;
  size_ = session_ ? scene_size(session_->scene.world) : 0;
  source_trail_ = shown_trail_ = {};
}

const Frame& SceneFrame::make(const EditorState& state, const ViewState& view, double pixel_scale) {
  if (state.session != session_) begin_session(state);
  const FrameKey key{session_,       state.picture_version,
                     view.compare,   view.show_trails,
                     view.show_limb, view.swing_in_picture ? view.swing_joint : -1};
  if (key == made_from_) {
    frame_.pixel_scale = pixel_scale;
    return frame_;
  }
  made_from_ = key;
  frame_ = Frame{};
  frame_.pixel_scale = pixel_scale;
  states_.clear();
  world_ = {};
  if (!session_) return frame_;
  world_ = session_->scene.world;
  const bool before = view.compare == Compare::before;
  world_.actors.front().clip = before ? state.source : state.clip;
  world_state_at(world_, state.time, states_);
  frame_.world = &world_;
  frame_.states = &states_;
  frame_.size = size_;
  frame_.looks.resize(world_.actors.size());
  limb_parts_.clear();
  if (const LimbModel* limb = state.limb_model()) {
    const auto nodes = limb_nodes(session_->scene.model().skeleton, limb->limb);
    limb_parts_.assign(nodes.begin(), nodes.end());
    if (view.show_limb) add_limb_look(state, view);
  }
  add_contacts(state, view);
  if (!before) {
    if (state.candidate)
      add_candidate(state);
    else if (view.compare == Compare::both && !state.document->draft.target)
      add_source_ghost(state);
    add_target(state);
  }
  if (view.show_trails) add_trails(state);
  if (view.swing_in_picture) add_swing_cone(state, view);
  // While a target is set the ghost follows it over a world that stands still.
  frame_.keep_scene = state.document->draft.target.has_value() && !state.playing;
  return frame_;
}

void SceneFrame::add_limb_look(const EditorState& state, const ViewState&) {
  ActorLook& look = frame_.looks.front();
  look.emphasis = limb_parts_;
  look.emphasis_colour = kStyle.accent;
  look.emphasis_strength = kLimbStrength;
  const LimbModel& limb = *state.limb_model();
  for (const int joint : {limb.limb.root, limb.limb.middle, limb.limb.end}) {
    Marker marker;
    marker.place = Vec3(states_.front().world_from_joint[static_cast<std::size_t>(joint)][3]);
    marker.colour = kStyle.accent;
    marker.radius = 3.5f;
    frame_.markers.push_back(marker);
  }
}

void SceneFrame::add_ghost(const World& world, const std::vector<ActorState>& states,
                           const Limb& limb, Rgb colour, float opacity) {
  const auto nodes = limb_nodes(session_->scene.model().skeleton, limb);
  std::vector<float> parts(nodes.begin(), nodes.end());
  for (std::size_t actor = 0; actor < world.actors.size() && actor < states.size(); ++actor) {
    if (actor > 0 && !carried_by(world, actor, parts)) continue;
    Ghost ghost;
    ghost.actor = &world.actors[actor];
    ghost.state = &states[actor];
    ghost.colour = colour;
    ghost.opacity = opacity;
    if (actor == 0) ghost.parts = parts;
    frame_.ghosts.push_back(ghost);
  }
}

void SceneFrame::add_candidate(const EditorState& state) {
  const int limb = state.candidate->report.limb;
  if (limb < 0 || limb >= static_cast<int>(session_->limbs.size())) return;
  if (state.time < static_cast<double>(state.candidate->correction.begin) ||
      state.time > static_cast<double>(state.candidate->correction.end))
    return;  // there it is the motion itself
  ghost_world_ = session_->scene.world;
  ghost_world_.actors.front().clip = state.candidate->clip;
  world_state_at(ghost_world_, state.time, ghost_states_);
  add_ghost(ghost_world_, ghost_states_, session_->limbs[static_cast<std::size_t>(limb)].limb,
            kStyle.ghost, kGhostOpacity);
}

// The source's limbs where an accepted correction has moved them.
void SceneFrame::add_source_ghost(const EditorState& state) {
  if (state.clip == state.source) return;
  bool any = false;
  for (const Correction& correction : state.document->corrections) {
    if (correction.muted || state.time < static_cast<double>(correction.begin) ||
        state.time > static_cast<double>(correction.end))
      continue;
    if (!any) {
      ghost_world_ = session_->scene.world;
      ghost_world_.actors.front().clip = state.source;
      world_state_at(ghost_world_, state.time, source_states_);
      any = true;
    }
    for (const LimbModel& limb : session_->limbs)
      if (limb.limb.name == correction.limb)
        add_ghost(ghost_world_, source_states_, limb.limb, kStyle.problem, kSourceOpacity);
  }
}

void SceneFrame::add_target(const EditorState& state) {
  const auto& target = state.document->draft.target;
  const LimbModel* limb = state.limb_model();
  if (!target || !limb) return;
  Marker marker;
  marker.place = target->position;
  marker.radius = 6;
  marker.shape = MarkerShape::ring;
  marker.colour = kStyle.selection;
  frame_.markers.push_back(marker);
  if (!state.target.state || !same_time(state.time, target->time, state.frame_rate)) return;
  // Green is free, orange is not; what is not known yet is neither.
  const auto status = state.target.status;
  const auto colour = status == TargetView::Status::solved    ? kStyle.good
                      : status == TargetView::Status::solving ? kStyle.ghost
                                                              : kStyle.problem;
  target_world_ = world_;
  target_states_ = states_;
  ActorState& figure = target_states_.front();
  apply_limb_state(*limb, *state.target.state, session_->scene.model().skeleton, figure.pose);
  compute_globals(session_->scene.model().skeleton, figure.pose,
                  target_world_.actors.front().world_from_file, figure.world_from_joint);
  for (std::size_t actor = 1; actor < target_world_.actors.size(); ++actor)
    if (carried_by(target_world_, actor, limb_parts_))
      actor_state_at(target_world_, static_cast<int>(actor), state.time, target_states_);
  add_ghost(target_world_, target_states_, limb->limb, colour, kGhostOpacity);
}

void SceneFrame::add_contacts(const EditorState& state, const ViewState& view) {
  const auto& strip = view.compare == Compare::before ? state.source_strip : state.strip;
  if (!strip || (view.compare != Compare::before && !state.strip_is_current)) return;
  for (const LimbStrip& limb : strip->limbs) {
    const StripSample* sample = strip_sample_at(limb, state.time);
    if (!sample || !sample->contact) continue;
    ContactMark mark;
    mark.place = sample->place;
    frame_.contacts.push_back(mark);
  }
}

const Trail& SceneFrame::trail_of(KeptTrail& kept, const std::shared_ptr<const Clip>& clip,
                                  const std::shared_ptr<const CollisionStrip>& strip, int limb,
                                  double begin, double end, Rgb colour, bool dashed) {
  const TrailKey key{clip, strip, limb, begin, end};
  if (kept.key == key && !kept.trail.points.empty()) return kept.trail;
  kept.key = key;
  Trail& trail = kept.trail;
  trail = {};
  World alone;
  alone.actors.push_back(session_->scene.world.actors.front());
  alone.actors.front().clip = clip;
  std::vector<ActorState> states;
  const int joint = session_->limbs[static_cast<std::size_t>(limb)].limb.end;
  const int points =
      std::clamp(static_cast<int>(std::ceil((end - begin) / kTrailStep)) + 1, 2, kMostTrailPoints);
  for (int i = 0; i < points; ++i) {
    const double t = begin + (end - begin) * i / (points - 1);
    world_state_at(alone, t, states);
    trail.points.emplace_back(states.front().world_from_joint[static_cast<std::size_t>(joint)][3]);
    const StripSample* sample =
        strip ? strip_sample_at(strip->limbs[static_cast<std::size_t>(limb)], t) : nullptr;
    trail.colours.push_back(sample && sample->contact ? kStyle.problem : colour);
  }
  if (dashed) trail.dash = 0.012 * size_;
  return trail;
}

void SceneFrame::add_trails(const EditorState& state) {
  const LimbModel* limb = state.limb_model();
  const auto& window = state.document->draft.window;
  if (!limb || !state.source) return;
  double begin = 0, end = 0;
  if (state.candidate && state.candidate->report.limb == state.limb) {
    begin = static_cast<double>(state.candidate->correction.begin);
    end = static_cast<double>(state.candidate->correction.end);
  } else if (window) {
    begin = window->lower;
    end = window->upper;
  } else {
    return;
  }
  frame_.trails.push_back(
      trail_of(source_trail_, state.clip, state.strip, state.limb, begin, end, 0x9aa3b2, true));
  if (state.candidate && state.candidate->report.limb == state.limb)
    frame_.trails.push_back(trail_of(shown_trail_, state.candidate->clip, nullptr, state.limb,
                                     begin, end, kStyle.good, false));
}

// How far the joint on the limb panel's map may swing, about the joint itself.
void SceneFrame::add_swing_cone(const EditorState& state, const ViewState& view) {
  const auto chosen = static_cast<std::size_t>(view.swing_joint);
  if (view.swing_joint < 0 || chosen >= state.swings.size()) return;
  const SwingView& swing = state.swings[chosen];
  LimbModel limb = *state.limb_model();
  // As the document has it, which is ahead of the session while a corner is dragged.
  limb.space = session_->own_limits[static_cast<std::size_t>(state.limb)];
  if (!swing.polygon.empty())
    if (Status set = set_swing_polygon(limb, swing.role, swing.polygon); !set) return;
  const auto first = static_cast<std::size_t>(swing.first_dof);
  limb.space.dofs[first].sample_lower = swing.sample_first[0];
  limb.space.dofs[first].sample_upper = swing.sample_first[1];
  limb.space.dofs[first + 1].sample_lower = swing.sample_second[0];
  limb.space.dofs[first + 1].sample_upper = swing.sample_second[1];
  const auto& placed = states_.front().world_from_joint;
  const auto place = [&](int joint) { return Vec3(placed[static_cast<std::size_t>(joint)][3]); };
  const int which = static_cast<int>(swing.role);
  const int joint = limb.joints[static_cast<std::size_t>(which)].joint;
  const int parent =
      session_->scene.model().skeleton.joints[static_cast<std::size_t>(joint)].parent;
  const Mat4 world_from_parent = parent >= 0 ? placed[static_cast<std::size_t>(parent)]
                                             : world_.actors.front().world_from_file;
  const double length = which == 0
                            ? glm::distance(place(limb.limb.root), place(limb.limb.middle))
                            : 0.5 * glm::distance(place(limb.limb.middle), place(limb.limb.end));
  for (Trail& trail : cone_trails(limit_cone(limb, which, world_from_parent, place(joint), length),
                                  kStyle.accent, 0.7f))
    frame_.trails.push_back(std::move(trail));
}

std::optional<Vec3> SceneFrame::figure_place() const {
  if (!session_ || states_.empty()) return std::nullopt;
  std::vector<int> joints;
  for (const LimbModel& limb : session_->limbs) joints.push_back(limb.limb.root);
  if (joints.empty()) joints = session_->character().joints;
  if (joints.empty()) return std::nullopt;
  Vec3 sum(0.0);
  for (const int joint : joints)
    sum += Vec3(states_.front().world_from_joint[static_cast<std::size_t>(joint)][3]);
  return sum / static_cast<double>(joints.size());
}

std::vector<Vec3> SceneFrame::points_of_figure(const EditorState& state, bool whole_clip) const {
  std::vector<Vec3> points;
  if (!session_) return points;
  std::vector<ActorState> states;
  // Where the figure is over the clip; a handful of moments tells.
  constexpr int kMoments = 5;
  for (int i = 0; i < (whole_clip ? kMoments : 1); ++i) {
    const double t =
        whole_clip ? state.begin + (state.end - state.begin) * i / (kMoments - 1) : state.time;
    world_state_at(world_, t, states);
    for (std::size_t actor = 0; actor < world_.actors.size(); ++actor) {
      if (actor > 0 && !world_.actors[actor].attachment) continue;
      std::vector<int> meshes(world_.actors[actor].model->meshes.size());
      for (std::size_t m = 0; m < meshes.size(); ++m) meshes[m] = static_cast<int>(m);
      body_points(world_.actors[actor], states[actor], meshes, kFramingPoints, points);
    }
  }
  return points;
}

std::vector<Vec3> SceneFrame::points_of_selection(const EditorState& state) const {
  std::vector<Vec3> points;
  if (!session_ || states_.empty()) return points;
  const LimbModel* limb = state.limb_model();
  if (!limb) {
    std::vector<int> meshes(session_->scene.model().meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m) meshes[m] = static_cast<int>(m);
    body_points(world_.actors.front(), states_.front(), meshes, kFramingPoints, points);
    return points;
  }
  for (std::size_t node = 0; node < limb_parts_.size(); ++node)
    if (limb_parts_[node] > 0) points.emplace_back(states_.front().world_from_joint[node][3]);
  const double around = 0.12 * size_;
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      points.push_back(points[i] + around * way);
      points.push_back(points[i] - around * way);
    }
  return points;
}

}  // namespace elbowroom
