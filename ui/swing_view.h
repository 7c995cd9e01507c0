// SPDX-License-Identifier: MIT
// How far a joint of a limb may swing, as its map shows it: the joint's own limit, the polygon that
// the document has in its place, what the clip does, and where the ways are that people know.
//
// Places are swings (first, second) from the joint's zero pose, radians: of a shoulder up and
// forward, of a hip outward and forward (core/anatomy/joint_model.h). Pure, any thread.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/anatomy/limits.h"
#include "core/editing/session.h"

namespace elbowroom {

struct SwingView {
  using Place = std::array<double, 2>;
  struct Landmark {
    std::string name;  // "ahead"
    Place place{};
  };

  LimbJointRole role = LimbJointRole::root;
  int first_dof = 0;
  std::string joint;                // "Shoulder"
  std::string first, second;        // "up", "forward"
  SwingPolygon own;                 // outline of the joint's own limit: ellipse and ranges
  SwingPolygon start;               // a polygon like it, to be edited; empty: there is none
  SwingPolygon polygon;             // the document's; empty: the joint's own limit holds
  std::vector<Place> clip;          // what the source clip does
  std::vector<Landmark> landmarks;  // of a shoulder or hip
  Place value{}, clip_value{};      // at the current time, in the motion shown and in the source
  std::array<double, 2> sample_first{}, sample_second{};  // sampling intervals in force
};

// One for each joint of the limb that swings, without what depends on time and document.
std::vector<SwingView> swing_views(const Session& session, int limb);

// "Raise 85°, forward 40°" of a shoulder or hip (core/anatomy/limb_model.h, Elevation); of other
// joints the numbers by the DOFs' own names.
std::string swing_text(const LimbModel& limb, const SwingView& view, const SwingView::Place& place);

}  // namespace elbowroom
