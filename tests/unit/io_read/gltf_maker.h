// SPDX-License-Identifier: MIT
// Makes small glTF files for tests: a document as JSON, bytes as they are needed.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace elbowroom::test {

using Json = nlohmann::json;

// A folder of its own, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    // In memory where there is such a place: tests write thousands of files.
    std::filesystem::path parent = std::filesystem::temp_directory_path();
    if (access("/dev/shm", W_OK) == 0) parent = "/dev/shm";
    std::string pattern = (parent / "elbowroom-XXXXXX").string();
    if (mkdtemp(pattern.data())) path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path write_file(const std::filesystem::path& path,
                                        const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

// A document and the one buffer it grows.
struct GltfMaker {
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::string binary;

  int view(const std::string& bytes, int stride = 0) {
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    Json entry = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) entry["byteStride"] = stride;
    binary += bytes;
    json["bufferViews"].push_back(entry);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  template <typename T>
  static std::string bytes_of(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
  }

  int accessor(const Json& entry) {
    json["accessors"].push_back(entry);
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  template <typename T>
  int accessor(const std::vector<T>& values, int component_type, const std::string& type,
               int components, bool normalized = false) {
    return accessor({{"bufferView", view(bytes_of(values))},
                     {"componentType", component_type},
                     {"count", values.size() / static_cast<std::size_t>(components)},
                     {"type", type},
                     {"normalized", normalized}});
  }
  int floats(const std::vector<float>& values, const std::string& type, int components) {
    return accessor(values, 5126, type, components);
  }
  int points(const std::vector<float>& values) { return floats(values, "VEC3", 3); }
  int scalars(const std::vector<float>& values) { return floats(values, "SCALAR", 1); }
  int indices(const std::vector<std::uint16_t>& values) {
    return accessor(values, 5123, "SCALAR", 1);
  }

  int node(const Json& entry) {
    json["nodes"].push_back(entry);
    return static_cast<int>(json["nodes"].size()) - 1;
  }
  // A mesh of one primitive.
  int mesh(const Json& primitive) {
    json["meshes"].push_back({{"primitives", {primitive}}});
    return static_cast<int>(json["meshes"].size()) - 1;
  }

  std::string glb() {
    Json document = json;
    if (!binary.empty() && !document.contains("buffers")) {
      document["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    }
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string data = binary;
    data.resize((data.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t value) {
      const auto v = static_cast<std::uint32_t>(value);
      return std::string{static_cast<char>(v & 0xff), static_cast<char>(v >> 8 & 0xff),
                         static_cast<char>(v >> 16 & 0xff), static_cast<char>(v >> 24 & 0xff)};
    };
    std::string chunks = word(text.size()) + "JSON" + text;
    if (!data.empty()) chunks += word(data.size()) + std::string("BIN\0", 4) + data;
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
  }
};

// One skinned, morphed and animated figure with a rigid part and a sparse accessor: something of
// everything the reader reads.
GltfMaker everything();

}  // namespace elbowroom::test
