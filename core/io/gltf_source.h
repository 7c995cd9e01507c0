// SPDX-License-Identifier: MIT
// The bytes of a glTF file and of what it refers to, and nothing else on the disk. Used inside the
// reader only: these functions refuse by throwing Refusal, which read_gltf turns into its Error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/io/gltf_reader.h"

namespace elbowroom::gltf {

using Bytes = std::vector<std::uint8_t>;

struct Refusal {
  Error error;
};
// The remedy for most damage.
inline const char* const kExportAgain =
    "the file is damaged or was written by a faulty exporter; export it again";
[[noreturn]] void refuse(std::string where, std::string what, std::string remedy);

// At most `most` bytes of a text for a message, cut between characters of UTF-8.
std::string excerpt(const std::string& text, std::size_t most);
std::string quoted(const std::string& text);

// Opens files in one folder, within a budget of bytes.
class Folder {
 public:
  // `file` is the glTF file itself.
  Folder(const std::filesystem::path& file, const ReadOptions& options);

  // The glTF file. Refuses what is no regular file or exceeds the budget.
  Bytes read_main();
  // At most `most` bytes of the file a relative URI names. Refuses absolute paths, schemes, and
  // whatever leaves the folder by `..`, percent encoding or a symbolic link. `where` is what refers
  // to it, for the error.
  Bytes read_uri(const std::string& uri, std::uint64_t most, const std::string& where);

  std::string file_name() const { return file_.filename().string(); }

 private:
  // Where that file's bytes stand meanwhile; empty: in the file itself.
  std::filesystem::path staged(const std::filesystem::path& path) const;
  Bytes read(const std::filesystem::path& path, std::uint64_t most, const std::string& where);

  std::filesystem::path file_, folder_;
  const ReadOptions& options_;
  std::uint64_t budget_;
};

// The payload of a data URI, at most `most` bytes of it. Refuses what is not valid base64 or
// percent encoding.
Bytes decode_data_uri(std::string_view uri, std::uint64_t most, const std::string& where);
inline bool is_data_uri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

// The two parts of a file, views into its bytes. `binary` is empty for a .gltf or a GLB without
// BIN.
struct Container {
  std::string_view json;
  std::span<const std::uint8_t> binary;
  bool has_binary = false;
  std::vector<std::string> warnings;
};
Container split_container(const Bytes& bytes, const std::string& where);

}  // namespace elbowroom::gltf
