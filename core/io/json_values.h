// SPDX-License-Identifier: MIT
// Reading a parsed JSON document that may hold anything anywhere: for the exporter's .cpp files.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

namespace elbowroom::json_text {

using json = nlohmann::json;

// A member of a parsed value; null if it is no object or has none of that key.
inline const json& member(const json& value, const char* key) {
  static const json none;
  if (!value.is_object()) return none;
  const auto found = value.find(key);
  return found != value.end() ? *found : none;
}

// A whole number from 0 to 2^53; 1.0 is one too.
inline std::optional<std::uint64_t> whole_number(const json& value) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
  if (value.is_number_unsigned() && value.get<std::uint64_t>() <= kMost) {
    return value.get<std::uint64_t>();
  }
  if (!value.is_number_float()) return std::nullopt;
  const double wide = value.get<double>();
  if (!(wide >= 0 && wide <= static_cast<double>(kMost))) return std::nullopt;
  const auto whole = static_cast<std::uint64_t>(wide);
  if (static_cast<double>(whole) != wide) return std::nullopt;
  return whole;
}

}  // namespace elbowroom::json_text
