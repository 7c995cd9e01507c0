// SPDX-License-Identifier: MIT
// What an animator has accepted, on the scene as it is now: the corrections of a document are laid
// over the clip key by key as they are, and looked at again as a planned motion is
// (core/editing/verify_window.h). A correction holds if
// * its keys are those of its limb's joints and meet the clip at its window's ends;
// * its task still asks for what it was made with: limb, window, wishes (whatever the seed: another
//   way around has one of its own);
// * of a reach, the hand is at the target at its time, within 1e-4 of the limb's length and 1e-3
//   rad;
// * the limb touches nothing over the window, on the deformed skin, with all others that hold laid
//   over too.
// Seconds, radians, scene units. Runs on the calling thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/editing/correct.h"
#include "core/editing/session.h"

namespace elbowroom {

struct Accepted {
  // One that holds; its report is marked `accepted`.
  struct Kept {
    Correction correction;
    WindowReport report;
  };
  struct Dropped {
    Correction correction;
    std::string why;  // for people: "X with Y at 1.234 s"
  };
  std::vector<Kept> kept;        // in the document's order
  std::vector<Dropped> dropped;  // likewise
  std::shared_ptr<const Clip> clip;
};

// Which of the corrections hold on the clip that `scene` plays; muted ones and other clips' are
// passed over. As many as hold together: what holds no more without one that was dropped is dropped
// too. `tasks` are looked for by name; a correction without one is of none. The scene plays `clip`
// afterwards. Stopped, it returns what it has; ask the token.
// Cost: a verification of each, again after each that was dropped; nothing is planned.
Accepted keep_accepted(SceneCollision& scene, const Session& session,
                       const std::vector<Correction>& corrections, const std::vector<Task>& tasks,
                       const std::stop_token& stop = {}, const ProgressSink& progress = {});

}  // namespace elbowroom
