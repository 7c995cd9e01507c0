// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "core/io/gltf_check_parts.h"

namespace elbowroom::gltf {
namespace {

int components_of(const std::string& type) {
  static constexpr std::array<std::pair<const char*, int>, 7> kTypes{{{"SCALAR", 1},
                                                                      {"VEC2", 2},
                                                                      {"VEC3", 3},
                                                                      {"VEC4", 4},
                                                                      {"MAT2", 4},
                                                                      {"MAT3", 9},
                                                                      {"MAT4", 16}}};
  for (const auto& [name, count] : kTypes) {
    if (type == name) return count;
  }
  return 0;
}

// Bytes of one element. Columns of a matrix start on 4-byte boundaries (glTF 2.0, 3.6.2.4).
std::int64_t element_bytes(const std::string& type, int component) {
  if (type == "MAT2" && component == 1) return 8;
  if (type == "MAT3" && component <= 2) return component == 1 ? 12 : 24;
  return static_cast<std::int64_t>(components_of(type)) * component;
}

class DataCheck {
 public:
  explicit DataCheck(CheckState& state) : state_(state), access_(state.access) {}

  void run() {
    check_buffers();
    check_buffer_views();
    check_accessors();
  }

 private:
  void check_buffers() {
    const Json& buffers = access_.section("buffers");
    Json& reduced = state_.reduced["buffers"] = Json::array();
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      const Json& buffer = buffers[i];
      const std::string part = part_name("buffer", i, name_of(buffer));
      const auto length = static_cast<std::uint64_t>(
          access_.integer(buffer, "byteLength", part, 0, std::int64_t{1} << 53, std::nullopt));
      const Json* uri = member(buffer, "uri");
      if (uri && !uri->is_string()) access_.refuse_part(part, "its \"uri\" is no text");
      Bytes bytes;
      bool absent = false;
      if (uri && is_data_uri(uri->get_ref<const std::string&>())) {
        bytes = decode_data_uri(uri->get_ref<const std::string&>(), length, access_.in_file(part));
      } else if (uri) {
        bytes = state_.folder.read_uri(uri->get<std::string>(), length, access_.in_file(part));
      } else if (i == 0 && state_.container.has_binary) {
        const std::size_t take = std::min<std::uint64_t>(length, state_.container.binary.size());
        bytes.assign(state_.container.binary.begin(),
                     state_.container.binary.begin() + static_cast<std::ptrdiff_t>(take));
      } else {
        absent = true;  // legal while nothing reads it: the place compressed data unpacks to
      }
      if (!absent && bytes.size() < length) {
        refuse(access_.in_file(part),
               "it should hold " + std::to_string(length) + " bytes, but there are " +
                   std::to_string(bytes.size()),
               "the data is cut short; export or download it again");
      }
      state_.out.total_bytes += bytes.size();
      absent_.push_back(absent);
      lengths_.push_back(length);
      if (bytes.empty()) bytes.push_back(0);  // tinygltf refuses an empty buffer, even unused
      reduced.push_back({{"byteLength", bytes.size()}, {"uri", "buffer/" + std::to_string(i)}});
      state_.out.buffers.push_back(std::move(bytes));
    }
  }

  void check_buffer_views() {
    const Json& views = access_.section("bufferViews");
    Json& reduced = state_.reduced["bufferViews"] = Json::array();
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Json& view = views[i];
      const std::string part = part_name("bufferView", i, name_of(view));
      const int buffer = access_.required_index(view, "buffer", part, lengths_.size());
      const auto limit = static_cast<std::int64_t>(lengths_[static_cast<std::size_t>(buffer)]);
      const std::int64_t offset = access_.integer(view, "byteOffset", part, 0, limit, 0);
      const std::int64_t length =
          access_.integer(view, "byteLength", part, 0, limit - offset, std::nullopt);
      const std::int64_t stride = access_.integer(view, "byteStride", part, 0, 252, 0);
      if (stride % 4 != 0) access_.refuse_part(part, "its byteStride is no multiple of 4");
      std::string unusable;
      if (absent_[static_cast<std::size_t>(buffer)]) {
        unusable = "buffer " + std::to_string(buffer) + " has no data";
        if (const Json* extensions = member(view, "extensions")) {
          for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
            if (member(*extensions, name)) unusable = std::string("its data is packed by ") + name;
          }
        }
      }
      view_unusable_.push_back(unusable);
      view_lengths_.push_back(length);
      view_strides_.push_back(stride);
      Json entry = {{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", length}};
      if (stride > 0) entry["byteStride"] = stride;
      reduced.push_back(std::move(entry));
    }
  }

  void check_range(const std::string& part, int view, std::int64_t offset, std::int64_t count,
                   std::int64_t element, bool strided) {
    const auto v = static_cast<std::size_t>(view);
    const std::int64_t stride = strided && view_strides_[v] > 0 ? view_strides_[v] : element;
    if (stride < element) {
      access_.refuse_part(part, "its elements of " + std::to_string(element) +
                                    " bytes overlap at a byteStride of " + std::to_string(stride));
    }
    // count is below 2^53 / 64, so nothing overflows.
    if (count > 0 && offset + (count - 1) * stride + element > view_lengths_[v]) {
      access_.refuse_part(part, "it runs past the end of bufferView " + std::to_string(view));
    }
  }

  void check_accessors() {
    const Json& accessors = access_.section("accessors");
    Json& reduced = state_.reduced["accessors"] = Json::array();
    const std::size_t views = view_lengths_.size();
    for (std::size_t i = 0; i < accessors.size(); ++i) {
      const Json& accessor = accessors[i];
      const std::string part = part_name("accessor", i, name_of(accessor));
      std::string unusable;
      const std::int64_t count =
          access_.integer(accessor, "count", part, 0, std::int64_t{1} << 32, std::nullopt);
      const auto component_type = static_cast<int>(
          access_.integer(accessor, "componentType", part, 0, 1 << 20, std::nullopt));
      const Json* type_text = member(accessor, "type");
      if (!type_text || !type_text->is_string()) access_.refuse_part(part, "it has no \"type\"");
      const std::string type = type_text->get<std::string>();
      const int component = component_bytes(component_type);
      if (component == 0 || components_of(type) == 0) {
        unusable = "accessor " + std::to_string(i) + " has an unknown type";
      }
      const int view = access_.index(accessor, "bufferView", part, views);
      const std::int64_t offset =
          access_.integer(accessor, "byteOffset", part, 0, std::int64_t{1} << 50, 0);
      const Json* sparse = member(accessor, "sparse");
      if (unusable.empty() && view >= 0) {
        check_range(part, view, offset, count, element_bytes(type, component), true);
        unusable = view_unusable_[static_cast<std::size_t>(view)];
      }
      // Without a bufferView it is all zeros, and only the rest of the file says how many are
      // plausible.
      if (view < 0 && count > static_cast<std::int64_t>(state_.out.total_bytes) + 65536) {
        access_.refuse_part(part,
                            "it claims " + std::to_string(count) + " elements without any data");
      }
      const Json* normalized = member(accessor, "normalized");
      Json entry = {{"componentType", 5126}, {"count", 0}, {"type", "SCALAR"}};
      if (unusable.empty()) {
        entry = {{"componentType", component_type},
                 {"count", count},
                 {"type", type},
                 {"byteOffset", offset},
                 {"normalized", normalized && normalized->is_boolean() && normalized->get<bool>()}};
        put_index(entry, "bufferView", view);
        if (sparse) {
          entry["sparse"] =
              check_sparse(*sparse, part, count, element_bytes(type, component), unusable);
        }
      }
      reduced.push_back(std::move(entry));
      state_.out.unusable.push_back(std::move(unusable));
    }
  }

  Json check_sparse(const Json& sparse, const std::string& part, std::int64_t most,
                    std::int64_t element, std::string& unusable) {
    const std::size_t views = view_lengths_.size();
    const std::int64_t count = access_.integer(sparse, "count", part, 0, most, std::nullopt);
    const Json* indices = member(sparse, "indices");
    const Json* values = member(sparse, "values");
    if (!indices || !values) access_.refuse_part(part, "its sparse part has no indices or values");
    const auto type = static_cast<int>(
        access_.integer(*indices, "componentType", part, 0, 1 << 20, std::nullopt));
    if (type != 5121 && type != 5123 && type != 5125) {
      access_.refuse_part(part, "its sparse indices are no unsigned integers");
    }
    constexpr std::int64_t kFar = std::int64_t{1} << 30;
    Json out = {{"count", count}};
    for (const auto& [key, object, bytes] :
         {std::tuple{"indices", indices, std::int64_t{component_bytes(type)}},
          std::tuple{"values", values, element}}) {
      const int view = access_.required_index(*object, "bufferView", part, views);
      const std::int64_t offset = access_.integer(*object, "byteOffset", part, 0, kFar, 0);
      check_range(part, view, offset, count, bytes, false);
      if (unusable.empty()) unusable = view_unusable_[static_cast<std::size_t>(view)];
      out[key] = {{"bufferView", view}, {"byteOffset", offset}};
    }
    out["indices"]["componentType"] = type;
    return out;
  }

  CheckState& state_;
  const JsonAccess& access_;
  std::vector<std::uint64_t> lengths_;  // by buffer, as declared
  std::vector<bool> absent_;            // by buffer: no data in the file
  std::vector<std::string> view_unusable_;
  std::vector<std::int64_t> view_lengths_, view_strides_;
};

}  // namespace

int component_bytes(int component_type) {
  switch (component_type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

void check_data(CheckState& state) { DataCheck(state).run(); }

}  // namespace elbowroom::gltf
