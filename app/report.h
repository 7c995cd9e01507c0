// SPDX-License-Identifier: MIT
// The report of a command, as JSON (DESIGN.md, "Report JSON"): seconds, radians, scene units;
// computing times in milliseconds.
#pragma once

#include <filesystem>
#include <string>

#include "app/outputs.h"
#include "core/base/result.h"
#include "core/editing/correct.h"
#include "core/editing/session.h"

namespace elbowroom {

// status: "corrected", "nothing_to_correct", "failed", "interrupted".
std::string correction_report(const std::string& status, const Session& session,
                              const SceneCollision& scene, const CorrectionOutcome& outcome,
                              const Outputs& outputs);

// status: "free", "contacts".
std::string check_report(const std::string& status, const Session& session,
                         const SceneCollision& scene, const std::vector<ContactInterval>& contacts,
                         const std::vector<ContactInterval>& others);

// What a command that looks at the source clip has to say of a project with corrections over it.
std::vector<std::string> not_looked_at(const Session& session);

// Of a run that came to nothing: every member is there, the clip is null, lists are empty.
std::string empty_report(const std::string& status);
// The same with the error; status "bad_input".
std::string error_report(const Error& error);

// Writes the report whole or not at all; `path` empty: does nothing.
Status write_report(const std::filesystem::path& path, const std::string& text);

}  // namespace elbowroom
