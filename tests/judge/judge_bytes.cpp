// SPDX-License-Identifier: MIT
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/judge/judge.h"

namespace judge {
namespace {

// Every scalar of a document by its JSON pointer, as the text it has in the file; containers by
// their kind, so that an empty one that vanishes is seen. Of a key that is there twice the last one
// counts.
class Flatten : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::map<std::string, std::string> values;

  bool null() override { return put("null"); }
  bool boolean(bool v) override { return put(v ? "true" : "false"); }
  bool number_integer(number_integer_t v) override { return put(std::to_string(v)); }
  bool number_unsigned(number_unsigned_t v) override { return put(std::to_string(v)); }
  bool number_float(number_float_t, const string_t& text) override { return put(text); }
  bool string(string_t& v) override { return put('"' + v + '"'); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open("{"); }
  bool start_array(std::size_t) override { return open("["); }
  bool key(string_t& k) override {
    path_.back().key = k;
    return true;
  }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  struct Level {
    bool array = false;
    std::size_t index = 0;
    std::string key;
  };
  std::string pointer() const {
    std::string text;
    for (const Level& level : path_) {
      text += '/' + (level.array ? std::to_string(level.index) : level.key);
    }
    return text;
  }
  // A value that replaces an earlier one of the same key takes its members away too.
  void forget(const std::string& at) {
    values.erase(at);
    auto below = values.lower_bound(at + '/');
    while (below != values.end() && below->first.compare(0, at.size() + 1, at + '/') == 0) {
      below = values.erase(below);
    }
  }
  bool put(const std::string& text) {
    const std::string at = pointer();
    if (!path_.empty() && !path_.back().array) forget(at);
    values[at] = text;
    advance();
    return true;
  }
  bool open(const char* kind) {
    const std::string at = pointer();
    if (!path_.empty() && !path_.back().array) forget(at);
    values[at] = kind;
    path_.push_back({*kind == '[', 0, ""});
    return true;
  }
  bool close() {
    path_.pop_back();
    advance();
    return true;
  }
  void advance() {
    if (!path_.empty() && path_.back().array) ++path_.back().index;
  }
  std::vector<Level> path_;
};

std::map<std::string, std::string> flattened(const std::string& json) {
  Flatten flat;
  nlohmann::json::sax_parse(json, &flat);
  return flat.values;
}

// "/accessors/12/min" -> true if /accessors/12 is not in the source.
bool appended(const std::string& pointer, const std::map<std::string, std::string>& source) {
  for (const char* array : {"accessors", "bufferViews", "buffers", "animations"}) {
    const std::string begin = std::string("/") + array;
    if (pointer == begin) return !source.count(begin);
    if (pointer.compare(0, begin.size() + 1, begin + '/') != 0) continue;
    const std::size_t end = pointer.find('/', begin.size() + 1);
    return !source.count(pointer.substr(0, end));
  }
  return false;
}

bool may_change(const std::string& pointer) {
  if (pointer == "/asset/generator") return true;
  const std::string begin = "/buffers/", end = "/byteLength";
  return pointer.compare(0, begin.size(), begin) == 0 && pointer.size() > end.size() &&
         pointer.compare(pointer.size() - end.size(), end.size(), end) == 0 &&
         pointer.find('/', begin.size()) == pointer.size() - end.size();
}

}  // namespace

ByteReport compare_bytes(const File& source, const File& output) {
  ByteReport report;
  report.buffers_are_prefixes = output.buffers.size() >= source.buffers.size();
  for (std::size_t i = 0; i < source.buffers.size() && report.buffers_are_prefixes; ++i) {
    report.buffers_are_prefixes =
        output.buffers[i].compare(0, source.buffers[i].size(), source.buffers[i]) == 0;
  }
  const auto before = flattened(source.json), after = flattened(output.json);
  for (const auto& [pointer, text] : before) {
    const auto at = after.find(pointer);
    if (at == after.end()) {
      report.json_differences.push_back(pointer + ": " + text + " -> nothing");
    } else if (at->second != text && !may_change(pointer)) {
      report.json_differences.push_back(pointer + ": " + text + " -> " + at->second);
    }
  }
  for (const auto& [pointer, text] : after) {
    if (!before.count(pointer) && !may_change(pointer) && !appended(pointer, before)) {
      report.json_differences.push_back(pointer + ": nothing -> " + text);
    }
  }
  return report;
}

}  // namespace judge
