// SPDX-License-Identifier: MIT
// A glTF file as text and bytes, before anybody looks at what it says: the JSON text, and of a GLB
// its chunks. And the URIs by which glTF names other files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace elbowroom::gltf_export {

struct Container {
  bool binary = false;             // GLB
  std::string json;                // the text as it stands in the file, a GLB's without its padding
  std::optional<std::string> bin;  // the BIN chunk with its padding
  std::string other_chunks;        // what follows in a GLB, headers included
};

// Takes a file's bytes apart; GLB by its magic, not by its name. Errors: chunks that don't fit the
// file, a version other than 2, text that is no JSON object.
Result<Container> parse_container(std::string_view bytes, const std::filesystem::path& file);

// The bytes of a file; chunks padded to 4. Error: a GLB of 4 GiB or more.
Result<std::string> write_container(const Container& container, const std::filesystem::path& file);

struct DataUri {
  std::string mime;  // "image/png"; may be empty
  std::string bytes;
};
bool is_data_uri(std::string_view uri);
// nullopt if it is not a well-formed data URI, base64 or percent-encoded.
std::optional<DataUri> decode_data_uri(std::string_view uri);
std::string encode_data_uri(std::string_view mime, std::string_view bytes);

// A path relative to the file: no scheme ("http:", "data:"), no absolute path.
bool is_relative_uri(std::string_view uri);
std::string percent_decoded(std::string_view uri);
// For a file name or relative path; '/' stays.
std::string percent_encoded(std::string_view path);

// The existing file inside `folder` that a relative URI names; nullopt if there is none, or if it
// lies outside of `folder`. Tried percent-decoded, then as it is written.
std::optional<std::filesystem::path> resolve_inside(const std::filesystem::path& folder,
                                                    std::string_view uri);

}  // namespace elbowroom::gltf_export
