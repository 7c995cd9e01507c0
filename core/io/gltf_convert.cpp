// SPDX-License-Identifier: MIT
// Change of container between .gltf and GLB.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/io/gltf_append.h"
#include "core/io/json_text.h"
#include "core/io/json_values.h"
#include "core/io/safe_file.h"

namespace elbowroom::gltf_export {
namespace {

using json_text::json;
using json_text::member;
using json_text::whole_number;
namespace jt = json_text;

// The entries of a root array, none if it is not there.
const json& entries(const json& document, const char* key) {
  static const json none = json::array();
  const json& array = member(document, key);
  return array.is_array() ? array : none;
}

struct Resource {
  std::string mime, bytes;
};

// What a URI names, from the file's own folder or out of the URI itself.
std::optional<Resource> fetch(const Draft& draft, const std::string& uri) {
  if (is_data_uri(uri)) {
    auto data = decode_data_uri(uri);
    if (!data) return std::nullopt;
    return Resource{data->mime, std::move(data->bytes)};
  }
  const auto file = resolve_inside(draft.file.parent_path(), uri);
  if (!file) return std::nullopt;
  auto bytes = read_whole_file(*file);
  if (!bytes) return std::nullopt;
  return Resource{"", *std::move(bytes)};
}

// By its first bytes; empty if it is no image that glTF or its extensions know.
std::string image_mime(std::string_view bytes) {
  const auto starts = [&](std::string_view magic) {
    return bytes.substr(0, magic.size()) == magic;
  };
  if (starts("\x89PNG")) return "image/png";
  if (starts("\xFF\xD8\xFF")) return "image/jpeg";
  if (starts("RIFF") && bytes.substr(8, 4) == "WEBP") return "image/webp";
  if (starts("\xABKTX 20\xBB")) return "image/ktx2";
  return "";
}

std::size_t aligned(std::size_t offset) { return (offset + 3) / 4 * 4; }

// Replaces elements of a root array by new texts; nullopt removes one. Needs one left.
void replace_elements(jt::Patch& patch, const std::string& text, const char* key,
                      const std::map<std::size_t, std::string>& changed, std::size_t keep) {
  const auto array = jt::find(text, jt::root(text), key);
  if (!array) return;
  const auto spans = jt::elements(text, *array);
  for (const auto& [index, with] : changed) {
    if (index < std::min(keep, spans.size())) patch.replace(spans[index], with);
  }
  if (keep < spans.size() && keep > 0) {
    patch.replace({spans[keep - 1].end, spans.back().end}, "");
  }
}

std::string element_text(const std::string& text, const char* key, std::size_t index) {
  const auto array = jt::find(text, jt::root(text), key);
  return std::string(jt::view(text, jt::elements(text, *array)[index]));
}

Error missing(const Draft& draft, std::size_t buffer) {
  return Error{"the buffer's bytes are not there",
               draft.file.string() + ", /buffers/" + std::to_string(buffer),
               "put the file its uri names beside it"};
}

// True if something but bufferViews[].buffer may name a buffer by its index, or a buffer has no
// bytes of its own (meshopt): then buffers keep their places.
bool buffers_are_pinned(const json& document) {
  for (const json& view : entries(document, "bufferViews")) {
    for (const auto& item : member(view, "extensions").items()) {
      if (!member(item.value(), "buffer").is_null()) return true;
    }
  }
  for (const json& buffer : entries(document, "buffers")) {
    for (const auto& item : member(buffer, "extensions").items()) {
      if (!member(item.value(), "fallback").is_null()) return true;
    }
    if (!member(buffer, "uri").is_string()) return true;
  }
  return false;
}

// Buffers into the BIN chunk. One after the other if they may be renumbered, else the first alone.
Status pack_buffers(Draft& draft) {
  const std::string text = draft.container.json;
  const json document = json::parse(text, nullptr, false);
  const json& buffers = entries(document, "buffers");
  if (buffers.empty() || !member(buffers[0], "uri").is_string()) return Done{};
  const std::size_t packed = buffers_are_pinned(document) ? 1 : buffers.size();

  std::string bin;
  std::vector<std::size_t> begin;
  for (std::size_t i = 0; i < packed; ++i) {
    auto data = fetch(draft, member(buffers[i], "uri").get<std::string>());
    const auto length = whole_number(member(buffers[i], "byteLength"));
    if (!data || !length || *length > data->bytes.size()) return missing(draft, i);
    data->bytes.resize(*length);
    bin.resize(aligned(bin.size()), '\0');
    begin.push_back(bin.size());
    bin += data->bytes;
  }

  jt::Patch patch(text);
  const std::string first = element_text(text, "buffers", 0);
  jt::Patch first_patch(first);
  first_patch.remove_member(jt::root(first), "uri");
  first_patch.set_member(jt::root(first), "byteLength", std::to_string(bin.size()));
  replace_elements(patch, text, "buffers", {{0, first_patch.apply()}},
                   packed == buffers.size() ? 1 : buffers.size());
  if (packed > 1) {
    std::map<std::size_t, std::string> views;
    const json& old_views = entries(document, "bufferViews");
    const auto array = jt::find(text, jt::root(text), "bufferViews");
    const auto spans = array ? jt::elements(text, *array) : std::vector<jt::Span>{};
    for (std::size_t i = 0; i < old_views.size(); ++i) {
      const auto buffer = whole_number(member(old_views[i], "buffer"));
      if (!buffer || *buffer == 0 || *buffer >= begin.size()) continue;
      const std::uint64_t old = whole_number(member(old_views[i], "byteOffset")).value_or(0);
      const std::string view(jt::view(text, spans[i]));
      jt::Patch view_patch(view);
      view_patch.set_member(jt::root(view), "buffer", "0");
      view_patch.set_member(jt::root(view), "byteOffset", std::to_string(old + begin[*buffer]));
      views[i] = view_patch.apply();
    }
    replace_elements(patch, text, "bufferViews", views, spans.size());
  }
  draft.container.json = patch.apply();
  draft.container.bin = std::move(bin);
  return Done{};
}

// Images that a URI names into the BIN chunk. Those that are not there stay as they are.
void pack_images(Draft& draft) {
  const std::string text = draft.container.json;
  const json document = json::parse(text, nullptr, false);
  const json& buffers = entries(document, "buffers");
  if (!buffers.empty() && !draft.container.bin) return;

  std::string bin = draft.container.bin.value_or("");
  const std::size_t first_view = entries(document, "bufferViews").size();
  std::vector<std::string> views;
  std::map<std::string, std::pair<std::size_t, std::string>> done;  // uri -> view and type
  std::map<std::size_t, std::string> images;
  const json& old_images = entries(document, "images");
  for (std::size_t i = 0; i < old_images.size(); ++i) {
    const json& uri_value = member(old_images[i], "uri");
    if (!uri_value.is_string()) continue;
    const std::string uri = uri_value.get<std::string>();
    auto at = done.find(uri);
    if (at == done.end()) {
      const auto image = fetch(draft, uri);
      if (!image) continue;
      std::string mime = image_mime(image->bytes);
      if (mime.empty()) mime = image->mime;
      const json& stated = member(old_images[i], "mimeType");
      if (mime.empty() && stated.is_string()) mime = stated.get<std::string>();
      if (mime.empty()) continue;
      bin.resize(aligned(bin.size()), '\0');
      views.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(bin.size()) +
                      ",\"byteLength\":" + std::to_string(image->bytes.size()) + "}");
      bin += image->bytes;
      at = done.emplace(uri, std::pair{first_view + views.size() - 1, mime}).first;
    }
    const std::string image = element_text(text, "images", i);
    jt::Patch patch(image);
    const jt::Span whole = jt::root(image);
    // The view takes the place of the URI, so that no member moves.
    const auto members = jt::members(image, whole);
    const auto last = std::find_if(members.rbegin(), members.rend(),
                                   [](const jt::Member& m) { return m.key == "uri"; });
    const bool twice = std::count_if(members.begin(), members.end(),
                                     [](const jt::Member& m) { return m.key == "uri"; }) > 1;
    if (twice) {
      patch.remove_member(whole, "uri");
      patch.set_member(whole, "bufferView", std::to_string(at->second.first));
    } else {
      patch.replace({last->key_text.begin, last->value.end},
                    "\"bufferView\":" + std::to_string(at->second.first));
    }
    if (!jt::find(image, whole, "mimeType")) {
      patch.set_member(whole, "mimeType", jt::quoted(at->second.second));
    }
    images[i] = patch.apply();
  }
  if (views.empty()) return;

  jt::Patch patch(text);
  const jt::Span root = jt::root(text);
  replace_elements(patch, text, "images", images, old_images.size());
  if (const auto array = jt::find(text, root, "bufferViews")) {
    patch.append(*array, views);
  } else {
    std::string all;
    for (const std::string& view : views) all += (all.empty() ? "" : ",") + view;
    patch.set_member(root, "bufferViews", "[" + all + "]");
  }
  const std::string length = std::to_string(bin.size());
  if (buffers.empty()) {
    if (const auto array = jt::find(text, root, "buffers")) {
      patch.replace(*array, "[{\"byteLength\":" + length + "}]");
    } else {
      patch.set_member(root, "buffers", "[{\"byteLength\":" + length + "}]");
    }
  } else {
    const auto array = jt::find(text, root, "buffers");
    patch.set_member(jt::elements(text, *array).front(), "byteLength", length);
  }
  draft.container.json = patch.apply();
  draft.container.bin = std::move(bin);
}

// The BIN chunk into a file beside the output.
void unpack_bin(Draft& draft) {
  Container& container = draft.container;
  if (!container.other_chunks.empty()) {
    draft.warnings.push_back(draft.file.string() +
                             ": chunks of the GLB that are neither JSON nor BIN are left out");
    container.other_chunks.clear();
  }
  const json document = json::parse(container.json, nullptr, false);
  const json& buffers = entries(document, "buffers");
  const bool named = container.bin && !buffers.empty() && buffers[0].is_object() &&
                     member(buffers[0], "uri").is_null();
  if (!named) {
    container.bin.reset();
    return;
  }
  const std::string text = container.json;
  jt::Patch patch(text);
  const auto array = jt::find(text, jt::root(text), "buffers");
  patch.set_member(jt::elements(text, *array).front(), "uri",
                   jt::quoted(percent_encoded(draft.free_name)));
  container.json = patch.apply();
  draft.bin_is_side_file = true;
}

}  // namespace

Status change_container(Draft& draft, bool to_binary) {
  if (draft.container.binary == to_binary) return Done{};
  draft.container.binary = to_binary;
  if (!to_binary) {
    unpack_bin(draft);
    return Done{};
  }
  if (auto status = pack_buffers(draft); !status) return status;
  pack_images(draft);
  return Done{};
}

}  // namespace elbowroom::gltf_export
