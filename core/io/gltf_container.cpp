// SPDX-License-Identifier: MIT
#include "core/io/gltf_container.h"

#include <array>
#include <cctype>
#include <cstdint>

#include "core/io/json_text.h"

namespace elbowroom::gltf_export {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;

std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  }
  return value;
}

void put_u32(std::string& bytes, std::uint64_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr std::string_view kBase64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::optional<std::string> decode_base64(std::string_view text) {
  static const auto digits = [] {
    std::array<int, 256> table;
    table.fill(-1);
    for (int i = 0; i < 64; ++i) {
      table[static_cast<unsigned char>(kBase64[static_cast<std::size_t>(i)])] = i;
    }
    return table;
  }();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t buffer = 0;
  int bits = 0;
  for (const char c : text) {
    const int digit = digits[static_cast<unsigned char>(c)];
    if (digit < 0) return std::nullopt;
    buffer = buffer << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<char>(buffer >> bits & 0xFF));
    }
  }
  return bytes;
}

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text.push_back(j <= count ? kBase64[group >> (18 - 6 * j) & 63] : '=');
    }
  }
  return text;
}

Error broken(const std::string& what, const fs::path& file) {
  return Error{what, file.string(), "export it again from the program that made it"};
}

}  // namespace

Result<Container> parse_container(std::string_view bytes, const fs::path& file) {
  Container container;
  container.binary = bytes.size() >= 4 && read_u32(bytes, 0) == kMagic;
  if (!container.binary) {
    container.json = bytes;
  } else {
    if (bytes.size() < 20) return broken("the GLB header is cut off", file);
    const std::uint32_t version = read_u32(bytes, 4), length = read_u32(bytes, 8);
    if (version != 2) {
      return broken("GLB version " + std::to_string(version) + " is not 2", file);
    }
    if (length < 20 || length > bytes.size()) {
      return broken("the GLB header's length does not fit the file", file);
    }
    bytes = bytes.substr(0, length);
    std::size_t at = 12;
    for (int index = 0; at < bytes.size(); ++index) {
      if (bytes.size() - at < 8) return broken("a GLB chunk is cut off", file);
      const std::uint32_t size = read_u32(bytes, at), type = read_u32(bytes, at + 4);
      if (size > bytes.size() - at - 8) return broken("a GLB chunk is cut off", file);
      const std::string_view data = bytes.substr(at + 8, size);
      if (index == 0) {
        if (type != kJsonChunk) return broken("the first GLB chunk is not JSON", file);
        container.json = data;
      } else if (index == 1 && type == kBinChunk) {
        container.bin = std::string(data);
      } else {
        container.other_chunks.append(bytes.substr(at));
        break;
      }
      at += 8 + size;
    }
    // Some writers pad with zeros.
    while (!container.json.empty() && container.json.back() == '\0') container.json.pop_back();
  }
  if (!json_text::is_json(container.json)) return broken("the text is not valid JSON", file);
  if (!json_text::is_object(container.json, json_text::root(container.json))) {
    return broken("the JSON is not an object", file);
  }
  return container;
}

Result<std::string> write_container(const Container& container, const fs::path& file) {
  if (!container.binary) return container.json;
  const auto padded = [](std::string bytes, char with) {
    while (bytes.size() % 4 != 0) bytes.push_back(with);
    return bytes;
  };
  // A byte order mark is allowed before a .gltf's text, not in a chunk.
  const bool marked = container.json.compare(0, 3, "\xEF\xBB\xBF") == 0;
  const std::string json = padded(container.json.substr(marked ? 3 : 0), ' ');
  const std::string bin = container.bin ? padded(*container.bin, '\0') : std::string();
  const std::uint64_t length = 12 + 8 + std::uint64_t{json.size()} +
                               (container.bin ? 8 + std::uint64_t{bin.size()} : 0) +
                               container.other_chunks.size();
  if (length > 0xFFFFFFFFu) {
    return Error{"a GLB cannot be 4 GiB or larger", file.string(), "write a .gltf"};
  }
  std::string bytes;
  bytes.reserve(length);
  put_u32(bytes, kMagic);
  put_u32(bytes, 2);
  put_u32(bytes, length);
  put_u32(bytes, json.size());
  put_u32(bytes, kJsonChunk);
  bytes += json;
  if (container.bin) {
    put_u32(bytes, bin.size());
    put_u32(bytes, kBinChunk);
    bytes += bin;
  }
  bytes += container.other_chunks;
  return bytes;
}

bool is_data_uri(std::string_view uri) {
  if (uri.size() < 5) return false;
  std::string scheme(uri.substr(0, 5));
  for (char& c : scheme) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return scheme == "data:";
}

std::optional<DataUri> decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!is_data_uri(uri) || comma == std::string_view::npos) return std::nullopt;
  const std::string_view header = uri.substr(5, comma - 5), body = uri.substr(comma + 1);
  DataUri data;
  data.mime = header.substr(0, header.find(';'));
  constexpr std::string_view kEncoding = ";base64";
  if (header.size() >= kEncoding.size() &&
      header.substr(header.size() - kEncoding.size()) == kEncoding) {
    // '+' and '/' may come percent-encoded.
    auto bytes = decode_base64(body.find('%') == std::string_view::npos ? std::string(body)
                                                                        : percent_decoded(body));
    if (!bytes) return std::nullopt;
    data.bytes = *std::move(bytes);
  } else {
    data.bytes = percent_decoded(body);
  }
  return data;
}

std::string encode_data_uri(std::string_view mime, std::string_view bytes) {
  return "data:" + std::string(mime) + ";base64," + encode_base64(bytes);
}

bool is_relative_uri(std::string_view uri) {
  if (uri.empty() || uri.front() == '/') return false;
  // scheme = ALPHA *( ALPHA / DIGIT / "+" / "-" / "." ) ":"
  for (const char c : uri) {
    if (c == ':') return false;
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.') break;
  }
  return true;
}

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 &&
        hex_digit(uri[i + 2]) >= 0) {
      text.push_back(static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])));
      i += 2;
    } else {
      text.push_back(uri[i]);
    }
  }
  return text;
}

std::string percent_encoded(std::string_view path) {
  constexpr std::string_view kHex = "0123456789ABCDEF", kPlain = "-._~/!$&'()*+,;=@";
  std::string text;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && (std::isalnum(byte) || kPlain.find(c) != std::string_view::npos)) {
      text.push_back(c);
    } else {
      text += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return text;
}

std::optional<fs::path> resolve_inside(const fs::path& folder, std::string_view uri) {
  if (!is_relative_uri(uri)) return std::nullopt;
  std::error_code failed;
  const fs::path base = fs::canonical(folder.empty() ? fs::path(".") : folder, failed);
  if (failed) return std::nullopt;
  for (const std::string& name : {percent_decoded(uri), std::string(uri)}) {
    if (name.empty() || name.find('\0') != std::string::npos) continue;
    const fs::path file = fs::canonical(base / name, failed);
    if (failed || !fs::is_regular_file(file, failed)) continue;
    const fs::path inside = file.lexically_relative(base);
    if (inside.empty() || *inside.begin() == "..") continue;
    return file;
  }
  return std::nullopt;
}

}  // namespace elbowroom::gltf_export
