// SPDX-License-Identifier: MIT
// A document made ready to work on: its files read, the character's limbs found and fitted, the
// scene's contacts at hand. Used by every command that looks at a scene.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/collision/scene_collision.h"
#include "core/editing/document.h"
#include "core/io/open_scene.h"

namespace elbowroom {

struct Session {
  Document document;
  OpenedScene scene;
  LimbFindings findings;
  std::vector<LimbModel> limbs;      // fitted; in the order of SceneCollision's indices
  std::vector<DofSpace> own_limits;  // of each limb before the document's swing limits
  std::map<std::string, int> named;  // what limbs were asked for as, and their indices in `limbs`
  std::vector<std::string> warnings;

  const Character& character() const {
    return scene.model().characters[static_cast<std::size_t>(scene.character)];
  }
  const std::shared_ptr<const Clip>& clip() const { return scene.world.actors.front().clip; }
  std::string clip_name() const;  // as the file has it, "clip 0" where it has no name
  // What a task or a correction of this clip says of it: its name, or its index where the name is
  // missing or another clip's too. Empty without a clip.
  std::string clip_id() const;
  // Whether such a text means this clip; an empty one means any.
  bool is_of_clip(const std::string& clip) const;
};

// Reads and fits. `named`: limbs FROM..TO to fit besides the ones found; empty ones and the usual
// names ask for nothing. Errors: no such limb; two that share joints.
Result<Session> open_session(const Document& document, const std::vector<std::string>& named = {});

// The same with every limb that the document's draft, tasks and corrections name by joints. Ones
// that are not there any more are told of by a warning: what an editor opens should open.
Result<Session> open_project_session(const Document& document);

// The session of another version of the document whose scene is the same: what was read is kept,
// the limbs are found and fitted anew. Some milliseconds.
Session refit_project_session(const Session& session, const Document& document);

// The limb indices that LIMB (auto: every one) means. Error: no such limb, with what there is.
Result<std::vector<int>> limbs_named(const Session& session, const std::string& limb);

// Contacts at hand, for the whole clip. Error: no clip.
Result<SceneCollision> contacts_of(const Session& session, const std::stop_token& stop = {});

}  // namespace elbowroom
