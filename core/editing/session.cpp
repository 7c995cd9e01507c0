// SPDX-License-Identifier: MIT
#include "core/editing/session.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/anatomy/limits.h"

namespace elbowroom {
namespace {

bool is_usual(const std::string& name) {
  for (const auto kind :
       {LimbKind::left_arm, LimbKind::right_arm, LimbKind::left_leg, LimbKind::right_leg})
    if (name == limb_id(kind)) return true;
  return name.empty() || name == "auto";
}

bool same_joints(const Limb& a, const Limb& b) {
  return a.root == b.root && a.middle == b.middle && a.end == b.end;
}

bool share_joints(const Session& session, const Limb& a, const Limb& b) {
  const Skeleton& skeleton = session.scene.model().skeleton;
  // What follows a limb from elsewhere in the tree is as much its own.
  const auto tops = [](const Limb& limb) {
    std::vector<int> joints = {limb.root};
    for (const FollowingJoint& own : limb.following) joints.push_back(own.joint);
    return joints;
  };
  for (const int x : tops(a))
    for (const int y : tops(b))
      if (skeleton.is_within(x, y) || skeleton.is_within(y, x)) return true;
  return false;
}

// A contact is of one limb: those found that share joints with this one give way.
void make_way_for(Session& session, const Limb& limb) {
  std::erase_if(session.findings.limbs,
                [&](const Limb& other) { return share_joints(session, other, limb); });
  session.findings.limbs.push_back(limb);
}

// The limbs of a scene that has been read.
void find_in_scene(Session& session) {
  const Document& document = session.document;
  session.warnings = session.scene.warnings;
  session.findings = find_limbs(session.scene.model(), session.character(), document.limbs);
  for (const auto& warning : session.findings.warnings) session.warnings.push_back(warning);
  for (const auto& [name, joints] : document.limbs) {
    const auto set = std::find_if(session.findings.limbs.begin(), session.findings.limbs.end(),
                                  [&](const Limb& limb) { return limb.name == name; });
    if (set == session.findings.limbs.end()) continue;
    const Limb limb = *set;
    for (const Limb& other : session.findings.limbs)
      if (other.name != name && share_joints(session, other, limb))
        session.warnings.push_back(other.name + " gives way to " + name +
                                   ", as it was set by hand: they share joints");
    make_way_for(session, limb);
  }
}

Status read_scene(const Document& document, Session& session) {
  session.document = document;
  auto scene = open_scene(document.scene);
  if (!scene) return scene.error();
  session.scene = std::move(*scene);
  find_in_scene(session);
  return Done{};
}

// A limb by the name that it was asked for.
using Asked = std::vector<std::pair<std::string, Limb>>;

// Puts the limb named by its joints among those found. Error: there is none, or it shares joints
// with one that was asked for before.
Status ask_for(Session& session, const std::string& name, Asked& asked) {
  auto limb =
      limb_by_name(session.scene.model(), session.character(), name, session.document.limbs);
  if (!limb) return limb.error();
  for (const auto& [other_name, other] : asked)
    if (!same_joints(other, *limb) && share_joints(session, other, *limb))
      return Error{"the limbs " + other_name + " and " + name + " share joints",
                   session.document.scene.character.string(), "work with one of them at a time"};
  const bool found = std::any_of(session.findings.limbs.begin(), session.findings.limbs.end(),
                                 [&](const Limb& other) { return same_joints(other, *limb); });
  if (!found) make_way_for(session, *limb);
  asked.emplace_back(name, *limb);
  return Done{};
}

// Puts the swing limits that the document has for the limb in place of its own. What they cannot be
// put to is told of by a warning.
void set_swing_limits(Session& session, LimbModel& limb) {
  const auto set = session.document.swing_limits.find(limb.limb.name);
  if (set == session.document.swing_limits.end()) return;
  for (const LimbJointRole role :
       {LimbJointRole::root, LimbJointRole::middle, LimbJointRole::end}) {
    const SwingPolygon& polygon = set->second[static_cast<std::size_t>(role)];
    if (polygon.empty()) continue;
    if (Status done = set_swing_polygon(limb, role, polygon); !done)
      session.warnings.push_back("a swing limit of " + limb.limb.name +
                                 " is passed over: " + done.error().what);
  }
}

// Fits what was found. Error: the first limb that was asked for and can't be fitted; of others a
// warning tells.
Status fit_limbs(Session& session, const Asked& asked) {
  Status result = Done{};
  for (const Limb& limb : session.findings.limbs) {
    auto fitted =
        fit_limb_model(session.scene.model(), session.character(), limb, session.findings);
    if (fitted) {
      session.own_limits.push_back(fitted->space);
      set_swing_limits(session, *fitted);
      session.limbs.push_back(std::move(*fitted));
    }
    const auto index = static_cast<int>(session.limbs.size()) - 1;
    bool was_asked = false;
    for (const auto& [name, other] : asked) {
      if (!same_joints(other, limb)) continue;
      was_asked = true;
      if (fitted) session.named[name] = index;
    }
    if (fitted) continue;
    session.warnings.push_back(fitted.error().message());
    if (was_asked && result.ok()) result = fitted.error();
  }
  return result;
}

}  // namespace

std::string Session::clip_name() const {
  if (!clip()) return "";
  return clip()->name.empty() ? "clip " + std::to_string(scene.clip) : clip()->name;
}

std::string Session::clip_id() const {
  if (!clip()) return "";
  const std::string& name = clip()->name;
  return !name.empty() && scene.model().find_clip(name) == scene.clip ? name
                                                                      : std::to_string(scene.clip);
}

bool Session::is_of_clip(const std::string& clip) const {
  return clip.empty() || scene.model().find_clip(clip) == scene.clip;
}

Result<Session> open_session(const Document& document, const std::vector<std::string>& named) {
  Session session;
  if (Status read = read_scene(document, session); !read) return read.error();
  Asked asked;
  for (const std::string& name : named) {
    if (is_usual(name)) continue;
    if (Status added = ask_for(session, name, asked); !added) return added.error();
  }
  if (Status fitted = fit_limbs(session, asked); !fitted) return fitted.error();
  return session;
}

namespace {

// `named`: limbs asked for besides those that the document names.
void fit_project(Session& session, std::set<std::string> named = {}) {
  const Document& document = session.document;
  named.insert(document.draft.limb);
  for (const Task& task : document.tasks) named.insert(task.limb);
  for (const Correction& correction : document.corrections) named.insert(correction.limb);
  Asked asked;
  for (const std::string& name : named) {
    if (is_usual(name)) continue;
    if (Status added = ask_for(session, name, asked); !added)
      session.warnings.push_back(added.error().message());
  }
  // One that can't be fitted has been told of by a warning.
  (void)fit_limbs(session, asked);
}

}  // namespace

Result<Session> open_project_session(const Document& document) {
  Session session;
  if (Status read = read_scene(document, session); !read) return read.error();
  fit_project(session);
  return session;
}

Session refit_project_session(const Session& session, const Document& document) {
  Session fresh;
  fresh.document = document;
  fresh.scene = session.scene;
  find_in_scene(fresh);
  std::set<std::string> named;
  for (const auto& [name, index] : session.named) named.insert(name);
  fit_project(fresh, std::move(named));
  return fresh;
}

Result<std::vector<int>> limbs_named(const Session& session, const std::string& limb) {
  if (const auto asked = session.named.find(limb); asked != session.named.end())
    return std::vector<int>{asked->second};
  std::vector<int> indices;
  std::string known;
  for (std::size_t i = 0; i < session.limbs.size(); ++i) {
    const std::string& name = session.limbs[i].limb.name;
    known += (known.empty() ? "" : ", ") + name;
    if (limb == "auto" || name == limb) indices.push_back(static_cast<int>(i));
  }
  if (!indices.empty()) return indices;
  const std::string file = session.document.scene.character.string();
  if (session.limbs.empty())
    return Error{"no limb was found on " + session.character().name, file,
                 "name one by its joints, FROM..TO; `elbowroom info` lists the joints"};
  return Error{"there is no limb \"" + limb + "\"", file,
               "found: " + known + "; any other by its joints, FROM..TO"};
}

Result<SceneCollision> contacts_of(const Session& session, const std::stop_token& stop) {
  const auto& clip = session.clip();
  if (!clip)
    return Error{"the character has no clip", session.document.scene.character.string(),
                 "give a file with an animation"};
  CollisionSettings settings;
  settings.height = body_height(session.scene.model(), session.character(), session.findings);
  return SceneCollision::build(session.scene.world, 0, session.scene.character, session.limbs,
                               clip->begin, clip->end, settings, stop);
}

}  // namespace elbowroom
