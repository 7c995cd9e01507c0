// SPDX-License-Identifier: MIT
// What an animator can ask of the editor, as values. Panels, shortcuts and tests emit them; the
// editor (app/editor) carries them out, each change of the document as one named step of undo.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/anatomy/limits.h"
#include "core/editing/document.h"
#include "core/editing/sampling_presets.h"

namespace elbowroom {

// Where in a drag a change comes from: one drag is one step of undo.
enum class Phase { begin, changing, committed, cancelled };

namespace command {

// Files. Which of the paths is the character, which obstacles, the editor finds out.
struct OpenFiles {
  std::vector<std::filesystem::path> paths;
  bool as_objects = false;  // whatever is in them, they go into the scene that is open
};
struct OpenDemo {};
// What to do with work that is not saved when something else is to be opened.
struct AnswerOpening {
  bool open = false;  // else what is open stays
};
// What to do with unsaved work that a session before has left behind.
struct AnswerRecovery {
  enum class Answer { recover, discard, later } answer = Answer::later;
};
struct SaveProject {
  std::filesystem::path path;  // empty: where it was saved last
};
struct Export {
  std::filesystem::path path;
};
struct AttachObject {  // hold an obstacle file's objects in a hand; empty joint: put it down
  std::filesystem::path file;
  std::string joint;
};
struct RemoveObject {
  std::filesystem::path file;
};
struct ChooseClip {
  std::string name;
};

struct Undo {};
struct Redo {};

// Time.
struct Scrub {
  double t = 0;
};
struct TogglePlay {};
struct ToggleLoop {};
struct SetSpeed {
  double speed = 1;
};
struct StepFrames {
  int frames = 1;
};
struct GoToEnd {
  bool last = false;
};
struct GoToProblem {  // of the selected limb, else of any
  int direction = 1;
};

// What is worked on.
struct SelectLimb {
  int limb = -1;
};
struct SelectProblem {  // limb and window of one of the strip's proposals
  int limb = -1;
  int window = 0;
};
struct SetWindow {
  std::optional<Interval> window;
  Phase phase = Phase::committed;
  int limb = -1;  // which is selected with it; -1: the one that is
};
struct SetSampling {
  std::string dof;
  std::optional<Interval> interval;  // none: the limb's own
  Phase phase = Phase::committed;
};
struct ChoosePreset {
  SamplingPreset preset = SamplingPreset::paper;
};
struct SetWishes {  // seed, clearance, budget; the sampling intervals stay
  PlanningWishes wishes;
  std::string what;  // the step's name, "Seed 7"
  Phase phase = Phase::committed;
};

// What the character's limbs are.
struct SetSwingLimit {  // of the selected limb's joint
  LimbJointRole role = LimbJointRole::root;
  SwingPolygon polygon;  // empty: the joint's own limit
  Phase phase = Phase::committed;
};
struct SetLimbJoints {
  std::string limb;                  // by limb_id, or a chain's name
  std::optional<LimbJoints> joints;  // none: as found by itself
};

// Planning.
struct Plan {};
struct CancelPlan {};
struct Accept {};
struct Discard {};
// Another of the ways that the plan came to becomes the candidate; past the last comes the first.
struct ShowWay {
  int index = 0;
};

// Corrections.
struct SelectCorrection {
  int index = -1;
};
struct MuteCorrection {
  int index = -1;
};
struct DeleteCorrection {
  int index = -1;
};
struct RenameCorrection {
  int index = -1;
  std::string name;
};
struct ReplanCorrection {
  int index = -1;
};

// The hand target.
struct SetTarget {
  std::optional<HandTarget> target;  // none: no target
  Phase phase = Phase::committed;
  std::string what = "Move hand target";
};
// The selected limb's end where it is now.
struct TargetFromPosture {};

// The hand keeps the orientation that it has at the target's time in the motion, or turns freely.
struct KeepOrientation {
  bool keep = true;
};

// A click in the viewport: a ray in the world.
struct Click {
  Vec3 origin{0.0}, direction{0.0, 0.0, -1.0};
  bool place_target = false;  // else the limb that is hit is selected
};

struct Quit {
  bool discard = false;  // without asking for what is not saved
};

}  // namespace command

using Command = std::variant<
    command::OpenFiles, command::OpenDemo, command::AnswerOpening, command::AnswerRecovery,
    command::SaveProject, command::Export, command::AttachObject, command::RemoveObject,
    command::ChooseClip, command::Undo, command::Redo, command::Scrub, command::TogglePlay,
    command::ToggleLoop, command::SetSpeed, command::StepFrames, command::GoToEnd,
    command::GoToProblem, command::SelectLimb, command::SelectProblem, command::SetWindow,
    command::SetSampling, command::ChoosePreset, command::SetWishes, command::SetSwingLimit,
    command::SetLimbJoints, command::Plan, command::CancelPlan, command::Accept, command::Discard,
    command::ShowWay, command::SelectCorrection, command::MuteCorrection, command::DeleteCorrection,
    command::RenameCorrection, command::ReplanCorrection, command::SetTarget,
    command::TargetFromPosture, command::KeepOrientation, command::Click, command::Quit>;

using Commands = std::vector<Command>;

}  // namespace elbowroom
