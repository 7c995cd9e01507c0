// SPDX-License-Identifier: MIT
// The files that a command has been asked to write, as the options that several commands share.
#pragma once

#include <filesystem>

#include "core/io/run_files.h"

namespace elbowroom {

struct Outputs {
  std::filesystem::path out;
  std::filesystem::path report{};        // may be empty, as the next two
  std::filesystem::path per_file{};      // a folder: the source under its own name
  std::filesystem::path save_project{};  // a project with the task and its corrections
  int ways = 1;                          // OUT-2 to OUT-ways may be written too
};

// Where the way around of that rank goes, 2 being the second best: OUT-2.glb beside OUT.glb.
std::filesystem::path other_way_file(const std::filesystem::path& out, std::size_t rank);
// The source's file in the folder of --per-file.
std::filesystem::path per_file_target(const Outputs& outputs, const std::filesystem::path& source);

// Tells `files` of the outputs. `source`, the character's file, may be empty while it is not known;
// `project` is the one that was opened, if one was: it may be saved over.
void declare_outputs(const Outputs& outputs, const std::filesystem::path& source,
                     const std::filesystem::path& project, RunFiles& files);

}  // namespace elbowroom
