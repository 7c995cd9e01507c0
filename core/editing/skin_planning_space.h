// SPDX-License-Identifier: MIT
// The world as the planner sees it when nothing may be approximated: the limb's deformed skin
// against everything, at any (q, t). A hundred times slower than LimbPlanningSpace; the last resort
// where skin moves far from its rigid parts.
#pragma once

#include "core/collision/scene_collision.h"
#include "core/planning/state_space.h"

namespace elbowroom {

class SkinPlanningSpace : public StateSpace {
 public:
  // Beside what the clip itself touches a motion has room to slide while it is planned; or none, as
  // in final verdicts, which lets what is found hold, and fewer be found.
  enum class BesideClipContacts { slides, as_verified };
  // As LimbPlanningSpace; clearances in scene units. Edges over one of `moments` are looked at then
  // too, whatever their resolution. Keeps a reference to `scene` and poses its limb while it lives.
  SkinPlanningSpace(SceneCollision& scene, int limb, double t_init, double t_goal,
                    const LimbState& at_init, const LimbState& at_goal, double clearance,
                    double body_clearance, BesideClipContacts beside = BesideClipContacts::slides,
                    const std::vector<double>& moments = {});
  ~SkinPlanningSpace() override;
  SkinPlanningSpace(const SkinPlanningSpace&) = delete;
  SkinPlanningSpace& operator=(const SkinPlanningSpace&) = delete;

  bool valid(const Configuration& c) override;
  void metric_points(const Configuration& c, std::vector<Vec3>& points) override;
  const std::vector<double>& step_times() const override;

 private:
  LimbState state_of(const Configuration& c) const;

  SceneCollision& scene_;
  int limb_;
  double t_init_, t_goal_, clearance_, body_clearance_;
  LimbState at_init_, at_goal_;
  BesideClipContacts beside_;
  std::vector<double> steps_;
  std::vector<ActorState> states_;
  Pose pose_;
  std::vector<Mat4> globals_;
};

}  // namespace elbowroom
