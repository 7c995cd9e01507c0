// SPDX-License-Identifier: MIT
#include "core/io/gltf_json.h"

#include <cmath>

#include "core/io/gltf_check.h"

namespace elbowroom::gltf {
namespace {

constexpr int kDeepest = 256;  // nesting of JSON; real files stay below 30

// A look at the brackets before parsing, so that no recursion over the document can overflow.
void check_nesting(std::string_view text, const std::string& where) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kDeepest) refuse(where, "its JSON is nested too deeply", kExportAgain);
  }
}

const Json& no_objects() {
  static const Json none = Json::array();
  return none;
}

}  // namespace

Json parse_json(std::string_view text, const std::string& file) {
  check_nesting(text, file);
  // GLB pads its JSON with spaces; some writers pad with zeros.
  while (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    refuse(file, "it is empty", "choose a glTF 2.0 file (.gltf, .glb, .vrm)");
  }
  try {
    Json document = Json::parse(text);
    if (!document.is_object()) {
      refuse(file, "it is JSON but no glTF document", "choose a glTF 2.0 file (.gltf, .glb, .vrm)");
    }
    return document;
  } catch (const Json::exception& failure) {
    std::string what = failure.what();
    for (char& c : what) {
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    }
    refuse(file, "it is no glTF file: neither GLB nor valid JSON: " + excerpt(what, 160),
           "choose a glTF 2.0 file (.gltf, .glb, .vrm), or export it again");
  }
}

const Json* member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto it = object.find(key);
  return it == object.end() || it->is_null() ? nullptr : &*it;
}

std::string name_of(const Json& object) {
  const Json* name = member(object, "name");
  return name && name->is_string() ? name->get<std::string>() : std::string();
}

void put_index(Json& object, const char* key, int index) {
  if (index >= 0) object[key] = index;
}

void JsonAccess::refuse_part(const std::string& part, const std::string& what) const {
  refuse(in_file(part), what, kExportAgain);
}

const Json& JsonAccess::section(const char* key) const { return objects(document_, key, key); }

const Json& JsonAccess::objects(const Json& object, const char* key,
                                const std::string& part) const {
  const Json* found = member(object, key);
  if (!found) return no_objects();
  if (!found->is_array()) refuse_part(part, std::string("\"") + key + "\" is no array");
  for (std::size_t i = 0; i < found->size(); ++i) {
    if (!(*found)[i].is_object()) {
      refuse_part(part, "entry " + std::to_string(i) + " of \"" + key + "\" is no object");
    }
  }
  return *found;
}

std::int64_t JsonAccess::integer(const Json& object, const char* key, const std::string& part,
                                 std::int64_t low, std::int64_t high,
                                 std::optional<std::int64_t> fallback) const {
  const Json* value = member(object, key);
  if (value) return to_integer(*value, part, key, low, high);
  if (fallback) return *fallback;
  refuse_part(part, std::string("it has no \"") + key + "\"");
}

std::int64_t JsonAccess::to_integer(const Json& value, const std::string& part, const char* key,
                                    std::int64_t low, std::int64_t high) const {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(std::floor(number) == number)) {
    refuse_part(part, std::string("\"") + key + "\" is no integer");
  }
  if (number < static_cast<double>(low) || number > static_cast<double>(high)) {
    const std::string shown = excerpt(value.dump(-1, ' ', true), 40);
    refuse_part(part, std::string("\"") + key + "\" is " + shown +
                          (high < low ? ", but there is nothing it could refer to"
                                      : ", outside " + std::to_string(low) + " to " +
                                            std::to_string(high)));
  }
  return static_cast<std::int64_t>(number);
}

int JsonAccess::index(const Json& object, const char* key, const std::string& part,
                      std::size_t count) const {
  if (!member(object, key)) return -1;
  return static_cast<int>(
      integer(object, key, part, 0, static_cast<std::int64_t>(count) - 1, std::nullopt));
}

int JsonAccess::required_index(const Json& object, const char* key, const std::string& part,
                               std::size_t count) const {
  return static_cast<int>(
      integer(object, key, part, 0, static_cast<std::int64_t>(count) - 1, std::nullopt));
}

Json JsonAccess::index_list(const Json& object, const char* key, const std::string& part,
                            std::size_t count) const {
  Json list = Json::array();
  const Json* values = member(object, key);
  if (!values) return list;
  if (!values->is_array()) refuse_part(part, std::string("\"") + key + "\" is no array");
  for (const Json& value : *values) {
    list.push_back(to_integer(value, part, key, 0, static_cast<std::int64_t>(count) - 1));
  }
  return list;
}

std::optional<std::vector<double>> JsonAccess::numbers(const Json& object, const char* key,
                                                       const std::string& part,
                                                       std::size_t count) const {
  const Json* values = member(object, key);
  if (!values) return std::nullopt;
  if (!values->is_array() || (count > 0 && values->size() != count)) {
    refuse_part(part, std::string("\"") + key + "\" is no array" +
                          (count > 0 ? " of " + std::to_string(count) + " numbers" : ""));
  }
  std::vector<double> out;
  for (const Json& value : *values) {
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(std::abs(number) <= kLargestNumber)) {
      refuse_part(part, std::string("\"") + key + "\" holds " +
                            excerpt(value.dump(-1, ' ', true), 40) + ", which is no usable number");
    }
    out.push_back(number);
  }
  return out;
}

}  // namespace elbowroom::gltf
