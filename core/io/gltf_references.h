// SPDX-License-Identifier: MIT
// The files that a glTF file names: its buffers and images, and whatever else an extension gives a
// "uri".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json_text.h"

namespace elbowroom::gltf_export {

// A relative URI of the document and where its text stands.
struct Reference {
  std::string uri;
  json_text::Span value;
};

// Every member called "uri", wherever an extension may have put it, that names a file. Requires a
// text that a JSON parser has accepted.
std::vector<Reference> relative_references(const std::string& text);

// The existing files, in the glTF file's own folder or below it, that it names. None if it can't be
// read or is no glTF: that is its reader's to tell of. Of a GLB only the JSON is read.
std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& file);

}  // namespace elbowroom::gltf_export
