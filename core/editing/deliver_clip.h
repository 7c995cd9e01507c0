// SPDX-License-Identifier: MIT
// A corrected clip on its way to a file: written, read back and compared, so that what was verified
// is what a player will show.
#pragma once

#include <filesystem>

#include "core/animation/clip.h"
#include "core/io/gltf_writer.h"

namespace elbowroom {

// Writes `out`: the source file and, if `clip` changes something of it, the clip as one animation
// more (else a copy). Errors: those of export_corrected; a file that, read back, does not hold the
// clip bit for bit, which is then removed. May be called on any thread.
Result<ExportReport> deliver_clip(const std::filesystem::path& source, const Clip& clip,
                                  const std::filesystem::path& out);

}  // namespace elbowroom
