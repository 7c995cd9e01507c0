// SPDX-License-Identifier: MIT
#include "app/editor/editor.h"

#include <algorithm>
#include <cmath>

#include "core/anatomy/limb_clip.h"
#include "core/editing/motion.h"

namespace elbowroom {
namespace {

constexpr std::size_t kMostNotices = 20;

}  // namespace

Editor::Editor(std::function<void()> wake, std::filesystem::path recovery)
    : recovery_folder_(std::move(recovery)),
      mailbox_(std::make_shared<Mailbox>(std::move(wake))),
      scene_work_(std::make_shared<SceneWork>()),
      target_work_(std::make_shared<TargetWork>()),
      recovery_(recovery_folder_,
                [this, mailbox = mailbox_](Error error) {
                  mailbox->post([this, error = std::move(error)] {
                    tell(Notice::Kind::warning,
                         {"unsaved work can't be kept for recovery: " + error.what, error.where,
                          "save often"});
                  });
                }),
      files_thread_(job_failure()),
      scene_thread_(job_failure()),
      target_thread_(job_failure()) {
  refresh();
}

// What becomes of a job that has thrown: nothing of it is waited for any more.
std::function<void(std::string)> Editor::job_failure() {
  return [this, mailbox = mailbox_](const std::string& what) {
    mailbox->post([this, what] {
      for (JobState* job : {&state_.opening, &state_.scanning, &state_.planning, &state_.exporting})
        job->active = false;
      tell(Notice::Kind::error, {"a computation in the background has failed: " + what, "",
                                 "save the project, then try again"});
    });
  };
}

Editor::~Editor() {
  for (Running* running : {&opening_, &scanning_, &planning_, &exporting_, &targeting_})
    running->stop.request_stop();
  target_work_->abandon();
}

bool Editor::working() const {
  return state_.opening.active || state_.scanning.active || state_.planning.active ||
         state_.exporting.active;
}

void Editor::begin_job(Running& running, JobState& job, const std::string& what) {
  running.stop.request_stop();
  running.ticket = next_ticket_++;
  running.began = now_;
  job = {true, what, -1, 0};
  changed_ = true;
}

void Editor::tell(Notice::Kind kind, Error text) {
  std::erase_if(state_.notices,
                [&](const Notice& old) { return old.text.message() == text.message(); });
  state_.notices.push_back({next_notice_++, kind, std::move(text)});
  if (state_.notices.size() > kMostNotices) state_.notices.erase(state_.notices.begin());
  changed_ = true;
}

const World* Editor::world() const { return session_ ? &session_->scene.world : nullptr; }

void Editor::states_at(const std::shared_ptr<const Clip>& clip, double t,
                       std::vector<ActorState>& states) const {
  if (!session_) {
    states.clear();
    return;
  }
  World world = session_->scene.world;
  world.actors.front().clip = clip;
  world_state_at(world, t, states);
}

int Editor::limb_index(const std::string& name) const {
  if (!session_) return -1;
  for (std::size_t i = 0; i < session_->limbs.size(); ++i)
    if (session_->limbs[i].limb.name == name) return static_cast<int>(i);
  return -1;
}

PlanningWishes Editor::wishes() const {
  const auto& draft = history_.document().draft;
  const auto found = draft.wishes.find(draft.limb);
  return found == draft.wishes.end() ? PlanningWishes{} : found->second;
}

void Editor::edit(const std::string& name, Phase phase, const History::Edit& change) {
  switch (phase) {
    case Phase::begin:
    case Phase::changing:
      history_.preview(name, change);
      break;
    case Phase::committed:
      if (history_.previewing()) history_.preview(name, change);
      if (history_.previewing())
        history_.commit();
      else
        history_.apply(name, change);
      break;
    case Phase::cancelled:
      history_.cancel();
      break;
  }
  document_changed();
}

void Editor::document_changed() {
  if (refreshed_revision_ == history_.revision()) return;
  refreshed_revision_ = history_.revision();
  refresh();
  changed_ = true;
}

void Editor::refresh() {
  const Document& document = history_.document();
  state_.document = &document;
  state_.revision = history_.revision();
  state_.session = session_.get();
  state_.dirty = session_ && history_.dirty();
  state_.undo_name = history_.undo_name();
  state_.redo_name = history_.redo_name();
  state_.has_project = !project_.empty();
  state_.name = !session_          ? ""
                : project_.empty() ? document.scene.character.stem().string()
                                   : project_.filename().string();
  state_.limb = limb_index(document.draft.limb);
  if (session_ && state_.source) {
    if (shown_corrections_ != document.corrections || !state_.clip) {
      const auto changed = changed_between(shown_corrections_, document.corrections);
      // Those of other clips are kept, but lie over nothing here.
      std::vector<Correction> own;
      std::vector<std::size_t> places;
      for (std::size_t i = 0; i < document.corrections.size(); ++i)
        if (session_->is_of_clip(document.corrections[i].clip)) {
          own.push_back(document.corrections[i]);
          places.push_back(i);
        }
      Motion motion = motion_of(session_->scene.model().skeleton, state_.source, own);
      // Another name is no other motion: what is known of it stays known.
      if (state_.clip && !changed) motion.clip = state_.clip;
      shown_corrections_ = document.corrections;
      if (state_.clip != motion.clip) state_.strip_is_current = false;
      state_.clip = motion.clip;
      state_.corrections.assign(document.corrections.size(), {false, true, ""});
      for (std::size_t i = 0; i < own.size(); ++i) {
        const auto& problem = motion.problems[i];
        state_.corrections[places[i]] = {true, !problem, problem ? problem->message() : ""};
      }
      if (changed) {
        // What is planned on another motion is none of this one.
        state_.candidate.reset();
        cancel_plan();
        rescan(*changed);
      }
    }
    state_.selected_correction =
        std::min(state_.selected_correction, static_cast<int>(document.corrections.size()) - 1);
    if (state_.selected_correction >= 0 &&
        !state_.corrections[static_cast<std::size_t>(state_.selected_correction)].of_this_clip)
      state_.selected_correction = -1;
  }
  if (shown_target_ != document.draft.target || shown_limb_ != document.draft.limb ||
      shown_clip_ != state_.clip) {
    if (shown_limb_ != document.draft.limb) state_.failure.reset();
    shown_target_ = document.draft.target;
    shown_limb_ = document.draft.limb;
    shown_clip_ = state_.clip;
    target_changed();
  }
  refresh_time();
}

// The swings' maps: what they show of limb and clip is made when one of these is another.
void Editor::refresh_swings() {
  if (swings_session_ != session_ || swings_limb_ != state_.limb) {
    swings_session_ = session_;
    swings_limb_ = state_.limb;
    state_.swings.clear();
    if (session_ && state_.limb >= 0) state_.swings = swing_views(*session_, state_.limb);
  }
  const Document& document = history_.document();
  const auto set = document.swing_limits.find(document.draft.limb);
  for (SwingView& view : state_.swings) {
    view.polygon.clear();
    if (set != document.swing_limits.end())
      view.polygon = set->second[static_cast<std::size_t>(view.role)];
    const auto first = static_cast<std::size_t>(view.first_dof);
    if (first + 1 >= state_.dofs.size()) continue;
    const DofView &a = state_.dofs[first], &b = state_.dofs[first + 1];
    view.value = {a.value, b.value};
    view.clip_value = {a.clip_value, b.clip_value};
    view.sample_first = {a.sample_lower, a.sample_upper};
    view.sample_second = {b.sample_lower, b.sample_upper};
  }
}

void Editor::refresh_time() {
  state_.dofs.clear();
  const LimbModel* limb = state_.limb_model();
  if (!limb || !state_.clip) {
    refresh_swings();
    return;
  }
  const Model& model = session_->scene.model();
  const PlanningWishes own = wishes();
  const Clip& shown = state_.candidate ? *state_.candidate->clip : *state_.clip;
  const LimbState now = limb_state_at(*limb, model, shown, state_.time);
  const LimbState in_clip = limb_state_at(*limb, model, *state_.source, state_.time);
  for (int d = 0; d < limb->dof_count(); ++d) {
    const Dof& dof = limb->space.dofs[static_cast<std::size_t>(d)];
    DofView view;
    view.name = dof.name;
    view.lower = dof.lower;
    view.upper = dof.upper;
    view.default_lower = view.sample_lower = dof.sample_lower;
    view.default_upper = view.sample_upper = dof.sample_upper;
    if (const auto wish = own.sampling.find(dof.name); wish != own.sampling.end()) {
      view.sample_lower = wish->second.lower;
      view.sample_upper = wish->second.upper;
      view.custom = true;
    }
    view.value = now.q[d];
    view.clip_value = in_clip.q[d];
    state_.dofs.push_back(view);
  }
  refresh_swings();
}

void Editor::set_time(double t) {
  if (!state_.source || !std::isfinite(t)) return;
  t = std::clamp(t, state_.begin, state_.end);
  if (t == state_.time) return;
  state_.time = t;
  ++state_.picture_version;
  refresh_time();
  changed_ = true;
}

bool Editor::update(double now) {
  now_ = now;
  for (const auto& letter : mailbox_->collect()) {
    letter_shows_ = true;
    letter();
    changed_ = true;
    if (letter_shows_) ++state_.picture_version;
  }
  if (state_.playing) {
    if (played_at_ >= 0) {
      double t = state_.time + (now - played_at_) * state_.speed;
      const double length = state_.end - state_.begin;
      if (t > state_.end) {
        if (state_.loop && length > 0)
          t = state_.begin + std::fmod(t - state_.begin, length);
        else
          t = state_.end, state_.playing = false;
      }
      set_time(t);
    }
    played_at_ = now;
  }
  for (auto [job, running] :
       {std::pair(&state_.opening, &opening_), std::pair(&state_.scanning, &scanning_),
        std::pair(&state_.planning, &planning_), std::pair(&state_.exporting, &exporting_)})
    if (job->active) job->seconds = now - running->began;
  keep_unsaved_work();
  return std::exchange(changed_, false);
}

}  // namespace elbowroom
