// SPDX-License-Identifier: MIT
// Typed access to an untrusted JSON document: each getter checks what it returns and refuses, by
// throwing Refusal, with the file and the part that is at fault. Used inside the reader only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/gltf_source.h"

namespace elbowroom::gltf {

using Json = nlohmann::json;

// The document in `text`; refuses what is empty, no JSON, no object, or nested so deeply that
// recursion over it could overflow.
Json parse_json(std::string_view text, const std::string& file);

// The member, or null if it is absent, JSON null, or `object` is no object.
const Json* member(const Json& object, const char* key);
// The member "name" if it is text, else empty.
std::string name_of(const Json& object);
// Sets a member unless the index is -1: the reduced document leaves absent things out.
void put_index(Json& object, const char* key, int index);

class JsonAccess {
 public:
  JsonAccess(std::string file, const Json& document)
      : file_(std::move(file)), document_(document) {}

  const std::string& file() const { return file_; }
  // Place of an error: the file and the part of it.
  std::string in_file(const std::string& part) const { return file_ + ", " + part; }
  [[noreturn]] void refuse_part(const std::string& part, const std::string& what) const;

  // A top-level array of objects; an empty one if it is absent.
  const Json& section(const char* key) const;
  // A member that is an array of objects; an empty one if it is absent.
  const Json& objects(const Json& object, const char* key, const std::string& part) const;

  // An integer in [low, high]; 1.0 and 1e0 are integers too. Absent: `fallback`, or a refusal.
  std::int64_t integer(const Json& object, const char* key, const std::string& part,
                       std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> fallback) const;
  // An index below `count`; -1 if absent.
  int index(const Json& object, const char* key, const std::string& part, std::size_t count) const;
  int required_index(const Json& object, const char* key, const std::string& part,
                     std::size_t count) const;
  // Indices below `count`; an empty array if absent.
  Json index_list(const Json& object, const char* key, const std::string& part,
                  std::size_t count) const;
  // `count` numbers (any count for 0), finite and at most kLargestNumber; nullopt if absent.
  std::optional<std::vector<double>> numbers(const Json& object, const char* key,
                                             const std::string& part, std::size_t count) const;

 private:
  std::int64_t to_integer(const Json& value, const std::string& part, const char* key,
                          std::int64_t low, std::int64_t high) const;

  std::string file_;
  const Json& document_;
};

}  // namespace elbowroom::gltf
