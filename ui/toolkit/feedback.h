// SPDX-License-Identifier: MIT
// What the program says back: progress, errors, questions.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ui/toolkit/ui.h"

namespace elbowroom {

struct ProgressOptions {
  std::string_view right = {};  // "4 s left", "seed 3"
  bool can_cancel = true;
  Tone tone = Tone::accent;
};
// A bar with its label above and a cancel button at the right. `fraction` [0, 1]; without one the
// bar says only that work goes on. True when cancel was pressed.
bool progress(Ui& ui, std::string_view label, std::optional<double> fraction,
              const ProgressOptions& options = {});

// An error in its place: what, where, what to do. True when dismissed.
bool inline_error(Ui& ui, const Error& error, bool can_dismiss = true);
// The same for other news: a warning, a note.
bool inline_note(Ui& ui, Tone tone, std::string_view what, std::string_view more = {},
                 bool can_dismiss = false);

struct Question {
  std::string title;                 // "Save changes to walk.elbow?"
  std::string text;                  // wrapped
  std::vector<std::string> answers;  // the first is the primary one: {"Save", "Discard", "Cancel"}
  int on_escape = -1;                // -1: the last answer
  int dangerous = -1;                // an answer that loses work: drawn as such
};
// A dialog over everything, while `open`. The answer's index once it is given (Enter gives the
// first, Escape `on_escape`); then `open` is false. Call in every frame, from the same id scope.
std::optional<int> ask(Ui& ui, bool& open, const Question& question);

// A dialog with contents of its own:
//   if (begin_dialog(ui, "Keys", open, {560, 420})) { … end_dialog(ui); }
// Escape closes it, if `escape_closes`. `size` in pixels at 100 %, cut to the window's.
bool begin_dialog(Ui& ui, std::string_view title, bool& open, ImVec2 size,
                  bool escape_closes = true);
void end_dialog(Ui& ui);

}  // namespace elbowroom
