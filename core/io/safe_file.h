// SPDX-License-Identifier: MIT
// Files that are there whole or not at all: written under a temporary name in the same folder,
// synced, then renamed over the target.
//
// Several files that belong together are all staged (where a full disk shows) and then committed,
// the one that names the others last. A file that exists keeps its permissions; a symbolic link is
// followed; anything but a regular file is refused, so that no device is ever replaced.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace elbowroom {

// A file's bytes. Errors: not there, not a regular file, unreadable, larger than max_bytes.
Result<std::string> read_whole_file(const std::filesystem::path& file,
                                    std::uint64_t max_bytes = std::uint64_t{1} << 32);

// The folder that a file is in; "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

// Where what is written under that name comes to stand: absolute, symbolic links followed, those to
// files that are not there (yet) too.
std::filesystem::path place_written(const std::filesystem::path& file);

// A file written and synced under a temporary name. Removed again unless committed.
class StagedFile {
 public:
  static Result<StagedFile> stage(const std::filesystem::path& target, std::string_view bytes);

  StagedFile(StagedFile&& other) noexcept;
  StagedFile& operator=(StagedFile&& other) noexcept;
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  ~StagedFile();

  // Gives the file its name, over an older one if there is one. Once only.
  Status commit();

  // Under which name it can be read until then, and which one it gets.
  const std::filesystem::path& temporary() const { return temporary_; }
  const std::filesystem::path& target() const { return target_; }

 private:
  StagedFile(std::filesystem::path temporary, std::filesystem::path target);
  std::filesystem::path temporary_, target_;
};

// stage and commit in one.
Status write_file_safely(const std::filesystem::path& target, std::string_view bytes);
// The same bytes under another name; nothing to do if both are one file.
Status copy_file_safely(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace elbowroom
