// SPDX-License-Identifier: MIT
// The editor without its window: carries out commands on the document, keeps what is computed in
// the background up to date with it, and tells panels how things stand.
//
// Commands change the document by named steps of undo; whatever follows from the document (the
// corrected clip, the strips of contacts, the posture at the hand target) is computed from it and
// never edited. Work goes to three threads: one reads and writes files, one looks for contacts and
// plans, one follows the hand target. Their results come in by update().
//
// All members are for the window's thread. Nothing here blocks for longer than a few milliseconds
// but for laying corrections over the clip.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/background.h"
#include "app/editor/recovery.h"
#include "app/editor/scene_work.h"
#include "app/editor/target_work.h"
#include "core/collision/surface_picker.h"
#include "core/editing/history.h"
#include "core/editing/surface_target.h"
#include "ui/commands.h"
#include "ui/editor_state.h"

namespace elbowroom {

class Editor {
 public:
  // `wake` is called from other threads when update() has something to take in. Unsaved work is
  // kept in `recovery` and beside projects (app/editor/recovery.h); nowhere if it is empty.
  explicit Editor(std::function<void()> wake = {}, std::filesystem::path recovery = {});
  ~Editor();
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  // How things stand; good until the next call that is not const.
  const EditorState& state() const { return state_; }
  ViewState& view() { return view_; }
  const ViewState& view() const { return view_; }

  void handle(const Command& command);
  void handle(const Commands& commands) {
    for (const Command& command : commands) handle(command);
  }

  // Asks about unsaved work of a session that did not end well, if there is some.
  void offer_lost_work();

  // Opens a document that is not in a file (the command line's scene, the demo).
  void open(Document document, std::filesystem::path project = {});

  // Takes in what has been computed and moves time while playing; `now` in seconds of any steady
  // clock. True if something to be seen has changed.
  bool update(double now);

  // True while the picture changes by itself.
  bool moving() const { return state_.playing; }
  bool working() const;
  // When update() has something to do without an event; none: nothing.
  std::optional<double> wakes_at() const;
  // Another number whenever something that a picture shows may have changed.
  std::uint64_t picture_version() const { return state_.picture_version; }
  // A quit that has been asked for, and agreed to if something is unsaved.
  bool quitting() const { return quitting_; }

  // Where the world stands at the state's time with the document's motion (or a clip instead).
  const World* world() const;
  void states_at(const std::shared_ptr<const Clip>& clip, double t,
                 std::vector<ActorState>& states) const;

  void tell(Notice::Kind kind, Error text);
  std::vector<std::string>& recent_files() { return state_.recent_files; }

 private:
  // editor.cpp
  std::function<void(std::string)> job_failure();
  void refresh();       // state_ from the document
  void refresh_time();  // what of state_ depends on time
  void document_changed();
  void set_time(double t);
  void edit(const std::string& name, Phase phase, const History::Edit& change);
  // Plans what is shown anew where its settings are others now and that takes but a moment.
  void replan_at_once(Phase phase);
  PlanningWishes wishes() const;
  void refresh_swings();
  int limb_index(const std::string& name) const;

  // editor_commands.cpp
  void select_limb(int limb);
  void select_problem(int limb, int window);
  void go_to_problem(int direction);
  void choose_preset(SamplingPreset preset);

  // editor_files.cpp
  void open_files(const std::vector<std::filesystem::path>& paths, bool as_objects);
  void open_demo();
  Document coming_document() const;
  enum class Why {
    fresh,   // another document
    change,  // a change of the scene of the one that is open
    follow,  // undo or redo has changed its scene
  };
  void read_files(Document document, std::filesystem::path project, Why why);
  void opened(Session session, std::filesystem::path project, bool fresh);
  void take_session(Session session);
  void show_anew();
  void scene_changed();
  void attach_object(const std::filesystem::path& file, const std::string& joint);
  void remove_object(const std::filesystem::path& file);
  void choose_clip(const std::string& name);
  void save(const std::filesystem::path& path);
  void export_to(const std::filesystem::path& path);
  void remember(const std::filesystem::path& path);

  // editor_limbs.cpp
  void set_swing_limit(const command::SetSwingLimit& wanted);
  void set_limb_joints(const command::SetLimbJoints& wanted);
  void refit();
  void refitted(Session session);

  // editor_recovery.cpp
  void keep_unsaved_work();
  void offer(LostWork lost);
  void answer_recovery(command::AnswerRecovery::Answer answer);
  void recover(const LostWork& lost);

  // editor_plan.cpp
  void set_window(const command::SetWindow& wanted);
  std::optional<Interval> within_clip(Interval window) const;
  void prepare_contacts();
  void rescan(const Interval& changed);
  void look_for_contacts();
  void plan();
  void start_plan(int limb, Task task);
  void cancel_plan();
  void accept();
  void replan(int correction);
  void keep_replanned();

  // editor_target.cpp
  void target_changed();
  void click(const command::Click& click);
  HandTarget target_on(const SurfacePoint& point, const LimbModel& limb,
                       const ActorState& figure) const;
  void target_from_posture();
  void keep_orientation(bool keep);

  struct Running {
    std::stop_source stop{std::nostopstate};
    std::uint64_t ticket = 0;  // of the newest job; older results are passed over
    double began = 0;
  };
  void begin_job(Running& running, JobState& job, const std::string& what);

  EditorState state_;
  ViewState view_;
  History history_;
  std::filesystem::path project_;
  std::shared_ptr<const Session> session_;
  std::vector<Correction> shown_corrections_;
  // Where the document's motion differs from what `strip` has been made of.
  std::optional<Interval> unseen_;
  std::uint64_t refreshed_revision_ = 0;
  std::optional<HandTarget> shown_target_;
  std::string shown_limb_;
  std::shared_ptr<const Clip> shown_clip_;
  // What `state_.swings` has been made of.
  std::shared_ptr<const Session> swings_session_;
  int swings_limb_ = -1;
  double now_ = 0, played_at_ = -1;
  int next_notice_ = 1;
  std::uint64_t next_ticket_ = 1;
  bool quitting_ = false;
  bool changed_ = true;
  bool letter_shows_ = true;  // what a letter has changed is to be seen in the picture
  SurfacePicker picker_;

  // Another document that waits for an answer about unsaved work.
  std::function<void()> pending_opening_;
  std::filesystem::path recovery_folder_;
  std::optional<LostWork> lost_;         // that is asked about
  std::optional<LostWork> coming_lost_;  // to be asked about when its project is open
  std::optional<LostWork> recovering_;   // whose scene is being read
  std::string replan_step_;              // the step that took a correction away to plan it anew
  std::optional<Correction> replanned_;  // that correction
  std::optional<SceneDescription> coming_scene_;  // of the files being read

  Running opening_, scanning_, planning_, exporting_, targeting_;
  std::shared_ptr<Mailbox> mailbox_;
  std::shared_ptr<SceneWork> scene_work_;
  std::shared_ptr<TargetWork> target_work_;
  Recovery recovery_;
  // Threads last: they end first.
  BackgroundThread files_thread_, scene_thread_, target_thread_;
};

}  // namespace elbowroom
