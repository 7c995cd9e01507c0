// SPDX-License-Identifier: MIT
#include "core/io/gltf_append.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/io/json_text.h"
#include "core/io/json_values.h"

static_assert(std::endian::native == std::endian::little, "glTF data is little-endian");

namespace elbowroom::gltf_export {
namespace {

using json_text::json;
using json_text::member;
using json_text::whole_number;
namespace jt = json_text;

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

// An index, -1 if it is none.
int index_of(const json& value) {
  const auto wide = whole_number(value);
  return wide && *wide < 0x7FFFFFFF ? static_cast<int>(*wide) : -1;
}

const char* path_name(Path path) {
  switch (path) {
    case Path::translation:
      return "translation";
    case Path::rotation:
      return "rotation";
    case Path::scale:
      return "scale";
    case Path::weights:
      return "weights";
  }
  return "";
}

const char* interpolation_name(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::linear:
      return "LINEAR";
    case Interpolation::step:
      return "STEP";
    case Interpolation::cubic_spline:
      return "CUBICSPLINE";
  }
  return "";
}

// The appending of entries to the root's arrays, which may not exist yet.
class Appender {
 public:
  explicit Appender(const std::string& text) : text_(text), root_(jt::root(text)), patch_(text) {}

  // How many entries the array has, those appended included; -1 if the key holds no array.
  int count(const char* key) const {
    const auto array = jt::find(text_, root_, key);
    if (array && !jt::is_array(text_, *array)) return -1;
    const auto waiting = added_.find(key);
    return static_cast<int>((array ? jt::elements(text_, *array).size() : 0) +
                            (waiting == added_.end() ? 0 : waiting->second.size()));
  }
  // Index of the new entry.
  int add(const std::string& key, std::string entry) {
    const int index = count(key.c_str());
    added_[key].push_back(std::move(entry));
    return index;
  }
  jt::Patch& patch() { return patch_; }
  std::string apply() {
    for (const auto& [key, entries] : added_) {
      if (const auto array = jt::find(text_, root_, key)) {
        patch_.append(*array, entries);
      } else {
        std::string all;
        for (const std::string& entry : entries) all += (all.empty() ? "" : ",") + entry;
        patch_.set_member(root_, key, "[" + all + "]");
      }
    }
    return patch_.apply();
  }

 private:
  const std::string& text_;
  jt::Span root_;
  jt::Patch patch_;
  std::map<std::string, std::vector<std::string>> added_;
};

Error wrong(const Draft& draft, const std::string& what, const std::string& where = "",
            const std::string& remedy = "") {
  return Error{what, draft.file.string() + (where.empty() ? "" : ", " + where), remedy};
}

// Where the corrected keys' bytes go.
struct Room {
  enum class Kind { bin, side_file, data_uri } kind = Kind::bin;
  int buffer = 0;           // index of the buffer
  bool new_buffer = false;  // it has no entry yet
  std::size_t offset = 0;   // in that buffer
};

Result<Room> find_room(const Draft& draft, const json& document) {
  const json& buffers = member(document, "buffers");
  const Container& container = draft.container;
  Room room;
  room.buffer = static_cast<int>(buffers.size());
  room.new_buffer = true;
  if (buffers.empty()) {
    room.kind = container.binary ? Room::Kind::bin : Room::Kind::side_file;
    // A BIN chunk that no buffer names is kept before the new bytes all the same.
    if (container.binary && container.bin) room.offset = (container.bin->size() + 3) / 4 * 4;
    return room;
  }
  const json& first = buffers.front();
  bool fallback = false;
  for (const auto& [name, extension] : member(first, "extensions").items()) {
    fallback = fallback || member(extension, "fallback") == true;
  }
  const bool has_uri = !member(first, "uri").is_null();
  if (container.bin && !fallback && (draft.bin_is_side_file || (container.binary && !has_uri))) {
    const auto length = whole_number(member(first, "byteLength"));
    if (!length || *length > container.bin->size()) {
      return wrong(draft, "the first buffer is longer than the BIN chunk", "/buffers/0");
    }
    room.kind = draft.bin_is_side_file ? Room::Kind::side_file : Room::Kind::bin;
    room.buffer = 0;
    room.new_buffer = false;
    room.offset = (container.bin->size() + 3) / 4 * 4;
    return room;
  }
  const bool any_external = std::any_of(buffers.begin(), buffers.end(), [](const json& buffer) {
    const json& uri = member(buffer, "uri");
    return uri.is_string() && !is_data_uri(uri.get_ref<const std::string&>());
  });
  room.kind = any_external ? Room::Kind::side_file : Room::Kind::data_uri;
  return room;
}

// The bytes of accessors made so far, each at a multiple of 4.
struct Bytes {
  std::string data;
  std::size_t add(const std::vector<float>& values) {
    const std::size_t at = data.size();
    data.resize(at + values.size() * sizeof(float));
    std::memcpy(data.data() + at, values.data(), values.size() * sizeof(float));
    return at;
  }
};

Status check_channel(const Draft& draft, const json& document, const Channel& channel) {
  const std::string where = "node " + std::to_string(channel.joint);
  const json& nodes = member(document, "nodes");
  if (channel.joint < 0 || static_cast<std::size_t>(channel.joint) >= nodes.size()) {
    return wrong(draft, "there is no such node", where);
  }
  if (!member(nodes[static_cast<std::size_t>(channel.joint)], "matrix").is_null()) {
    return wrong(draft, "the node has a matrix, so it can't be animated", where,
                 "give it translation, rotation and scale instead");
  }
  const int components = channel.path == Path::rotation  ? 4
                         : channel.path == Path::weights ? channel.components
                                                         : 3;
  const std::size_t per_key = static_cast<std::size_t>(std::max(components, 0)) *
                              (channel.interpolation == Interpolation::cubic_spline ? 3 : 1);
  if (components < 1 || channel.components != components || channel.times.empty() ||
      channel.values.size() != per_key * channel.times.size()) {
    return wrong(draft, "a corrected channel has the wrong number of values", where);
  }
  for (std::size_t i = 0; i < channel.times.size(); ++i) {
    if (!std::isfinite(channel.times[i]) || (i > 0 && !(channel.times[i] > channel.times[i - 1]))) {
      return wrong(draft, "the times of a corrected channel do not increase", where);
    }
  }
  for (const float value : channel.values) {
    if (!std::isfinite(value)) {
      return wrong(draft, "a corrected channel holds a value that is not finite", where);
    }
  }
  return Done{};
}

struct NewAccessors {
  Bytes times, values;
  std::vector<std::pair<std::vector<float>, int>> inputs;  // times -> accessor
  std::vector<std::string> pending;                        // with %T or %V for the buffer view
};

// Text of the new animation; its accessors are added to `made`, numbered from `first_accessor`.
Result<std::string> animation_text(const Draft& draft, const CorrectedClip& clip,
                                   const std::string& name, int first_accessor,
                                   NewAccessors& made) {
  const std::string& text = draft.container.json;
  const std::string where = "/animations/" + std::to_string(clip.source_animation);
  const auto animations = jt::find(text, jt::root(text), "animations");
  const auto all = animations ? jt::elements(text, *animations) : std::vector<jt::Span>{};
  if (clip.source_animation < 0 || static_cast<std::size_t>(clip.source_animation) >= all.size()) {
    return wrong(draft, "there is no such animation", where);
  }
  const std::string source(jt::view(text, all[static_cast<std::size_t>(clip.source_animation)]));
  const jt::Span whole = jt::root(source);
  const auto channels = jt::find(source, whole, "channels");
  const auto samplers = jt::find(source, whole, "samplers");
  if (!channels || !samplers) return wrong(draft, "the animation has no channels", where);

  std::vector<std::string> sampler_texts;
  for (const jt::Span span : jt::elements(source, *samplers)) {
    sampler_texts.emplace_back(jt::view(source, span));
  }
  struct OldChannel {
    std::string text;
    int sampler = -1;
    int changed = -1;  // index in clip.changed
    bool dropped = false;
  };
  std::vector<OldChannel> old_channels;
  std::set<int> used;  // samplers that untouched channels keep
  std::vector<bool> placed(clip.changed.size(), false);
  for (const jt::Span span : jt::elements(source, *channels)) {
    OldChannel old;
    old.text = jt::view(source, span);
    const json parsed = json::parse(old.text, nullptr, false);
    const json& target = member(parsed, "target");
    old.sampler = index_of(member(parsed, "sampler"));
    if (old.sampler < 0 || static_cast<std::size_t>(old.sampler) >= sampler_texts.size()) {
      return wrong(draft, "a channel has no sampler", where);
    }
    for (std::size_t i = 0; i < clip.changed.size(); ++i) {
      if (index_of(member(target, "node")) != clip.changed[i].joint ||
          member(target, "path") != path_name(clip.changed[i].path)) {
        continue;
      }
      // A file that animates one property twice is out of order; the copy must not show the old
      // one.
      old.dropped = placed[i];
      old.changed = static_cast<int>(i);
      placed[i] = true;
    }
    if (old.changed < 0) used.insert(old.sampler);
    old_channels.push_back(std::move(old));
  }

  const auto make_sampler = [&](const Channel& channel) {
    const auto accessor = [&](std::string entry) {
      made.pending.push_back(std::move(entry));
      return first_accessor + static_cast<int>(made.pending.size()) - 1;
    };
    int input = -1;
    for (const auto& [times, index] : made.inputs) {
      if (times == channel.times) input = index;
    }
    if (input < 0) {
      const std::size_t at = made.times.add(channel.times);
      input = accessor("{\"bufferView\":%T,\"byteOffset\":" + std::to_string(at) +
                       ",\"componentType\":5126,\"count\":" + std::to_string(channel.times.size()) +
                       ",\"type\":\"SCALAR\",\"min\":[" + number(channel.times.front()) +
                       "],\"max\":[" + number(channel.times.back()) + "]}");
      made.inputs.emplace_back(channel.times, input);
    }
    const std::size_t at = made.values.add(channel.values);
    const bool scalar = channel.path == Path::weights;
    const std::size_t count =
        channel.values.size() / (scalar ? 1 : static_cast<std::size_t>(channel.components));
    const char* type = scalar ? "SCALAR" : (channel.components == 4 ? "VEC4" : "VEC3");
    const int output = accessor("{\"bufferView\":%V,\"byteOffset\":" + std::to_string(at) +
                                ",\"componentType\":5126,\"count\":" + std::to_string(count) +
                                ",\"type\":\"" + type + "\"}");
    return "{\"input\":" + std::to_string(input) + ",\"interpolation\":\"" +
           interpolation_name(channel.interpolation) + "\",\"output\":" + std::to_string(output) +
           "}";
  };

  std::vector<std::string> channel_texts;
  const auto put_sampler = [&](const Channel& channel, int old_sampler) {
    std::string made_text = make_sampler(channel);
    // Takes the place of the sampler that nobody uses any more, so that none is left unused.
    if (old_sampler >= 0 && used.insert(old_sampler).second) {
      sampler_texts[static_cast<std::size_t>(old_sampler)] = std::move(made_text);
      return old_sampler;
    }
    sampler_texts.push_back(std::move(made_text));
    return static_cast<int>(sampler_texts.size()) - 1;
  };
  for (const OldChannel& old : old_channels) {
    if (old.dropped) continue;
    if (old.changed < 0) {
      channel_texts.push_back(old.text);
      continue;
    }
    const int sampler =
        put_sampler(clip.changed[static_cast<std::size_t>(old.changed)], old.sampler);
    jt::Patch patch(old.text);
    patch.set_member(jt::root(old.text), "sampler", std::to_string(sampler));
    channel_texts.push_back(patch.apply());
  }
  for (std::size_t i = 0; i < clip.changed.size(); ++i) {
    if (placed[i]) continue;
    const int sampler = put_sampler(clip.changed[i], -1);
    channel_texts.push_back("{\"sampler\":" + std::to_string(sampler) +
                            ",\"target\":{\"node\":" + std::to_string(clip.changed[i].joint) +
                            ",\"path\":\"" + path_name(clip.changed[i].path) + "\"}}");
  }

  const auto joined = [](const std::vector<std::string>& parts) {
    std::string all = "[";
    for (const std::string& part : parts) all += (all.size() > 1 ? "," : "") + part;
    return all + "]";
  };
  jt::Patch patch(source);
  patch.replace(*channels, joined(channel_texts));
  patch.replace(*samplers, joined(sampler_texts));
  patch.set_member(whole, "name", jt::quoted(name));
  return patch.apply();
}

std::string new_name(const json& document, const CorrectedClip& clip,
                     std::set<std::string>& taken) {
  std::string base = clip.name;
  std::string tail;
  if (base.empty()) {
    const json& animations = member(document, "animations");
    const auto index = static_cast<std::size_t>(clip.source_animation);
    const json& name = index < animations.size() ? member(animations[index], "name") : json();
    base = name.is_string() && !name.get_ref<const std::string&>().empty()
               ? name.get<std::string>()
               : "animation " + std::to_string(clip.source_animation);
    tail = "corrected";
  }
  for (int i = 1;; ++i) {
    const std::string count = i == 1 ? "" : std::to_string(i);
    const std::string name = tail.empty() ? base + (i == 1 ? "" : " (" + count + ")")
                                          : base + " (" + tail + (i == 1 ? "" : " " + count) + ")";
    if (taken.insert(name).second) return name;
  }
}

}  // namespace

Status append_animations(Draft& draft, const std::vector<CorrectedClip>& clips,
                         std::vector<ExportedAnimation>& appended) {
  const std::string text = draft.container.json;
  const json document = json::parse(text, nullptr, false);
  for (const char* key : {"accessors", "bufferViews", "buffers", "animations", "nodes"}) {
    const json& array = member(document, key);
    if (!array.is_null() && !array.is_array()) {
      return wrong(draft, "is not an array", std::string("/") + key);
    }
  }
  const auto room = find_room(draft, document);
  if (!room) return room.error();

  Appender appender(text);
  std::set<std::string> taken;
  for (const json& animation : member(document, "animations")) {
    const json& name = member(animation, "name");
    if (name.is_string()) taken.insert(name.get<std::string>());
  }
  NewAccessors made;
  const int first_accessor = appender.count("accessors");
  std::vector<std::string> animations;
  for (const CorrectedClip& clip : clips) {
    if (clip.changed.empty()) continue;
    std::set<std::pair<int, Path>> targets;
    for (const Channel& channel : clip.changed) {
      if (auto status = check_channel(draft, document, channel); !status) return status;
      if (!targets.emplace(channel.joint, channel.path).second) {
        return wrong(draft, "two corrected channels animate the same property",
                     "node " + std::to_string(channel.joint));
      }
    }
    const std::string name = new_name(document, clip, taken);
    auto animation = animation_text(draft, clip, name, first_accessor, made);
    if (!animation) return animation.error();
    appended.push_back({name, appender.add("animations", *std::move(animation))});
  }
  if (appended.empty()) return Done{};

  // One view of all times, one of all values behind it.
  const auto view = [&](std::size_t offset, std::size_t length) {
    return appender.add("bufferViews", "{\"buffer\":" + std::to_string(room->buffer) +
                                           ",\"byteOffset\":" + std::to_string(offset) +
                                           ",\"byteLength\":" + std::to_string(length) + "}");
  };
  const std::string data = made.times.data + made.values.data;
  const int times_view = view(room->offset, made.times.data.size());
  const int values_view = view(room->offset + made.times.data.size(), made.values.data.size());
  for (std::string& accessor : made.pending) {
    const std::size_t at = accessor.find('%');
    accessor.replace(at, 2, std::to_string(accessor[at + 1] == 'T' ? times_view : values_view));
    appender.add("accessors", std::move(accessor));
  }

  const std::uint64_t length = room->offset + data.size();
  const auto put_in_bin = [&] {
    std::string bin = draft.container.bin.value_or("");
    bin.resize(room->offset, '\0');
    draft.container.bin = bin + data;
  };
  if (!room->new_buffer) {
    put_in_bin();
    const auto buffers = jt::find(text, jt::root(text), "buffers");
    appender.patch().set_member(jt::elements(text, *buffers).front(), "byteLength",
                                std::to_string(length));
  } else if (room->kind == Room::Kind::bin) {
    put_in_bin();
    appender.add("buffers", "{\"byteLength\":" + std::to_string(length) + "}");
  } else {
    std::string uri;
    if (room->kind == Room::Kind::side_file) {
      uri = percent_encoded(draft.free_name);
      draft.side_files.push_back({draft.free_name, data});
    } else {
      uri = encode_data_uri("application/octet-stream", data);
    }
    appender.add("buffers",
                 "{\"uri\":" + jt::quoted(uri) + ",\"byteLength\":" + std::to_string(length) + "}");
  }
  draft.container.json = appender.apply();
  return Done{};
}

}  // namespace elbowroom::gltf_export
