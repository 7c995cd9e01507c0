// SPDX-License-Identifier: MIT
#include "ui/swing_view.h"

#include <algorithm>
#include <cmath>

#include "core/anatomy/limb_clip.h"
#include "ui/toolkit/text.h"

namespace elbowroom {
namespace {

constexpr int kOutline = 96, kStartCorners = 10, kSamples = 240;

// "Shoulder, swing up" is "Shoulder" and "up"; a chain's "Tail2, swing 1" stays "swing 1".
std::pair<std::string, std::string> parts_of(const std::string& name) {
  const std::size_t comma = name.rfind(", ");
  if (comma == std::string::npos) return {"", name};
  std::string way = name.substr(comma + 2);
  const std::string swing = "swing ";
  if (way.rfind(swing, 0) == 0 && !(way.size() > swing.size() && way[swing.size()] <= '9'))
    way = way.substr(swing.size());
  return {name.substr(0, comma), way};
}

// The swing that brings the bone from the zero pose to a direction of the parent's space: the
// shortest rotation, taken apart as core/anatomy/joint_model.h has it.
SwingView::Place place_of(const JointModel& joint, const Vec3& direction) {
  const Vec3 v = glm::conjugate(joint.parent_from_zero) * direction;
  const double across = std::hypot(v.y, v.z);
  if (!(across > 1e-9)) return {0, 0};
  const double angle = std::atan2(across, v.x);
  return {-joint.side * angle * v.z / across, angle * v.y / across};
}

void add_landmarks(const LimbModel& limb, SwingView& view) {
  const JointModel& joint = limb.joints[0];
  const bool arm = limb.limb.is_arm();
  view.landmarks = {{arm ? "hanging" : "standing", place_of(joint, -limb.up)},
                    {"to the side", place_of(joint, limb.outward)},
                    {"ahead", place_of(joint, limb.forward)}};
  if (arm) view.landmarks.push_back({"overhead", place_of(joint, limb.up)});
}

}  // namespace

std::vector<SwingView> swing_views(const Session& session, int index) {
  std::vector<SwingView> views;
  if (index < 0 || index >= static_cast<int>(session.limbs.size())) return views;
  const LimbModel& limb = session.limbs[static_cast<std::size_t>(index)];
  LimbModel own = limb;
  own.space = session.own_limits[static_cast<std::size_t>(index)];
  for (const LimbJointRole role :
       {LimbJointRole::root, LimbJointRole::middle, LimbJointRole::end}) {
    const JointModel& joint = limb.joints[static_cast<std::size_t>(role)];
    if (joint.kind != JointModelKind::ball && joint.kind != JointModelKind::swing) continue;
    SwingView view;
    view.role = role;
    view.first_dof = joint.first_dof;
    const auto first = static_cast<std::size_t>(joint.first_dof);
    std::tie(view.joint, view.first) = parts_of(own.space.dofs[first].name);
    view.second = parts_of(own.space.dofs[first + 1].name).second;
    view.own = swing_polygon_of(own, role, kOutline);
    view.start = swing_polygon_of(own, role, kStartCorners);
    if (role == LimbJointRole::root && limb.limb.kind != LimbKind::chain) add_landmarks(limb, view);
    views.push_back(std::move(view));
  }
  const auto& clip = session.clip();
  if (!clip) return views;
  LimbState state;
  for (int i = 0; i < kSamples; ++i) {
    const double t = clip->begin + (clip->end - clip->begin) * i / (kSamples - 1);
    state = limb_state_at(limb, session.scene.model(), *clip, t, i > 0 ? &state : nullptr);
    for (SwingView& view : views)
      view.clip.push_back({state.q[view.first_dof], state.q[view.first_dof + 1]});
  }
  return views;
}

std::string swing_text(const LimbModel& limb, const SwingView& view,
                       const SwingView::Place& place) {
  const auto degrees = [](double radians) { return number_text(radians * 180 / kPi, 0, "°"); };
  if (view.role == LimbJointRole::root && limb.limb.kind != LimbKind::chain) {
    Dofs q;
    q.count = limb.dof_count();
    q[view.first_dof] = place[0];
    q[view.first_dof + 1] = place[1];
    const Elevation seen = elevation(limb, q);
    return "raise " + degrees(seen.raise) + ", forward " + degrees(seen.forward);
  }
  return view.first + " " + degrees(place[0]) + ", " + view.second + " " + degrees(place[1]);
}

}  // namespace elbowroom
