// SPDX-License-Identifier: MIT
#include "ui/toolkit/file_listing.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace elbowroom {
namespace {

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool digit(char c) { return c >= '0' && c <= '9'; }

bool fits(const std::filesystem::path& name, const ListingFilter& filter) {
  if (filter.extensions.empty()) return true;
  std::string extension = name.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), small);
  return std::find(filter.extensions.begin(), filter.extensions.end(), extension) !=
         filter.extensions.end();
}

}  // namespace

bool comes_before(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto run = [](std::string_view text, std::size_t& at) {
        while (at + 1 < text.size() && text[at] == '0' && digit(text[at + 1])) ++at;
        const std::size_t begin = at;
        while (at < text.size() && digit(text[at])) ++at;
        return text.substr(begin, at - begin);
      };
      const std::string_view x = run(a, i), y = run(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      continue;
    }
    const auto x = static_cast<unsigned char>(small(a[i])),
               y = static_cast<unsigned char>(small(b[j]));
    if (x != y) return x < y;
    ++i;
    ++j;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // "A" and "a", "01" and "1": some order, always the same
}

Result<std::vector<FileEntry>> list_folder(const std::filesystem::path& folder,
                                           const ListingFilter& filter) {
  std::error_code failed;
  std::filesystem::directory_iterator next(folder, failed);
  if (failed) {
    const bool missing = failed == std::errc::no_such_file_or_directory;
    return Error{missing ? "There is no such folder"
                         : "The folder cannot be read: " + failed.message(),
                 folder.string(), missing ? "Check the path" : "Choose another folder"};
  }
  std::vector<FileEntry> entries;
  for (; next != std::filesystem::directory_iterator() && entries.size() < 50000;
       next.increment(failed)) {
    if (failed) break;
    FileEntry entry;
    entry.name = next->path().filename().string();
    if (entry.name.empty() || (entry.name.front() == '.' && !filter.hidden)) continue;
    std::error_code ignored;
    entry.folder = next->is_directory(ignored);
    if (!entry.folder) {
      if (!next->is_regular_file(ignored) || !fits(next->path(), filter)) continue;
      entry.bytes = next->file_size(ignored);
      if (ignored) entry.bytes = 0;
    }
    entries.push_back(std::move(entry));
  }
  std::sort(entries.begin(), entries.end(), [](const FileEntry& a, const FileEntry& b) {
    return a.folder != b.folder ? a.folder : comes_before(a.name, b.name);
  });
  return entries;
}

std::filesystem::path home_folder() {
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? home : "/";
}

std::filesystem::path path_meant(std::string_view text, const std::filesystem::path& folder) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\n')) text.remove_suffix(1);
  if (text == "~" || text.starts_with("~/")) {
    const std::string_view rest = text.size() > 2 ? text.substr(2) : std::string_view();
    return (home_folder() / rest).lexically_normal();
  }
  const std::filesystem::path path(text);
  return (path.is_absolute() ? path : folder / path).lexically_normal();
}

std::string completed(std::string_view text, const std::filesystem::path& folder,
                      const ListingFilter& filter) {
  const std::size_t slash = text.rfind('/');
  const std::string_view head =
      slash == std::string_view::npos ? std::string_view() : text.substr(0, slash + 1);
  const std::string_view tail = text.substr(head.size());
  ListingFilter wider = filter;
  wider.hidden |= tail.starts_with('.');
  const auto entries = list_folder(head.empty() ? folder : path_meant(head, folder), wider);
  if (!entries) return std::string(text);
  std::string agreed;
  int matches = 0;
  bool is_folder = false;
  for (const FileEntry& entry : *entries) {
    if (!std::string_view(entry.name).starts_with(tail)) continue;
    if (matches++ == 0) {
      agreed = entry.name;
      is_folder = entry.folder;
      continue;
    }
    std::size_t same = 0;
    while (same < std::min(agreed.size(), entry.name.size()) && agreed[same] == entry.name[same]) {
      ++same;
    }
    // Never half a UTF-8 character.
    while (same > 0 && same < agreed.size() &&
           (static_cast<unsigned char>(agreed[same]) & 0xc0u) == 0x80u) {
      --same;
    }
    agreed.resize(same);
  }
  if (matches == 0) return std::string(text);
  if (matches == 1 && is_folder) agreed += '/';
  return std::string(head) + agreed;
}

std::string size_text(std::uintmax_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + " B";
  double size = static_cast<double>(bytes);
  const char* units[] = {"kB", "MB", "GB", "TB"};
  int unit = -1;
  do {
    size /= 1000;
    ++unit;
  } while (size >= 999.5 && unit < 3);
  char text[48];
  std::snprintf(text, sizeof text, size < 9.95 ? "%.1f %s" : "%.0f %s", size, units[unit]);
  return text;
}

}  // namespace elbowroom
