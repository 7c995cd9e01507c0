// SPDX-License-Identifier: MIT
// What a file dialog knows about folders. No drawing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace elbowroom {

struct FileEntry {
  std::string name;  // as the folder has it
  bool folder = false;
  std::uintmax_t bytes = 0;  // of a file
};

struct ListingFilter {
  std::vector<std::string> extensions;  // with the dot, small letters; empty: all files
  bool hidden = false;                  // names that begin with a dot
};

// Folders first, then files, each by name without regard to case, numbers by value. What cannot be
// looked at (a broken link) is left out. At most 50,000 entries. Error: no such folder, no right to
// read it; with what to do.
Result<std::vector<FileEntry>> list_folder(const std::filesystem::path& folder,
                                           const ListingFilter& filter);
bool comes_before(std::string_view a, std::string_view b);

// The path meant by a text: "~" is the home folder, what is relative starts at `folder`.
std::filesystem::path path_meant(std::string_view text, const std::filesystem::path& folder);
std::filesystem::path home_folder();

// The text completed as far as the names there agree; a single folder gets its "/". Unchanged where
// nothing fits.
std::string completed(std::string_view text, const std::filesystem::path& folder,
                      const ListingFilter& filter);

// "840 B", "1.2 MB".
std::string size_text(std::uintmax_t bytes);

}  // namespace elbowroom
