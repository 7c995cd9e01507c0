// SPDX-License-Identifier: MIT
// What panels read: the editor as it stands, for one frame. The editor (app/editor) fills it;
// panels change nothing in it but say what is wanted by commands (ui/commands.h). How the window
// looks at it all (camera, tabs, zoom) is ViewState, which panels change as they like: it is no
// part of the document and of no undo step.
//
// Plain values; pointers are good for the frame. Seconds, radians, scene units, world space.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/editing/collision_strip.h"
#include "core/editing/document.h"
#include "core/editing/session.h"
#include "ui/swing_view.h"
#include "ui/view_state.h"

namespace elbowroom {

// A computation in the background.
struct JobState {
  bool active = false;
  std::string what;      // "Planning right arm", for people
  double fraction = -1;  // [0, 1]; -1: unknown
  double seconds = 0;    // since it began
};

// Something that happened and is told once: what went wrong, what was done.
struct Notice {
  enum class Kind { error, warning, good };
  int id = 0;  // ascending
  Kind kind = Kind::error;
  Error text;
};

// One DOF of the selected limb, as the limb panel shows it.
struct DofView {
  std::string name;
  double lower = 0, upper = 0;                  // limits
  double sample_lower = 0, sample_upper = 0;    // sampling interval in force
  double default_lower = 0, default_upper = 0;  // that of the limb's own model
  double value = 0;                             // at the current time, in the motion shown
  double clip_value = 0;                        // and in the source clip
  bool custom = false;                          // the animator has set the interval
};

// A correction of the document, and whether it still lies on the clip.
struct CorrectionView {
  bool of_this_clip = true;  // else it is kept for its own
  bool fits = true;
  std::string problem;  // when it doesn't: why, and what to do
};

// What planning came to, shown as a ghost until it is accepted.
struct Candidate {
  Task task;
  Correction correction;
  WindowReport report;
  double scene_clearance = 0;        // least room from all that is not the character, at most
                                     // kStripReach × height
  std::vector<StripSample> room;     // the same over the window, at kStripRate
  std::shared_ptr<const Clip> clip;  // the document's motion with it
};

// Why the last plan failed, and what was tried instead.
struct PlanFailure {
  std::string limb, reason, blocked_by;
  double begin = 0, end = 0;
  std::vector<Suggestion> suggestions{};
  // Nothing was searched: the window's ends are in contact, or no posture reaches the target. What
  // the planner draws at random changes nothing then.
  bool hopeless = false;
  bool reach = false;
  bool turning = false;  // a reach that may do with the hand turned otherwise
};

// Where the limb stands for the hand target that is being set.
struct TargetView {
  enum class Status { none, solving, solved, out_of_reach, at_limit, in_collision };
  Status status = Status::none;
  std::string text;                // one sentence, for people
  std::optional<LimbState> state;  // the posture to show, the nearest one where it isn't solved
};

struct EditorState {
  // The document.
  const Document* document = nullptr;  // never null
  std::uint64_t revision = 0;
  std::uint64_t picture_version = 1;  // another one whenever the viewport may show something else
  std::string name;  // of the project, or of the character's file; empty: nothing is open
  bool has_project = false;
  bool dirty = false;
  std::string undo_name, redo_name;  // empty: none

  // The scene; null while nothing is open.
  const Session* session = nullptr;
  std::shared_ptr<const Clip> source;  // the clip as it is in the file
  std::shared_ptr<const Clip> clip;    // with the document's corrections
  std::vector<CorrectionView> corrections;

  // Contacts of the source clip and of the corrected one. Null: not yet looked at.
  std::shared_ptr<const CollisionStrip> source_strip, strip;
  bool strip_is_current = false;  // strip is that of `clip`; else of the motion before it

  // Time.
  double time = 0, begin = 0, end = 0;
  double frame_rate = 30;
  bool playing = false, loop = true;
  double speed = 1;

  // The selected limb: index in session->limbs, -1: none.
  int limb = -1;
  std::vector<DofView> dofs;
  std::vector<SwingView> swings;  // of its joints that swing
  int selected_correction = -1;

  std::optional<Candidate> candidate;
  std::vector<Candidate> ways;  // all that the plan came to, best first; the candidate is one
  int way = 0;                  // which
  std::optional<PlanFailure> failure;
  TargetView target;

  // Unsaved work that was found and is asked about.
  struct Lost {
    std::string name, when;  // "mannequin", "26 Nov, 14:32"
  };
  std::optional<Lost> lost;

  JobState opening, scanning, planning, exporting;
  std::vector<Notice> notices;  // the last few, oldest first
  std::vector<std::string> recent_files;

  bool open() const { return session != nullptr; }
  const LimbModel* limb_model() const {
    return session && limb >= 0 ? &session->limbs[static_cast<std::size_t>(limb)] : nullptr;
  }
};

// "Right arm" for right_arm; FROM..TO as it is.
std::string limb_title(const std::string& limb);

// The plan that is shown was made with other settings, another window or target than are set now.
bool made_otherwise(const EditorState& state);

}  // namespace elbowroom
