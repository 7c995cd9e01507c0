// SPDX-License-Identifier: MIT
#include "core/io/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace elbowroom::json_text {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::size_t skip_space(std::string_view text, std::size_t at) {
  while (at < text.size() && is_space(text[at])) ++at;
  return at;
}

// Past a string that begins at `at`.
std::size_t skip_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size(); ++at) {
    if (text[at] == '\\') {
      ++at;
    } else if (text[at] == '"') {
      return at + 1;
    }
  }
  return text.size();
}

// Past any value that begins at `at`. Without recursion: nesting may be deep.
std::size_t skip_value(std::string_view text, std::size_t at) {
  if (at >= text.size()) return text.size();
  if (text[at] == '"') return skip_string(text, at);
  if (text[at] != '{' && text[at] != '[') {
    while (at < text.size() && !is_space(text[at]) && text[at] != ',' && text[at] != ']' &&
           text[at] != '}') {
      ++at;
    }
    return at;
  }
  std::size_t depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      at = skip_string(text, at);
      continue;
    }
    ++at;
    if (c == '{' || c == '[') ++depth;
    if ((c == '}' || c == ']') && --depth == 0) return at;
  }
  return text.size();
}

std::string unescaped(std::string_view quoted_text) {
  const std::string_view inner = quoted_text.substr(1, quoted_text.size() - 2);
  if (inner.find('\\') == std::string_view::npos) return std::string(inner);
  const auto value = nlohmann::json::parse(quoted_text, nullptr, false);
  return value.is_string() ? value.get<std::string>() : std::string(inner);
}

}  // namespace

bool is_json(std::string_view text) { return nlohmann::json::accept(text); }

Span root(std::string_view text) {
  std::size_t at = text.substr(0, 3) == kByteOrderMark ? 3 : 0;
  at = skip_space(text, at);
  return {at, skip_value(text, at)};
}

std::string_view view(std::string_view text, Span span) {
  return text.substr(span.begin, span.end - span.begin);
}

bool is_object(std::string_view text, Span value) {
  return value.begin < value.end && text[value.begin] == '{';
}
bool is_array(std::string_view text, Span value) {
  return value.begin < value.end && text[value.begin] == '[';
}

std::vector<Member> members(std::string_view text, Span object) {
  std::vector<Member> found;
  if (!is_object(text, object)) return found;
  std::size_t at = skip_space(text, object.begin + 1);
  while (at + 1 < object.end && text[at] == '"') {
    Member member;
    member.key_text = {at, skip_string(text, at)};
    member.key = unescaped(view(text, member.key_text));
    at = skip_space(text, member.key_text.end);  // at the colon
    at = skip_space(text, at + 1);
    member.value = {at, skip_value(text, at)};
    at = skip_space(text, member.value.end);
    found.push_back(std::move(member));
    if (at < object.end && text[at] == ',') at = skip_space(text, at + 1);
  }
  return found;
}

std::vector<Span> elements(std::string_view text, Span array) {
  std::vector<Span> found;
  if (!is_array(text, array)) return found;
  std::size_t at = skip_space(text, array.begin + 1);
  while (at + 1 < array.end) {
    const Span value{at, skip_value(text, at)};
    if (value.end == value.begin) break;
    found.push_back(value);
    at = skip_space(text, value.end);
    if (at < array.end && text[at] == ',') at = skip_space(text, at + 1);
  }
  return found;
}

std::optional<Span> find(std::string_view text, Span object, std::string_view key) {
  std::optional<Span> found;
  for (const Member& member : members(text, object)) {
    if (member.key == key) found = member.value;
  }
  return found;
}

std::vector<Member> all_members(std::string_view text) {
  constexpr int kMaxDepth = 64;
  std::vector<Member> found;
  std::vector<Span> level{root(text)};
  for (int depth = 0; depth < kMaxDepth && !level.empty(); ++depth) {
    std::vector<Span> next;
    const auto descend = [&](Span value) {
      if (is_object(text, value) || is_array(text, value)) next.push_back(value);
    };
    for (const Span value : level) {
      for (Member& member : members(text, value)) {
        descend(member.value);
        found.push_back(std::move(member));
      }
      for (const Span element : elements(text, value)) descend(element);
    }
    level = std::move(next);
  }
  return found;
}

std::string quoted(std::string_view value) {
  return nlohmann::json(std::string(value))
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void Patch::replace(Span span, std::string with) { edits_.push_back({span, std::move(with)}); }

void Patch::set_member(Span object, std::string_view key, const std::string& value) {
  if (const auto old = find(text_, object, key)) {
    replace(*old, value);
  } else {
    add_member(object, key, value);
  }
}

void Patch::add_member(Span object, std::string_view key, const std::string& value) {
  const auto present = members(text_, object);
  const bool first =
      present.empty() && std::find(filled_.begin(), filled_.end(), object.begin) == filled_.end();
  const std::size_t at = present.empty() ? object.begin + 1 : present.back().value.end;
  if (first) filled_.push_back(object.begin);
  replace({at, at}, (first ? "" : ",") + quoted(key) + ":" + value);
}

void Patch::remove_member(Span object, std::string_view key) {
  const auto present = members(text_, object);
  // Every kept member keeps the text up to the next one's key; the last kept one loses its comma.
  std::size_t last_kept = present.size();
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (present[i].key != key) last_kept = i;
  }
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (present[i].key != key) continue;
    const bool behind_all = last_kept == present.size() || i > last_kept;
    if (!behind_all) {
      replace({present[i].key_text.begin, present[i + 1].key_text.begin}, "");
    } else {
      const std::size_t from = i == 0 ? present[i].key_text.begin : present[i - 1].value.end;
      replace({from, present[i].value.end}, "");
    }
  }
}

void Patch::append(Span array, const std::vector<std::string>& values) {
  const auto present = elements(text_, array);
  std::string added;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 || !present.empty()) added += ',';
    added += values[i];
  }
  const std::size_t at = present.empty() ? array.begin + 1 : present.back().end;
  replace({at, at}, added);
}

std::string Patch::apply() const {
  std::vector<Edit> sorted = edits_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
  std::string result;
  std::size_t at = 0;
  for (const Edit& edit : sorted) {
    result.append(text_.substr(at, edit.span.begin - at));
    result.append(edit.with);
    at = edit.span.end;
  }
  result.append(text_.substr(at));
  return result;
}

}  // namespace elbowroom::json_text
