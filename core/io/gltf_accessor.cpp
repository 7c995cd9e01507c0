// SPDX-License-Identifier: MIT
// Accessors to plain arrays: strides, unaligned data, normalized integers, sparse replacement.
// Ranges were checked by gltf_check_data.cpp; only sparse indices, which are data, are checked
// here.
#include <algorithm>
#include <cstddef>
#include <cstring>

#include "core/io/gltf_parse.h"

namespace elbowroom::gltf {
namespace {

template <typename T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));  // files need not align
  return value;
}

float to_float(const unsigned char* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const auto v = static_cast<float>(load<std::int8_t>(bytes));
      return normalized ? std::max(v / 127.0f, -1.0f) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const auto v = static_cast<float>(load<std::uint8_t>(bytes));
      return normalized ? v / 255.0f : v;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const auto v = static_cast<float>(load<std::int16_t>(bytes));
      return normalized ? std::max(v / 32767.0f, -1.0f) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const auto v = static_cast<float>(load<std::uint16_t>(bytes));
      return normalized ? v / 65535.0f : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return static_cast<float>(load<std::uint32_t>(bytes));
    default:
      return load<float>(bytes);
  }
}

std::uint32_t to_integer(const unsigned char* bytes, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
};

Elements elements_of(const tinygltf::Model& model, int view_index, std::size_t offset,
                     std::size_t element, bool strided) {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  const tinygltf::Buffer& buffer = model.buffers[static_cast<std::size_t>(view.buffer)];
  return {buffer.data.data() + view.byteOffset + offset,
          strided && view.byteStride > 0 ? view.byteStride : element};
}

// `convert(bytes)` makes one component.
template <typename T, typename Convert>
std::vector<T> read_elements(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                             int components, const std::string& where, const Convert& convert) {
  const auto width = static_cast<std::size_t>(component_bytes(accessor.componentType));
  const auto count = static_cast<std::size_t>(components);
  const std::size_t element = width * count;
  std::vector<T> out(accessor.count * count, T{});
  const auto copy = [&](const unsigned char* bytes, std::size_t to) {
    for (std::size_t c = 0; c < count; ++c) out[to * count + c] = convert(bytes + c * width);
  };
  if (accessor.bufferView >= 0) {
    const Elements from =
        elements_of(model, accessor.bufferView, accessor.byteOffset, element, true);
    for (std::size_t i = 0; i < accessor.count; ++i) copy(from.first + i * from.stride, i);
  }
  if (!accessor.sparse.isSparse) return out;
  const auto& sparse = accessor.sparse;
  const int index_type = sparse.indices.componentType;
  const auto index_width = static_cast<std::size_t>(component_bytes(index_type));
  const Elements indices =
      elements_of(model, sparse.indices.bufferView,
                  static_cast<std::size_t>(sparse.indices.byteOffset), index_width, false);
  const Elements values =
      elements_of(model, sparse.values.bufferView,
                  static_cast<std::size_t>(sparse.values.byteOffset), element, false);
  for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
    const std::uint32_t to = to_integer(indices.first + i * index_width, index_type);
    if (to >= accessor.count) {
      refuse(where,
             "a sparse accessor replaces element " + std::to_string(to) + " of " +
                 std::to_string(accessor.count),
             "export the file again");
    }
    copy(values.first + i * element, to);
  }
  return out;
}

const tinygltf::Accessor& usable(const tinygltf::Model& model, const Checked& checked, int index,
                                 int components, const std::string& what,
                                 const std::string& where) {
  const std::string& reason = checked.unusable[static_cast<std::size_t>(index)];
  if (!reason.empty()) {
    refuse(where, what + " can't be read: " + reason,
           "export the file again without compression or extensions");
  }
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const int type = accessor.type;
  const int own = type == TINYGLTF_TYPE_SCALAR ? 1
                  : type == TINYGLTF_TYPE_MAT4 ? 16
                  : type <= TINYGLTF_TYPE_VEC4 ? type
                                               : 0;
  if (own != components) {
    refuse(where, what + " have the wrong type", "export the file again");
  }
  return accessor;
}

}  // namespace

std::vector<float> read_floats(const tinygltf::Model& model, const Checked& checked, int index,
                               int components, bool always_normalized, const std::string& what,
                               const std::string& where) {
  const tinygltf::Accessor& accessor = usable(model, checked, index, components, what, where);
  const int type = accessor.componentType;
  const bool normalized = accessor.normalized || always_normalized;
  return read_elements<float>(
      model, accessor, components, where,
      [type, normalized](const unsigned char* bytes) { return to_float(bytes, type, normalized); });
}

std::vector<std::uint32_t> read_integers(const tinygltf::Model& model, const Checked& checked,
                                         int index, int components, const std::string& what,
                                         const std::string& where) {
  const tinygltf::Accessor& accessor = usable(model, checked, index, components, what, where);
  const int type = accessor.componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    refuse(where, what + " are no unsigned integers", "export the file again");
  }
  return read_elements<std::uint32_t>(
      model, accessor, components, where,
      [type](const unsigned char* bytes) { return to_integer(bytes, type); });
}

}  // namespace elbowroom::gltf
