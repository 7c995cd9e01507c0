// SPDX-License-Identifier: MIT
// Contacts and plans: what the scene's thread is asked, and what becomes of its answers.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "app/editor/editor.h"

namespace elbowroom {
namespace {

constexpr const char* kPreparing = "Looking at the scene";

std::string with_window(const std::string& what, const Interval& window) {
  char text[160];
  std::snprintf(text, sizeof text, "%s %.2f–%.2f s", what.c_str(), window.lower, window.upper);
  return text;
}

// A name that no task of the document has yet.
std::string unique_name(const Document& document, const std::string& wanted) {
  std::set<std::string> taken;
  for (const Task& task : document.tasks) taken.insert(task.name);
  std::string name = wanted;
  for (int n = 2; taken.contains(name); ++n) name = wanted + " (" + std::to_string(n) + ")";
  return name;
}

}  // namespace

void Editor::prepare_contacts() {
  if (!session_ || !state_.source || session_->limbs.empty()) return;
  begin_job(scanning_, state_.scanning, kPreparing);
  scanning_.stop =
      scene_thread_.run([this, session = session_, work = scene_work_, ticket = scanning_.ticket,
                         mailbox = mailbox_](const std::stop_token& stop) {
        if (stop.stop_requested()) return;
        Status prepared = work->prepare(session, stop);
        if (stop.stop_requested()) return;
        mailbox->post([this, ticket, prepared] {
          if (ticket != scanning_.ticket) return;
          state_.scanning.active = false;
          if (!prepared)
            tell(Notice::Kind::error, prepared.error());
          else if (!state_.source_strip || !state_.source_strip->complete() || !state_.strip ||
                   !state_.strip->complete() || !state_.strip_is_current)
            look_for_contacts();
        });
      });
}

void Editor::rescan(const Interval& changed) {
  if (!unseen_) unseen_ = changed;
  unseen_->lower = std::min(unseen_->lower, changed.lower);
  unseen_->upper = std::max(unseen_->upper, changed.upper);
  // While the scene is made ready, its first look is to come and sees this too.
  if (state_.scanning.active && state_.scanning.what == kPreparing) return;
  look_for_contacts();
}

// The strip of the document's motion, anew or only where it has changed since the last one.
void Editor::look_for_contacts() {
  if (!session_ || !state_.clip || session_->limbs.empty()) return;
  auto changed = unseen_;
  if (!state_.source_strip || !state_.strip || !state_.strip->complete()) changed.reset();
  begin_job(scanning_, state_.scanning, "Looking for contacts");
  scanning_.stop = scene_thread_.run([this, work = scene_work_, source = state_.source,
                                      clip = state_.clip, known_source = state_.source_strip,
                                      known = state_.strip, changed, ticket = scanning_.ticket,
                                      mailbox = mailbox_](const std::stop_token& stop) {
    if (stop.stop_requested()) return;
    if (!work->ready()) {
      mailbox->post([this, ticket] {
        if (ticket == scanning_.ticket) state_.scanning.active = false;
      });
      return;
    }
    const auto tell_strip = [&](bool of_source, bool of_clip, CollisionStrip strip) {
      mailbox->post([this, ticket, of_source, of_clip, clip,
                     shared = std::make_shared<const CollisionStrip>(std::move(strip))] {
        if (ticket != scanning_.ticket) return;
        if (of_source) state_.source_strip = shared;
        if (of_clip) {
          state_.strip = shared;
          state_.strip_is_current = clip == state_.clip;
        }
        const double length = shared->end - shared->begin;
        state_.scanning.fraction = length > 0 ? (shared->computed_to - shared->begin) / length : 1;
        if (of_clip && shared->complete()) {
          state_.scanning.active = false;
          unseen_.reset();
        }
      });
    };
    const bool same = source == clip;
    auto source_strip = known_source;
    if (!source_strip || !source_strip->complete()) {
      auto strip = work->look(source, stop, [&](const CollisionStrip& grown) {
        if (!grown.complete()) tell_strip(true, same, grown);
      });
      if (stop.stop_requested()) return;
      source_strip = std::make_shared<const CollisionStrip>(strip);
      tell_strip(true, same, std::move(strip));
    }
    if (same) {
      if (known_source && known_source->complete()) tell_strip(false, true, *source_strip);
      return;
    }
    // Where no strip of the document's motion is known, what the source's says outside the
    // corrections is as true of it.
    CollisionStrip strip =
        known && known->complete() && changed
            ? work->look_again(clip, *known, changed->lower, changed->upper, stop)
            : work->look(clip, stop, {});
    if (!stop.stop_requested()) tell_strip(false, true, std::move(strip));
  });
}

// The window put right: two frames long at least, inside the clip, its ends float32 as keys are.
// None for what is no window, and for a clip too short to have one.
std::optional<Interval> Editor::within_clip(Interval window) const {
  if (!std::isfinite(window.lower) || !std::isfinite(window.upper)) return std::nullopt;
  if (window.lower > window.upper) std::swap(window.lower, window.upper);
  const double least = std::min(2 / state_.frame_rate, state_.end - state_.begin);
  window.lower = std::max(state_.begin, std::min(window.lower, state_.end - least));
  window.upper = std::min(state_.end, std::max(window.upper, window.lower + least));
  window.lower = static_cast<double>(static_cast<float>(window.lower));
  window.upper = static_cast<double>(static_cast<float>(window.upper));
  if (!(window.lower < window.upper)) return std::nullopt;
  return window;
}

void Editor::set_window(const command::SetWindow& wanted) {
  const int limb = wanted.limb < 0 ? state_.limb : wanted.limb;
  if (!state_.source || limb < 0 || limb >= static_cast<int>(session_->limbs.size())) return;
  std::optional<Interval> window;
  if (wanted.window) {
    window = within_clip(*wanted.window);
    if (!window) return;
  }
  edit(window ? "Set window" : "Clear window", wanted.phase,
       [&, name = session_->limbs[static_cast<std::size_t>(limb)].limb.name](Document& document) {
         if (document.draft.limb != name) document.draft.target.reset();
         document.draft.limb = name;
         document.draft.window = window;
       });
}

void Editor::plan() {
  if (!session_ || !state_.clip) return;
  history_.commit();
  document_changed();
  if (state_.limb < 0) {
    go_to_problem(1);
    if (state_.limb < 0) {
      tell(Notice::Kind::warning,
           {"no limb is chosen", "", "click one on the body, or a red mark in the timeline"});
      return;
    }
  }
  Draft draft = history_.document().draft;
  // It may have been chosen on a longer clip.
  if (draft.window) draft.window = within_clip(*draft.window);
  Task task;
  task.clip = session_->clip_id();
  task.limb = draft.limb;
  task.wishes = wishes();
  if (draft.target) {
    task.kind = TaskKind::reach;
    task.target = draft.target;
    task.window = draft.window;
    if (task.window &&
        !(task.window->lower < draft.target->time && draft.target->time < task.window->upper))
      task.window.reset();
    char text[96];
    std::snprintf(text, sizeof text, "%s reach at %.2f s", limb_title(draft.limb).c_str(),
                  draft.target->time);
    task.name = text;
  } else {
    if (!draft.window) {
      const auto& strip = state_.strip;
      const auto limb = static_cast<std::size_t>(state_.limb);
      if (!strip || strip->limbs[limb].windows.empty()) {
        tell(Notice::Kind::warning,
             {limb_title(draft.limb) + " has no window to plan", "",
              "it collides nowhere; drag on its row in the timeline to choose a window all the "
              "same"});
        return;
      }
      select_problem(state_.limb, 0);
      draft.window = history_.document().draft.window;
    }
    task.window = draft.window;
    task.even_if_free = true;  // it was asked for by hand
    task.name = with_window(limb_title(task.limb), *task.window);
  }
  start_plan(state_.limb, std::move(task));
}

void Editor::replan_at_once(Phase phase) {
  constexpr double kMoment = 2000;  // ms
  if (phase != Phase::committed || state_.planning.active || !made_otherwise(state_)) return;
  const Candidate& shown = *state_.candidate;
  if (shown.task.limb == history_.document().draft.limb && shown.report.total_ms < kMoment) plan();
}

void Editor::start_plan(int limb, Task task) {
  task.name = unique_name(history_.document(), task.name);
  state_.failure.reset();
  state_.candidate.reset();
  refresh_time();
  // A scan that is under way waits: the plan is what somebody is looking at.
  const bool scan_again = state_.scanning.active && state_.scanning.what == "Looking for contacts";
  if (scan_again) scanning_.stop.request_stop();
  begin_job(planning_, state_.planning, "Planning " + limb_title(task.limb));
  planning_.stop = scene_thread_.run([this, work = scene_work_, clip = state_.clip, limb, task,
                                      ticket = planning_.ticket,
                                      mailbox = mailbox_](const std::stop_token& stop) {
    if (stop.stop_requested()) return;
    if (!work->ready()) {
      mailbox->post([this, ticket] {
        if (ticket != planning_.ticket) return;
        state_.planning.active = false;
        tell(Notice::Kind::error, {"the scene's contacts are not known, so nothing can be planned",
                                   "", "the messages before this one say why"});
      });
      return;
    }
    const auto progress = [&](const Progress& p) {
      mailbox->post([this, ticket, p, task_limb = task.limb] {
        letter_shows_ = false;
        if (ticket != planning_.ticket) return;
        state_.planning.fraction = p.fraction;
        state_.planning.what = limb_title(task_limb) + ": " + p.phase;
      });
    };
    auto outcome = work->plan(clip, limb, task, stop, progress);
    mailbox->post([this, ticket, clip, outcome = std::move(outcome)] {
      if (ticket != planning_.ticket) return;
      state_.planning.active = false;
      if (clip != state_.clip) return;
      state_.ways = outcome.ways;
      state_.way = 0;
      state_.candidate.reset();
      if (!state_.ways.empty()) state_.candidate = state_.ways.front();
      state_.failure = outcome.failure;
      if (!state_.candidate) {
        keep_replanned();
        state_.failure = outcome.failure;
      }
      if (outcome.error) tell(Notice::Kind::error, *outcome.error);
      refresh_time();
    });
  });
  if (scan_again) look_for_contacts();
}

void Editor::cancel_plan() {
  planning_.stop.request_stop();
  planning_.ticket = next_ticket_++;
  state_.planning.active = false;
  keep_replanned();
}

// A correction that was to be planned anew and has no better motion stays what it was.
void Editor::keep_replanned() {
  if (replan_step_.empty()) return;
  if (history_.undo_name() == replan_step_) {
    history_.undo();
    document_changed();
  }
  replan_step_.clear();
  replanned_.reset();
}

void Editor::accept() {
  if (!state_.candidate) return;
  replan_step_.clear();
  const Candidate candidate = *state_.candidate;
  // A name that somebody gave outlives the motion.
  const auto replanned = std::exchange(replanned_, std::nullopt);
  const bool named =
      replanned && replanned->limb == candidate.task.limb && replanned->name != replanned->task;
  edit("Accept " + candidate.task.name, Phase::committed, [&](Document& document) {
    document.tasks.push_back(candidate.task);
    Correction correction = candidate.correction;
    correction.name = named ? replanned->name : candidate.task.name;
    correction.task = candidate.task.name;
    correction.clip = candidate.task.clip;
    document.corrections.push_back(std::move(correction));
    // What has been done is no draft any more; what is prepared for another limb stays.
    if (document.draft.limb == candidate.task.limb) {
      document.draft.window.reset();
      document.draft.target.reset();
    }
  });
  state_.candidate.reset();
  state_.selected_correction = static_cast<int>(history_.document().corrections.size()) - 1;
  refresh_time();
}

// The correction's task goes back to where it can be planned anew: its limb, window and wishes are
// chosen, and it is taken away.
void Editor::replan(int index) {
  const Document& document = history_.document();
  if (index < 0 || index >= static_cast<int>(document.corrections.size())) return;
  const Correction correction = document.corrections[static_cast<std::size_t>(index)];
  if (limb_index(correction.limb) < 0 || !session_->is_of_clip(correction.clip)) return;
  std::optional<HandTarget> target;
  PlanningWishes wishes = correction.made_with;
  for (const Task& task : document.tasks)
    if (task.name == correction.task && !correction.task.empty()) {
      target = task.target;
      wishes = task.wishes;
    }
  const std::string step = "Replan " + correction.name;
  edit(step, Phase::committed, [&](Document& changed) {
    changed.corrections.erase(changed.corrections.begin() + index);
    std::erase_if(changed.tasks, [&](const Task& task) {
      return task.name == correction.task && !correction.task.empty();
    });
    changed.draft.limb = correction.limb;
    changed.draft.window =
        Interval{static_cast<double>(correction.begin), static_cast<double>(correction.end)};
    changed.draft.target = target;
    changed.draft.wishes[correction.limb] = wishes;
  });
  replan_step_ = step;
  replanned_ = correction;
  plan();
}

}  // namespace elbowroom
