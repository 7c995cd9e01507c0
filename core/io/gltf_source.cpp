// SPDX-License-Identifier: MIT
#include "core/io/gltf_source.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace elbowroom::gltf {
namespace fs = std::filesystem;
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// Percent signs that begin no escape stand for themselves: exporters forget to encode them.
std::string percent_decode(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
                        hex_digit(text[i + 2]) >= 0;
    if (!escape) {
      out += text[i];
      continue;
    }
    out += static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
    i += 2;
  }
  return out;
}

// True if `path` is `folder` or lies below it; both canonical.
bool lies_within(const fs::path& path, const fs::path& folder) {
  const auto [in_folder, in_path] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end() || in_folder->empty();
}

std::uint32_t little_endian(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

}  // namespace

void refuse(std::string where, std::string what, std::string remedy) {
  throw Refusal{{std::move(what), std::move(where), std::move(remedy)}};
}

std::string excerpt(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

std::string quoted(const std::string& text) {
  std::string out(1, '"');
  out += text;
  out += '"';
  return out;
}

Folder::Folder(const fs::path& file, const ReadOptions& options)
    : file_(file), options_(options), budget_(options.max_bytes) {
  std::error_code failure;
  const fs::path parent = fs::absolute(file, failure).parent_path();
  folder_ = fs::canonical(parent, failure);
  if (failure) {
    refuse(file.string(), "the folder can't be opened: " + failure.message(), "check the path");
  }
}

fs::path Folder::staged(const fs::path& path) const {
  return options_.staged_at ? options_.staged_at(path) : fs::path();
}

Bytes Folder::read_main() {
  const fs::path path = folder_ / file_.filename(), staged_path = staged(path);
  return read(staged_path.empty() ? path : staged_path, UINT64_MAX, file_.string());
}

Bytes Folder::read_uri(const std::string& uri, std::uint64_t most, const std::string& where) {
  const std::string shown = quoted(excerpt(uri, 80));
  const std::string remedy = "put the file beside the model and refer to it by its name alone";
  // The decoded name is what the URI means; the raw one is what careless exporters mean.
  for (std::string name : {percent_decode(uri), uri}) {
    if (name.empty()) refuse(where, "an empty URI", "name a file");
    if (std::any_of(name.begin(), name.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; })) {
      refuse(where, "a URI with control characters", remedy);
    }
    std::replace(name.begin(), name.end(), '\\', '/');
    if (name.substr(0, name.find('/')).find(':') != std::string::npos) {
      refuse(where,
             "the URI " + shown +
                 " is no relative path; only files in the model's own folder "
                 "are opened",
             remedy);
    }
    const fs::path relative = fs::path(name).lexically_normal();
    if (fs::path(name).is_absolute() || name.front() == '/') {
      refuse(where,
             "the URI " + shown +
                 " is an absolute path; only files in the model's own folder "
                 "are opened",
             remedy);
    }
    if (relative.empty() || *relative.begin() == "..") {
      refuse(where, "the URI " + shown + " leads out of the model's folder", remedy);
    }
    if (const fs::path path = staged(folder_ / relative); !path.empty())
      return read(path, most, where);
    std::error_code failure;
    const fs::path target = fs::canonical(folder_ / relative, failure);
    if (failure) continue;
    if (!lies_within(target, folder_)) {
      refuse(where, "the URI " + shown + " leads out of the model's folder by a symbolic link",
             remedy);
    }
    return read(target, most, where);
  }
  refuse(where, "the file " + shown + " it refers to is not there",
         "copy it into the model's folder, or export again as one .glb");
}

Bytes Folder::read(const fs::path& path, std::uint64_t most, const std::string& where) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) {
    refuse(where, "there is no such file", "check the path");
  }
  if (fs::is_directory(status)) refuse(where, "this is a folder, not a file", "check the path");
  // A pipe or a device might never end.
  if (!fs::is_regular_file(status)) {
    refuse(where, quoted(path.filename().string()) + " is no regular file", "check the path");
  }
  const std::uintmax_t on_disk = fs::file_size(path, failure);
  if (failure) refuse(where, "can't be read: " + failure.message(), "check its permissions");
  const std::uint64_t size = std::min<std::uint64_t>(on_disk, most);
  if (size > budget_) {
    refuse(where,
           "the file and all it refers to exceed " + std::to_string(options_.max_bytes) + " bytes",
           "split it, or reduce its textures");
  }
  budget_ -= size;
  if (options_.on_open) options_.on_open(path);
  std::ifstream stream(path, std::ios::binary);
  Bytes bytes(static_cast<std::size_t>(size));
  if (size > 0)
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) {
    refuse(where, quoted(path.filename().string()) + " can't be read", "check its permissions");
  }
  return bytes;
}

Bytes decode_data_uri(std::string_view uri, std::uint64_t most, const std::string& where) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) {
    refuse(where, "a data URI without data", "export the file again");
  }
  const std::string_view header = uri.substr(0, comma);
  std::string_view data = uri.substr(comma + 1);
  constexpr std::string_view kBase64 = ";base64";
  const bool base64 =
      header.size() >= kBase64.size() && header.substr(header.size() - kBase64.size()) == kBase64;
  Bytes out;
  if (!base64) {
    const std::string decoded = percent_decode(data);
    out.assign(decoded.begin(), decoded.end());
    if (out.size() > most) out.resize(static_cast<std::size_t>(most));
    return out;
  }
  while (!data.empty() && data.back() == '=') data.remove_suffix(1);
  out.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(most, data.size() / 4 * 3 + 3)));
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : data) {
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+') value = 62;
    if (c == '/') value = 63;
    if (value < 0) refuse(where, "a data URI that is not valid base64", "export the file again");
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    if (out.size() == most) return out;
    out.push_back(static_cast<std::uint8_t>(bits >> held & 0xff));
  }
  return out;
}

Container split_container(const Bytes& bytes, const std::string& where) {
  Container parts;
  const char* text = reinterpret_cast<const char*>(bytes.data());
  if (bytes.size() < 4 || std::memcmp(bytes.data(), "glTF", 4) != 0) {
    parts.json = std::string_view(text, bytes.size());
    return parts;
  }
  const std::string remedy = "the file is damaged; export or download it again";
  constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  if (bytes.size() < 20) refuse(where, "the GLB file ends within its header", remedy);
  const std::uint32_t version = little_endian(bytes, 4);
  if (version != 2) {
    refuse(where, "the GLB container has version " + std::to_string(version) + "; only 2 is read",
           "convert the file to glTF 2.0");
  }
  std::size_t end = little_endian(bytes, 8);
  if (end > bytes.size()) {
    refuse(where,
           "the GLB file is cut short: its header says " + std::to_string(end) +
               " bytes, there are " + std::to_string(bytes.size()),
           remedy);
  }
  if (end < bytes.size()) parts.warnings.push_back("bytes after the end of the GLB were ignored");

  int chunk = 0;
  for (std::size_t at = 12; at < end; ++chunk) {
    if (end - at < 8) refuse(where, "the GLB file ends within a chunk header", remedy);
    const std::size_t length = little_endian(bytes, at);
    const std::uint32_t type = little_endian(bytes, at + 4);
    at += 8;
    if (length > end - at) {
      refuse(where, "chunk " + std::to_string(chunk) + " of the GLB file runs past its end",
             remedy);
    }
    if (chunk == 0 && type != kJson) {
      refuse(where, "the first chunk of the GLB file is not JSON", remedy);
    }
    if (chunk == 0) parts.json = std::string_view(text + at, length);
    if (chunk == 1 && type == kBinary) {
      parts.binary = std::span(bytes).subspan(at, length);
      parts.has_binary = true;
    }
    at += length;
  }
  return parts;
}

}  // namespace elbowroom::gltf
