// SPDX-License-Identifier: MIT
// Changes a JSON text in a few places and leaves every other character of it as it is: numbers keep
// their digits, objects their order, strings their escapes. Dumping a parsed document does not.
//
// All functions require a text that a JSON parser has accepted (is_json). Spans are byte offsets.
// Where an object has a key twice the last one counts, as it does for the usual parsers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace elbowroom::json_text {

struct Span {
  std::size_t begin = 0, end = 0;
};

struct Member {
  std::string key;  // unescaped
  Span key_text;    // with its quotes
  Span value;
};

// True if the whole text is one JSON value (RFC 8259, UTF-8), perhaps after a byte order mark.
bool is_json(std::string_view text);

// The text's value, without byte order mark and surrounding space.
Span root(std::string_view text);
std::string_view view(std::string_view text, Span span);
bool is_object(std::string_view text, Span value);
bool is_array(std::string_view text, Span value);

// Members of an object in their order (none if it is no object), elements of an array likewise.
std::vector<Member> members(std::string_view text, Span object);
std::vector<Span> elements(std::string_view text, Span array);
// Value of the last member of that key.
std::optional<Span> find(std::string_view text, Span object, std::string_view key);
// All members of all objects down to a depth no glTF has, outer ones first.
std::vector<Member> all_members(std::string_view text);

// Quoted and escaped; bytes that are no UTF-8 become U+FFFD.
std::string quoted(std::string_view value);

// Changes to one text, applied together. Spans must not overlap.
class Patch {
 public:
  explicit Patch(std::string_view text) : text_(text) {}

  void replace(Span span, std::string with);
  // Sets the last member of that key, or adds one behind the others.
  void set_member(Span object, std::string_view key, const std::string& value);
  // Removes every member of that key.
  void remove_member(Span object, std::string_view key);
  // Appends values (JSON texts) to an array.
  void append(Span array, const std::vector<std::string>& values);

  std::string apply() const;

 private:
  struct Edit {
    Span span;
    std::string with;
  };
  void add_member(Span object, std::string_view key, const std::string& value);

  std::string_view text_;
  std::vector<Edit> edits_;
  std::vector<std::size_t> filled_;  // empty objects that have been given a member
};

}  // namespace elbowroom::json_text
