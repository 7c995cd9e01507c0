// SPDX-License-Identifier: MIT
// From a correction's outcome to a file on disk that has been read back and compared, the report
// beside it and the exit code. Shared by `correct` and `solve`.
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "core/editing/correct.h"
#include "core/editing/session.h"

namespace elbowroom {

struct DeliveryPlaces {
  std::filesystem::path out;
  std::string report;                // may be empty
  std::filesystem::path per_file{};  // folder for the source's own name; may be empty
};

// Where the way around of that rank goes, 2 being the second best: OUT-2.glb beside OUT.glb.
std::filesystem::path other_way_file(const std::filesystem::path& out, std::size_t rank);

// Writes out and report, prints what was done, and returns the exit code. Nothing but the report is
// written unless every window was corrected (or there was nothing to correct).
int deliver(const Session& session, const SceneCollision& scene, const CorrectionOutcome& outcome,
            const DeliveryPlaces& places);

// An error before there was an outcome: message, report, exit code 2.
int refuse(const Error& error, const std::string& report);

}  // namespace elbowroom
