// SPDX-License-Identifier: MIT
#include "core/editing/session.h"

#include <algorithm>
#include <set>

namespace elbowroom {
namespace {

bool is_usual(const std::string& name) {
  for (const auto kind :
       {LimbKind::left_arm, LimbKind::right_arm, LimbKind::left_leg, LimbKind::right_leg})
    if (name == limb_id(kind)) return true;
  return name.empty() || name == "auto";
}

// A contact is of one limb: those found that share joints with this one give way.
void make_way_for(Session& session, const Limb& limb) {
  const Skeleton& skeleton = session.scene.model().skeleton;
  std::erase_if(session.findings.limbs, [&](const Limb& other) {
    return skeleton.is_within(other.root, limb.root) || skeleton.is_within(limb.root, other.root);
  });
  session.findings.limbs.push_back(limb);
}

Status read_scene(const Document& document, Session& session) {
  session.document = document;
  auto scene = open_scene(document.scene);
  if (!scene) return scene.error();
  session.scene = std::move(*scene);
  session.warnings = session.scene.warnings;
  session.findings = find_limbs(session.scene.model(), session.character(), document.limbs);
  for (const auto& warning : session.findings.warnings) session.warnings.push_back(warning);
  for (const auto& [name, joints] : document.limbs) {
    const auto set = std::find_if(session.findings.limbs.begin(), session.findings.limbs.end(),
                                  [&](const Limb& limb) { return limb.name == name; });
    if (set != session.findings.limbs.end()) make_way_for(session, Limb(*set));
  }
  return Done{};
}

// Puts the limb named by its joints among those found.
Status give_way_to(Session& session, const std::string& name) {
  auto limb =
      limb_by_name(session.scene.model(), session.character(), name, session.document.limbs);
  if (!limb) return limb.error();
  make_way_for(session, *limb);
  return Done{};
}

Status fit(Session& session, const Limb& limb) {
  auto fitted = fit_limb_model(session.scene.model(), session.character(), limb, session.findings);
  if (!fitted) return fitted.error();
  session.limbs.push_back(std::move(*fitted));
  return Done{};
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

Result<Session> open_session(const Document& document, const std::string& extra_limb) {
  Session session;
  if (Status read = read_scene(document, session); !read) return read.error();
  if (!is_usual(extra_limb)) {
    if (Status added = give_way_to(session, extra_limb); !added) return added.error();
  }
  for (const Limb& limb : session.findings.limbs) {
    if (Status fitted = fit(session, limb); !fitted) {
      if (limb.name == extra_limb) return fitted.error();
      session.warnings.push_back(fitted.error().message());
    }
  }
  return session;
}

Result<Session> open_project_session(const Document& document) {
  Session session;
  if (Status read = read_scene(document, session); !read) return read.error();
  std::set<std::string> named = {document.draft.limb};
  for (const Task& task : document.tasks) named.insert(task.limb);
  for (const Correction& correction : document.corrections) named.insert(correction.limb);
  for (const std::string& name : named) {
    if (is_usual(name)) continue;
    if (Status added = give_way_to(session, name); !added)
      session.warnings.push_back(added.error().message());
  }
  for (const Limb& limb : session.findings.limbs)
    if (Status fitted = fit(session, limb); !fitted)
      session.warnings.push_back(fitted.error().message());
  return session;
}

Result<std::vector<int>> limbs_named(const Session& session, const std::string& limb) {
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
  return SceneCollision::build(session.scene.world, 0, session.scene.character, session.limbs,
                               clip->begin, clip->end, CollisionSettings{}, stop);
}

}  // namespace elbowroom
