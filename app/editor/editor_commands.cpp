// SPDX-License-Identifier: MIT
// What each command does; those that are more than an edit have files of their own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <type_traits>

#include "app/editor/editor.h"
#include "core/anatomy/limb_clip.h"

namespace elbowroom {
namespace {

std::string seconds_text(double a, double b) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f–%.2f s", a, b);
  return text;
}

// Commands come from other programs too: what makes no sense is not carried out.
bool usable(const PlanningWishes& wishes) {
  return std::isfinite(wishes.clearance) && wishes.clearance >= 0 &&
         std::isfinite(wishes.max_seconds) && wishes.max_seconds >= 0 &&
         wishes.max_iterations > 0 && wishes.alternatives > 0;
}

bool usable(const HandTarget& target) {
  const auto finite = [](const auto& v, int count) {
    for (int i = 0; i < count; ++i)
      if (!std::isfinite(v[i])) return false;
    return true;
  };
  return std::isfinite(target.time) && finite(target.position, 3) &&
         (!target.orientation || (finite(*target.orientation, 4) &&
                                  std::abs(glm::length(*target.orientation) - 1) < 1e-3));
}

// The limb has that DOF, and the interval holds something within its limits.
bool usable_sampling(const LimbModel* limb, const command::SetSampling& wanted) {
  if (wanted.phase == Phase::cancelled) return true;
  if (!limb) return false;
  for (int d = 0; d < limb->dof_count(); ++d) {
    const Dof& dof = limb->space.dofs[static_cast<std::size_t>(d)];
    if (dof.name != wanted.dof) continue;
    const auto& interval = wanted.interval;
    return !interval || (std::isfinite(interval->lower) && std::isfinite(interval->upper) &&
                         interval->lower <= interval->upper && interval->upper >= dof.lower &&
                         interval->lower <= dof.upper);
  }
  return false;
}

}  // namespace

void Editor::select_limb(int limb) {
  if (!session_ || limb < 0 || limb >= static_cast<int>(session_->limbs.size())) return;
  const std::string name = session_->limbs[static_cast<std::size_t>(limb)].limb.name;
  if (history_.document().draft.limb == name) return;
  edit("Select " + limb_title(name), Phase::committed, [&](Document& document) {
    document.draft.limb = name;
    document.draft.window.reset();
    document.draft.target.reset();
  });
}

void Editor::select_problem(int limb, int window) {
  if (!state_.strip || limb < 0 || limb >= static_cast<int>(state_.strip->limbs.size())) return;
  const auto& windows = state_.strip->limbs[static_cast<std::size_t>(limb)].windows;
  if (window < 0 || window >= static_cast<int>(windows.size())) return;
  const ProposedWindow& problem = windows[static_cast<std::size_t>(window)];
  const std::string name = session_->limbs[static_cast<std::size_t>(limb)].limb.name;
  edit("Choose " + limb_title(name) + " " + seconds_text(problem.begin, problem.end),
       Phase::committed, [&](Document& document) {
         if (document.draft.limb != name) document.draft.target.reset();
         document.draft.limb = name;
         document.draft.window = Interval{problem.begin, problem.end};
       });
  const ContactInterval* deepest = nullptr;
  for (const auto& contact : problem.contacts)
    if (!deepest || contact.deepest.depth > deepest->deepest.depth) deepest = &contact;
  if (deepest) set_time(deepest->time_of_deepest);
}

void Editor::go_to_problem(int direction) {
  if (!state_.strip) return;
  // The next problem's deepest moment after (before) the current time, on any limb; round the end.
  struct Place {
    double t;
    int limb, window;
  };
  std::vector<Place> places;
  for (std::size_t limb = 0; limb < state_.strip->limbs.size(); ++limb) {
    const auto& windows = state_.strip->limbs[limb].windows;
    for (std::size_t w = 0; w < windows.size(); ++w) {
      const ContactInterval* deepest = nullptr;
      for (const auto& contact : windows[w].contacts)
        if (!deepest || contact.deepest.depth > deepest->deepest.depth) deepest = &contact;
      if (deepest)
        places.push_back({deepest->time_of_deepest, static_cast<int>(limb), static_cast<int>(w)});
    }
  }
  if (places.empty()) {
    if (state_.strip->complete())
      tell(Notice::Kind::good, {"No limb collides in this clip", "", ""});
    return;
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.t < b.t; });
  const Place* found = nullptr;
  if (direction > 0) {
    for (const Place& place : places)
      if (!found && place.t > state_.time + 1e-6) found = &place;
    if (!found) found = &places.front();
  } else {
    for (const Place& place : places)
      if (place.t < state_.time - 1e-6) found = &place;
    if (!found) found = &places.back();
  }
  select_problem(found->limb, found->window);
}

void Editor::choose_preset(SamplingPreset preset) {
  const LimbModel* limb = state_.limb_model();
  if (!limb) return;
  const std::string name = limb->limb.name;
  edit("Preset " + preset_title(preset, limb->limb), Phase::committed, [&](Document& document) {
    document.draft.wishes[name].sampling = preset_intervals(*limb, preset);
  });
}

void Editor::handle(const Command& command) {
  std::visit(
      [this](const auto& c) {
        using T = std::decay_t<decltype(c)>;
        namespace cmd = command;
        const Document& document = history_.document();
        const auto has_correction = [&](int index) {
          return index >= 0 && index < static_cast<int>(document.corrections.size());
        };
        const auto title_of = [&](int index) {
          return document.corrections[static_cast<std::size_t>(index)].name;
        };
        if constexpr (std::is_same_v<T, cmd::OpenFiles>) {
          open_files(c.paths, c.as_objects);
        } else if constexpr (std::is_same_v<T, cmd::OpenDemo>) {
          open_demo();
        } else if constexpr (std::is_same_v<T, cmd::AnswerOpening>) {
          const auto pending = std::exchange(pending_opening_, nullptr);
          if (c.open && pending) pending();
        } else if constexpr (std::is_same_v<T, cmd::AnswerRecovery>) {
          answer_recovery(c.answer);
        } else if constexpr (std::is_same_v<T, cmd::SaveProject>) {
          save(c.path);
        } else if constexpr (std::is_same_v<T, cmd::Export>) {
          export_to(c.path);
        } else if constexpr (std::is_same_v<T, cmd::AttachObject>) {
          attach_object(c.file, c.joint);
        } else if constexpr (std::is_same_v<T, cmd::RemoveObject>) {
          remove_object(c.file);
        } else if constexpr (std::is_same_v<T, cmd::ChooseClip>) {
          choose_clip(c.name);
        } else if constexpr (std::is_same_v<T, cmd::Undo>) {
          history_.undo();
          document_changed();
          scene_changed();
        } else if constexpr (std::is_same_v<T, cmd::Redo>) {
          history_.redo();
          document_changed();
          scene_changed();
        } else if constexpr (std::is_same_v<T, cmd::Scrub>) {
          state_.playing = false;
          set_time(c.t);
        } else if constexpr (std::is_same_v<T, cmd::TogglePlay>) {
          if (!state_.source) return;
          state_.playing = !state_.playing;
          played_at_ = -1;
          if (state_.playing && state_.time >= state_.end) set_time(state_.begin);
        } else if constexpr (std::is_same_v<T, cmd::ToggleLoop>) {
          state_.loop = !state_.loop;
        } else if constexpr (std::is_same_v<T, cmd::SetSpeed>) {
          state_.speed = std::clamp(std::isfinite(c.speed) ? c.speed : 1.0, 0.05, 8.0);
        } else if constexpr (std::is_same_v<T, cmd::StepFrames>) {
          state_.playing = false;
          const double frame =
              std::round((state_.time - state_.begin) * state_.frame_rate) + c.frames;
          set_time(state_.begin + frame / state_.frame_rate);
        } else if constexpr (std::is_same_v<T, cmd::GoToEnd>) {
          state_.playing = false;
          set_time(c.last ? state_.end : state_.begin);
        } else if constexpr (std::is_same_v<T, cmd::GoToProblem>) {
          state_.playing = false;
          go_to_problem(c.direction);
        } else if constexpr (std::is_same_v<T, cmd::SelectLimb>) {
          select_limb(c.limb);
        } else if constexpr (std::is_same_v<T, cmd::SelectProblem>) {
          state_.playing = false;
          select_problem(c.limb, c.window);
        } else if constexpr (std::is_same_v<T, cmd::SetWindow>) {
          set_window(c);
        } else if constexpr (std::is_same_v<T, cmd::SetSampling>) {
          const std::string limb = document.draft.limb;
          if (limb.empty() || !usable_sampling(state_.limb_model(), c)) return;
          edit(c.interval ? "Sampling of " + c.dof : "Reset " + c.dof, c.phase,
               [&](Document& changed) {
                 auto& sampling = changed.draft.wishes[limb].sampling;
                 if (c.interval)
                   sampling[c.dof] = *c.interval;
                 else
                   sampling.erase(c.dof);
               });
          replan_at_once(c.phase);
        } else if constexpr (std::is_same_v<T, cmd::ChoosePreset>) {
          choose_preset(c.preset);
        } else if constexpr (std::is_same_v<T, cmd::SetWishes>) {
          const std::string limb = document.draft.limb;
          if (limb.empty() || (c.phase != Phase::cancelled && !usable(c.wishes))) return;
          edit(c.what, c.phase, [&](Document& changed) {
            auto& wishes = changed.draft.wishes[limb];
            auto sampling = std::move(wishes.sampling);
            wishes = c.wishes;
            wishes.sampling = std::move(sampling);
          });
          replan_at_once(c.phase);
        } else if constexpr (std::is_same_v<T, cmd::SetSwingLimit>) {
          set_swing_limit(c);
        } else if constexpr (std::is_same_v<T, cmd::SetLimbJoints>) {
          set_limb_joints(c);
        } else if constexpr (std::is_same_v<T, cmd::Plan>) {
          plan();
        } else if constexpr (std::is_same_v<T, cmd::CancelPlan>) {
          cancel_plan();
        } else if constexpr (std::is_same_v<T, cmd::Accept>) {
          accept();
        } else if constexpr (std::is_same_v<T, cmd::Discard>) {
          state_.candidate.reset();
          state_.failure.reset();
          keep_replanned();
          refresh_time();
        } else if constexpr (std::is_same_v<T, cmd::ShowWay>) {
          const int count = static_cast<int>(state_.ways.size());
          if (!state_.candidate || count == 0) return;
          state_.way = ((c.index % count) + count) % count;
          state_.candidate = state_.ways[static_cast<std::size_t>(state_.way)];
          ++state_.picture_version;
          refresh_time();
        } else if constexpr (std::is_same_v<T, cmd::SelectCorrection>) {
          if (has_correction(c.index)) state_.selected_correction = c.index;
        } else if constexpr (std::is_same_v<T, cmd::MuteCorrection>) {
          if (!has_correction(c.index)) return;
          const auto i = static_cast<std::size_t>(c.index);
          edit((document.corrections[i].muted ? "Unmute " : "Mute ") + title_of(c.index),
               Phase::committed, [i](Document& changed) { changed.corrections[i].muted ^= true; });
        } else if constexpr (std::is_same_v<T, cmd::DeleteCorrection>) {
          if (!has_correction(c.index)) return;
          edit("Delete " + title_of(c.index), Phase::committed, [&](Document& changed) {
            const std::string task = changed.corrections[static_cast<std::size_t>(c.index)].task;
            changed.corrections.erase(changed.corrections.begin() + c.index);
            // A task of which nothing is left is no wish any more.
            const bool left = std::any_of(changed.corrections.begin(), changed.corrections.end(),
                                          [&](const auto& other) { return other.task == task; });
            if (!left && !task.empty())
              std::erase_if(changed.tasks, [&](const Task& t) { return t.name == task; });
          });
        } else if constexpr (std::is_same_v<T, cmd::RenameCorrection>) {
          if (!has_correction(c.index) || c.name.empty()) return;
          edit("Rename to " + c.name, Phase::committed, [&](Document& changed) {
            changed.corrections[static_cast<std::size_t>(c.index)].name = c.name;
          });
        } else if constexpr (std::is_same_v<T, cmd::ReplanCorrection>) {
          replan(c.index);
        } else if constexpr (std::is_same_v<T, cmd::SetTarget>) {
          if (state_.limb < 0 || !state_.source) return;
          auto target = c.target;
          if (c.phase != Phase::cancelled && target) {
            if (!usable(*target)) return;
            target->time = std::clamp(target->time, state_.begin, state_.end);
          }
          edit(c.target ? c.what : "Remove hand target", c.phase,
               [&](Document& changed) { changed.draft.target = target; });
        } else if constexpr (std::is_same_v<T, cmd::TargetFromPosture>) {
          target_from_posture();
        } else if constexpr (std::is_same_v<T, cmd::KeepOrientation>) {
          keep_orientation(c.keep);
        } else if constexpr (std::is_same_v<T, cmd::Click>) {
          click(c);
        } else if constexpr (std::is_same_v<T, cmd::Quit>) {
          if (state_.dirty && !c.discard) {
            view_.dialog = Dialog::discard;
          } else {
            quitting_ = true;
            recovery_.forget();
          }
        }
      },
      command);
  changed_ = true;
  ++state_.picture_version;
}

}  // namespace elbowroom
