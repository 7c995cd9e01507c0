// SPDX-License-Identifier: MIT
// Follows the hand target in the background: the posture that reaches it without running into
// anything [SKF07 5], for the newest target only.
//
// Belongs to the target's thread alone. The scene's contacts are built at the first question, which
// then takes as long as it takes; until then the window shows what
// posture_by_limits finds.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>

#include "core/editing/document.h"
#include "core/editing/session.h"
#include "ui/editor_state.h"

namespace elbowroom {

struct TargetQuestion {
  std::shared_ptr<const Session> session;
  std::shared_ptr<const Clip> clip;
  int limb = -1;
  HandTarget target;
  double clearance = 0;  // scene units; 0: the scene's default
};

// By limits alone, at once: microseconds.
TargetView posture_by_limits(const TargetQuestion& question);

class TargetWork {
 public:
  // With contacts, on the deformed skin. When stopped, whatever it is at.
  TargetView posture(const TargetQuestion& question, const std::stop_token& stop);

  // No more questions will come: the building of contacts may stop. Any thread.
  void abandon() { abandoned_.request_stop(); }

 private:
  std::shared_ptr<const Session> session_;
  std::optional<SceneCollision> scene_;
  std::stop_source abandoned_;  // questions stop one after another; the scene is built for all
};

}  // namespace elbowroom
