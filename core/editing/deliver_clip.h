// SPDX-License-Identifier: MIT
// A corrected clip on its way to a file: written, read back and compared, so that what was verified
// is what a player will show.
#pragma once

#include <filesystem>

#include "core/animation/clip.h"
#include "core/io/gltf_writer.h"
#include "core/io/run_files.h"

namespace elbowroom {

// Stages `out`: the source file and, if `clip` changes something of it, the clip as one animation
// more (else a copy). It has been read back when this returns, and gets its name with the rest of
// the run's files. Errors: those of stage_corrected; a file that, read back, does not hold the clip
// bit for bit. After an error nothing of the run should be committed. May be called on any thread.
Result<ExportReport> stage_clip(const std::filesystem::path& source, const Clip& clip,
                                const std::filesystem::path& out, RunFiles& run);

// The same as a run of its own, committed.
Result<ExportReport> deliver_clip(const std::filesystem::path& source, const Clip& clip,
                                  const std::filesystem::path& out);

}  // namespace elbowroom
