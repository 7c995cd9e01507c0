// SPDX-License-Identifier: MIT
// The two steps of an export on text and bytes alone: change of container, and appending an
// animation. gltf_writer.h has the promises and deals with files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/gltf_container.h"
#include "core/io/gltf_writer.h"

namespace elbowroom::gltf_export {

// A file of its own that the JSON names.
struct SideFile {
  std::string name;  // plain, beside the output
  std::string bytes;
};

// An export under way.
struct Draft {
  Container container;            // `binary` says what the output is to be
  std::filesystem::path file;     // the source, for messages
  std::string free_name;          // a file name that a new buffer may have, if it needs a file
  bool bin_is_side_file = false;  // a .gltf whose first buffer's bytes are container.bin, to be
                                  // written as `free_name`
  std::vector<SideFile> side_files;
  std::vector<std::string> warnings;
};

// Source in memory -> GLB that stands alone, or text whose first buffer is a side file. Does
// nothing if the container is of that kind.
Status change_container(Draft& draft, bool to_binary);

// Appends the animations; draft.container.json and .bin (or a side file) grow.
Status append_animations(Draft& draft, const std::vector<CorrectedClip>& clips,
                         std::vector<ExportedAnimation>& appended);

}  // namespace elbowroom::gltf_export
