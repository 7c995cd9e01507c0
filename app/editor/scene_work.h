// SPDX-License-Identifier: MIT
// What the editor's background thread does with a scene: look for contacts, plan.
//
// A SceneWork and its SceneCollision belong to that thread alone; results are values that can be
// handed over. Every call answers its stop token within a fraction of a second.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>

#include "core/editing/collision_strip.h"
#include "core/editing/session.h"
#include "ui/editor_state.h"

namespace elbowroom {

// A plan's outcome: a candidate, a failure, or neither when it was cancelled.
struct PlanOutcome {
  std::vector<Candidate> ways;  // as many as were asked for and found, best first
  std::optional<PlanFailure> failure;
  std::optional<Error> error;  // the question itself was wrong
};

class SceneWork {
 public:
  // Makes the scene's contacts ready; the whole clip's. Error: no clip, no limbs.
  Status prepare(std::shared_ptr<const Session> session, const std::stop_token& stop);
  bool ready() const { return scene_.has_value(); }

  CollisionStrip look(std::shared_ptr<const Clip> clip, std::stop_token stop,
                      const StripSink& grown);
  // After a change within [from, to] only.
  CollisionStrip look_again(std::shared_ptr<const Clip> clip, const CollisionStrip& before,
                            double from, double to, std::stop_token stop);

  // Plans the task's one limb on `clip`, which is the document's motion so far. The task has a
  // window, or a target.
  PlanOutcome plan(std::shared_ptr<const Clip> clip, int limb, const Task& task,
                   std::stop_token stop, const ProgressSink& progress);

 private:
  // One verified motion more, with what the animator is to know of it.
  void add_way(PlanOutcome& outcome, const std::shared_ptr<const Clip>& clip, int limb,
               const Task& task, WindowReport report, Correction correction,
               const std::stop_token& stop);

  std::shared_ptr<const Session> session_;
  std::optional<SceneCollision> scene_;
};

}  // namespace elbowroom
