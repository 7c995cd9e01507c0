// SPDX-License-Identifier: MIT
#include <fstream>  // tinygltf forgets it when told to keep off the disk
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include "core/io/gltf_parse.h"

#include <charconv>
#include <utility>

namespace elbowroom::gltf {
namespace {

constexpr char kPrefix[] = "buffer/";

// The index in a path that ends in "buffer/N", -1 if it is anything else. tinygltf puts a folder in
// front of what it asks for.
int buffer_of(const std::string& path, const Checked& checked) {
  const std::size_t at = path.rfind(kPrefix);
  if (at == std::string::npos) return -1;
  const char* begin = path.data() + at + sizeof(kPrefix) - 1;
  const char* end = path.data() + path.size();
  int index = -1;
  const auto [rest, failure] = std::from_chars(begin, end, index);
  const bool good = failure == std::errc() && rest == end && index >= 0 &&
                    static_cast<std::size_t>(index) < checked.buffers.size();
  return good ? index : -1;
}

bool file_exists(const std::string& path, void* checked) {
  return buffer_of(path, *static_cast<Checked*>(checked)) >= 0;
}

std::string same_path(const std::string& path, void*) { return path; }

bool give_buffer(std::vector<unsigned char>* out, std::string* error, const std::string& path,
                 void* user) {
  Checked& checked = *static_cast<Checked*>(user);
  const int index = buffer_of(path, checked);
  if (index < 0) {
    if (error) *error += "no such buffer";
    return false;
  }
  *out = std::move(checked.buffers[static_cast<std::size_t>(index)]);
  return true;
}

bool write_nothing(std::string* error, const std::string&, const std::vector<unsigned char>&,
                   void*) {
  if (error) *error += "reading only";
  return false;
}

}  // namespace

tinygltf::Model parse_document(Checked& checked, const std::string& file) {
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({file_exists, same_path, give_buffer, write_nothing, &checked});
  tinygltf::Model model;
  std::string error, warning;
  // `error` may hold remarks although all went well; the returned value is the truth.
  const bool good = loader.LoadASCIIFromString(&model, &error, &warning, checked.json.data(),
                                               static_cast<unsigned int>(checked.json.size()), "");
  if (!good) {
    for (char& c : error) {
      if (c == '\n') c = ' ';
    }
    refuse(file, "it can't be read: " + excerpt(error, 200), "export it again");
  }
  checked.json.clear();
  checked.json.shrink_to_fit();
  return model;
}

}  // namespace elbowroom::gltf
