// SPDX-License-Identifier: MIT
// Unsaved work: kept while it is made, offered after a crash.
#include <chrono>
#include <ctime>
#include <utility>

#include "app/editor/editor.h"

namespace elbowroom {
namespace {

// "26 Nov, 14:32", local time.
std::string time_of_day(std::filesystem::file_time_type when) {
  const auto system = std::chrono::file_clock::to_sys(when);
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(system));
  std::tm local{};
  char text[64] = "";
  if (localtime_r(&seconds, &local)) std::strftime(text, sizeof text, "%e %b, %H:%M", &local);
  return text[0] == ' ' ? text + 1 : text;
}

}  // namespace

void Editor::keep_unsaved_work() {
  if (!session_ || quitting_ || history_.previewing()) return;
  if (history_.dirty())
    recovery_.keep(history_.document(), history_.revision(), project_, now_);
  else
    recovery_.forget();
}

std::optional<double> Editor::wakes_at() const {
  return history_.previewing() ? std::nullopt : recovery_.due();
}

void Editor::offer_lost_work() {
  if (auto lost = lost_in(recovery_folder_)) offer(std::move(*lost));
}

void Editor::offer(LostWork lost) {
  if (recovery_folder_.empty() || lost_ || view_.dialog != Dialog::none) return;
  const std::filesystem::path name =
      lost.project.empty() ? lost.document.scene.character.stem() : lost.project.filename();
  state_.lost = EditorState::Lost{name.string(), time_of_day(lost.when)};
  lost_ = std::move(lost);
  view_.dialog = Dialog::recover;
  changed_ = true;
}

void Editor::answer_recovery(command::AnswerRecovery::Answer answer) {
  using Answer = command::AnswerRecovery::Answer;
  const auto lost = std::exchange(lost_, std::nullopt);
  state_.lost.reset();
  if (!lost || answer == Answer::later) return;
  if (answer == Answer::discard) {
    recovery_.discard(lost->file);
  } else if (session_ && !lost->project.empty() && project_ == lost->project) {
    recover(*lost);
  } else {
    // Its scene as it was opened comes first; what was done in it follows as a step.
    Document scene;
    scene.scene = lost->document.scene;
    scene.limbs = lost->document.limbs;
    recovering_ = lost;
    open(std::move(scene));
  }
}

void Editor::recover(const LostWork& lost) {
  edit("Recover unsaved work", Phase::committed,
       [&](Document& document) { document = lost.document; });
  recovery_.take_over(lost.file);
  scene_changed();
}

}  // namespace elbowroom
