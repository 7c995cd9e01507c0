// SPDX-License-Identifier: MIT
// How a run ends: files on disk that have been read back and compared, the report beside them, the
// exit code. Shared by the commands.
//
// All files are staged, and get their names only when nothing can fail any more: with an exit code
// other than 0 nothing is written but the report.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/interruption.h"
#include "app/outputs.h"
#include "core/editing/correct.h"
#include "core/editing/session.h"

namespace elbowroom {

// What a run came to.
struct Delivery {
  const Session& session;
  const SceneCollision& scene;
  const CorrectionOutcome& outcome;
  std::shared_ptr<const Clip> start;  // that the outcome's corrections lie over
  const Outputs& outputs;
  // Of --save-project: with the task and its corrections, and where it was opened from.
  const Document& document;
  std::filesystem::path opened_from;
};

// Prints what was done, writes the outputs, and returns the exit code: of a run that was
// interrupted, failed, or is done.
int deliver(const Delivery& delivery, RunFiles& files, Interruption& interruption);

// An error before there was an outcome: message, report, exit code 2; or 130 where the error is
// that the run was interrupted.
int refuse(const Error& error, const std::filesystem::path& report, Interruption& interruption);

// What a run that was interrupted says and writes; its exit code.
int leave_interrupted(const std::filesystem::path& report, const std::string& text);

}  // namespace elbowroom
