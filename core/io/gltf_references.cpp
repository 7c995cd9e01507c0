// SPDX-License-Identifier: MIT
#include "core/io/gltf_references.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/io/gltf_container.h"
#include "core/io/safe_file.h"

namespace elbowroom::gltf_export {
namespace {

namespace fs = std::filesystem;
namespace jt = json_text;

// The JSON of a .gltf or GLB; empty if there is none.
std::string json_of(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return {};
  const std::uintmax_t size = fs::file_size(file, failed);
  std::ifstream in(file, std::ios::binary);
  unsigned char head[20] = {};
  in.read(reinterpret_cast<char*>(head), sizeof head);
  const bool binary = in.gcount() == sizeof head && std::string(head, head + 4) == "glTF";
  if (!binary) {
    auto text = read_whole_file(file);
    return text ? *std::move(text) : std::string();
  }
  const std::uint64_t length = head[12] | std::uint64_t{head[13]} << 8 |
                               std::uint64_t{head[14]} << 16 | std::uint64_t{head[15]} << 24;
  if (failed || length + sizeof head > size) return {};
  std::string text(length, '\0');
  in.read(text.data(), static_cast<std::streamsize>(length));
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return in ? text : std::string();
}

}  // namespace

std::vector<Reference> relative_references(const std::string& text) {
  std::vector<Reference> found;
  for (const jt::Member& member : jt::all_members(text)) {
    if (member.key != "uri" || text[member.value.begin] != '"') continue;
    const auto value = nlohmann::json::parse(jt::view(text, member.value), nullptr, false);
    if (!value.is_string()) continue;
    std::string uri = value.get<std::string>();
    if (is_relative_uri(uri)) found.push_back({std::move(uri), member.value});
  }
  return found;
}

std::vector<fs::path> referenced_files(const fs::path& file) {
  const std::string text = json_of(file);
  if (text.empty() || !jt::is_json(text)) return {};
  std::vector<fs::path> files;
  for (const Reference& reference : relative_references(text)) {
    // Careless exporters write paths as Windows does; the reader forgives it.
    std::string forward = reference.uri;
    std::replace(forward.begin(), forward.end(), '\\', '/');
    for (const std::string& uri : {reference.uri, forward}) {
      const auto named = resolve_inside(file.parent_path(), uri);
      if (!named || std::find(files.begin(), files.end(), *named) != files.end()) continue;
      files.push_back(*named);
    }
  }
  return files;
}

}  // namespace elbowroom::gltf_export
